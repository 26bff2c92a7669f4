//! The methods to be measured, each with its one knob turned from coarse to fine.

use crate::failures::SteppedMethod;
use crate::methods::{Events, Exact, Integrator, Scheme};
use softstop::Scene;

use crate::solvers::{Adaptive, AdaptiveScheme};

/// A method and the settings of its knob.
pub struct Family {
    /// The method's name, without settings.
    pub name: String,
    /// How its curve looks.
    pub look: Look,
    /// From coarse to fine.
    pub settings: Vec<Setting>,
}

/// How a curve looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Look {
    /// Which colour and marker: methods of the same scheme share them.
    pub scheme: usize,
    /// Whether the method is blind to events, which dashes its line.
    pub blind: bool,
}

/// A method ready to run, and its step in drive periods or tolerance; nothing if the method has no knob.
pub type Setting = (Option<f64>, Box<dyn Integrator>);

/// Finest step is a drive period over 2 to this.
const FINEST: i32 = 22;
/// Coarsest step is a drive period over 2 to this.
const COARSEST: i32 = 4;

/// A method's name without its crate, and without the events of which it locates all.
pub fn short_name(method: &str) -> &str {
    let name = method.trim_start_matches("differential-equations ");
    let name = name.trim_start_matches("diffsol ");
    name.trim_end_matches(", events located")
}

/// All methods that are made for a scene: the exact one first, then every scheme with a fixed step, Moreau's for a rigid
/// stop, and the adaptive solvers. Every other setting if it has to be
/// quick.
pub fn all(scene: &Scene, quick: bool) -> Vec<Family> {
    let (every, period) = (if quick { 2 } else { 1 }, scene.period());
    let look = |scheme, blind| Look { scheme, blind };
    let stepped = |name: &str, look, method: SteppedMethod| {
        let steps = (COARSEST..=FINEST).step_by(every).map(|k| 0.5_f64.powi(k));
        Family::new(name, look, steps, |knob| method.method(knob * period))
    };
    let schemes = Scheme::ALL.into_iter().enumerate();
    let both = schemes.flat_map(|(index, scheme)| {
        [Events::Located, Events::Ignored].map(|events| {
            let method = SteppedMethod::FixedStep(scheme, events);
            let look = look(1 + index, events == Events::Ignored);
            stepped(&method.name(), look, method)
        })
    });
    let moreau = scene.wall().map(|_| {
        let look = look(1 + Scheme::ALL.len(), false);
        stepped(SteppedMethod::Moreau.title(), look, SteppedMethod::Moreau)
    });
    let schemes = AdaptiveScheme::ALL.into_iter().enumerate();
    let adaptive = schemes.map(|(index, scheme)| {
        let tolerances = (3..=13).step_by(every).map(|k| 10.0_f64.powi(-k));
        let look = look(2 + Scheme::ALL.len() + index, false);
        Family::new(scheme.name(), look, tolerances, |tolerance| {
            Box::new(Adaptive { scheme, tolerance })
        })
    });
    let others = both.chain(moreau).chain(adaptive);
    [Family::exact()].into_iter().chain(others).collect()
}

impl Family {
    /// A method with a knob.
    pub fn new(
        name: &str,
        look: Look,
        knobs: impl IntoIterator<Item = f64>,
        method: impl Fn(f64) -> Box<dyn Integrator>,
    ) -> Self {
        let setting = |knob| (Some(knob), method(knob));
        Self {
            name: name.to_owned(),
            look,
            settings: knobs.into_iter().map(setting).collect(),
        }
    }

    /// The exact method.
    pub fn exact() -> Self {
        let (scheme, blind) = (0, false);
        Self {
            name: Exact.name(),
            look: Look { scheme, blind },
            settings: vec![(None, Box::new(Exact))],
        }
    }
}
