//! The methods to be measured, each with its one knob turned from coarse to fine.

use crate::methods::{Events, Exact, FixedStep, Integrator, Moreau, Scheme};
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

/// A method ready to run.
pub struct Setting {
    /// Step in drive periods or tolerance; nothing if the method has no knob.
    pub knob: Option<f64>,
    /// The method.
    pub method: Box<dyn Integrator>,
}

/// Finest step is a drive period over 2 to this.
const FINEST: i32 = 22;
/// Coarsest step is a drive period over 2 to this.
const COARSEST: i32 = 4;

/// All methods that are made for a scene, the exact one first; every other setting of the others if it has to be quick.
pub fn all(scene: &Scene, quick: bool) -> Vec<Family> {
    let every = if quick { 2 } else { 1 };
    let mut families = vec![Family::exact()];
    families.extend(fixed_steps(scene.period(), every));
    families.extend(scene.wall().map(|_| moreau(scene.period(), every)));
    families.extend(adaptive(every));
    families
}

/// The steps of a period in periods, from coarse to fine.
fn steps(every: usize) -> impl Iterator<Item = f64> + Clone {
    (COARSEST..=FINEST).step_by(every).map(|k| 0.5_f64.powi(k))
}

fn fixed_steps(period: f64, every: usize) -> Vec<Family> {
    let mut families = Vec::new();
    for (index, scheme) in Scheme::ALL.into_iter().enumerate() {
        for events in [Events::Located, Events::Ignored] {
            let blind = events == Events::Ignored;
            let name = format!("{}, {}", scheme.name(), events.name());
            let method = |knob: f64| FixedStep {
                scheme,
                step: knob * period,
                events,
            };
            let scheme = 1 + index;
            families.push(Family::new(
                &name,
                Look { scheme, blind },
                steps(every),
                method,
            ));
        }
    }
    families
}

/// Moreau's method, for a rigid stop.
fn moreau(period: f64, every: usize) -> Family {
    let look = Look {
        scheme: 1 + Scheme::ALL.len(),
        blind: false,
    };
    Family::new("Moreau", look, steps(every), |knob| Moreau {
        step: knob * period,
        theta: 0.5,
    })
}

/// Tolerances of the adaptive solvers, from coarse to fine; absolute ones are the same in m and m/s.
fn adaptive(every: usize) -> Vec<Family> {
    let family = |(index, scheme): (usize, AdaptiveScheme)| {
        let look = Look {
            scheme: 2 + Scheme::ALL.len() + index,
            blind: false,
        };
        let tolerances = (3..=13).step_by(every).map(|k| 10.0_f64.powi(-k));
        Family::new(scheme.name(), look, tolerances, |tolerance| Adaptive {
            scheme,
            relative: tolerance,
            absolute: tolerance,
        })
    };
    let schemes = AdaptiveScheme::ALL.into_iter().enumerate();
    schemes.map(family).collect()
}

impl Family {
    /// A method with a knob.
    pub fn new<M: Integrator + 'static>(
        name: &str,
        look: Look,
        knobs: impl IntoIterator<Item = f64>,
        method: impl Fn(f64) -> M,
    ) -> Self {
        let setting = |knob| Setting {
            knob: Some(knob),
            method: Box::new(method(knob)),
        };
        Self {
            name: name.to_owned(),
            look,
            settings: knobs.into_iter().map(setting).collect(),
        }
    }

    /// The exact method.
    pub fn exact() -> Self {
        let look = Look {
            scheme: 0,
            blind: false,
        };
        let method = Box::new(Exact);
        Self {
            name: method.name(),
            look,
            settings: vec![Setting { knob: None, method }],
        }
    }
}
