//! The part of HTTP/1.1 (RFC 9112) that a page needs. Each connection carries one request.

use std::io::{self, Read, Write};
use std::net::TcpStream;

/// Longest head of a request \[bytes\].
const LONGEST_HEAD: usize = 16 * 1024;

/// What is asked.
#[derive(Debug, Default)]
pub struct Request {
    pub method: String,
    pub path: String,
    /// What stands behind the question mark.
    pub query: String,
    pub host: String,
    /// The page that asks, where the browser says so.
    pub origin: Option<String>,
    pub body: Vec<u8>,
}

/// What is answered.
#[derive(Debug)]
pub struct Answer {
    pub status: u16,
    pub kind: &'static str,
    pub body: Vec<u8>,
    /// Whether pages from elsewhere may load it.
    pub is_open: bool,
}

impl Answer {
    /// A body of a kind.
    pub fn new(status: u16, kind: &'static str, body: impl Into<Vec<u8>>) -> Self {
        Answer {
            status,
            kind,
            body: body.into(),
            is_open: false,
        }
    }

    /// A status alone.
    pub fn bare(status: u16) -> Self {
        Answer::new(status, "text/plain; charset=utf-8", reason(status))
    }

    /// Sends it.
    ///
    /// # Errors
    /// Those of the connection.
    pub fn send(&self, stream: &mut TcpStream) -> io::Result<()> {
        let policy = if self.is_open {
            "cross-origin"
        } else {
            "same-origin"
        };
        let head = format!(
            "HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nConnection: close\r\nCache-Control: no-store\r\n\
             X-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\nCross-Origin-Resource-Policy: {policy}\r\n\
             Content-Security-Policy: frame-ancestors 'self'\r\n\r\n",
            self.status,
            reason(self.status),
            self.kind,
            self.body.len()
        );
        stream.write_all(&[head.as_bytes(), &self.body].concat())?;
        stream.flush()
    }
}

fn reason(status: u16) -> &'static str {
    match status {
        200 => "OK",
        400 => "Bad Request",
        403 => "Forbidden",
        404 => "Not Found",
        405 => "Method Not Allowed",
        409 => "Conflict",
        413 => "Content Too Large",
        422 => "Unprocessable Content",
        _ => "Error",
    }
}

/// Reads a request with a body of so many bytes at most.
///
/// # Errors
/// The status of the answer, or `None` if the connection has ended.
pub fn read(stream: &mut impl Read, most: usize) -> Result<Request, Option<u16>> {
    let mut bytes = Vec::new();
    let mut piece = [0; 4096];
    let end = loop {
        let from = bytes.len().saturating_sub(3);
        match stream.read(&mut piece) {
            Ok(0) | Err(_) => return Err(None),
            Ok(count) => bytes.extend_from_slice(&piece[..count]),
        }
        let found = bytes[from..].windows(4).position(|own| own == b"\r\n\r\n");
        if let Some(at) = found {
            break from + at;
        }
        if bytes.len() > LONGEST_HEAD {
            return Err(Some(413));
        }
    };
    let body = bytes.split_off(end + 4);
    let head = std::str::from_utf8(&bytes[..end]).map_err(|_| Some(400))?;
    let (mut request, length) = head_of(head)?;
    if length > most || body.len() > length {
        return Err(Some(if length > most { 413 } else { 400 }));
    }
    let rest = length - body.len();
    request.body = body;
    let read = stream
        .take(rest as u64)
        .read_to_end(&mut request.body)
        .map_err(|_| None)?;
    (read == rest).then_some(request).ok_or(None)
}

/// The request but for its body, and the length of that.
fn head_of(head: &str) -> Result<(Request, usize), Option<u16>> {
    let bad = Some(400);
    let mut lines = head.split("\r\n");
    let mut words = lines.next().unwrap_or_default().split(' ');
    let (Some(method), Some(target), Some("HTTP/1.1"), None) =
        (words.next(), words.next(), words.next(), words.next())
    else {
        return Err(bad);
    };
    let (path, query) = target.split_once('?').unwrap_or((target, ""));
    let mut request = Request {
        method: method.to_owned(),
        path: path.to_owned(),
        query: query.to_owned(),
        ..Request::default()
    };
    let (mut length, mut hosts) = (0, 0);
    for line in lines {
        let (name, value) = line.split_once(':').ok_or(bad)?;
        let value = value.trim();
        match name.to_ascii_lowercase().as_str() {
            "host" => (request.host, hosts) = (value.to_owned(), hosts + 1),
            "origin" => request.origin = Some(value.to_owned()),
            "content-length" => length = value.parse().map_err(|_| bad)?,
            "transfer-encoding" => return Err(bad),
            _ => {}
        }
    }
    (hosts == 1).then_some((request, length)).ok_or(bad)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read_text(text: &str) -> Result<Request, Option<u16>> {
        read(&mut text.as_bytes(), 1000)
    }

    #[test]
    fn a_request_is_read_with_its_body() {
        let text =
            "POST /a/try?7 HTTP/1.1\r\nhost: h:1\r\nORIGIN: o\r\nContent-Length: 4\r\n\r\n{\r\n}";
        let request = read_text(text).expect("a request");
        let Request {
            method,
            path,
            query,
            host,
            origin,
            body,
        } = request;
        assert_eq!([method, path, query, host], ["POST", "/a/try", "7", "h:1"]);
        assert_eq!((origin.as_deref(), &*body), (Some("o"), &b"{\r\n}"[..]));
    }

    #[test]
    fn what_is_no_request_or_too_long_is_refused() {
        let head = |rest: &str| format!("GET / HTTP/1.1\r\n{rest}\r\n\r\n");
        for (text, status) in [
            (head("Host: a\r\nHost: b"), Some(400)),
            (head("No: host"), Some(400)),
            (head("Host: a\r\nTransfer-Encoding: chunked"), Some(400)),
            (head("Host: a\r\nContent-Length: -1"), Some(400)),
            (head("Host: a\r\nContent-Length: 99999999"), Some(413)),
            (head("Host: a\r\nContent-Length: 5"), None),
            ("GET / HTTP/1.0\r\nHost: a\r\n\r\n".into(), Some(400)),
            ("GET /\r\n\r\n".into(), Some(400)),
            ("G".repeat(LONGEST_HEAD + 4096), Some(413)),
            ("GET".into(), None),
        ] {
            assert_eq!(read_text(&text).map(|_| ()), Err(status), "{text:.80}");
        }
    }
}
