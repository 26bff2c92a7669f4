//! One instance of the importer's, its shadow and its model.

use std::ffi::{c_int, c_void};

use softstop_fmu::table;

use super::calls::{Call, Null, Type, reference};
use super::model::{Life, Model};
use super::perform::{name_of, perform};
use crate::common::{ERROR, Log, OK};

pub struct Slot {
    pub component: *mut c_void,
    pub shadow: *mut c_void,
    pub log: *mut Log,
    pub has_log: bool,
    pub model: Model,
    /// Something was set since the last step that the motion takes over when it is next looked at.
    pub unsettled: bool,
}

impl Slot {
    /// One line for a refused call, none of an error otherwise.
    pub fn check_log(&self, call: &Call, status: c_int) {
        // SAFETY: the log lives as long as its instance, and no call is under way.
        let lines = unsafe { std::mem::take(&mut (*self.log).lines) };
        let name = name_of(call);
        if !self.has_log {
            assert!(lines.is_empty());
        } else if status == ERROR {
            let told = lines.len() == 1 && lines[0].starts_with(&format!("3 errors {name}: "));
            assert!(told, "{call:?}: {lines:?}");
        } else {
            let told: &[&str] = match name {
                "fmi2DoStep" => &["0 warnings currentCommunicationPoint", "0 events "],
                "fmi2SetupExperiment" => &["0 warnings tolerance"],
                _ => &[],
            };
            let apt = |line: &String| told.iter().any(|words| line.starts_with(words));
            assert!(
                lines.iter().all(apt) && lines.len() <= told.len(),
                "{call:?}: {lines:?}"
            );
        }
    }

    /// A look at the outputs makes the motion take over what was set: the shadow looks as well. How far
    /// a refused look came is nobody's business, so both look again.
    pub fn note_look(&mut self, call: &Call, done: bool) {
        let looks = match call {
            Call::Get(_, references, _) => references.iter().any(|vr| {
                table()
                    .by_reference(*vr)
                    .is_some_and(|variable| variable.is_output())
            }),
            Call::Directional(..) | Call::GetOutputDerivatives(..) => true,
            _ => false,
        };
        if looks && self.unsettled && self.model.life == Life::Running {
            let position = vec![reference("position")];
            let look = Call::Get(Type::Real, position, Null::Nothing);
            assert!(done || perform(self.component, &look).0 == OK);
            assert_eq!(perform(self.shadow, &look).0, OK);
            self.unsettled = false;
        }
    }

    /// Takes note of a call that was carried out.
    pub fn note(&mut self, call: &Call, values: &[f64]) {
        self.model.take(call);
        let changes = matches!(
            call,
            Call::SetupExperiment(..)
                | Call::EnterInitializationMode
                | Call::ExitInitializationMode
                | Call::Terminate
                | Call::Reset
                | Call::Set(..)
                | Call::SetInputDerivatives(..)
        );
        if changes {
            assert_eq!(perform(self.shadow, call).0, OK, "the shadow's {call:?}");
        }
        match call {
            Call::Reset => self.unsettled = false,
            Call::Set(..) | Call::SetInputDerivatives(..) => self.unsettled = true,
            Call::Get(_, references, _) => self.model.check_values(references, values),
            _ => {}
        }
    }
}
