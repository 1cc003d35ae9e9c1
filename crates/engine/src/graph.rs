//! Topology of a linkage: bodies are nodes, joints are edges, and two joints may join the same two bodies.
//!
//! ```text
//! islands      connected components; one of them holds ground (body 0)
//! tree         breadth-first from ground, joints in file order: every body's shortest way to ground
//! loops        one per joint that is no tree joint (chord): the shortest one over tree joints and earlier chords
//! mobility     3·(bodies − 1) − Σ constraints        Grübler, planar [–]
//! ```
//!
//! Each loop holds a chord that no loop before it holds, so they are independent, and there are joints − bodies + islands
//! of them. petgraph has no cycle basis, and its `bridges` takes two parallel joints
//! for two bridges, so the tree is grown here, by joint and not by neighbour.

use std::collections::{BTreeSet, VecDeque};

use petgraph::algo::tarjan_scc;
use petgraph::graph::{DiGraph, NodeIndex, UnGraph};
use petgraph::visit::EdgeRef;

/// Index of ground among the bodies.
const GROUND: usize = 0;

/// Nodes that wait for each other, those first that wait for no later ones: strongly connected components (Tarjan, SIAM J. Comput. 1, 1972).
/// `waits` has by node those that it waits for.
pub(crate) fn waiting_groups(waits: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let mut graph = DiGraph::<(), ()>::new();
    let nodes: Vec<NodeIndex> = waits.iter().map(|_| graph.add_node(())).collect();
    for (node, others) in nodes.iter().zip(waits) {
        for other in others {
            graph.update_edge(*node, nodes[*other], ());
        }
    }
    let groups = tarjan_scc(&graph).into_iter();
    let sorted = groups.map(|group| {
        let mut group: Vec<usize> = group.into_iter().map(NodeIndex::index).collect();
        group.sort_unstable();
        group
    });
    sorted.collect()
}

/// The graph of bodies and joints, its islands, spanning tree and loops.
#[derive(Debug, Clone)]
pub struct Topology {
    graph: UnGraph<(), Joint>,
    /// By body: joint and body on the way to the island's root; none at a root.
    parents: Vec<Option<(usize, usize)>>,
    /// By body: number of joints up to the island's root.
    depths: Vec<usize>,
    /// By body: index of its island.
    island_of: Vec<usize>,
    islands: Vec<Island>,
    loops: Vec<Loop>,
}

#[derive(Debug, Clone, Copy)]
struct Joint {
    constraints: usize,
}

/// Bodies that joints connect.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Island {
    /// In breadth-first order from the island's root (ground, or its first body).
    pub bodies: Vec<usize>,
    /// In file order.
    pub joints: Vec<usize>,
    /// Whether ground is one of the bodies.
    pub grounded: bool,
}

/// A closed walk: `bodies[i]` –`joints[i]`– `bodies[i + 1]`, the last joint leads back to `bodies[0]`, the body nearest
/// to the root; walked in the direction whose first joint stands first in the file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Loop {
    /// Its joints.
    pub joints: Vec<usize>,
    /// Its bodies.
    pub bodies: Vec<usize>,
    /// The joint that closes the tree to this loop.
    pub chord: usize,
}

impl Topology {
    /// Topology of `bodies` bodies, ground (always body 0) among them, and of joints (first body, second body, number of constraints).
    ///
    /// # Panics
    /// When a joint names a body that is not there.
    pub fn new(bodies: usize, joints: &[(usize, usize, usize)]) -> Self {
        let mut graph = UnGraph::with_capacity(bodies, joints.len());
        for _ in 0..bodies {
            graph.add_node(());
        }
        for &(first, second, constraints) in joints {
            graph.add_edge(
                NodeIndex::new(first),
                NodeIndex::new(second),
                Joint { constraints },
            );
        }
        let mut topology = Topology {
            graph,
            parents: vec![None; bodies],
            depths: vec![0; bodies],
            island_of: vec![usize::MAX; bodies],
            islands: Vec::new(),
            loops: Vec::new(),
        };
        for root in 0..bodies {
            if topology.island_of[root] == usize::MAX {
                topology.grow_island(root);
            }
        }
        let chords = (0..joints.len()).filter(|&joint| !topology.is_tree_joint(joint));
        topology.loops = chords.map(|chord| topology.close_loop(chord)).collect();
        topology
    }

    /// Number of bodies, ground included.
    pub fn body_count(&self) -> usize {
        self.graph.node_count()
    }

    /// Number of joints.
    pub fn joint_count(&self) -> usize {
        self.graph.edge_count()
    }

    /// Connected components; the first holds ground.
    pub fn islands(&self) -> &[Island] {
        &self.islands
    }

    /// Index of the island of a body.
    pub fn island_of(&self, body: usize) -> usize {
        self.island_of[body]
    }

    /// Independent loops, in the order of their chords.
    pub fn loops(&self) -> &[Loop] {
        &self.loops
    }

    /// Joints of each biconnected part that has loops, in ascending order: those that loops share joints with one another in.
    pub fn parts(&self) -> Vec<Vec<usize>> {
        let mut parts: Vec<BTreeSet<usize>> = Vec::new();
        for closed in &self.loops {
            let mut part: BTreeSet<usize> = closed.joints.iter().copied().collect();
            parts.retain(|other| {
                let apart = part.is_disjoint(other);
                if !apart {
                    part.extend(other);
                }
                apart
            });
            parts.push(part);
        }
        parts
            .into_iter()
            .map(|part| part.into_iter().collect())
            .collect()
    }

    /// Joint and body on the way from `body` to ground (or to its island's root); none at a root.
    pub fn parent(&self, body: usize) -> Option<(usize, usize)> {
        self.parents[body]
    }

