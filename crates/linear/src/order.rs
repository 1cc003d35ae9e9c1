//! In which order to eliminate the columns of a square matrix, and which pivot each would like.
//!
//! Fill-in is what a factorisation costs. Approximate minimum degree (Amestoy, Davis & Duff, SIAM J. Matrix Anal. Appl.
//! 17, 1996; faer's implementation) keeps it low when pivots lie on the diagonal. Constraint Jacobians and KKT matrices
//! have zeros there, so rows are first paired with columns through large entries (`matching`), and the degree is
//! counted on
//!
//! ```text
//! J (n × n)                   nodes = (column, its row)
//! [M Jᵀ; J −ε] (symmetric)    nodes = (coordinate, its constraint), both columns eliminated one after the other
//! ```
//!
//! On a grid of 16 × 16 cells pairing leaves a third of the fill of plain minimum degree; on chains plain is a fifth
//! better.
//!
//! Strongly connected blocks of the paired graph (petgraph has them) would be the loops that are solved one after the
//! other, and only their diagonal blocks would be factored (block triangular form). They are not looked for: minimum
//! degree already leaves a driven chain of 200 loops less than four times its entries (a test below holds that), and a KKT
//! matrix is symmetric, so that a connected mechanism is one block. petgraph serves where topology itself is the
//! question, in `graph` of the engine.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;

use super::matching::{Matching, Unmatched};
use super::pattern::Pattern;
use super::triangle::NONE;

/// Elimination order and preferred pivot rows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ColumnOrder {
    /// Column eliminated at each step.
    columns: Vec<u32>,
    /// Preferred pivot row of each column.
    preferred: Vec<u32>,
}

impl ColumnOrder {
    /// Columns as they come, pivots on the diagonal.
    pub fn natural(n: usize) -> Self {
        let columns: Vec<u32> = (0..n as u32).collect();
        ColumnOrder {
            preferred: columns.clone(),
            columns,
        }
    }

    /// Minimum degree of A + Aᵀ, pivots on the diagonal: right for matrices with a sound diagonal.
    ///
    /// # Panics
    /// When the pattern is not square.
    pub fn amd(pattern: &Pattern) -> Self {
        assert_eq!(
            pattern.rows(),
            pattern.columns(),
            "an elimination order wants a square pattern"
        );
        let nodes: Vec<u32> = (0..pattern.columns() as u32).collect();
        let columns = minimum_degree(&compress(pattern, &nodes, &nodes, nodes.len()));
        ColumnOrder {
            columns,
            preferred: nodes,
        }
    }

    /// Minimum degree of pairs of rows and columns, for Jacobians and KKT matrices; values are those of a typical
    /// configuration.
    ///
    /// # Errors
    /// [`Unmatched`] when the matrix is singular whatever its values.
    ///
    /// # Panics
    /// When the pattern is not square.
    pub fn paired(pattern: &Pattern, values: &[f64]) -> Result<Self, Unmatched> {
        assert_eq!(
            pattern.rows(),
            pattern.columns(),
            "an elimination order wants a square pattern"
        );
        let n = pattern.columns();
        let symmetric = pattern.transposed().0 == *pattern;
        let partner = if symmetric {
            constraint_partners(pattern, values)
        } else {
            vec![NONE; n]
        };

        // Start from the pairs and from sound diagonals, complete by whatever is left.
        let mut matching = Matching::empty(pattern);
        if symmetric {
            for index in 0..n {
                let partner = partner[index];
                let on_diagonal = || {
                    pattern
                        .slot(index, index)
                        .is_some_and(|slot| values[slot] != 0.0)
                };
                if partner != NONE {
                    matching.pair(partner as usize, index);
                } else if on_diagonal() {
                    matching.pair(index, index);
                }
            }
        }
        matching.complete(pattern, values);
        matching.check_perfect()?;

        // A node per pair of indices, or per column.
        let mut node_of_column = vec![NONE; n];
        let mut members: Vec<[u32; 2]> = Vec::with_capacity(n);
        for column in 0..n {
            if node_of_column[column] != NONE {
                continue;
            }
            node_of_column[column] = members.len() as u32;
            let partner = partner[column];
            if partner != NONE {
                node_of_column[partner as usize] = members.len() as u32;
            }
            members.push([column as u32, partner]);
        }
        let preferred: Vec<u32> = (0..n)
            .map(|column| matching.row_of(column).map_or(NONE, |row| row as u32))
            .collect();
        let mut node_of_row = vec![NONE; n];
        for (column, &row) in preferred.iter().enumerate() {
            node_of_row[row as usize] = node_of_column[column];
        }
        let graph = compress(pattern, &node_of_row, &node_of_column, members.len());
        let mut columns: Vec<u32> = minimum_degree(&graph)
            .into_iter()
            .flat_map(|node| members[node as usize])
            .filter(|&column| column != NONE)
            .collect();
        columns.shrink_to_fit();
        Ok(ColumnOrder { columns, preferred })
    }

