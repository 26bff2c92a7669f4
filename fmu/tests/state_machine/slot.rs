//! One instance of the importer's, its shadow and its model.

use std::ffi::c_int;

use softstop_fmu::table;

use super::calls::Call;
use super::model::{Life, Model};
use super::perform::perform;
use super::probe::silent;
use crate::common::{ERROR, InstantiateArguments, OK, Unit};

pub struct Slot {
    pub unit: Unit,
    pub shadow: Unit,
    has_log: bool,
    pub model: Model,
    /// Something was set since the last step that the motion takes over when it is next looked at.
    pub unsettled: bool,
}

impl Slot {
    pub fn new(unit: Unit, arguments: &InstantiateArguments) -> Self {
        Self {
            unit,
            shadow: silent(),
            has_log: arguments.has_callbacks && arguments.has_logger,
            model: Model::new(),
            unsettled: false,
        }
    }

    /// One line for a refused call, none of an error otherwise.
    pub fn check_log(&self, call: &Call, (name, status): (&str, c_int)) {
        let lines = self.unit.take_log();
        let told = match name {
            _ if !self.has_log => vec![],
            _ if status == ERROR => vec![format!("3 errors {name}: ")],
            "fmi2DoStep" => ["0 warnings currentCommunicationPoint", "0 events "]
                .map(str::to_owned)
                .to_vec(),
            "fmi2SetupExperiment" => vec!["0 warnings tolerance".to_owned()],
            _ => vec![],
        };
        let least = usize::from(self.has_log && status == ERROR);
        let apt = |line: &String| told.iter().any(|words| line.starts_with(words));
        let is_told = lines.iter().all(apt) && (least..=told.len()).contains(&lines.len());
        assert!(is_told, "{call:?}: {lines:?}");
    }

    /// A look at the outputs makes the motion take over what was set: the shadow looks as well. How far
    /// a refused look came is nobody's business, so both look again.
    pub fn note_look(&mut self, call: &Call, done: bool) {
        let is_output = |vr: &u32| table().by_reference(*vr).is_some_and(|row| row.is_output());
        let looks = match call {
            Call::Get(_, references, _) => references.iter().any(is_output),
            Call::Directional(..) | Call::GetOutputDerivatives(..) => true,
            _ => false,
        };
        if looks && self.unsettled && self.model.life == Life::Running {
            if !done {
                self.unit.get("position");
            }
            self.shadow.get("position");
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
            let ((_, status), _) = perform(self.shadow.component, call);
            assert_eq!(status, OK, "the shadow's {call:?}");
        }
        match call {
            Call::Reset => self.unsettled = false,
            Call::Set(..) | Call::SetInputDerivatives(..) => self.unsettled = true,
            Call::Get(_, references, _) => self.model.check_values(references, values),
            _ => {}
        }
    }
}
