//! The methods of the atlas: each with its step left open.

use softstop::methods::{Events, FixedStep, Integrator, Scheme};

/// A method for any step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Family {
    /// The scheme within a smooth law.
    pub scheme: Scheme,
    /// What it does about events.
    pub events: Events,
}

impl Family {
    /// All of them: those that ignore events first.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let with = |events| Scheme::ALL.map(|scheme| Self { scheme, events });
        [with(Events::Ignored), with(Events::Located)].concat()
    }

    /// Its name: scheme and treatment of events.
    #[must_use]
    pub fn name(&self) -> String {
        format!("{}, {}", self.scheme.name(), self.row())
    }

    /// The row of the atlas in which it stands.
    #[must_use]
    pub fn row(&self) -> &'static str {
        self.events.name()
    }

    /// Its name within the row.
    #[must_use]
    pub fn title(&self) -> &'static str {
        self.scheme.name()
    }

    /// Longest stable step times the frequency of an oscillator of this damping ratio; none if there is no limit.
    #[must_use]
    pub fn limit(&self, ratio: f64) -> Option<f64> {
        match self.scheme {
            Scheme::ExplicitEuler => Some(2.0 * ratio),
            Scheme::SemiImplicitEuler => Some(2.0),
            Scheme::RungeKutta4 => Some(8.0_f64.sqrt()),
            _ => None,
        }
    }

    /// The method with a step in s.
    #[must_use]
    pub fn method(&self, step: f64) -> impl Integrator {
        FixedStep {
            scheme: self.scheme,
            step,
            events: self.events,
        }
    }
}