    /// Number of columns.
    pub(crate) fn len(&self) -> usize {
        self.columns.len()
    }

    /// Column eliminated at each step.
    pub fn columns(&self) -> &[u32] {
        &self.columns
    }

    /// Preferred pivot row of each column.
    pub fn preferred(&self) -> &[u32] {
        &self.preferred
    }
}

/// Pairs indices without a positive diagonal (constraints) with others (coordinates): the partner of each index, both
/// ways.
fn constraint_partners(pattern: &Pattern, values: &[f64]) -> Vec<u32> {
    let n = pattern.columns();
    let is_coordinate: Vec<bool> = (0..n)
        .map(|index| {
            pattern
                .slot(index, index)
                .is_some_and(|slot| values[slot] > 0.0)
        })
        .collect();
    let mut entries = Vec::new();
    let mut sizes = Vec::new();
    let constraints: Vec<usize> = (0..n).filter(|&index| !is_coordinate[index]).collect();
    for (number, &constraint) in constraints.iter().enumerate() {
        for (&row, &value) in pattern
            .column(constraint)
            .iter()
            .zip(&values[pattern.span(constraint)])
        {
            if is_coordinate[row as usize] {
                entries.push((row as usize, number));
                sizes.push(value);
            }
        }
    }
    let mut partner = vec![NONE; n];
    // Entries came sorted by column and row, so slots and values agree.
    if let Ok((block, _)) = Pattern::from_entries(n, constraints.len(), &entries) {
        let matching = Matching::maximum(&block, &sizes);
        for (number, &constraint) in constraints.iter().enumerate() {
            if let Some(coordinate) = matching.row_of(number) {
                partner[constraint] = coordinate as u32;
                partner[coordinate] = constraint as u32;
            }
        }
    }
    partner
}

/// Graph of the nodes: an edge wherever a row of one meets a column of the other.
fn compress(
    pattern: &Pattern,
    node_of_row: &[u32],
    node_of_column: &[u32],
    nodes: usize,
) -> (Vec<u32>, Vec<u32>) {
    let mut edges: Vec<(u32, u32)> = Vec::with_capacity(pattern.entries());
    for (column, &to) in node_of_column.iter().enumerate() {
        edges.extend(
            pattern
                .column(column)
                .iter()
                .map(|&row| (to, node_of_row[row as usize])),
        );
    }
    edges.sort_unstable();
    edges.dedup();
    let mut start = vec![0u32; nodes + 1];
    for &(to, _) in &edges {
        start[to as usize + 1] += 1;
    }
    for node in 0..nodes {
        start[node + 1] += start[node];
    }
    (start, edges.into_iter().map(|(_, from)| from).collect())
}

