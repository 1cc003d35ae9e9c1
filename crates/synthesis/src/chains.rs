//! Kinematic chains with one freedom: which bodies are pinned to which.
//!
//! n bodies have (3n − 4)/2 pins. No part of a chain is rigid, and none hangs on one body or one pin alone. Bodies with more than two
//! pins and the rows of bodies between them make a multigraph; all of them are counted up, and bodies with two pins are dealt out to its
//! edges in all ways (Franke's notation: Tsai, Mechanism Design, 2001, ch. 4). There are 1, 2, 16, 230 chains of 4, 6, 8, 10 bodies, and
//! 1, 5, 71, 1834 mechanisms with one body fixed.

use petgraph::algo::is_isomorphic_matching;
use petgraph::graph::UnGraph;

/// Which bodies are pinned to each other.
pub type Chain = UnGraph<(), ()>;

/// Most bodies that are counted up.
pub const MOST_BODIES: usize = 10;

/// All chains with so many bodies.
pub fn chains(bodies: usize) -> Vec<Chain> {
    if bodies < 4 || !bodies.is_multiple_of(2) {
        return Vec::new();
    }
    let excess = bodies - 4;
    if excess == 0 {
        let ring = [(0, 1), (1, 2), (2, 3), (3, 0)];
        return vec![Chain::from_edges(ring)];
    }
    let mut found: Vec<(Vec<usize>, Chain)> = Vec::new();
    for degrees in partitions(excess, excess) {
        let degrees: Vec<usize> = degrees.iter().map(|more| more + 2).collect();
        for graph in multigraphs(&degrees) {
            deal(&graph, bodies - degrees.len(), &mut |chain| {
                if is_chain(chain) {
                    let key = invariant(chain);
                    let mut like = found.iter().filter(|(own, _)| *own == key);
                    if !like.any(|(_, own)| same(own, chain, &[], &[])) {
                        found.push((key, chain.clone()));
                    }
                }
            });
        }
    }
    found.into_iter().map(|(_, chain)| chain).collect()
}

/// Ways to write a number as a sum of numbers not larger than `most`, each falling.
fn partitions(of: usize, most: usize) -> Vec<Vec<usize>> {
    if of == 0 {
        return vec![Vec::new()];
    }
    let with = |first: usize| {
        let rest = partitions(of - first, first).into_iter();
        rest.map(move |rest| [vec![first], rest].concat())
    };
    (1..=of.min(most)).flat_map(with).collect()
}

/// Edges between bodies with these numbers of pins, several between the same two, none from a body to itself; each graph once.
fn multigraphs(degrees: &[usize]) -> Vec<UnGraph<(), usize>> {
    let mut found: Vec<UnGraph<(), usize>> = Vec::new();
    let count = degrees.len();
    let pairs: Vec<(usize, usize)> = (0..count)
        .flat_map(|a| (a + 1..count).map(move |b| (a, b)))
        .collect();
    let mut stack = vec![(0, degrees.to_vec(), Vec::<usize>::new())];
    while let Some((at, left, times)) = stack.pop() {
        let Some(&(a, b)) = pairs.get(at) else {
            if left.iter().any(|left| *left > 0) {
                continue;
            }
            let edges = pairs.iter().zip(&times).filter(|(_, times)| **times > 0);
            let mut graph = UnGraph::new_undirected();
            let nodes: Vec<_> = (0..count).map(|_| graph.add_node(())).collect();
            for ((a, b), times) in edges {
                graph.add_edge(nodes[*a], nodes[*b], *times);
            }
            let like = |own: &UnGraph<(), usize>| {
                is_isomorphic_matching(own, &graph, |_, _| true, |a, b| a == b)
            };
            if !found.iter().any(like) {
                found.push(graph);
            }
            continue;
        };
        // The last pair of a body takes all that it has left.
        let least = if b + 1 == count { left[a] } else { 0 };
        for own in least..=left[a].min(left[b]) {
            let mut left = left.clone();
            left[a] -= own;
            left[b] -= own;
            stack.push((at + 1, left, [&times[..], &[own]].concat()));
        }
    }
    found
}

/// Deals bodies with two pins out to the edges, at most one edge of a pair without any.
fn deal(graph: &UnGraph<(), usize>, bodies: usize, each: &mut dyn FnMut(&Chain)) {
    let edges: Vec<(usize, usize, bool)> = graph
        .edge_indices()
        .flat_map(|edge| {
            let (a, b) = graph.edge_endpoints(edge).expect("an edge");
            (0..graph[edge]).map(move |k| (a.index(), b.index(), k > 0))
        })
        .collect();
    let mut stack = vec![(bodies, Vec::<usize>::new())];
    while let Some((left, dealt)) = stack.pop() {
        let Some(&(_, _, is_further)) = edges.get(dealt.len()) else {
            if left == 0 {
                each(&chain(graph.node_count(), &edges, &dealt));
            }
            continue;
        };
        // Edges of the same pair by rising numbers, of which only the first may be 0.
        let least = match dealt.last() {
            Some(last) if is_further => (*last).max(1),
            _ => 0,
        };
        for own in least..=left {
            stack.push((left - own, [&dealt[..], &[own]].concat()));
        }
    }
}

