//! `linkdyn edit`: who may ask, and what is read and written.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};

use crate::browser::Scratch;

/// The command while it serves; it ends with this.
struct Editing {
    child: Child,
    host: String,
    token: String,
}

impl Editing {
    fn begin(scratch: &Scratch, model: &str) -> Self {
        let page = scratch.0.join("page.html");
        let policy = "connect-src 'none'";
        fs::write(
            &page,
            format!("{policy}<meta name=\"viewport\" content=\"\">"),
        )
        .expect("written");
        let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
        command
            .arg("edit")
            .arg(scratch.0.join(model))
            .arg("--page")
            .arg(page);
        let command = command.stdin(Stdio::null()).stdout(Stdio::null());
        let mut child = command
            .stderr(Stdio::piped())
            .spawn()
            .expect("the binary runs");
        let mut line = String::new();
        let said = child.stderr.take().expect("a pipe");
        BufReader::new(said).read_line(&mut line).expect("a line");
        let address = line.strip_prefix("http://").expect("an address");
        let (host, rest) = address.split_once('/').expect("a path");
        let (token, _) = rest.split_once('/').expect("a token");
        Editing {
            host: host.to_owned(),
            token: token.to_owned(),
            child,
        }
    }

    /// Status and body of an answer in words.
    fn ask(&self, method: &str, path: &str, more: &str, body: &str) -> (u16, String) {
        let (status, body) = self.bytes(method, path, more, body);
        (status, String::from_utf8(body).expect("text"))
    }

    fn bytes(&self, method: &str, path: &str, more: &str, body: &str) -> (u16, Vec<u8>) {
        let mut stream = TcpStream::connect(&self.host).expect("it listens");
        let (host, token, length) = (&self.host, &self.token, body.len());
        let request = format!(
            "{method} /{token}/{path} HTTP/1.1\r\nHost: {host}\r\n{more}Content-Length: {length}\r\n\r\n{body}"
        );
        stream.write_all(request.as_bytes()).expect("sent");
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).expect("an answer");
        let end = answer.windows(4).position(|four| four == b"\r\n\r\n");
        let body = answer.split_off(end.expect("a head") + 4);
        let head = String::from_utf8(answer).expect("text");
        let status = head.split(' ').nth(1).expect("a status").parse();
        (status.expect("a number"), body)
    }
}

impl Drop for Editing {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn a_file_is_read_saved_and_watched() {
    let scratch = Scratch::new("edit");
    let file = scratch.0.join("mine.json");
    fs::write(&file, "{ \"a\": 1 }\r\n").expect("written");
    let editing = Editing::begin(&scratch, "mine.json");
    let (status, page) = editing.ask("GET", "", "", "");
    assert_eq!(status, 200);
    assert!(
        page.contains("connect-src 'self'") && page.contains("content=\"mine.json\""),
        "{page}"
    );
    let (_, version) = editing.ask("GET", "state?", "", "");
    assert_eq!(
        editing.ask("GET", "model", "", ""),
        (200, "{ \"a\": 1 }\r\n".into())
    );
    let (status, next) = editing.ask("POST", &format!("save?{version}"), "", "{}\n");
    assert_eq!(
        (status, fs::read_to_string(&file).expect("there")),
        (200, "{}\n".into())
    );
    // Another program saves: what the page has is not written over it.
    fs::write(&file, "theirs").expect("written");
    assert_eq!(
        editing.ask("POST", &format!("save?{next}"), "", "ours").0,
        409
    );
    assert_eq!(fs::read_to_string(&file).expect("there"), "theirs");
    let (_, now) = editing.ask("GET", &format!("state?{next}"), "", "");
    assert_ne!(now, next);
    for (method, path, more, expected) in [
        ("GET", "model", "Origin: https://example.com\r\n", 403),
        ("POST", "model", "", 405),
        ("GET", "../mine.json", "", 404),
        ("GET", "elsewhere", "", 404),
    ] {
        assert_eq!(
            editing.ask(method, path, more, "").0,
            expected,
            "{method} {path}"
        );
    }
}

#[test]
fn a_new_file_is_begun_and_what_is_none_is_refused() {
    let scratch = Scratch::new("edit-new");
    let editing = Editing::begin(&scratch, "new.json");
    assert_eq!(editing.ask("GET", "model", "", "").0, 404);
    assert_eq!(editing.ask("POST", "save?none", "", "{}").0, 200);
    assert_eq!(
        fs::read_to_string(scratch.0.join("new.json")).expect("there"),
        "{}"
    );
    let mut command = Command::new(env!("CARGO_BIN_EXE_linkdyn"));
    let output = command
        .args(["edit", "four-bar", "--page"])
        .arg(scratch.0.join("page.html"))
        .output();
    let output = output.expect("the binary runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2));
    assert!(said.contains("linkdyn models NAME > FILE.json"), "{said}");
}

#[test]
fn the_command_answers_what_the_page_asks() {
    let scratch = Scratch::new("edit-asks");
    let editing = Editing::begin(&scratch, "mine.json");
    let model = include_str!("../../models/four-bar.json");
    let (status, words) = editing.ask("POST", "ask?check", "", model);
    let said = Command::new(env!("CARGO_BIN_EXE_linkdyn"))
        .args(["check", "four-bar"])
        .output()
        .expect("the binary runs");
    assert_eq!(
        (status, words),
        (
            200,
            String::from_utf8_lossy(&said.stdout).replace("(four-bar)", "(mine)")
        )
    );
    let (status, words) = editing.ask("POST", "ask?study", "", model);
    assert!(status == 200 && words.contains("responses"), "{words}");
    let (status, words) = editing.ask("POST", "ask?modes", "", "{ \"format\": 1 }");
    assert!(status == 200 && words.contains("line 1"), "{words}");
    assert_eq!(editing.ask("POST", "ask?delete", "", model).0, 404);
    assert_eq!(editing.ask("GET", "run", "", "").0, 405);
    assert_eq!(editing.ask("POST", "run", "", "{").0, 422);

    let (status, run) = editing.bytes("POST", "run", "", model);
    assert_eq!(status, 200);
    let end = run.iter().position(|&byte| byte == b'\n').expect("a line");
    let facts: serde_json::Value = serde_json::from_slice(&run[..end]).expect("JSON");
    let rows = facts["rows"].as_u64().expect("rows") as usize;
    let columns = facts["columns"].as_array().expect("columns").len();
    assert_eq!(run.len() - end - 1, 8 * rows * columns);
    let times: Vec<f64> = run[end + 1..].as_chunks().0[..rows]
        .iter()
        .map(|bytes| f64::from_le_bytes(*bytes))
        .collect();
    assert_eq!(times[0], 0.0);
    assert!(times.is_sorted(), "{times:?}");
}
