//! Who may ask the page's server.

use std::io::{Read, Write};
use std::net::TcpStream;

use super::watching::{Watching, bundled};

/// The status of the answer to a request.
fn status(host: &str, request: &str) -> String {
    let mut stream = TcpStream::connect(host).expect("it listens");
    stream.write_all(request.as_bytes()).expect("sent");
    let mut answer = String::new();
    stream.read_to_string(&mut answer).expect("an answer");
    answer.lines().next().unwrap_or_default().to_owned()
}

#[test]
fn only_who_has_the_token_and_comes_from_here_gets_an_answer() {
    let watching = Watching::begin(&bundled("slider-crank"));
    let (host, token) = watching.address();
    assert!(
        host.starts_with("127.0.0.1:") && token.len() == 32,
        "{host} {token}"
    );
    let port = host.split_once(':').expect("a port").1;
    let other = "0".repeat(32);
    let local = format!("localhost:{port}");
    let get = |path: &str, host: &str, more: &str| {
        format!("GET /{path} HTTP/1.1\r\nHost: {host}\r\n{more}\r\n")
    };
    let post = |path: &str, origin: &str, body: &str| {
        let length = body.len();
        format!(
            "POST /{token}/{path} HTTP/1.1\r\nHost: {host}\r\nOrigin: {origin}\r\nContent-Length: {length}\r\n\r\n{body}"
        )
    };
    let page = format!("{token}/");
    let own = format!("http://{host}");
    // The first run: it is answered when there is another state than none.
    let begun = status(&host, &get(&format!("{token}/state?0"), &host, ""));
    assert_eq!(begun, "HTTP/1.1 200 OK");
    let before = std::fs::read(&watching.model).expect("there");
    for (request, expected) in [
        (get(&page, &host, ""), "200 OK"),
        (
            get(&page, &host, "Origin: https://example.com\r\n"),
            "403 Forbidden",
        ),
        (get(&page, &local, ""), "403 Forbidden"),
        (get(&page, "example.com", ""), "403 Forbidden"),
        (get(&format!("{other}/"), &host, ""), "403 Forbidden"),
        (get("", &host, ""), "403 Forbidden"),
        (
            get(&format!("{token}/../mine.json"), &host, ""),
            "404 Not Found",
        ),
        (
            get(&format!("{token}/write"), &host, ""),
            "405 Method Not Allowed",
        ),
        (post("write", "null", "{\"crank\":51}"), "403 Forbidden"),
        (
            post("write", "http://127.0.0.1:1", "{\"crank\":51}"),
            "403 Forbidden",
        ),
        (post("try", &own, "[]"), "400 Bad Request"),
        (post("try", &own, "{\"crank\":\"51\"}"), "400 Bad Request"),
        (
            post("try", &own, &" ".repeat(70_000)),
            "413 Content Too Large",
        ),
    ] {
        let found = status(&host, &request);
        assert_eq!(found, format!("HTTP/1.1 {expected}"), "{request:.200}");
    }
    assert_eq!(std::fs::read(&watching.model).expect("there"), before);
}
