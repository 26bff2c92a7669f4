//! The methods of the atlas: each with its step left open.

use crate::methods::{Events, FixedStep, Integrator, Moreau, Scheme};

/// Weight of the step's end in Moreau's time stepping: of second order between impacts.
const THETA: f64 = 0.5;

/// A method for any step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SteppedMethod {
    /// A scheme for smooth laws, and what it does about events.
    FixedStep(Scheme, Events),
    /// Moreau's time stepping for rigid stops.
    Moreau,
}

impl SteppedMethod {
    /// All of them: those that ignore events first.
    pub fn all() -> Vec<Self> {
        let with = |events| Scheme::ALL.map(|scheme| Self::FixedStep(scheme, events));
        let mut all = with(Events::Ignored).to_vec();
        all.push(Self::Moreau);
        all.extend(with(Events::Located));
        all
    }

    /// Its name: scheme and treatment of events.
    pub fn name(&self) -> String {
        format!("{}, {}", self.title(), self.row())
    }

    /// The row of the atlas in which it stands.
    pub fn row(&self) -> &'static str {
        match self {
            Self::FixedStep(_, events) => events.name(),
            Self::Moreau => Events::Ignored.name(),
        }
    }

    /// Its name within the row.
    pub fn title(&self) -> &'static str {
        match self {
            Self::FixedStep(scheme, _) => scheme.name(),
            Self::Moreau => "Moreau",
        }
    }

    /// The method with a step in s.
    pub fn method(&self, step: f64) -> Box<dyn Integrator> {
        match *self {
            Self::FixedStep(scheme, events) => Box::new(FixedStep::new(scheme, step, events)),
            Self::Moreau => Box::new(Moreau { step, theta: THETA }),
        }
    }

    /// Longest stable step times the frequency of an oscillator of this damping ratio; none if there is no
    /// limit.
    pub fn limit(&self, ratio: f64) -> Option<f64> {
        match self {
            Self::FixedStep(scheme, _) => scheme.stability_limit(ratio),
            Self::Moreau => None,
        }
    }
}