    /// Whether the joint is in the spanning tree.
    pub fn is_tree_joint(&self, joint: usize) -> bool {
        let (first, second) = self.ends(joint);
        [first, second]
            .iter()
            .any(|&body| self.parents[body].is_some_and(|(parent_joint, _)| parent_joint == joint))
    }

    /// Moving bodies that no joint holds.
    pub fn unheld_bodies(&self) -> Vec<usize> {
        (1..self.body_count())
            .filter(|&body| self.joints_at(body).is_empty())
            .collect()
    }

    /// Number of joints between the body and ground; `None` if no way leads there.
    pub fn distance(&self, body: usize) -> Option<usize> {
        self.islands[self.island_of[body]]
            .grounded
            .then(|| self.depths[body])
    }

    /// Joints by their distance from ground (that of the nearer body), then in file order; those that no way leads to last.
    pub fn joints_by_distance(&self) -> Vec<usize> {
        let distance = |joint: usize| {
            let (first, second) = self.ends(joint);
            match (self.distance(first), self.distance(second)) {
                (Some(first), Some(second)) => first.min(second),
                (Some(_), None) | (None, Some(_)) | (None, None) => usize::MAX,
            }
        };
        let mut joints: Vec<usize> = (0..self.joint_count()).collect();
        joints.sort_by_key(|&joint| distance(joint));
        joints
    }

    /// Grübler's mobility 3·(moving bodies) − Σ constraints, drivers not counted.
    pub fn mobility(&self) -> i64 {
        let constraints: usize = self
            .graph
            .edge_weights()
            .map(|joint| joint.constraints)
            .sum();
        3 * (self.body_count().saturating_sub(1) as i64) - constraints as i64
    }

    /// A loop as text, by the names of its joints: `a – b – c – d`.
    pub fn loop_name<S: AsRef<str>>(&self, one: &Loop, joint_names: &[S]) -> String {
        let names: Vec<&str> = one
            .joints
            .iter()
            .map(|&joint| joint_names[joint].as_ref())
            .collect();
        names.join(" – ")
    }

    /// All loops as text, by the names of the joints.
    pub fn loop_names<S: AsRef<str>>(&self, joint_names: &[S]) -> Vec<String> {
        self.loops
            .iter()
            .map(|one| self.loop_name(one, joint_names))
            .collect()
    }

    /// The two bodies of a joint, first and second.
    fn ends(&self, joint: usize) -> (usize, usize) {
        let edge = &self.graph.raw_edges()[joint];
        (edge.source().index(), edge.target().index())
    }

    /// Joints at a body, each with the body at its other end, in file order.
    fn joints_at(&self, body: usize) -> Vec<(usize, usize)> {
        let edges = self.graph.edges(NodeIndex::new(body));
        let mut joints: Vec<_> = edges
            .map(|edge| (edge.id().index(), edge.target().index()))
            .collect();
        joints.sort_unstable();
        joints
    }

    /// Grows the spanning tree of the island of `root`, breadth-first.
    fn grow_island(&mut self, root: usize) {
        let island = self.islands.len();
        let mut bodies = vec![root];
        let mut joints = Vec::new();
        let mut queue = VecDeque::from([root]);
        self.island_of[root] = island;
        while let Some(body) = queue.pop_front() {
            for (joint, other) in self.joints_at(body) {
                joints.push(joint);
                if self.island_of[other] != island {
                    self.island_of[other] = island;
                    self.parents[other] = Some((joint, body));
                    self.depths[other] = self.depths[body] + 1;
                    bodies.push(other);
                    queue.push_back(other);
                }
            }
        }
        // Every joint was met from both its ends.
        joints.sort_unstable();
        joints.dedup();
        self.islands.push(Island {
            bodies,
            joints,
            grounded: root == GROUND,
        });
    }

    /// The shortest loop that `chord` closes with the tree and the chords before it.
    fn close_loop(&self, chord: usize) -> Loop {
        let (from, to) = self.ends(chord);
        let mut joints =
            self.shortest_way(from, to, |joint| joint < chord || self.is_tree_joint(joint));
        joints.push(chord);
        // Start at the body nearest to the root.
        let bodies = self.walk(from, &joints);
        let start = (0..bodies.len())
            .min_by_key(|&i| self.depths[bodies[i]])
            .unwrap_or(0);
        joints.rotate_left(start);
        if joints.first() > joints.last() {
            joints.reverse();
        }
        Loop {
            bodies: self.walk(bodies[start], &joints),
            joints,
            chord,
        }
    }

    /// Joints of a shortest way between two bodies over allowed joints, breadth-first; `None` if they are the same.
    fn shortest_way(&self, from: usize, to: usize, allowed: impl Fn(usize) -> bool) -> Vec<usize> {
        let mut back: Vec<Option<(usize, usize)>> = vec![None; self.body_count()];
        let mut queue = VecDeque::from([from]);
        while let Some(body) = queue.pop_front() {
            if body == to {
                break;
            }
            for (joint, other) in self.joints_at(body) {
                if other != from && back[other].is_none() && allowed(joint) {
                    back[other] = Some((joint, body));
                    queue.push_back(other);
                }
            }
        }
        let mut joints: Vec<usize> = std::iter::successors(back[to], |&(_, body)| back[body])
            .map(|step| step.0)
            .collect();
        joints.reverse();
        joints
    }

    /// The bodies met from `start` along `joints`, the last one (back at the start) left out.
    fn walk(&self, start: usize, joints: &[usize]) -> Vec<usize> {
        let step = |body: &mut usize, &joint: &usize| {
            let from = *body;
            let (first, second) = self.ends(joint);
            *body = if first == from { second } else { first };
            Some(from)
        };
        joints.iter().scan(start, step).collect()
    }
}

#[cfg(test)]
mod tests;
