//! The methods to be measured, each with its one knob turned from coarse to fine.

use softstop::methods::{Exact, Integrator};

/// A method and the settings of its knob.
pub struct Family {
    /// The method's name, without settings.
    pub name: String,
    /// From coarse to fine.
    pub settings: Vec<Setting>,
}

/// A method ready to run.
pub struct Setting {
    /// Step in drive periods or tolerance; nothing if the method has no knob.
    pub knob: Option<f64>,
    /// The method.
    pub method: Box<dyn Integrator>,
}

impl Family {
    /// A method with a knob.
    pub fn new<M: Integrator + 'static>(
        name: &str,
        knobs: impl IntoIterator<Item = f64>,
        method: impl Fn(f64) -> M,
    ) -> Self {
        let setting = |knob| Setting {
            knob: Some(knob),
            method: Box::new(method(knob)),
        };
        Self {
            name: name.to_owned(),
            settings: knobs.into_iter().map(setting).collect(),
        }
    }

    /// The exact method.
    #[must_use]
    pub fn exact() -> Self {
        let method = Box::new(Exact);
        Self {
            name: method.name(),
            settings: vec![Setting { knob: None, method }],
        }
    }
}
