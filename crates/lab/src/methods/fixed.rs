//! Fixed steps, with and without location of events.

use super::ignored::{self, Places};
use super::located::Located;
use super::machine::{Laws, Machine, State, in_range};
use super::scheme::Scheme;
use super::step::Step;
use super::{Integrator, MethodError, Solution, Task};

/// What a method does about places at which the law changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Events {
    /// Nothing: the law is taken as it is wherever the state is evaluated. Dry friction goes by sign(v) with
    /// sign(0) = 0; a mass beyond a rigid stop at the end of a step is put on it and sent back.
    Ignored,
    /// Each phase's law is followed smoothly to the end of a step; if a guard of the phase is above zero
    /// there, its crossing is located by shorter steps from the same start. What crosses and comes back
    /// within one step is not seen.
    Located,
}

impl Events {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Ignored, Self::Located];

    /// What is done about them, in a word.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Ignored => "events ignored",
            Self::Located => "events located",
        }
    }
}

/// Steps of equal length by a classical scheme.
///
/// The duration is divided into the least number of equal steps that are no longer than `step`, so that the
/// last one ends at its end. Located events divide single steps further.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FixedStep {
    /// The scheme.
    pub scheme: Scheme,
    /// Longest step in s, > 0.
    pub step: f64,
    /// What it does about events.
    pub events: Events,
}

impl FixedStep {
    /// A scheme with steps of a length in s.
    pub const fn new(scheme: Scheme, step: f64, events: Events) -> Self {
        Self {
            scheme,
            step,
            events,
        }
    }

    /// Every scheme of [`Scheme::ALL`], each with events ignored and located.
    pub fn all(step: f64) -> Vec<Self> {
        let both = |scheme| Events::ALL.map(|events| Self::new(scheme, step, events));
        Scheme::ALL.into_iter().flat_map(both).collect()
    }
}

impl Integrator for FixedStep {
    fn name(&self) -> String {
        let (scheme, events) = (self.scheme.name(), self.events.name());
        format!("{scheme}, h = {} s, {events}", self.step)
    }

    fn integrate(&self, task: &Task) -> Result<Solution, MethodError> {
        if let Some((name, value)) = self.scheme.out_of_range() {
            in_range(name, value, false, "in [0, 1]")?;
        }
        let mut machine = Machine::new(task, self.step)?;
        let start = Step {
            scheme: self.scheme,
            laws: Laws::All,
            time: 0.0,
            from: State::of(task.start),
        };
        let end = match self.events {
            Events::Ignored => {
                let places = Places::of(task, &machine);
                ignored::run(&mut machine, places, start)?
            }
            Events::Located => Located::new(&mut machine, task, start)?.run()?,
        };
        Ok(machine.finish(end))
    }
}
