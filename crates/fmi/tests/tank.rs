//! A unit that has nothing to do with an oscillator, through the C functions.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

#[path = "tank/three.rs"]
mod three;
#[path = "tank/mod.rs"]
mod unit;

mod functions {
    pub mod fmi2 {
        softstop_fmi::fmi2_functions!(crate::unit::Tank);
    }
    pub mod fmi3 {
        softstop_fmi::fmi3_functions!(crate::unit::Tank);
    }
}

mod fmi2 {
    use crate::functions::fmi2;

    softstop_fmi::export_fmi2!(fmi2);
}

mod fmi3 {
    use crate::functions::fmi3;

    softstop_fmi::export_fmi3!(fmi3);
}

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr;

use fmi2::*;
use softstop_fmi::package::{self, Library};
use softstop_fmi::{Imprint, description, guid_of, library_guid};
use unit::Tank;

const OK: c_int = 0;
const DISCARD: c_int = 2;
const ERROR: c_int = 3;
const INFLOW: u32 = 0;
const OPEN: u32 = 1;
const START: u32 = 2;
const GAIN: u32 = 3;
const LEVEL: u32 = 200;
const STEPS: u32 = 201;
/// Bytes before the data of a state.
const HEADER: usize = 52;

// Takes one argument after the format where C takes any number; the library passes exactly one.
unsafe extern "C" fn logger(
    environment: *mut c_void,
    _name: *const c_char,
    status: c_int,
    category: *const c_char,
    _format: *const c_char,
    text: *const c_char,
) {
    unsafe {
        let [category, text] = [category, text].map(|text| CStr::from_ptr(text).to_string_lossy());
        (*environment.cast::<Vec<String>>()).push(format!("{status} {category} {text}"));
    }
}

struct Instance {
    component: *mut c_void,
    log: *mut Vec<String>,
}

impl Instance {
    fn new() -> Self {
        let log = Box::into_raw(Box::<Vec<String>>::default());
        let guid = CString::new(library_guid::<Tank>()).expect("no NUL");
        let functions = CallbackFunctions {
            // A variadic call with one pointer more looks like one with that as the last argument.
            logger: Some(unsafe { std::mem::transmute::<*const (), Logger>(logger as *const ()) }),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            environment: log.cast(),
        };
        let (name, nothing) = (c"tank".as_ptr(), ptr::null());
        let component =
            unsafe { fmi2Instantiate(name, 1, guid.as_ptr(), nothing, &raw const functions, 0, 0) };
        assert!(!component.is_null());
        Self { component, log }
    }

    fn begun() -> Self {
        let instance = Self::new();
        instance.begin();
        instance
    }

    fn begin(&self) {
        unsafe {
            assert_eq!(fmi2SetupExperiment(self.component, 0, 0.0, 0.0, 0, 0.0), OK);
            assert_eq!(fmi2EnterInitializationMode(self.component), OK);
            assert_eq!(fmi2ExitInitializationMode(self.component), OK);
        }
    }

    fn log(&self) -> Vec<String> {
        std::mem::take(unsafe { &mut *self.log })
    }

    fn set(&self, reference: u32, value: f64) -> c_int {
        unsafe { fmi2SetReal(self.component, &raw const reference, 1, &raw const value) }
    }

    fn get(&self, reference: u32) -> f64 {
        let mut value = f64::NAN;
        let status =
            unsafe { fmi2GetReal(self.component, &raw const reference, 1, &raw mut value) };
        assert_eq!(status, OK, "{:?}", self.log());
        value
    }

    fn steps(&self) -> c_int {
        let (reference, mut value) = (STEPS, -1);
        let at = &raw mut value;
        assert_eq!(
            unsafe { fmi2GetInteger(self.component, &raw const reference, 1, at) },
            OK
        );
        value
    }

    fn status_of_step(&self) -> c_int {
        let mut status = -1;
        assert_eq!(
            unsafe { fmi2GetStatus(self.component, 0, &raw mut status) },
            OK
        );
        status
    }

    fn step(&self, point: f64, size: f64) -> c_int {
        unsafe { fmi2DoStep(self.component, point, size, 1) }
    }

    /// The derivative of the level by one known.
    fn by(&self, known: u32) -> Option<f64> {
        let (unknown, seed, mut value) = (LEVEL, 1.0, f64::NAN);
        let (known, unknown) = (&raw const known, &raw const unknown);
        let status = unsafe {
            let (seed, value) = (&raw const seed, &raw mut value);
            fmi2GetDirectionalDerivative(self.component, unknown, 1, known, 1, seed, value)
        };
        (status == OK).then_some(value)
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        unsafe {
            fmi2FreeInstance(self.component);
            drop(Box::from_raw(self.log));
        }
    }
}

