//! FMI 2.0.

use std::ffi::{c_char, c_int, c_void};

use super::{
    Handle, answer, array, array_mut, c_text, free, free_state, get_state, handed, lacking, place,
    read_state, set_state, state_size, text, write_state,
};
use crate::instance::{Instance, Made, Start};
use crate::refusal::{Refusal, Severity};
use crate::uri::path_of_uri;

/// The importer's log: environment, instance, status, category, format of the rest.
pub(super) type Logger =
    unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...);

/// What the importer lends, of which the log is needed.
#[repr(C)]
pub(super) struct Callbacks {
    logger: Option<Logger>,
    _allocate: *const c_void,
    _free: *const c_void,
    _step_finished: *const c_void,
    environment: *mut c_void,
}

/// Co-simulation, among the types of units; the instant that was reached, and whether that was the end, among kinds of status.
const CO_SIMULATION: c_int = 1;
const LAST_SUCCESSFUL_TIME: c_int = 2;
const TERMINATED: c_int = 3;

const NO_SUCH_TYPE: &str =
    "variables of this type can't be had here: those of linkdyn are real, and events an integer";
const NO_MODEL_EXCHANGE: &str = "the unit is one for co-simulation, not for model exchange";
const NO_INPUT_DERIVATIVES: &str = "inputs are constant in a step: canInterpolateInputs is false";
const NO_OUTPUT_DERIVATIVES: &str =
    "the unit has no derivatives of outputs by time: maxOutputDerivativeOrder is 0";
const NOT_PENDING: &str = "no step is pending: canRunAsynchronuously is false";

#[unsafe(no_mangle)]
pub(super) extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

#[unsafe(no_mangle)]
pub(super) extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2Instantiate(
    name: *const c_char,
    kind: c_int,
    token: *const c_char,
    resources: *const c_char,
    callbacks: *const Callbacks,
    _visible: c_int,
    is_logging: c_int,
) -> Handle {
    // SAFETY: the caller's, texts or null.
    let (name, token, resources) = unsafe { (text(name), text(token), text(resources)) };
    // SAFETY: the caller's.
    let lent = unsafe { callbacks.as_ref() };
    let (logger, environment) = lent.map_or((None, std::ptr::null_mut()), |lent| {
        (lent.logger, lent.environment)
    });
    let name = c_text(&name);
    let say = move |severity: Option<Severity>, category: &str, line: &str| {
        let Some(logger) = logger else { return };
        let status = severity.map_or(super::OK, |severity| severity as c_int);
        let (category, line) = (c_text(category), c_text(line));
        // SAFETY: the importer's function, with texts that live as long as it takes; the line is no format.
        unsafe {
            logger(
                environment,
                name.as_ptr(),
                status,
                category.as_ptr(),
                c"%s".as_ptr(),
                line.as_ptr(),
            );
        }
    };
    let made = || {
        if kind != CO_SIMULATION {
            return Err(Refusal::new(NO_MODEL_EXCHANGE));
        }
        let made = Made {
            token: &token,
            resources: &path_of_uri(&resources)?,
            stops_at_events: false,
            is_logging: is_logging != 0,
        };
        Instance::new(&made, Box::new(say.clone()))
    };
    handed(made, |severity, line| {
        say(Some(severity), super::CATEGORY, line)
    })
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2FreeInstance(instance: Handle) {
    // SAFETY: the caller's.
    unsafe { free(instance) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SetDebugLogging(instance: Handle, is_on: c_int) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |instance| {
            instance.is_logging = is_on != 0;
            Ok(())
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SetupExperiment(
    instance: Handle,
    _has_tolerance: c_int,
    _tolerance: f64,
    start: f64,
    has_end: c_int,
    end: f64,
) -> c_int {
    let end = (has_end != 0).then_some(end);
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |instance| {
            instance.set_start(Start { start, end })
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2EnterInitializationMode(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { answer(instance, Instance::enter_initialization) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2ExitInitializationMode(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { answer(instance, Instance::exit_initialization) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2Terminate(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { answer(instance, Instance::terminate) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2Reset(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { answer(instance, Instance::reset) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetReal(
    instance: Handle,
    references: *const u32,
    count: usize,
    values: *mut f64,
) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |instance| {
            instance.get(array(references, count)?, array_mut(values, count)?)
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SetReal(
    instance: Handle,
    references: *const u32,
    count: usize,
    values: *const f64,
) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |instance| {
            instance.set(array(references, count)?, array(values, count)?)
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetInteger(
    instance: Handle,
    references: *const u32,
    count: usize,
    values: *mut c_int,
) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |instance| {
            instance.get_counts(array(references, count)?, array_mut(values, count)?)
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetDirectionalDerivative(
    instance: Handle,
    unknowns: *const u32,
    unknown_count: usize,
    knowns: *const u32,
    known_count: usize,
    seed: *const f64,
    sensitivity: *mut f64,
) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |instance| {
            let unknowns = (
                array(unknowns, unknown_count)?,
                array_mut(sensitivity, unknown_count)?,
            );
            instance.derivative(
                (array(knowns, known_count)?, array(seed, known_count)?),
                unknowns,
            )
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2DoStep(
    instance: Handle,
    now: f64,
    step: f64,
    _never_back: c_int,
) -> c_int {
    // SAFETY: the caller's.
    unsafe { answer(instance, |instance| instance.step(now, step).map(drop)) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetStatus(
    instance: Handle,
    _kind: c_int,
    status: *mut c_int,
) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |_| {
            *place(status)? = super::OK;
            Err(Refusal::new(NOT_PENDING))
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetRealStatus(
    instance: Handle,
    kind: c_int,
    value: *mut f64,
) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |instance| match kind {
            LAST_SUCCESSFUL_TIME => {
                *place(value)? = instance.time();
                Ok(())
            }
            _ => Err(Refusal::new(NOT_PENDING)),
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetBooleanStatus(
    instance: Handle,
    kind: c_int,
    value: *mut c_int,
) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |_| match kind {
            TERMINATED => {
                *place(value)? = 0;
                Ok(())
            }
            _ => Err(Refusal::new(NOT_PENDING)),
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetFMUstate(instance: Handle, state: *mut Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { get_state(instance, state) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SetFMUstate(instance: Handle, state: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { set_state(instance, state) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2FreeFMUstate(instance: Handle, state: *mut Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { free_state(instance, state) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SerializedFMUstateSize(
    instance: Handle,
    state: Handle,
    size: *mut usize,
) -> c_int {
    // SAFETY: the caller's.
    unsafe { state_size(instance, state, size) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SerializeFMUstate(
    instance: Handle,
    state: Handle,
    bytes: *mut u8,
    count: usize,
) -> c_int {
    // SAFETY: the caller's.
    unsafe { write_state(instance, state, bytes, count) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2DeSerializeFMUstate(
    instance: Handle,
    bytes: *const u8,
    count: usize,
    state: *mut Handle,
) -> c_int {
    // SAFETY: the caller's.
    unsafe { read_state(instance, bytes, count, state) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetBoolean(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetString(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SetInteger(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SetBoolean(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SetString(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SetRealInputDerivatives(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_INPUT_DERIVATIVES) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetRealOutputDerivatives(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_OUTPUT_DERIVATIVES) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2CancelStep(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NOT_PENDING) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetIntegerStatus(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NOT_PENDING) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetStringStatus(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NOT_PENDING) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2EnterEventMode(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2NewDiscreteStates(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2EnterContinuousTimeMode(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2CompletedIntegratorStep(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SetTime(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SetContinuousStates(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetDerivatives(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetEventIndicators(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetContinuousStates(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetNominalsOfContinuousStates(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}
