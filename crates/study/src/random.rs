//! Philox4x64-10: random numbers by their number, without a state.
//!
//! ```text
//! one round   (c0, c1, c2, c3) ← (hi(M1 c2) ⊕ c1 ⊕ k0, lo(M1 c2), hi(M0 c0) ⊕ c3 ⊕ k1, lo(M0 c0))
//! key         k0 ← k0 + W0, k1 ← k1 + W1 between the rounds, of which there are ten
//! ```
//!
//! Source: Salmon, Moraes, Dror, Shaw, Parallel random numbers: as easy as 1, 2, 3, SC 2011; its published vectors are held by a test.
//!
//! The words are those of `numpy.random.Philox(key=[k0, k1])`. numpy adds one to its counter before each block, so that its word j is
//! word j mod 4 of the block with counter j div 4 + 1. What numpy calls a seed is no key: it makes the two words of the key from it by
//! `SeedSequence(seed).generate_state(2, numpy.uint64)`. Here the first word of a key is the seed as it is, and the second says what the
//! numbers are for ([`Purpose`]).
//!
//! Fixed forever: a study that is repeated in ten years has the same variants.

/// Multipliers of the rounds.
const M: [u64; 2] = [0xD2E7_470E_E14C_6C93, 0xCA5A_8263_9512_1157];
/// What is added to the key between rounds: golden ratio, √3 − 1.
const W: [u64; 2] = [0x9E37_79B9_7F4A_7C15, 0xBB67_AE85_84CA_A73B];
const ROUNDS: usize = 10;

/// What random numbers are for, so that no two purposes share them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// Independent samples.
    MonteCarlo,
    /// Keys of the permutations of a Latin hypercube.
    LatinOrder,
    /// Places within the strata of a Latin hypercube.
    LatinPlace,
    /// Scrambling of Sobol points.
    Scramble,
    /// Resampling of results.
    Bootstrap,
}

impl Purpose {
    /// The second word of the key.
    pub fn word(self) -> u64 {
        match self {
            Purpose::MonteCarlo => 0,
            Purpose::LatinOrder => 1,
            Purpose::LatinPlace => 2,
            Purpose::Scramble => 3,
            Purpose::Bootstrap => 4,
        }
    }
}

/// A family of random words, one block of four for each counter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Philox {
    key: [u64; 2],
}

impl Philox {
    /// The family of a key.
    pub fn new(key: [u64; 2]) -> Self {
        Philox { key }
    }

    /// The family of a seed for one purpose.
    pub fn of(seed: u64, purpose: Purpose) -> Self {
        Philox::new([seed, purpose.word()])
    }

    /// The four words of a counter.
    pub fn block(&self, counter: [u64; 4]) -> [u64; 4] {
        let ([mut c0, mut c1, mut c2, mut c3], [mut k0, mut k1]) = (counter, self.key);
        for round in 0..ROUNDS {
            if round > 0 {
                k0 = k0.wrapping_add(W[0]);
                k1 = k1.wrapping_add(W[1]);
            }
            let (high0, low0) = product(M[0], c0);
            let (high1, low1) = product(M[1], c2);
            [c0, c1, c2, c3] = [high1 ^ c1 ^ k0, low1, high0 ^ c3 ^ k1, low0];
        }
        [c0, c1, c2, c3]
    }

    /// Word `number` of the stream that numpy draws from this key.
    pub fn word(&self, number: u128) -> u64 {
        let block = number / 4 + 1;
        let counter = [block as u64, (block >> 64) as u64, 0, 0];
        self.block(counter)[(number % 4) as usize]
    }
}

/// High and low word of a product.
fn product(a: u64, b: u64) -> (u64, u64) {
    let whole = u128::from(a) * u128::from(b);
    ((whole >> 64) as u64, whole as u64)
}