#[test]
fn inputs_of_higher_order_over_one_step_or_many() {
    let ends = [1, 8].map(|number| {
        let tank = Instance::begun();
        let (inflow, order, rate) = (INFLOW, 1, 2.0);
        assert_eq!(tank.set(INFLOW, 1.0), OK);
        let (order, rate) = (&raw const order, &raw const rate);
        let status = unsafe {
            fmi2SetRealInputDerivatives(tank.component, &raw const inflow, 1, order, rate)
        };
        assert_eq!(status, OK);
        let size = 4.0 / f64::from(number);
        for k in 0..number {
            assert_eq!(tank.step(size * f64::from(k), size), OK);
        }
        assert_eq!(tank.get(INFLOW), 9.0);
        assert_eq!(tank.steps(), number);
        assert!(tank.log().is_empty());
        tank.get(LEVEL)
    });
    // 1.5 + 4 + 4^2
    assert_eq!(ends, [21.5; 2]);
}

#[test]
fn values_are_taken_over_together() {
    let tank = Instance::begun();
    assert_eq!(tank.set(INFLOW, 2.0), OK);
    assert_eq!(tank.step(0.0, 1.0), OK);
    assert_eq!(tank.set(GAIN, 0.5), OK);
    assert_eq!(tank.step(1.0, 1.0), OK);
    let (open, closed) = (OPEN, 0);
    unsafe {
        assert_eq!(
            fmi2SetBoolean(tank.component, &raw const open, 1, &raw const closed),
            OK
        )
    };
    assert_eq!(tank.step(2.0, 1.0), OK);
    assert_eq!(tank.get(LEVEL), 1.5 + 2.0 + 1.0);
    let refused = |status: c_int, words: &str| {
        let lines = tank.log();
        assert_eq!((status, lines.len()), (ERROR, 1), "{words}: {lines:?}");
        assert!(lines[0].contains(words), "{words}: {lines:?}");
    };
    refused(tank.set(GAIN, 7.0), "fmi2SetReal: gain: more arrives");
    refused(
        tank.set(GAIN, 10.0),
        "gain = 10.0: must be within 0.0 and 9.0",
    );
    refused(tank.set(START, 0.0), "start is a fixed parameter");
    refused(tank.set(LEVEL, 0.0), "level is an output");
    refused(tank.set(77, 0.0), "value reference 77");
    refused(tank.step(3.0, 1e7), "10000003 s is beyond");
    refused(tank.step(9.0, 1.0), "currentCommunicationPoint = 9 s");
    assert_eq!(tank.get(LEVEL), 4.5);
}

#[test]
fn a_discarded_step_can_be_repeated() {
    let tank = Instance::begun();
    assert_eq!(tank.set(INFLOW, 1.0), OK);
    assert_eq!(tank.step(0.0, 250.0), DISCARD);
    let lines = tank.log();
    assert!(
        lines[0].contains("up to 100 s only (100 s at a time)"),
        "{lines:?}"
    );
    assert_eq!(tank.get(LEVEL), 101.5);
    assert_eq!(tank.set(INFLOW, 3.0), OK);
    assert_eq!(tank.step(0.0, 10.0), OK);
    assert_eq!((tank.get(LEVEL), tank.steps()), (31.5, 1));
}

#[test]
fn a_discarded_step_is_told_even_if_it_cannot_be_repeated() {
    let tank = Instance::begun();
    assert_eq!(tank.step(0.0, 2e3), DISCARD);
    assert_eq!(tank.status_of_step(), DISCARD);
    assert_eq!(tank.step(0.0, 10.0), ERROR);
    assert_eq!(tank.step(100.0, 10.0), OK);
    assert_eq!(tank.status_of_step(), OK);
}

#[test]
fn bytes_lead_on() {
    let (one, other) = (Instance::begun(), Instance::new());
    assert_eq!(one.set(INFLOW, 1.25), OK);
    assert_eq!(one.step(0.0, 3.0), OK);
    let (mut state, mut copy, mut size) = (ptr::null_mut(), ptr::null_mut(), 0);
    unsafe {
        assert_eq!(fmi2GetFMUstate(one.component, &raw mut state), OK);
        assert_eq!(
            fmi2SerializedFMUstateSize(one.component, state, &raw mut size),
            OK
        );
        let mut bytes: Vec<c_char> = vec![0; size];
        let place = bytes.as_mut_ptr();
        assert_eq!(fmi2SerializeFMUstate(one.component, state, place, size), OK);
        assert_eq!(
            fmi2DeSerializeFMUstate(other.component, place, size, &raw mut copy),
            OK
        );
        assert_eq!(fmi2SetFMUstate(other.component, copy), OK);
        assert_eq!(fmi2FreeFMUstate(one.component, &raw mut state), OK);
        assert_eq!(fmi2FreeFMUstate(other.component, &raw mut copy), OK);
    }
    for tank in [&one, &other] {
        assert_eq!(tank.step(3.0, 1.0), OK);
    }
    assert_eq!(one.get(LEVEL), other.get(LEVEL));
}