/// Nodes by approximate minimum degree of the symmetrised graph.
fn minimum_degree((start, neighbour): &(Vec<u32>, Vec<u32>)) -> Vec<u32> {
    let n = start.len() - 1;
    let (mut order, mut inverse) = (vec![0u32; n], vec![0u32; n]);
    let graph = SymbolicSparseColMatRef::new_checked(n, n, start, None, neighbour);
    // faer counts the workspace without the nodes themselves.
    let mut memory = MemBuffer::new(amd::order_scratch::<u32>(n, neighbour.len() + n));
    match amd::order(
        &mut order,
        &mut inverse,
        graph,
        Default::default(),
        MemStack::new(&mut memory),
    ) {
        Ok(_) => order,
        // Only when the graph overflows 32 bits: any order is right, this one is merely slower.
        Err(_) => (0..n as u32).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::lu::SparseLu;
    use super::*;
    use crate::linkage::{self, Matrix, Random};

    fn sparse(matrix: &Matrix) -> (Pattern, Vec<f64>) {
        let (pattern, slots) =
            Pattern::from_entries(matrix.rows, matrix.columns, &matrix.positions()).unwrap();
        let mut values = vec![0.0; pattern.entries()];
        for (&slot, &(_, _, value)) in slots.iter().zip(&matrix.entries) {
            values[slot as usize] += value;
        }
        (pattern, values)
    }

    fn assert_permutations(order: &ColumnOrder) {
        for list in [order.columns(), order.preferred()] {
            let mut sorted = list.to_vec();
            sorted.sort_unstable();
            assert!(
                sorted
                    .iter()
                    .enumerate()
                    .all(|(i, &entry)| entry as usize == i),
                "{list:?}"
            );
        }
    }

    /// Fill of a factorisation in this order.
    fn fill(pattern: &Pattern, values: &[f64], order: ColumnOrder) -> usize {
        assert_permutations(&order);
        let mut lu = SparseLu::new(pattern.clone(), order);
        lu.factor(values).unwrap();
        println!(
            "n {}: fill {}, pivot ratio {:e}, growth {}",
            pattern.columns(),
            lu.fill(),
            lu.smallest_pivot_ratio(values),
            lu.growth()
        );
        lu.fill()
    }

    #[test]
    fn pairing_keeps_fill_low() {
        let kkt = |(bodies, pins): (usize, Vec<_>)| {
            sparse(&linkage::kkt(
                &linkage::jacobian(bodies, &pins, &[]),
                &mut Random(1),
            ))
        };
        // A chain costs the same per cell however long it is.
        let (pattern, values) = kkt(linkage::four_bar_chain(200, 0.8));
        let paired = fill(
            &pattern,
            &values,
            ColumnOrder::paired(&pattern, &values).unwrap(),
        );
        assert!(paired < 100 * 200, "{paired}");
        let plain = fill(&pattern, &values, ColumnOrder::amd(&pattern));
        assert!(paired < 2 * plain, "{paired} against {plain}");

        // Many loops: this is where it pays.
        let (pattern, values) = kkt(linkage::grid(16));
        let paired = fill(
            &pattern,
            &values,
            ColumnOrder::paired(&pattern, &values).unwrap(),
        );
        let plain = fill(&pattern, &values, ColumnOrder::amd(&pattern));
        assert!(3 * paired < plain, "{paired} against {plain}");
    }

    #[test]
    fn square_jacobian_of_a_driven_chain() {
        let (bodies, pins) = linkage::four_bar_chain(200, 0.8);
        let (pattern, values) = sparse(&linkage::jacobian(bodies, &pins, &[0]));
        let paired = fill(
            &pattern,
            &values,
            ColumnOrder::paired(&pattern, &values).unwrap(),
        );
        assert!(paired < 4 * pattern.entries(), "{paired}");
    }

    #[test]
    fn massless_and_regularised_bodies() {
        // A slider-crank's coupler without mass, and all masses eight decades apart.
        let (bodies, pins) = linkage::four_bar_chain(3, 0.8);
        let jac = linkage::jacobian(bodies, &pins, &[]);
        for change in 0..3 {
            let mut matrix = linkage::kkt(&jac, &mut Random(1));
            for entry in matrix.entries.iter_mut().filter(|entry| entry.0 == entry.1) {
                match change {
                    0 if entry.0 / 3 % 2 == 1 => entry.2 = 0.0,
                    1 => entry.2 *= if entry.0 / 3 % 2 == 1 { 1e-4 } else { 1e4 },
                    _ => {}
                }
            }
            if change == 2 {
                matrix
                    .entries
                    .extend((jac.columns..matrix.rows).map(|i| (i, i, -1e-8)));
            }
            let (pattern, values) = sparse(&matrix);
            fill(
                &pattern,
                &values,
                ColumnOrder::paired(&pattern, &values).unwrap(),
            );
        }
    }

    #[test]
    fn rows_that_cannot_have_pivots_are_named() {
        // Two rows share their only column; a third column is empty.
        let pattern = Pattern::new(3, vec![0, 1, 3, 3], vec![0, 1, 2]).unwrap();
        let fault = ColumnOrder::paired(&pattern, &[1.0; 3]).unwrap_err();
        assert_eq!((fault.rows, fault.columns), (vec![2], vec![2]));
        let empty = Pattern::new(0, vec![0], vec![]).unwrap();
        assert_eq!(ColumnOrder::paired(&empty, &[]).unwrap().len(), 0);
    }
}
