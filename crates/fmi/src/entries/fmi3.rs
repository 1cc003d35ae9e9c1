//! FMI 3.0.

use std::ffi::{c_char, c_int, c_void};
use std::path::Path;

use super::{
    Handle, answer, array, array_mut, c_text, free, free_state, get_state, handed, lacking, place,
    read_state, set_state, state_size, text, write_state,
};
use crate::instance::{Instance, Made, Start};
use crate::refusal::Severity;

/// The importer's log.
pub(super) type Message = unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char);

const NO_SUCH_TYPE: &str = "variables of this type can't be had here: those of linkdyn are of type Float64, and events of type Int32";
const NO_CLOCKS: &str = "the unit has no clocks";
const NO_DEPENDENCIES: &str =
    "dependencies are in modelDescription.xml: providesPerElementDependencies is false";
const NO_ADJOINTS: &str =
    "the unit has no adjoint derivatives: providesAdjointDerivatives is false";
const NO_STRUCTURE: &str = "the unit has no structural parameters";
const NO_DISCRETE_STATES: &str =
    "the unit has no discrete states to evaluate: providesEvaluateDiscreteStates is false";
const NO_MODEL_EXCHANGE: &str = "the unit is one for co-simulation, not for model exchange";
const NO_OUTPUT_DERIVATIVES: &str =
    "the unit has no derivatives of outputs by time: maxOutputDerivativeOrder is 0";
const NO_PARTITIONS: &str = "the unit is one for co-simulation, not for scheduled execution";

#[unsafe(no_mangle)]
pub(super) extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

