//! What an importer solves for, beside the unit's own motion.

use serde::{Deserialize, Serialize};

use crate::signal::Signal;
use crate::unit::{Events, Row, State, StateSpace, Unit};

/// Share of its nominal value by which a state that an importer has integrated may miss the unit's own motion.
const AGREEMENT: f64 = 0.1;

/// What the importer has set since the last event.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Exchange<U> {
    /// The unit on its own way.
    pub(crate) own: U,
    /// The inputs that it takes along.
    pub(crate) inputs: Vec<Signal>,
    /// The importer's time in s, and states.
    pub(crate) time: f64,
    pub(crate) states: Vec<f64>,
    /// When event mode was last entered, and when the last integrator step ended, in s.
    pub(crate) event: f64,
    pub(crate) completed: f64,
    /// When the next event comes, and when it does as the importer knows.
    pub(crate) next: Option<f64>,
    pub(crate) told: Option<f64>,
    /// What is much of each state, as the importer knows.
    pub(crate) nominals: Vec<f64>,
    /// The instance's unit is as these states say.
    pub(crate) is_shown: bool,
}

/// What model exchange needs of a unit; nothing where there is none.
pub(crate) fn space_of<U: Unit>() -> &'static StateSpace {
    const NONE: &StateSpace = &StateSpace {
        states: &[],
        indicators: &[],
    };
    U::about().state_space.unwrap_or(NONE)
}

/// The number of a variable among the states.
pub(crate) fn number_of_state<U: Unit>(variable: &Row<U>) -> Option<usize> {
    let mut states = space_of::<U>().states.iter();
    states.position(|state| state.value == variable.reference)
}

/// The states of a unit as it is.
pub(crate) fn states_of<U: Unit>(unit: &U) -> Vec<f64> {
    of_states(unit, |state| state.value)
}

/// The derivatives of these states.
pub(crate) fn derivatives_of<U: Unit>(unit: &U) -> Vec<f64> {
    of_states(unit, |state| state.derivative)
}

fn of_states<U: Unit>(unit: &U, reference: fn(&State) -> u32) -> Vec<f64> {
    let states = space_of::<U>().states.iter();
    let value = |state| U::about().table.number(unit, reference(state));
    states.map(value).collect()
}

impl<U: Unit> Exchange<U> {
    /// What an importer begins with.
    pub(crate) fn new(own: U, inputs: Vec<Signal>) -> Self {
        let (time, states, nominals) = (own.time(), states_of(&own), own.nominals());
        Self {
            own,
            inputs,
            time,
            states,
            event: time,
            completed: time,
            next: None,
            told: None,
            nominals,
            is_shown: true,
        }
    }

    /// Whether the importer's states are those of the unit's own motion, but for its integrator's errors.
    pub(crate) fn agrees(&self) -> bool {
        let mut own = self.own.clone();
        let begin = own.time();
        if self.time > begin
            && own
                .advance(self.time, Some(begin), &mut Events::default())
                .is_err()
        {
            return false;
        }
        let ahead = self.time - own.time();
        let expected = states_of(&own).into_iter().zip(derivatives_of(&own));
        let expected = expected.map(|(value, rate)| value + rate * ahead);
        let pairs = self.states.iter().zip(expected).zip(own.nominals());
        let misses =
            |((given, expected), nominal): ((&f64, f64), f64)| (given - expected).abs() / nominal;
        pairs.map(misses).all(|missed| missed <= AGREEMENT)
    }
}
