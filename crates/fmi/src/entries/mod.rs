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

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::ffi::{c_char, c_int, c_void};
    use std::path::Path;
    use std::ptr;

    use super::{Handle, answer, fmi2, fmi3, handed, text};
    use crate::instance::{Instance, Made};

    const MODEL: &str = r#"{ "format": "linkdyn/1", "units": "SI",
        "bodies": { "ground": { "points": { "O": [0, 0] } }, "disc": { "mass": 1, "inertia": 1, "com": [0, 0], "points": { "O": [0, 0] } } },
        "joints": { "pin": { "type": "revolute", "between": ["ground.O", "disc.O"] } }, "analysis": { "type": "dynamics", "end": 1, "outputs": 2 } }"#;

    thread_local! { static SAID: RefCell<Vec<String>> = const { RefCell::new(Vec::new()) }; }

    unsafe extern "C" fn message(
        _: *mut c_void,
        status: c_int,
        category: *const c_char,
        line: *const c_char,
    ) {
        // SAFETY: texts of this library.
        let [category, line] = unsafe { [text(category), text(line)] };
        SAID.with_borrow_mut(|said| said.push(format!("{status} {category}: {line}")));
    }

    fn said() -> Vec<String> {
        SAID.with_borrow_mut(std::mem::take)
    }

    fn instance(name: &str) -> Handle {
        let folder =
            std::env::temp_dir().join(format!("linkdyn-fmi-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        std::fs::write(folder.join("model.json"), MODEL).expect("written");
        let token = linkdyn::fmu::token(MODEL.as_bytes(), b"");
        let made = Made {
            token: &token,
            resources: Path::new(&folder),
            stops_at_events: false,
            is_logging: false,
        };
        let log = |severity: Option<crate::Severity>, category: &str, line: &str| {
            let severity = severity.map_or(0, |severity| severity as c_int);
            SAID.with_borrow_mut(|said| said.push(format!("{severity} {category}: {line}")));
        };
        handed(
            || Instance::new(&made, Box::new(log)),
            |_, line| panic!("{line}"),
        )
    }

    #[test]
    fn null_is_refused_wherever_it_comes_from() {
        let none = ptr::null_mut();
        // SAFETY: the instance is there, all else is null.
        unsafe {
            assert_eq!(fmi3::fmi3Reset(none), 3);
            assert_eq!(fmi2::fmi2Reset(none), 3);
            fmi3::fmi3FreeInstance(none);
            let one = instance("null");
            assert_eq!(
                fmi3::fmi3GetFloat64(one, ptr::null(), 1, ptr::null_mut(), 1),
                3
            );
            assert_eq!(
                fmi3::fmi3GetFloat64(one, ptr::null(), 0, ptr::null_mut(), 0),
                0
            );
            assert_eq!(fmi3::fmi3GetFMUState(one, ptr::null_mut()), 3);
            assert_eq!(fmi3::fmi3SetFMUState(one, none), 3);
            assert_eq!(fmi3::fmi3FreeFMUState(one, &mut ptr::null_mut()), 0);
            assert_eq!(
                said(),
                [
                    "3 logStatusError: an array is null",
                    "3 logStatusError: a pointer is null",
                    "3 logStatusError: a pointer is null"
                ]
            );
            assert_eq!(fmi3::fmi3GetClock(one), 3);
            assert_eq!(said(), ["3 logStatusError: the unit has no clocks"]);
            fmi3::fmi3FreeInstance(one);
        }
    }

    #[test]
    fn an_instance_that_can_not_be_made_is_null() {
        let nothing = ptr::null_mut::<c_void>();
        // SAFETY: texts that end with a zero, or null.
        let made = unsafe {
            fmi3::fmi3InstantiateCoSimulation(
                c"one".as_ptr(),
                c"token".as_ptr(),
                c"/nowhere".as_ptr(),
                0,
                0,
                0,
                0,
                ptr::null(),
                0,
                nothing,
                Some(message),
                nothing,
            )
        };
        assert!(made.is_null());
        let name = ptr::null();
        let other =
            fmi3::fmi3InstantiateModelExchange(name, name, name, 0, 0, nothing, Some(message));
        assert!(other.is_null());
        let said = said();
        assert!(
            said[0].starts_with("3 logStatusError: /nowhere"),
            "{said:?}"
        );
        assert_eq!(
            said[1],
            "3 logStatusError: the unit is one for co-simulation, not for model exchange"
        );
    }

    #[test]
    fn a_panic_ends_at_the_entry() {
        // SAFETY: the instance is there.
        unsafe {
            let one = instance("panic");
            let status = answer(one, |_| panic!("on purpose"));
            assert_eq!(status, 4);
            assert_eq!(
                said(),
                [
                    "4 logStatusError: this is a fault of linkdyn itself: on purpose (please report it with the unit)"
                ]
            );
            assert_eq!(
                fmi3::fmi3EnterInitializationMode(one, 0, 0.0, 0.0, 0, 0.0),
                3
            );
            assert_eq!(fmi3::fmi3Reset(one), 3);
            assert_eq!(
                said()[1],
                "3 logStatusError: the instance can only be freed after a fault of linkdyn"
            );
            fmi3::fmi3FreeInstance(one);
        }
    }
}
