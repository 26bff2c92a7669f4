//! All that can be read of an instance, read without touching it.

use std::ffi::c_void;
use std::ptr;

use softstop_fmi::variable::Kind;
use softstop_fmi2::*;
use softstop_fmu::{library_guid, table};

use super::calls::{Call, Null, Type, reference};
use super::perform::perform;

/// An instance without a log.
pub fn silent() -> *mut c_void {
    let guid = std::ffi::CString::new(library_guid().expect("a GUID")).expect("no NUL");
    // SAFETY: strings outlive the call; callbacks may be NULL.
    let made = unsafe {
        fmi2Instantiate(
            c"silent".as_ptr(),
            1,
            guid.as_ptr(),
            ptr::null(),
            ptr::null(),
            0,
            0,
        )
    };
    assert!(!made.is_null());
    made
}

/// An instance that takes up the state of another one to be read in its place.
pub struct Probe(*mut c_void);

impl Probe {
    pub fn new() -> Self {
        Self(silent())
    }

    fn take_up(&self, component: *mut c_void) {
        let mut state = ptr::null_mut();
        // SAFETY: both instances are alive; the state is freed once.
        unsafe {
            assert_eq!(fmi2GetFMUstate(component, &raw mut state), 0);
            assert_eq!(fmi2SetFMUstate(self.0, state), 0);
            assert_eq!(fmi2FreeFMUstate(self.0, &raw mut state), 0);
        }
    }

    /// Status and bits of everything that can be read.
    pub fn everything(&self, component: *mut c_void) -> Vec<(i32, u64)> {
        self.take_up(component);
        let mut calls: Vec<_> = table()
            .rows()
            .map(|variable| {
                let kind = match variable.kind {
                    Kind::Real(_) => Type::Real,
                    Kind::Boolean => Type::Boolean,
                    _ => Type::Integer,
                };
                Call::Get(kind, vec![variable.reference], Null::Nothing)
            })
            .collect();
        let velocity = reference("velocity");
        calls.push(Call::GetOutputDerivatives(
            vec![(velocity, 2)],
            Null::Nothing,
        ));
        let by = vec![(reference("force"), 1.0)];
        calls.push(Call::Directional(vec![velocity], by, Null::Nothing));
        let mut read: Vec<_> = calls
            .iter()
            .map(|call| {
                let (status, values) = perform(self.0, call);
                (status, values[0].to_bits())
            })
            .collect();
        read.push((0, self.time_of(self.0).to_bits()));
        read.push((step_status(self.0), 0));
        read
    }

    /// The position, if it can be read.
    pub fn position(&self, component: *mut c_void) -> f64 {
        self.take_up(component);
        let call = Call::Get(Type::Real, vec![reference("position")], Null::Nothing);
        perform(self.0, &call).1[0]
    }

    /// The last successful time.
    pub fn time_of(&self, component: *mut c_void) -> f64 {
        let mut time = f64::NAN;
        // SAFETY: the instance is alive.
        assert_eq!(unsafe { fmi2GetRealStatus(component, 2, &raw mut time) }, 0);
        time
    }
}

fn step_status(component: *mut c_void) -> i32 {
    let mut status = -1;
    // SAFETY: the instance is alive.
    assert_eq!(unsafe { fmi2GetStatus(component, 0, &raw mut status) }, 0);
    status
}

impl Drop for Probe {
    fn drop(&mut self) {
        // SAFETY: made by `silent` and freed once.
        unsafe { fmi2FreeInstance(self.0) };
    }
}
