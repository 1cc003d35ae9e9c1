//! Mechanisms of PMKS+, which shares them as links: all of a drawing stands behind the `?`.
//!
//! The links of two generations are read. The first one's text is plain, `j=A,1.4,0.485,AB,R,t,…` ([`plain`]). In the second numbers
//! are thousandths in digits of base 64 ([`packed`]); it grew over the years, and old links stayed as they were.

mod build;
mod drawing;
mod packed;
mod plain;

use super::Imported;
use crate::source::Refused;

/// Reads a share link, or what stands behind its `?`; `name` is that of the file.
pub(super) fn read(name: &str, text: &str) -> Result<Imported, Refused> {
    let content = content(text)?;
    let drawing = if content.starts_with("j=") || content.contains("&l=") {
        plain::read(&content)?
    } else if content.starts_with("pmks2:") {
        return Err(Refused::new(
            "",
            "this is a document of PMKS+'s native editor (pmks2), which is not read",
            "share the mechanism from https://app.pmksplus.com",
        ));
    } else {
        packed::read(&content)?
    };
    build::draft(name, drawing)
}

/// What stands behind the `?` of the first line with a link; or all of it, where there is none. Escapes are read.
fn content(text: &str) -> Result<String, Refused> {
    let text = text.trim();
    let link = match text.lines().find(|line| line.contains("://")) {
        // It may be a shortcut's file; names in a link may have spaces.
        Some(line) => line.split_once('?').map(|(_, behind)| behind.trim_end()),
        None => Some(text.strip_prefix('?').unwrap_or(text)),
    };
    let Some(link) = link else {
        return Err(Refused::new(
            "",
            "nothing stands behind a ? of the link",
            "in PMKS+ choose Share, and copy the whole link",
        ));
    };
    let link = link.split('#').next().unwrap_or_default();
    if link.is_empty() {
        return Err(Refused::new(
            "",
            "the link is empty",
            "in PMKS+ choose Share, and copy the whole link",
        ));
    }
    unescaped(link)
}

/// A text whose escapes, `%2C`, are what they stand for.
fn unescaped(text: &str) -> Result<String, Refused> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes().iter();
    while let Some(&byte) = rest.next() {
        let two = rest.as_slice().get(..2);
        let escaped = two
            .filter(|_| byte == b'%')
            .and_then(|two| std::str::from_utf8(two).ok())
            .filter(|two| two.bytes().all(|digit| digit.is_ascii_hexdigit()))
            .and_then(|two| u8::from_str_radix(two, 16).ok());
        match escaped {
            Some(escaped) => {
                bytes.push(escaped);
                rest.nth(1);
            }
            None => bytes.push(byte),
        }
    }
    String::from_utf8(bytes).map_err(|error| {
        Refused::new(
            format!("character {}", error.utf8_error().valid_up_to() + 1),
            "the escapes of the link make no text",
            "copy the link again",
        )
    })
}