fn chain(nodes: usize, edges: &[(usize, usize, bool)], dealt: &[usize]) -> Chain {
    let mut all = Vec::new();
    let mut next = nodes;
    for ((a, b, _), count) in edges.iter().zip(dealt) {
        let mut at = *a;
        for _ in 0..*count {
            all.push((at as u32, next as u32));
            (at, next) = (next, next + 1);
        }
        all.push((at as u32, *b as u32));
    }
    Chain::from_edges(all)
}

/// Whether no part is rigid and none hangs on one body alone.
fn is_chain(chain: &Chain) -> bool {
    let count = chain.node_count();
    let pairs: Vec<(usize, usize)> = pins(chain);
    let all = 1_usize << count;
    // 3 (k − 1) − 2 e ≥ 1
    let is_rigid = (1..all).filter(|part| part.count_ones() > 1).any(|part| {
        let inside = pairs.iter().filter(|(a, b)| part >> a & part >> b & 1 == 1);
        2 * inside.count() + 4 > 3 * part.count_ones() as usize
    });
    let is_cut = (0..count).any(|without| {
        let mut reached = 1_usize << usize::from(without == 0);
        loop {
            let before = reached;
            for (a, b) in pairs.iter().filter(|(a, b)| *a != without && *b != without) {
                if (reached >> a | reached >> b) & 1 == 1 {
                    reached |= 1 << a | 1 << b;
                }
            }
            if reached == before {
                break;
            }
        }
        reached.count_ones() as usize + 1 < count
    });
    !is_rigid && !is_cut
}

/// The pins, as pairs of bodies.
pub fn pins(chain: &Chain) -> Vec<(usize, usize)> {
    let ends = chain
        .edge_indices()
        .filter_map(|edge| chain.edge_endpoints(edge));
    ends.map(|(a, b)| (a.index(), b.index())).collect()
}

/// What chains of one form have in common: of each body its pins and those of its neighbours, sorted.
fn invariant(chain: &Chain) -> Vec<usize> {
    let degree = |node| chain.neighbors(node).count();
    let of = |node| {
        let mut around: Vec<usize> = chain
            .neighbors(node)
            .map(|next| {
                let further = chain.neighbors(next).map(degree).sum::<usize>();
                100 * degree(next) + further
            })
            .collect();
        around.sort_unstable();
        around
            .iter()
            .fold(degree(node), |sum, own| 1009 * sum % 1_000_003 + own)
    };
    let mut all: Vec<usize> = chain.node_indices().map(of).collect();
    all.sort_unstable();
    all
}

/// Whether two chains are one, with bodies of the first going to those of the second.
fn same(one: &Chain, other: &Chain, own: &[usize], others: &[usize]) -> bool {
    let mark = |chain: &Chain, marked: &[usize]| {
        chain.map(
            |node, ()| marked.iter().position(|own| *own == node.index()),
            |_, ()| (),
        )
    };
    let (one, other) = (mark(one, own), mark(other, others));
    is_isomorphic_matching(&one, &other, |a, b| a == b, |(), ()| true)
}

/// The bodies that can be fixed, one of each kind.
pub fn inversions(chain: &Chain) -> Vec<usize> {
    different(chain, (0..chain.node_count()).map(|body| vec![body]))
        .into_iter()
        .map(|own| own[0])
        .collect()
}

/// Choices of bodies of a chain, one of each kind.
pub fn different(chain: &Chain, choices: impl Iterator<Item = Vec<usize>>) -> Vec<Vec<usize>> {
    let mut found: Vec<Vec<usize>> = Vec::new();
    for own in choices {
        if !found.iter().any(|other| same(chain, chain, &own, other)) {
            found.push(own);
        }
    }
    found
}

/// The name of a chain of six bodies with one of them fixed: `watt_1`, `watt_2`, `stephenson_1` … `stephenson_3`.
pub fn name(chain: &Chain, fixed: usize) -> Option<&'static str> {
    let degree = |body: usize| {
        pins(chain)
            .iter()
            .filter(|(a, b)| *a == body || *b == body)
            .count()
    };
    match chain.node_count() {
        4 => return Some("four_bar"),
        6 => (),
        _ => return None,
    }
    let is_watt = pins(chain)
        .iter()
        .any(|(a, b)| degree(*a) == 3 && degree(*b) == 3);
    let near = pins(chain)
        .into_iter()
        .filter_map(|(a, b)| match (a == fixed, b == fixed) {
            (true, _) => Some(b),
            (_, true) => Some(a),
            _ => None,
        });
    let ternary = near.filter(|body| degree(*body) == 3).count();
    Some(match (is_watt, degree(fixed), ternary) {
        (true, 3, _) => "watt_2",
        (true, ..) => "watt_1",
        (false, 3, _) => "stephenson_3",
        (false, _, 2) => "stephenson_1",
        (false, ..) => "stephenson_2",
    })
}
