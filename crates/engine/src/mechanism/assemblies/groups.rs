//! Which bodies can be placed one group after the other: Assur groups.
//!
//! Each row is paired with a coordinate that it determines. A body whose rows name other bodies waits for them; those that wait for each
//! other are a group (strongly connected components: petgraph, Tarjan 1972; Servatius, Shai and Whiteley, European J. Combinatorics 31, 2010).
//! A dyad is a group of two bodies, one loop; the triad of four bodies and six pins has two.

use crate::element::algebra::{Algebraic, FormPart, LinearForm};
use crate::element::{Axis, BodyId};
use crate::graph::waiting_groups;
use crate::motion::Jet;
use crate::system::{Block, System};
use linkdyn_linear::bilinear::Number;

/// A row of a block.
#[derive(Debug)]
pub(super) struct PolynomialRow {
    /// What it says; `None` if that is no polynomial.
    pub algebra: Option<Algebraic>,
    /// The moving bodies that it names.
    bodies: Vec<usize>,
    /// Columns where its derivative is not zero.
    columns: Vec<usize>,
}

/// Bodies that are placed together, and the rows that do it.
#[derive(Debug)]
pub(super) struct Group {
    pub bodies: Vec<BodyId>,
    pub rows: Vec<usize>,
}

/// What is known of a mechanism beforehand.
#[derive(Debug, Clone, Copy)]
pub struct KnownPosition<'a> {
    /// A position: coordinates that are free stay as there, and angles are counted from there (n).
    pub q: &'a [f64],
    /// Rows that follow from others.
    pub dependent: &'a [usize],
    /// Coordinates that are free, one for each freedom, as far as they are known.
    pub free: &'a [usize],
}

/// The groups in the order in which they can be placed.
#[derive(Debug)]
pub(super) struct Groups {
    pub rows: Vec<PolynomialRow>,
    pub groups: Vec<Group>,
    /// Coordinates that nothing determines: these are held.
    pub free: Vec<(BodyId, Axis)>,
}

impl Groups {
    /// Of blocks, where drivers have the values `drive`.
    pub fn new(system: &System, blocks: &[&Block], drive: &[Jet], known: &KnownPosition) -> Self {
        let mut rows: Vec<PolynomialRow> = Vec::new();
        for block in blocks {
            let mut own: Vec<PolynomialRow> = block
                .constraint
                .rows()
                .iter()
                .map(|_| PolynomialRow {
                    algebra: None,
                    bodies: Vec::new(),
                    columns: Vec::new(),
                })
                .collect();
            for (row, algebra) in own.iter_mut().zip(block.constraint.algebra(drive)) {
                row.algebra = Some(algebra);
            }
            for (row, body, axis) in block.constraint.entries() {
                if let (Some(column), Some(index)) =
                    (system.layout.column(body, axis), body.index())
                {
                    own[row].columns.push(column);
                    if !own[row].bodies.contains(&index) {
                        own[row].bodies.push(index);
                    }
                }
            }
            // Places are paired before turns, so that what is free is a turn.
            let is_turn = |column: &usize| system.layout.is_angle(*column);
            own.iter_mut()
                .for_each(|row| row.columns.sort_by_key(is_turn));
            rows.extend(own);
        }
        for row in known.dependent {
            rows[*row].columns.clear();
        }
        let mut free = Vec::new();
        let mut held = |rows: &mut Vec<PolynomialRow>, column: usize| {
            let (body, axis) = system.layout.coordinate(column);
            rows.push(hold(body, axis, known.q[column], column));
            free.push((body, axis));
        };
        for column in known.free {
            held(&mut rows, *column);
        }
        let mut row_of = paired(&rows, system.n());
        for (column, own) in row_of.iter_mut().enumerate() {
            if own.is_none() {
                *own = Some(rows.len());
                held(&mut rows, column);
            }
        }
        let groups = ordered(system, &rows, &row_of);
        Groups { rows, groups, free }
    }
}

/// Which of the moving bodies a column belongs to.
fn column_body(system: &System, column: usize) -> usize {
    let (body, _) = system.layout.coordinate(column);
    body.index().unwrap_or_default()
}

/// A row that leaves a coordinate where it is.
fn hold(body: BodyId, axis: Axis, value: f64, column: usize) -> PolynomialRow {
    let off = |at: Number| {
        let place = LinearForm(vec![(body, FormPart::Place, 1.0.into())]);
        place.minus(LinearForm::constant(at))
    };
    let algebra = match axis {
        Axis::X => Algebraic::Real(off(Number::new(value, 0.0))),
        Axis::Y => Algebraic::Imaginary(off(Number::new(0.0, value))),
        Axis::Theta => Algebraic::tied(BodyId::GROUND, body, value),
    };
    PolynomialRow {
        algebra: Some(algebra),
        bodies: body.index().into_iter().collect(),
        columns: vec![column],
    }
}

/// By column the row that is paired with it: a maximum matching by augmenting paths (Kuhn 1955).
fn paired(rows: &[PolynomialRow], n: usize) -> Vec<Option<usize>> {
    let mut row_of = vec![None; n];
    for row in 0..rows.len() {
        augment(rows, row, &mut row_of, &mut vec![false; n]);
    }
    row_of
}

fn augment(
    rows: &[PolynomialRow],
    row: usize,
    row_of: &mut [Option<usize>],
    seen: &mut [bool],
) -> bool {
    // What is free is taken before others have to move.
    for is_free in [true, false] {
        for &column in &rows[row].columns {
            if row_of[column].is_none() != is_free || seen[column] {
                continue;
            }
            seen[column] = true;
            let other = row_of[column];
            if other.is_none_or(|other| augment(rows, other, row_of, seen)) {
                row_of[column] = Some(row);
                return true;
            }
        }
    }
    false
}

fn ordered(system: &System, rows: &[PolynomialRow], row_of: &[Option<usize>]) -> Vec<Group> {
    let bodies = system.layout.bodies().len();
    let mut own: Vec<Vec<usize>> = vec![Vec::new(); bodies];
    let mut waits: Vec<Vec<usize>> = vec![Vec::new(); bodies];
    for (column, row) in row_of.iter().enumerate() {
        let Some(row) = *row else { continue };
        let index = column_body(system, column);
        own[index].push(row);
        let others = rows[row].bodies.iter().copied();
        waits[index].extend(others.filter(|other| *other != index));
    }
    waiting_groups(&waits)
        .into_iter()
        .map(|indices| {
            let mut rows: Vec<usize> = indices.iter().flat_map(|k| own[*k].clone()).collect();
            rows.sort_unstable();
            Group {
                bodies: indices.into_iter().map(BodyId::moving).collect(),
                rows,
            }
        })
        .collect()
}