/// Says something to an importer.
fn say(environment: *mut c_void, message: Option<Message>, said: (Option<Severity>, &str, &str)) {
    let (severity, category, line) = said;
    if let Some(message) = message {
        let status = severity.map_or(super::OK, |severity| severity as c_int);
        let (category, line) = (c_text(category), c_text(line));
        // SAFETY: the importer's function, with texts that live as long as it takes.
        unsafe { message(environment, status, category.as_ptr(), line.as_ptr()) };
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3InstantiateCoSimulation(
    _name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: u8,
    is_logging: u8,
    stops_at_events: u8,
    may_return_early: u8,
    _required: *const u32,
    _required_count: usize,
    environment: *mut c_void,
    message: Option<Message>,
    _update: *const c_void,
) -> Handle {
    // SAFETY: the caller's, texts or null.
    let (token, resources) = unsafe { (text(token), text(resources)) };
    let log = move |severity, category: &str, line: &str| {
        say(environment, message, (severity, category, line));
    };
    let made = Made {
        token: &token,
        resources: Path::new(&resources),
        stops_at_events: stops_at_events != 0 && may_return_early != 0,
        is_logging: is_logging != 0,
    };
    handed(
        || Instance::new(&made, Box::new(log)),
        |severity, line| {
            say(
                environment,
                message,
                (Some(severity), super::CATEGORY, line),
            )
        },
    )
}

#[unsafe(no_mangle)]
pub(super) extern "C" fn fmi3InstantiateModelExchange(
    _name: *const c_char,
    _token: *const c_char,
    _resources: *const c_char,
    _visible: u8,
    _is_logging: u8,
    environment: *mut c_void,
    message: Option<Message>,
) -> Handle {
    let said = (Some(Severity::Error), super::CATEGORY, NO_MODEL_EXCHANGE);
    say(environment, message, said);
    std::ptr::null_mut()
}

#[unsafe(no_mangle)]
pub(super) extern "C" fn fmi3InstantiateScheduledExecution(
    _name: *const c_char,
    _token: *const c_char,
    _resources: *const c_char,
    _visible: u8,
    _is_logging: u8,
    environment: *mut c_void,
    message: Option<Message>,
    _update: *const c_void,
    _lock: *const c_void,
    _unlock: *const c_void,
) -> Handle {
    let said = (Some(Severity::Error), super::CATEGORY, NO_PARTITIONS);
    say(environment, message, said);
    std::ptr::null_mut()
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3FreeInstance(instance: Handle) {
    // SAFETY: the caller's.
    unsafe { free(instance) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetDebugLogging(instance: Handle, is_on: u8) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |instance| {
            instance.is_logging = is_on != 0;
            Ok(())
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3EnterInitializationMode(
    instance: Handle,
    _has_tolerance: u8,
    _tolerance: f64,
    start: f64,
    has_end: u8,
    end: f64,
) -> c_int {
    let end = (has_end != 0).then_some(end);
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |instance| {
            instance.set_start(Start { start, end })?;
            instance.enter_initialization()
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3ExitInitializationMode(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { answer(instance, Instance::exit_initialization) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3EnterEventMode(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { answer(instance, Instance::enter_event) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3UpdateDiscreteStates(
    instance: Handle,
    need_update: *mut bool,
    terminate: *mut bool,
    nominals_changed: *mut bool,
    values_changed: *mut bool,
    has_next_event: *mut bool,
    _next_event: *mut f64,
) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |instance| {
            let flags = [
                need_update,
                terminate,
                nominals_changed,
                values_changed,
                has_next_event,
            ];
            for flag in flags {
                *place(flag)? = false;
            }
            instance.update_discrete_states()
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3EnterStepMode(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { answer(instance, Instance::enter_step) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3Terminate(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { answer(instance, Instance::terminate) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3Reset(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { answer(instance, Instance::reset) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetFloat64(
    instance: Handle,
    references: *const u32,
    count: usize,
    values: *mut f64,
    value_count: usize,
) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |instance| {
            instance.get(array(references, count)?, array_mut(values, value_count)?)
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetFloat64(
    instance: Handle,
    references: *const u32,
    count: usize,
    values: *const f64,
    value_count: usize,
) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |instance| {
            instance.set(array(references, count)?, array(values, value_count)?)
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetInt32(
    instance: Handle,
    references: *const u32,
    count: usize,
    values: *mut i32,
    value_count: usize,
) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |instance| {
            instance.get_counts(array(references, count)?, array_mut(values, value_count)?)
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetDirectionalDerivative(
    instance: Handle,
    unknowns: *const u32,
    unknown_count: usize,
    knowns: *const u32,
    known_count: usize,
    seed: *const f64,
    seed_count: usize,
    sensitivity: *mut f64,
    sensitivity_count: usize,
) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |instance| {
            let unknowns = (
                array(unknowns, unknown_count)?,
                array_mut(sensitivity, sensitivity_count)?,
            );
            instance.derivative(
                (array(knowns, known_count)?, array(seed, seed_count)?),
                unknowns,
            )
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3DoStep(
    instance: Handle,
    now: f64,
    step: f64,
    _never_back: u8,
    has_event: *mut bool,
    terminate: *mut bool,
    is_early: *mut bool,
    reached: *mut f64,
) -> c_int {
    // SAFETY: the caller's.
    unsafe {
        answer(instance, |instance| {
            *place(terminate)? = false;
            *place(has_event)? = false;
            *place(is_early)? = false;
            let stepped = instance.step(now, step);
            *place(reached)? = instance.time();
            let stepped = stepped?;
            *place(has_event)? = stepped.has_event;
            *place(is_early)? = stepped.is_early;
            Ok(())
        })
    }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetFMUState(instance: Handle, state: *mut Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { get_state(instance, state) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetFMUState(instance: Handle, state: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { set_state(instance, state) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3FreeFMUState(instance: Handle, state: *mut Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { free_state(instance, state) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SerializedFMUStateSize(
    instance: Handle,
    state: Handle,
    size: *mut usize,
) -> c_int {
    // SAFETY: the caller's.
    unsafe { state_size(instance, state, size) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SerializeFMUState(
    instance: Handle,
    state: Handle,
    bytes: *mut u8,
    count: usize,
) -> c_int {
    // SAFETY: the caller's.
    unsafe { write_state(instance, state, bytes, count) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3DeserializeFMUState(
    instance: Handle,
    bytes: *const u8,
    count: usize,
    state: *mut Handle,
) -> c_int {
    // SAFETY: the caller's.
    unsafe { read_state(instance, bytes, count, state) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetFloat32(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetInt8(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetUInt8(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetInt16(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetUInt16(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetUInt32(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetInt64(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetUInt64(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetBoolean(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetString(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetBinary(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetClock(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_CLOCKS) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetFloat32(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetInt8(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetUInt8(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetInt16(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetUInt16(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetInt32(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetUInt32(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetInt64(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetUInt64(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetBoolean(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetString(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetBinary(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_SUCH_TYPE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetClock(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_CLOCKS) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetNumberOfVariableDependencies(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_DEPENDENCIES) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetVariableDependencies(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_DEPENDENCIES) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetAdjointDerivative(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_ADJOINTS) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3EnterConfigurationMode(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_STRUCTURE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3ExitConfigurationMode(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_STRUCTURE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetIntervalDecimal(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_CLOCKS) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetIntervalFraction(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_CLOCKS) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetShiftDecimal(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_CLOCKS) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetShiftFraction(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_CLOCKS) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetIntervalDecimal(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_CLOCKS) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetIntervalFraction(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_CLOCKS) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetShiftDecimal(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_CLOCKS) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetShiftFraction(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_CLOCKS) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3EvaluateDiscreteStates(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_DISCRETE_STATES) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3EnterContinuousTimeMode(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3CompletedIntegratorStep(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetTime(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3SetContinuousStates(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetContinuousStateDerivatives(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetEventIndicators(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetContinuousStates(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetNominalsOfContinuousStates(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetNumberOfEventIndicators(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetNumberOfContinuousStates(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_MODEL_EXCHANGE) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3GetOutputDerivatives(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_OUTPUT_DERIVATIVES) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi3ActivateModelPartition(instance: Handle) -> c_int {
    // SAFETY: the caller's.
    unsafe { lacking(instance, NO_PARTITIONS) }
}
