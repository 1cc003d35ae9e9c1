//! The C functions of the interface. This module alone has `unsafe`: it turns pointers into slices and texts, and calls safe code.
//!
//! What each function may assume of its caller is the standard's: pointers that it was given by this library, or null; arrays as long as
//! their count says; texts that end with a zero. Null is refused, the rest can't be checked. Functions for what units of linkdyn do not have
//! name the instance only: by the C calling conventions of all systems that there are libraries for, a function may ignore its further
//! arguments.

#![allow(unsafe_code, non_snake_case)]

mod fmi2;
mod fmi3;

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::slice;

use crate::instance::Instance;
use crate::refusal::{Refusal, Severity};
use crate::state::State;

/// An [`Instance`], as importers hold it.
type Handle = *mut c_void;

const OK: c_int = 0;
const CATEGORY: &str = "logStatusError";

/// Answers a call to an instance: its status, with what was refused in the log.
///
/// # Safety
/// The handle is null, or one that [`handed`] gave and nobody has freed.
unsafe fn answer(handle: Handle, call: impl FnOnce(&mut Instance) -> Result<(), Refusal>) -> c_int {
    // SAFETY: the caller's.
    let Some(instance) = (unsafe { handle.cast::<Instance>().as_mut() }) else {
        return Severity::Error as c_int;
    };
    let done = catch_unwind(AssertUnwindSafe(|| call(&mut *instance)));
    let done = done.unwrap_or_else(|panic| {
        instance.break_down();
        Err(broken(&*panic))
    });
    match done {
        Ok(()) => OK,
        Err(refusal) => {
            instance.log(Some(refusal.severity), CATEGORY, &refusal.message);
            refusal.severity as c_int
        }
    }
}

/// What a panic means.
fn broken(panic: &dyn std::any::Any) -> Refusal {
    let said = panic.downcast_ref::<&str>().copied();
    let said = said.or(panic.downcast_ref::<String>().map(String::as_str));
    Refusal {
        severity: Severity::Fatal,
        message: format!(
            "this is a fault of linkdyn itself: {} (please report it with the unit)",
            said.unwrap_or("a panic")
        ),
    }
}

/// Makes an instance; null and a message where that can't be.
fn handed(
    made: impl FnOnce() -> Result<Instance, Refusal>,
    log: impl Fn(Severity, &str),
) -> Handle {
    let made = catch_unwind(AssertUnwindSafe(made)).unwrap_or_else(|panic| Err(broken(&*panic)));
    match made {
        Ok(instance) => Box::into_raw(Box::new(instance)).cast(),
        Err(refusal) => {
            log(refusal.severity, &refusal.message);
            std::ptr::null_mut()
        }
    }
}

/// Frees an instance.
///
/// # Safety
/// As of [`answer`].
unsafe fn free(handle: Handle) {
    if !handle.is_null() {
        // SAFETY: the caller's; it was a box.
        let instance = unsafe { Box::from_raw(handle.cast::<Instance>()) };
        let _ = catch_unwind(AssertUnwindSafe(|| drop(instance)));
    }
}

/// What units of linkdyn do not have.
///
/// # Safety
/// As of [`answer`].
unsafe fn lacking(handle: Handle, what: &str) -> c_int {
    // SAFETY: the caller's.
    unsafe { answer(handle, |_| Err(Refusal::new(what))) }
}

/// An array of the importer's.
///
/// # Safety
/// It has so many elements, or is null.
unsafe fn array<'a, T>(first: *const T, count: usize) -> Result<&'a [T], Refusal> {
    match (count, first.is_null()) {
        (0, _) => Ok(&[]),
        (_, true) => Err(Refusal::new("an array is null")),
        // SAFETY: the caller's.
        (_, false) => Ok(unsafe { slice::from_raw_parts(first, count) }),
    }
}

/// An array of the importer's to be filled.
///
/// # Safety
/// It has so many elements that nobody else uses, or is null.
unsafe fn array_mut<'a, T>(first: *mut T, count: usize) -> Result<&'a mut [T], Refusal> {
    match (count, first.is_null()) {
        (0, _) => Ok(&mut []),
        (_, true) => Err(Refusal::new("an array is null")),
        // SAFETY: the caller's.
        (_, false) => Ok(unsafe { slice::from_raw_parts_mut(first, count) }),
    }
}

/// Something of the importer's.
///
/// # Safety
/// It is there, and nobody else uses it, or it is null.
unsafe fn place<'a, T>(place: *mut T) -> Result<&'a mut T, Refusal> {
    // SAFETY: the caller's.
    unsafe { place.as_mut() }.ok_or_else(|| Refusal::new("a pointer is null"))
}

/// A text of the importer's; empty where it is null.
///
/// # Safety
/// It ends with a zero, or is null.
unsafe fn text(text: *const c_char) -> String {
    if text.is_null() {
        return String::new();
    }
    // SAFETY: the caller's.
    unsafe { CStr::from_ptr(text) }
        .to_string_lossy()
        .into_owned()
}

/// A text for the importer.
fn c_text(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}

/// Keeps a state in the place of one.
///
/// # Safety
/// As of [`answer`]; the place is null, or has null or a state that [`get_state`] gave.
unsafe fn keep(
    handle: Handle,
    kept: *mut Handle,
    state: impl FnOnce(&mut Instance) -> Result<State, Refusal>,
) -> c_int {
    // SAFETY: the caller's; a state was a box.
    unsafe {
        answer(handle, |instance| {
            let kept = place(kept)?;
            let state = state(instance)?;
            match kept.cast::<State>().as_mut() {
                Some(old) => *old = state,
                None => *kept = Box::into_raw(Box::new(state)).cast(),
            }
            Ok(())
        })
    }
}

/// # Safety
/// As of [`keep`].
unsafe fn get_state(handle: Handle, kept: *mut Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { keep(handle, kept, Instance::state) }
}

/// # Safety
/// As of [`keep`]; the array has so many bytes.
unsafe fn read_state(handle: Handle, bytes: *const u8, count: usize, kept: *mut Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        keep(handle, kept, |instance| {
            instance.state_of(array(bytes, count)?)
        })
    }
}

/// # Safety
/// As of [`answer`]; the state is null, or one that [`get_state`] gave.
unsafe fn set_state(handle: Handle, state: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { answer(handle, |instance| instance.set_state(place(state.cast())?)) }
}

/// # Safety
/// As of [`keep`].
unsafe fn free_state(handle: Handle, kept: *mut Handle) -> c_int {
    // SAFETY: the caller's; a state was a box.
    unsafe {
        answer(handle, |_| {
            if let Some(kept) = kept.as_mut().filter(|kept| !kept.is_null()) {
                drop(Box::from_raw(kept.cast::<State>()));
                *kept = std::ptr::null_mut();
            }
            Ok(())
        })
    }
}

/// # Safety
/// As of [`set_state`]; the place is null or there.
unsafe fn state_size(handle: Handle, state: Handle, size: *mut usize) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(handle, |instance| {
            *place(size)? = instance.bytes(place(state.cast())?)?.len();
            Ok(())
        })
    }
}

/// # Safety
/// As of [`set_state`]; the array has so many bytes.
unsafe fn write_state(handle: Handle, state: Handle, bytes: *mut u8, count: usize) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(handle, |instance| {
            let own = instance.bytes(place(state.cast())?)?;
            let space = array_mut(bytes, count)?;
            let space = space.get_mut(..own.len()).ok_or_else(|| {
                Refusal::new(format!("{count} bytes are too few for {}", own.len()))
            })?;
            space.copy_from_slice(&own);
            Ok(())
        })
    }
}
