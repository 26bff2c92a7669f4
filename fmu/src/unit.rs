//! The machine as a unit.

use std::error::Error;
use std::sync::OnceLock;

use softstop::{Effort, InitialConditions, MotionError, SceneError, Simulation};
use softstop_fmi::{
    About, Advance, Block, Derivatives, Events, HIGHEST_ORDER, Known, Outcome, Unit,
};

use crate::drive::Drive;
use crate::machine::{Machine, More};
use crate::start::StartValues;
use crate::start::slot::{self, SLOTS};
use crate::step::Tally;
use crate::table::{GROUPS, IMPACT, STATE_SPACE, TERMINALS};
use crate::tangent::Tangent;
use crate::units::{ENUMERATIONS, QUANTITIES};

/// How far the next crossing is looked for, in drive periods, and what that may cost.
const SIGHT: f64 = 16.0;
const OUTLOOK: Effort = Effort::windows(1 << 14);

const _: () = assert!(HIGHEST_ORDER == softstop::HIGHEST_ORDER);

/// The one place that the packager patches.
#[used]
static BLOCK: Block<[u64; SLOTS]> = Block::new(
    IDENTIFIER,
    IDENTIFIER,
    "Impact oscillator with soft, preloaded and rigid stops and piercing of a strip, solved exactly",
    &slot::START,
);

const IDENTIFIER: &str = "softstop";

static ABOUT: About<Machine> = About {
    identifier: IDENTIFIER,
    version: env!("CARGO_PKG_VERSION"),
    license: env!("CARGO_PKG_LICENSE"),
    author: env!("CARGO_PKG_AUTHORS"),
    copyright: concat!("Copyright (c) 2026 ", env!("CARGO_PKG_AUTHORS")),
    date: "2026-11-23T00:00:00Z",
    events: "impacts and pierced strips, one line for each step that has any",
    knowns: "the inputs force, base.acceleration, drive.speed and drive.amplitude, over the first step also those by initial.position and initial.velocity",
    experiment: &[
        ("startTime", "0"),
        ("stopTime", "100"),
        ("tolerance", "1e-10"),
        ("stepSize", "0.01"),
    ],
    quantities: QUANTITIES,
    enumerations: ENUMERATIONS,
    terminals: TERMINALS,
    table: softstop_fmi::Table::new(GROUPS),
    state_space: Some(&STATE_SPACE),
    clock: Some(&IMPACT),
    page: include_str!("../assets/page.html"),
    files: FILES,
    guid: OnceLock::new(),
};

const FILES: &[(&str, &[u8])] = softstop_fmi::files! {
    "model.png" = "../assets/model.png";
    "documentation/machine.svg" = "../assets/machine.svg";
    "documentation/licenses/license.txt" = "../assets/license.txt";
    "documentation/licenses/LICENSE-MIT.txt" = "../LICENSE-MIT";
    "documentation/licenses/LICENSE-APACHE.txt" = "../LICENSE-APACHE";
    "documentation/licenses/third-party.txt" = "../assets/third-party.txt";
};

impl Unit for Machine {
    type Tangent = Tangent;

