//! Which variants make a chunk, and who computes it.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use thiserror::Error;

/// Variants in chunks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Plan {
    rows: u64,
    rows_per_chunk: u64,
}

impl Plan {
    /// So many variants in chunks of so many, at least one.
    pub fn new(rows: u64, rows_per_chunk: u64) -> Self {
        Plan {
            rows,
            rows_per_chunk: rows_per_chunk.max(1),
        }
    }

    /// How many variants.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// How many chunks.
    pub fn chunks(&self) -> u64 {
        self.rows.div_ceil(self.rows_per_chunk)
    }

    /// The variants of a chunk.
    pub fn range(&self, chunk: u64) -> Range<u64> {
        let from = chunk.saturating_mul(self.rows_per_chunk).min(self.rows);
        from..from.saturating_add(self.rows_per_chunk).min(self.rows)
    }
}

/// A part of the chunks: `i/n`, counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    index: u64,
    of: u64,
}

/// Why a text is no shard.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ShardFault {
    /// Not two whole numbers.
    #[error("shard \"{0}\": write i/n with two whole numbers, such as 2/7")]
    Form(String),
    /// Not among the shards.
    #[error("shard {index}/{of}: there are shards 1/{of} to {of}/{of}")]
    Range {
        /// Which.
        index: u64,
        /// Of how many.
        of: u64,
    },
    /// No shards at all.
    #[error("shard {0}/0: there must be at least 1 shard")]
    None(u64),
}

impl Shard {
    /// All chunks.
    pub const WHOLE: Shard = Shard { index: 1, of: 1 };

    /// Shard `index` of `of`, counted from 1.
    ///
    /// # Errors
    /// Where there is no such shard.
    pub fn new(index: u64, of: u64) -> Result<Self, ShardFault> {
        match of {
            0 => Err(ShardFault::None(index)),
            _ if index == 0 || index > of => Err(ShardFault::Range { index, of }),
            _ => Ok(Shard { index, of }),
        }
    }

    /// Whether a chunk belongs to it.
    pub fn has(&self, chunk: u64) -> bool {
        chunk % self.of + 1 == self.index
    }
}

impl FromStr for Shard {
    type Err = ShardFault;

    fn from_str(text: &str) -> Result<Self, ShardFault> {
        let numbers = text.split_once('/').and_then(|(index, of)| {
            let number = |text: &str| text.trim().parse::<u64>().ok();
            number(index).zip(number(of))
        });
        let (index, of) = numbers.ok_or_else(|| ShardFault::Form(text.to_string()))?;
        Shard::new(index, of)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    proptest::proptest! {
        #[test]
        fn each_variant_has_one_chunk_and_each_chunk_one_shard(rows in 0..500_u64, per in 1..60_u64, of in 1..9_u64) {
            let plan = Plan::new(rows, per);
            let mut next = 0;
            for chunk in 0..plan.chunks() {
                let range = plan.range(chunk);
                proptest::prop_assert!(range.start == next && range.end > next);
                next = range.end;
                let shards = (1..=of).filter(|&index| Shard::new(index, of).is_ok_and(|shard| shard.has(chunk)));
                proptest::prop_assert_eq!(shards.count(), 1);
            }
            proptest::prop_assert_eq!(next, rows);
        }
    }

    #[test]
    fn shards_are_read_or_refused() {
        assert_eq!(
            "2/7".parse::<Shard>().map(|shard| shard.to_string()),
            Ok("2/7".to_string())
        );
        for (text, complaint) in [
            ("8/7", "shard 8/7: there are shards 1/7 to 7/7"),
            ("0/7", "shard 0/7: there are shards 1/7 to 7/7"),
            ("1/0", "shard 1/0: there must be at least 1 shard"),
            (
                "two",
                "shard \"two\": write i/n with two whole numbers, such as 2/7",
            ),
            (
                "-1/3",
                "shard \"-1/3\": write i/n with two whole numbers, such as 2/7",
            ),
        ] {
            let found = text.parse::<Shard>().expect_err(text).to_string();
            assert_eq!(found, complaint);
        }
    }
}
