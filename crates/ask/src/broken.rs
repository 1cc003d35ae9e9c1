//! Faults of linkdyn itself: a panic as a text, so that what goes on goes on, and what ends is reported in one line.

use std::any::Any;
use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    /// What the panic of this thread said, where its work is watched.
    static SAID: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Does a work that may panic.
///
/// What it had in hand may be half done: the caller makes it anew.
///
/// # Errors
/// What the panic said, and where in the source it was, in one line.
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    listen();
    let outer = SAID.replace(Some(String::new()));
    let done = panic::catch_unwind(AssertUnwindSafe(work));
    let said = SAID.replace(outer).filter(|said| !said.is_empty());
    done.map_err(|payload| said.unwrap_or_else(|| words(payload.as_ref())))
}

/// From now on panics of watched works are kept, and those of others go the way they went before.
fn listen() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            let place = info
                .location()
                .map_or_else(String::new, |at| format!(" ({}:{})", at.file(), at.line()));
            let said = words(info.payload()) + &place;
            let is_watched = SAID.with_borrow_mut(|kept| kept.as_mut().map(|kept| *kept = said));
            if is_watched.is_none() {
                before(info);
            }
        }));
    });
}

/// The first line of what a panic carries.
fn words(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    let line = text.and_then(|text| text.lines().next());
    line.unwrap_or("a panic without words").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_a_line_with_its_place() {
        let said = caught(|| [1, 2, 3][std::hint::black_box(7)]).expect_err("it panics");
        let expected =
            "index out of bounds: the len is 3 but the index is 7 (crates/ask/src/broken.rs:";
        assert!(said.starts_with(expected), "{said}");
        let inner = caught(|| caught(|| panic!("one\ntwo")).expect_err("it panics"));
        assert!(inner.expect("the outer work goes on").starts_with("one ("));
        assert_eq!(caught(|| 5), Ok(5));
    }
}