/// A number in [0, 1) from the upper 53 bits of a word, as `random()` of numpy makes it.
pub fn uniform(word: u64) -> f64 {
    (word >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
}

/// A number in (0, 1), symmetric about 1/2, from the upper 52 bits of a word: for inverse distributions without limits.
pub fn uniform_open(word: u64) -> f64 {
    ((word >> 12) as f64 + 0.5) * (1.0 / (1_u64 << 52) as f64)
}

/// A number below `count` from a word; the odds of any two differ by less than count/2⁶⁴.
pub fn below(word: u64, count: u64) -> u64 {
    product(word, count).0
}

/// A hash: the finaliser of splitmix64 (Steele, Lea, Flood, Fast splittable pseudorandom number generators, OOPSLA 2014).
pub fn mix(word: u64) -> u64 {
    let word = (word ^ word >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let word = (word ^ word >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
    word ^ word >> 31
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `kat_vectors` of Random123, the authors' own code.
    #[test]
    fn blocks_are_the_published_ones() {
        let all = u64::MAX;
        for (key, counter, block) in [
            (
                [0, 0],
                [0; 4],
                [
                    0x1655_4d9e_ca36_314c,
                    0xdb20_fe9d_672d_0fdc,
                    0xd7e7_72ce_e186_176b,
                    0x7e68_b68a_ec7b_a23b,
                ],
            ),
            (
                [all; 2],
                [all; 4],
                [
                    0x87b0_92c3_013f_e90b,
                    0x438c_3c67_be8d_0224,
                    0x9cc7_d7c6_9cd7_77b6,
                    0xa09c_aebf_594f_0ba0,
                ],
            ),
            (
                [0x452821e638d01377, 0xbe5466cf34e90c6c],
                [
                    0x243f_6a88_85a3_08d3,
                    0x1319_8a2e_0370_7344,
                    0xa409_3822_299f_31d0,
                    0x082e_fa98_ec4e_6c89,
                ],
                [
                    0xa528_f454_03e6_1d95,
                    0x38c7_2dbd_566e_9788,
                    0xa5a1_610e_72fd_18b5,
                    0x57bd_43b5_e52b_7fe6,
                ],
            ),
        ] {
            let found = Philox::new(key).block(counter);
            assert_eq!(found, block, "{found:x?}");
        }
    }

    /// numpy 2.4: `Philox(key=[20, 0]).random_raw(6)` and `Generator(Philox(key=[20, 0])).random(6)`.
    #[test]
    fn words_are_those_of_numpy() {
        let philox = Philox::of(20, Purpose::MonteCarlo);
        let expected = [
            (0xdeb2_04ca_26f8_eede, 0.8699038499389392),
            (0xc883_f5a6_519a_7f96, 0.7832635432292622),
            (0x7bfa_12ee_98e4_5460, 0.48428457570197847),
            (0x2d33_df5e_f079_7c97, 0.1765727621827632),
            (0xbcdb_515f_be1a_af30, 0.7377215250727241),
            (0x255c_d60b_8dc0_a93d, 0.14594781667779222),
        ];
        for (number, (word, number_of_it)) in expected.into_iter().enumerate() {
            let found = philox.word(number as u128);
            assert_eq!((found, uniform(found)), (word, number_of_it), "{number}");
        }
    }

    /// numpy: `Philox(12345)` has the key that `SeedSequence(12345)` makes.
    #[test]
    fn a_key_of_numpys_seed_gives_its_words() {
        let philox = Philox::new([0xb5ae_6482_a03d_837c, 0xbbe2_996f_fa1f_7a2f]);
        assert_eq!(philox.word(0), 0x6bb6_8ec5_e088_7940);
        assert_eq!(philox.word(1), 0xa736_3669_9d49_8901);
    }

    #[test]
    fn uniforms_keep_within_their_ends() {
        assert_eq!(uniform(0), 0.0);
        assert_eq!(uniform(u64::MAX), 1.0 - f64::EPSILON / 2.0);
        assert_eq!(uniform_open(0), f64::EPSILON / 2.0);
        assert_eq!(uniform_open(u64::MAX), 1.0 - f64::EPSILON / 2.0);
        assert_eq!(below(u64::MAX, 7), 6);
        assert_eq!(below(0, 7), 0);
    }

    #[test]
    fn purposes_share_no_numbers() {
        let first = |purpose| Philox::of(1, purpose).word(0);
        let all = [
            Purpose::MonteCarlo,
            Purpose::LatinOrder,
            Purpose::LatinPlace,
            Purpose::Scramble,
            Purpose::Bootstrap,
        ];
        for (place, &a) in all.iter().enumerate() {
            for &b in &all[place + 1..] {
                assert_ne!(first(a), first(b), "{a:?} {b:?}");
            }
        }
    }
}
