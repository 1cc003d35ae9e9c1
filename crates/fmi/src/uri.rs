//! Where FMI 2.0 says that resources are.

use std::path::PathBuf;

use crate::refusal::Refusal;

/// The folder that a URI such as `file:///tmp/unit/resources` names.
///
/// # Errors
/// Where it is no file.
pub fn path_of_uri(uri: &str) -> Result<PathBuf, Refusal> {
    let path = uri.strip_prefix("file:").ok_or_else(|| {
        Refusal::new(format!(
            "{uri:?} is not where resources can be: it must begin with file:"
        ))
    })?;
    // file:///path, file://localhost/path, or file:/path
    let path = match path.strip_prefix("//") {
        Some(rest) => rest.find('/').map_or("", |slash| &rest[slash..]),
        None => path,
    };
    let mut bytes = Vec::with_capacity(path.len());
    let mut rest = path.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let digits = after.get(..2).filter(|_| first == b'%');
        let digits = digits.and_then(|digits| std::str::from_utf8(digits).ok());
        let escaped = digits.and_then(|digits| u8::from_str_radix(digits, 16).ok());
        bytes.push(escaped.unwrap_or(first));
        rest = if escaped.is_some() {
            &after[2..]
        } else {
            after
        };
    }
    let path = String::from_utf8_lossy(&bytes).into_owned();
    // /C:/path
    let is_drive = cfg!(windows) && path.as_bytes().get(2) == Some(&b':');
    Ok(PathBuf::from(&path[usize::from(is_drive)..]))
}

#[cfg(test)]
mod tests {
    use super::path_of_uri;

    #[test]
    fn uris_are_paths() {
        let path = |uri| path_of_uri(uri).map(|path| path.to_string_lossy().into_owned());
        for uri in [
            "file:///tmp/a%20b%C3%A9/r",
            "file:/tmp/a%20b%C3%A9/r",
            "file://localhost/tmp/a%20b%C3%A9/r",
        ] {
            assert_eq!(path(uri).as_deref(), Ok("/tmp/a bé/r"), "{uri}");
        }
        assert_eq!(path("file:///50%/%zz%4").as_deref(), Ok("/50%/%zz%4"));
        assert_eq!(
            path("http://a/b").map_err(|refusal| refusal.message),
            Err("\"http://a/b\" is not where resources can be: it must begin with file:".into())
        );
    }
}
