//! The methods to be measured, each with its one knob turned from coarse to fine.

use crate::failures::Family as Stepped;
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

/// All methods that are made for a scene, the exact one first; every other setting of the others if it has to be quick.
pub fn all(scene: &Scene, quick: bool) -> Vec<Family> {
    let every = if quick { 2 } else { 1 };
    let mut families = vec![Family::exact()];
    families.extend(fixed_steps(scene, every));
    families.extend(adaptive(every));
    families
}

/// Methods with a fixed step: every scheme, and Moreau's for a rigid stop.
fn fixed_steps(scene: &Scene, every: usize) -> Vec<Family> {
    let period = scene.period();
    let schemes = Scheme::ALL.into_iter().enumerate();
    let both = schemes.flat_map(|(index, scheme)| {
        let with = |events| (index, Stepped::FixedStep(scheme, events));
        [Events::Located, Events::Ignored].map(with)
    });
    let moreau = scene.wall().map(|_| (Scheme::ALL.len(), Stepped::Moreau));
    let family = |(index, stepped): (usize, Stepped)| {
        let (name, blind) = match stepped {
            Stepped::FixedStep(_, events) => (stepped.name(), events == Events::Ignored),
            Stepped::Moreau => (stepped.title().to_owned(), false),
        };
        let scheme = 1 + index;
        let look = Look { scheme, blind };
        let steps = (COARSEST..=FINEST).step_by(every).map(|k| 0.5_f64.powi(k));
        Family::new(&name, look, steps, |knob| stepped.method(knob * period))
    };
    both.chain(moreau).map(family).collect()
}

/// Tolerances of the adaptive solvers, from coarse to fine; absolute ones are the same in m and m/s.
fn adaptive(every: usize) -> Vec<Family> {
    let family = |(index, scheme): (usize, AdaptiveScheme)| {
        let look = Look {
            scheme: 2 + Scheme::ALL.len() + index,
            blind: false,
        };
        let tolerances = (3..=13).step_by(every).map(|k| 10.0_f64.powi(-k));
        Family::new(scheme.name(), look, tolerances, |tolerance| {
            Box::new(Adaptive {
                scheme,
                relative: tolerance,
                absolute: tolerance,
            })
        })
    };
    let schemes = AdaptiveScheme::ALL.into_iter().enumerate();
    schemes.map(family).collect()
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
        let look = Look {
            scheme: 0,
            blind: false,
        };
        let method = Box::new(Exact);
        Self {
            name: method.name(),
            look,
            settings: vec![(None, method)],
        }
    }
}