    fn about() -> &'static About<Self> {
        &ABOUT
    }

    fn block() -> &'static Block {
        &BLOCK
    }

    fn begin(values: &[f64], time: f64) -> Outcome<Self> {
        let values = StartValues::of(values);
        let fed = values.is_fed();
        let begin = InitialConditions::from(values.start())
            .at_time(time)
            .fed(fed);
        let scene = values.scene();
        let simulation = Simulation::new(&scene, begin).map_err(in_names)?;
        let mut machine = Self::new(simulation, More::default());
        let takes = |slot| values.number(slot) != 0;
        let takes = (takes(slot::TAKES_SPEED), takes(slot::TAKES_AMPLITUDE));
        if takes.0 || takes.1 {
            let drive = Drive::begin(machine.simulation(), takes);
            machine.more.drive = Some(drive.into());
            machine.push()?;
        }
        Ok(machine)
    }

    fn time(&self) -> f64 {
        self.simulation().time()
    }

    fn check_values(values: &[f64]) -> Outcome<()> {
        Ok(StartValues::of(values).scene().validate()?)
    }

    fn tune(&mut self, values: &[f64]) -> Outcome<()> {
        let values = StartValues::of(values);
        self.close();
        self.retune(&values.scene())?;
        let fed = values.is_fed();
        self.change().feed_strip(fed);
        Ok(())
    }

    fn advance(
        &mut self,
        until: f64,
        halt: Option<f64>,
        events: &mut Events,
    ) -> Outcome<Advance<Self>> {
        self.go_to(until, halt, events)
    }

    const HAS_EVENTS: bool = true;

    fn pass_event(&mut self, events: &mut Events) -> Outcome<()> {
        let simulation = self.change();
        let before = Tally::of(simulation);
        if simulation.cross(&mut ()) {
            events.note();
        }
        before.tell(simulation, events);
        Ok(())
    }

    fn next_event(&self) -> Option<f64> {
        if self.more.drive.as_ref().is_some_and(|drive| drive.varies()) {
            return None;
        }
        let simulation = self.simulation();
        let sight = simulation.time() + SIGHT * simulation.scene().period();
        simulation.next_crossing(sight, OUTLOOK)
    }

    fn at_states(&self, time: f64, states: &[f64]) -> Outcome<Self> {
        self.placed(time, states)
    }

    fn keep_law(&mut self, of: &Self) {
        let of = of.simulation().clone();
        self.change().continue_law_of(&of);
    }

    fn nominals(&self) -> Vec<f64> {
        self.scales().into()
    }

    fn is_passing(&self) -> bool {
        self.simulation().is_chattering()
    }

    fn drive(&mut self, signal: usize, derivatives: &Derivatives) -> Outcome<()> {
        self.close();
        let before = self.sample().position;
        self.set(signal, derivatives);
        self.push()?;
        // Beyond the end of a law another force may move the mass to where it holds.
        let moved = self.sample().position - before;
        self.more.external.shift(moved);
        Ok(())
    }

    fn check_reach(&self, until: f64) -> Outcome<()> {
        Ok(self.simulation().check_reach(until)?)
    }

    fn law(&self) -> i32 {
        self.phase()
    }

    fn set_checkpoint(&mut self) {
        self.close();
        self.change().set_checkpoint();
    }

    fn has_tangent(&self, known: Known) -> bool {
        let begin = self.more.origin.as_deref().unwrap_or(self);
        match known {
            Known::Signal(_) | Known::State(_) => true,
            Known::Parameter(slot) => {
                [slot::INITIAL_POSITION, slot::INITIAL_VELOCITY].contains(&slot)
                    && begin.simulation().is_checkpoint_at_start()
            }
        }
    }

    fn tangent(&self, direction: &[(Known, f64)]) -> Outcome<Tangent> {
        Tangent::new(self, direction)
    }
}

/// What keeps a motion from beginning or going on, in the names of the variables.
fn in_names(error: MotionError) -> Box<dyn Error> {
    match error {
        MotionError::BeyondStop { position, wall } if position < wall => format!(
            "initial.position = {position} m: must be >= {wall} m, where stop.below.clearance puts the rigid stop below"
        )
        .into(),
        MotionError::BeyondStop { position, wall } => format!(
            "initial.position = {position} m: must be <= {wall} m, where clearance, strip and rigid.travel put \
             the rigid stop"
        )
        .into(),
        MotionError::Scene(SceneError::Slope {
            list,
            index,
            from,
            stiffness,
        }) => {
            // Counted from 1 as in the variables' names.
            let number = index + 1;
            format!(
                "{list}.from[{number}] = {from}, {list}.stiffness[{number}] = {stiffness}: the first slope must \
                 begin at 0, each further one up to {list}.count beyond the one before it"
            )
            .into()
        }
        other => other.into(),
    }
}
