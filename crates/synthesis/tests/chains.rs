//! Chains and their inversions against the published counts (Tsai, Mechanism Design, 2001, appendix D).

use linkdyn_synthesis::chains::{chains, inversions, name};

#[test]
fn there_are_as_many_chains_as_published() {
    let of = |bodies| {
        let all = chains(bodies);
        let mechanisms: usize = all.iter().map(|chain| inversions(chain).len()).sum();
        (all.len(), mechanisms)
    };
    assert_eq!(
        [4, 6, 8, 10].map(of),
        [(1, 1), (2, 5), (16, 71), (230, 1834)]
    );
    assert!(chains(5).is_empty());
}

#[test]
fn the_six_bars_have_their_names() {
    let mut names: Vec<_> = chains(6)
        .iter()
        .flat_map(|chain| {
            inversions(chain)
                .into_iter()
                .map(|fixed| name(chain, fixed))
                .collect::<Vec<_>>()
        })
        .flatten()
        .collect();
    names.sort_unstable();
    assert_eq!(
        names,
        [
            "stephenson_1",
            "stephenson_2",
            "stephenson_3",
            "watt_1",
            "watt_2"
        ]
    );
}
