use super::*;

#[test]
fn the_table_can_be_read_and_names_nothing_twice() {
    let words = Vocabulary::read(TABLE);
    let named = words.blocks.iter().filter(|block| block.word != "kind");
    assert_eq!(named.count(), words.known.len());
    for block in words.blocks {
        let mut keys: Vec<&str> = block.rows.iter().map(|&row| columns(row).0).collect();
        let count = keys.len();
        keys.sort_unstable();
        keys.dedup();
        assert_eq!(keys.len(), count, "{}", block.name);
        // a row that can't be read panics
        match words.known.get(block.name) {
            Some(Definition::Choice(choice)) => assert_eq!(choice.words.len(), count),
            Some(Definition::Tagged(kinds)) => assert!(!kinds.variants.is_empty()),
            _ if ["file", "part", "object", "kind"].contains(&block.word) => {
                let object = read_object(block);
                assert!(object.fields.len() <= count, "{}", block.name);
            }
            _ => assert_eq!(count, 0, "{}", block.name),
        }
    }
}