/// Values to go back to that are too few are refused, as too few values are.
#[test]
fn bytes_of_other_values_are_refused() {
    let tank = Instance::begun();
    let (component, mut state, mut size) = (tank.component, ptr::null_mut(), 0);
    unsafe {
        assert_eq!(fmi2GetFMUstate(component, &raw mut state), OK);
        let status = fmi2SerializedFMUstateSize(component, state, &raw mut size);
        assert_eq!(status, OK);
    }
    let mut bytes = vec![0_u8; size];
    let place: *mut c_char = bytes.as_mut_ptr().cast();
    assert_eq!(
        unsafe { fmi2SerializeFMUstate(component, state, place, size) },
        OK
    );
    assert_eq!(unsafe { fmi2FreeFMUstate(component, &raw mut state) }, OK);
    let (head, data) = bytes.split_at(HEADER);
    let guid = uuid::Uuid::from_slice(&head[12..28]).expect("a GUID");
    // One more entry of a CBOR map: a text of five letters, and an array.
    let three = [&[0x83][..], &[0xf9, 0, 0].repeat(3)].concat();
    for (sound, expected) in [(&three[..], OK), (&[0x80], ERROR)] {
        let mut data = [data, b"\x65sound", sound].concat();
        data[0] += 1;
        let fingerprint = uuid::Uuid::new_v5(&guid, &data);
        let length = (data.len() as u64).to_le_bytes();
        let bytes = [&head[..28], fingerprint.as_bytes(), &length, &data].concat();
        let place: *const c_char = bytes.as_ptr().cast();
        let status =
            unsafe { fmi2DeSerializeFMUstate(component, place, bytes.len(), &raw mut state) };
        assert_eq!(status, expected, "{:?}", tank.log());
    }
    let lines = tank.log();
    assert!(
        lines[0].contains("has another set of variables"),
        "{lines:?}"
    );
    assert_eq!(unsafe { fmi2FreeFMUstate(component, &raw mut state) }, OK);
}

#[test]
fn derivatives_by_inputs_start_and_parameters() {
    let tank = Instance::new();
    unsafe {
        assert_eq!(fmi2SetupExperiment(tank.component, 0, 0.0, 0.0, 0, 0.0), OK);
        assert_eq!(fmi2EnterInitializationMode(tank.component), OK);
    }
    // In initialisation by differences where the unit has nothing to say.
    assert_eq!(
        [START, GAIN, INFLOW].map(|known| tank.by(known)),
        [Some(1.0), Some(0.0), Some(0.0)]
    );
    assert_eq!(unsafe { fmi2ExitInitializationMode(tank.component) }, OK);
    assert_eq!(tank.set(INFLOW, 1.0), OK);
    assert_eq!(tank.step(0.0, 4.0), OK);
    assert_eq!(
        [START, INFLOW].map(|known| tank.by(known)),
        [Some(1.0), Some(4.0)]
    );
    assert_eq!(tank.by(GAIN), None);
    assert!(tank.log()[0].contains("there are those by inflow"));
    assert_eq!(tank.set(INFLOW, 1.0), OK);
    assert_eq!(tank.by(INFLOW), Some(0.0));
}

#[test]
fn its_description_and_its_package() {
    let imprint = Imprint::<Tank>::new(&[2.5])
        .named("Kessel")
        .expect("a name");
    let xml = description::write(&imprint, &guid_of(&imprint));
    for words in [
        "modelName=\"Kessel\"",
        "description=\"A tank that fills\"",
        "modelIdentifier=\"tank\"",
        "maxOutputDerivativeOrder=\"1\"",
        "<DefaultExperiment startTime=\"0\" stopTime=\"10\"/>",
        "start=\"2.5\"",
    ] {
        assert!(xml.contains(words), "{words}: {xml}");
    }
    assert_ne!(guid_of(&imprint), library_guid::<Tank>());
    // This very program holds the unit's block, once.
    let program = std::env::current_exe().expect("a program");
    let library = Library::read(&program).expect("readable");
    let archive = package::archive(&imprint, &[library]).expect("an archive");
    assert!(archive.starts_with(b"PK"));
}
