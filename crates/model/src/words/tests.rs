use super::*;

#[test]
fn the_table_can_be_read_and_names_nothing_twice() {
    let words = Vocabulary::read(TABLE);
    let named = words.blocks.iter().filter(|block| block.word != "kind");
    assert_eq!(named.count(), words.known.len());
    for block in &words.blocks {
        let mut keys: Vec<&str> = block.rows.iter().map(|&row| columns(row).0).collect();
        let count = keys.len();
        keys.sort_unstable();
        keys.dedup();
        assert_eq!(keys.len(), count, "{}", block.name);
    }
}
