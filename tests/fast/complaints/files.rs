//! Files that are no model at all.

use super::*;

#[test]
fn what_is_no_model_at_all_gets_one_clear_complaint() {
    let deep = "[".repeat(100_000);
    let cases: [(&[u8], &str); 17] = [
        (b"", "the file is empty (a model is a JSON object)"),
        (b" \n\t", "the file is empty (a model is a JSON object)"),
        (
            b"\xEF\xBB\xBF",
            "the file is empty (a model is a JSON object)",
        ),
        (
            b"[]",
            "line 1, column 1: a model is an object, { \u{2026} }, not a list",
        ),
        (
            b"\"four-bar\"",
            "line 1, column 1: a model is an object, { \u{2026} }, not text",
        ),
        (
            b"{\n  \"a\": 1",
            "line 2, column 9: not JSON: it ends where \",\" or \"}\" is expected; it seems cut short",
        ),
        (
            b"{\n  \"a\":",
            "line 2, column 7: not JSON: it ends where a value is expected; it seems cut short",
        ),
        (
            b"{ \"a\": \"b",
            "line 1, column 8: not JSON: the text has no closing quote; it seems cut short",
        ),
        (
            b"{} {}",
            "line 1, column 4: not JSON: '{' where the end is expected (it is complete before this: take out what follows)",
        ),
        (
            b"{} that is all",
            "line 1, column 4: not JSON: 't' where the end is expected (it is complete before this: take out what follows)",
        ),
        (
            b"{} }",
            "line 1, column 4: not JSON: '}' where the end is expected (there is one closing bracket too many, here or before)",
        ),
        (
            b"{ \"a\": 1e999 }",
            "line 1, column 8: not JSON: 1e999: the number is too large for a double",
        ),
        (
            b"{ \"\xc3\xa9\": 'x' }",
            "line 1, column 8: not JSON: '\\'' where a value is expected (text stands in double quotes)",
        ),
        (
            b"{\n\"a\": \xff }",
            "line 2, column 6: the file is not UTF-8 text (a model is a JSON file; save it as UTF-8)",
        ),
        (
            b"\xff\xfe{\0}\0",
            "line 1, column 1: the file is not UTF-8 text (a model is a JSON file; save it as UTF-8)",
        ),
        (
            b"\x7fELF\x02\x01\x01",
            "line 1, column 1: not JSON: '\\u{7f}' where a value is expected",
        ),
        (
            deep.as_bytes(),
            "line 1, column 129: not JSON: nested more than 128 deep",
        ),
    ];
    for (text, words) in cases {
        assert_eq!(said(text, &[]), [words]);
    }
}

#[test]
fn a_byte_order_mark_and_windows_line_ends_do_no_harm() {
    let text = format!("\u{feff}{}", BASE.replace('\n', "\r\n"));
    assert_eq!(said(text.as_bytes(), &[]), Vec::<String>::new());
    let text = text
        .replace("0.8", "-0.8")
        .replace("\"four-bar", "\"čtyřkloub");
    assert_eq!(
        said(text.as_bytes(), &[]),
        ["line 8, column 24: bodies.crank.mass: -0.8: must not be negative"]
    );
    // on the first line the mark is no column
    assert_eq!(
        said("\u{feff}?".as_bytes(), &[]),
        ["line 1, column 1: not JSON: '?' where a value is expected"]
    );
}

#[test]
fn files_that_cannot_be_models_are_refused_by_name() {
    let folder = std::env::temp_dir().join(format!("linkdyn-complaints-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let large = folder.join("large.json");
    let mut file = std::fs::File::create(&large).unwrap();
    file.write_all(b"[[[[").unwrap();
    file.set_len(100 * 1024 * 1024).unwrap();
    let said =
        |path: &std::path::Path| linkdyn_model::load_file(path, &[]).unwrap_err()[0].to_string();
    let (folder_name, large_name) = (folder.display().to_string(), large.display().to_string());
    assert_eq!(
        said(&large),
        format!("{large_name}: 100 MB are too much for a model, at most 64 MB are read")
    );
    assert_eq!(
        said(&folder),
        format!("{folder_name}: this is a directory, not a model file")
    );
    assert_eq!(
        said(&folder.join("none.json")),
        format!("{folder_name}/none.json: there is no such file")
    );
    std::fs::remove_dir_all(&folder).unwrap();
    assert_eq!(
        linkdyn_model::load(&vec![b' '; 65 * 1024 * 1024], &[]).unwrap_err()[0].to_string(),
        "65 MB are too much for a model, at most 64 MB are read"
    );
}

#[test]
fn a_file_with_thousands_of_faults_is_not_repeated_whole() {
    let names: Vec<String> = (0..5000).map(|index| format!("\"f{index}\": 1")).collect();
    let said = said(
        BASE.replace(
            "\"load\": {",
            &format!("{}, \"load\": {{", names.join(", ")),
        )
        .as_bytes(),
        &[],
    );
    assert_eq!(said.len(), 101);
    assert_eq!(said[100], "and 4900 more faults");
}
