use crate::linkage::{self, Random};
use crate::{ColumnOrder, Pattern, SparseLu};

#[test]
fn lists_and_columns_give_the_same_bits() {
    let mut random = Random(3);
    let (bodies, pins) = linkage::grid(4);
    let matrix = linkage::kkt(&linkage::jacobian(bodies, &pins, &[]), &mut random);
    let (pattern, slots) =
        Pattern::from_entries(matrix.rows, matrix.columns, &matrix.positions()).expect("sound");
    let mut values = vec![0.0; pattern.entries()];
    for (&slot, &(_, _, value)) in slots.iter().zip(&matrix.entries) {
        values[slot as usize] = value;
    }
    let order = ColumnOrder::paired(&pattern, &values).expect("regular");
    let mut listed = SparseLu::new(pattern, order);
    let mut by_columns = listed.clone();
    by_columns.frozen.most = 0;
    for lu in [&mut listed, &mut by_columns] {
        lu.factor(&values).expect("regular");
    }
    let mut copy = listed.clone();
    copy.take_over(&by_columns);
    for _ in 0..3 {
        for value in &mut values {
            *value *= 1.0 + 0.1 * random.signed();
        }
        let right: Vec<f64> = (0..matrix.rows).map(|_| random.signed()).collect();
        let [one, two, three] = [&mut listed, &mut by_columns, &mut copy].map(|lu| {
            let (mut x, mut y) = (right.clone(), right.clone());
            lu.refactor(&values).expect("regular");
            lu.solve(&mut x);
            lu.solve_transposed(&mut y);
            (x, y, lu.growth(), lu.fallbacks())
        });
        assert_eq!(one.3, 0);
        assert!(one == two && one == three);
    }
    assert!(listed.frozen.is_listed && !by_columns.frozen.is_listed && !copy.frozen.is_listed);
}
