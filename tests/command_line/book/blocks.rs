//! Fenced blocks of a page, and lines as a reader compares them.

/// A fenced block.
pub struct Block {
    /// Line of the opening fence.
    pub line: usize,
    /// Words behind the opening fence: the language first.
    pub words: Vec<String>,
    pub body: String,
}

impl Block {
    /// The value of `key:…` behind the fence.
    pub fn word(&self, key: &str) -> Option<&str> {
        self.words
            .iter()
            .find_map(|word| word.strip_prefix(key)?.strip_prefix(':'))
    }

    /// Whether `word` stands behind the fence.
    pub fn is(&self, word: &str) -> bool {
        self.words.iter().any(|known| known == word)
    }
}

/// The blocks of a page in their order.
pub fn blocks(text: &str) -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    let mut open = false;
    for (index, line) in text.lines().enumerate() {
        match line.strip_prefix("```") {
            Some(_) if open => open = false,
            Some(words) => {
                open = true;
                let words = words.split([' ', ',']).map(String::from).collect();
                blocks.push(Block {
                    line: index + 1,
                    words,
                    body: String::new(),
                });
            }
            None if open => {
                let body = &mut blocks.last_mut().expect("open").body;
                body.push_str(line);
                body.push('\n');
            }
            None => {}
        }
    }
    assert!(!open, "a block is not closed");
    blocks
}

/// What stands outside of the blocks.
pub fn prose(text: &str) -> String {
    let mut open = false;
    let mut prose = String::new();
    for line in text.lines() {
        if line.starts_with("```") {
            open = !open;
        } else if !open {
            prose.push_str(line);
            prose.push('\n');
        }
    }
    prose
}

/// Whether a line is as shown, `…` standing for anything.
pub fn is_as_shown(line: &str, shown: &str) -> bool {
    let mut rest = line.trim();
    let parts: Vec<&str> = shown.trim().split('…').collect();
    for (index, part) in parts.iter().enumerate() {
        match rest.find(part) {
            Some(at) if index > 0 || at == 0 => rest = &rest[at + part.len()..],
            Some(_) | None => return false,
        }
    }
    rest.is_empty() || parts.last().is_some_and(|last| last.is_empty())
}

/// The words of a command line, as a shell splits it.
pub fn words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quote = None;
    for c in line.chars() {
        match (c, quote) {
            ('"' | '\'', None) => quote = Some(c),
            (c, Some(open)) if c == open => quote = None,
            (' ', None) => words.push(String::new()),
            (c, _) => words.last_mut().expect("one").push(c),
        }
    }
    words
}

#[test]
fn lines_are_compared_as_a_reader_would() {
    for (line, shown, same) in [
        ("  a b", "a b", true),
        ("a b c", "a …", true),
        ("a b c", "… c", true),
        ("a b c", "a … c", true),
        ("a b c", "a b", false),
        ("a b c", "b c", false),
        ("a b c", "a … d", false),
    ] {
        assert_eq!(is_as_shown(line, shown), same, "{line:?} {shown:?}");
    }
}
