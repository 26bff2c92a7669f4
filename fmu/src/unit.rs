//! The machine as a unit.

use std::error::Error;
use std::ops::ControlFlow;
use std::sync::OnceLock;

use softstop::{Begin, Effort, MotionError, Perturbation, SceneError, Sensitivity, Simulation};
use softstop_fmi::{
    About, Advance, Block, Derivatives, Events, HIGHEST_ORDER, Known, Outcome, Unit,
};

use crate::machine::Machine;
use crate::start::StartValues;
use crate::start::slot::{self, SLOTS};
use crate::table::GROUPS;
use crate::units::{ENUMERATIONS, QUANTITIES};

/// Work that one step may cost: eight million crossings, some seconds. A step that would take longer
/// is carried out in part, so that no importer waits for ever.
const EFFORT: Effort = Effort::windows(1 << 27);

const _: () = assert!(HIGHEST_ORDER == softstop::HIGHEST_ORDER);

/// The one place that the packager patches.
#[used]
static BLOCK: Block<[u64; SLOTS]> = Block::new(
    IDENTIFIER,
    IDENTIFIER,
    "Impact oscillator with soft, preloaded and rigid stops and piercing of a strip, solved exactly",
    StartValues::DEFAULT.values(),
);

const IDENTIFIER: &str = "softstop";

static ABOUT: About<Machine> = About {
    identifier: IDENTIFIER,
    version: env!("CARGO_PKG_VERSION"),
    license: "MIT OR Apache-2.0",
    events: "impacts and pierced strips, one line for each step that has any",
    knowns: "force, over the first step also those by initial.position and initial.velocity",
    experiment: &[
        ("startTime", "0"),
        ("stopTime", "100"),
        ("tolerance", "1e-10"),
        ("stepSize", "0.01"),
    ],
    quantities: QUANTITIES,
    enumerations: ENUMERATIONS,
    table: softstop_fmi::Table::new(GROUPS),
    page: include_str!("../assets/page.html"),
    files: &FILES,
    guid: OnceLock::new(),
};

const FILES: [(&str, &[u8]); 6] = [
    ("model.png", include_bytes!("../assets/model.png")),
    (
        "documentation/machine.svg",
        include_bytes!("../assets/machine.svg"),
    ),
    (
        "documentation/licenses/license.txt",
        b"softstop is licensed under either of the MIT licence (LICENSE-MIT.txt) or the Apache\n\
          licence, version 2.0 (LICENSE-APACHE.txt), at your option. Its libraries hold parts of\n\
          others: see third-party.txt.\n",
    ),
    (
        "documentation/licenses/LICENSE-MIT.txt",
        include_bytes!("../LICENSE-MIT"),
    ),
    (
        "documentation/licenses/LICENSE-APACHE.txt",
        include_bytes!("../LICENSE-APACHE"),
    ),
    (
        "documentation/licenses/third-party.txt",
        include_bytes!("../assets/third-party.txt"),
    ),
];

impl Unit for Machine {
    type Tangent = Sensitivity;

    fn about() -> &'static About<Self> {
        &ABOUT
    }

    fn block() -> &'static Block {
        &BLOCK
    }

    fn begin(values: &[f64], time: f64) -> Outcome<Self> {
        let values = StartValues::of(values);
        let fed = values.number(slot::MATERIAL) != 0;
        let begin = Begin::from(values.start()).at_time(time).fed(fed);
        Simulation::new(&values.scene(), begin)
            .map(Self::new)
            .map_err(in_names)
    }

    fn time(&self) -> f64 {
        self.simulation().time()
    }

    fn tune(&mut self, values: &[f64]) -> Outcome<()> {
        let values = StartValues::of(values);
        let simulation = self.change();
        simulation.tune(&values.scene())?;
        simulation.feed_strip(values.number(slot::MATERIAL) != 0);
        Ok(())
    }

    fn advance(&mut self, until: f64, events: &mut Events) -> Outcome<Advance<Self>> {
        let simulation = self.change();
        let before = (simulation.impact_count(), simulation.pierce_count());
        let outcome = simulation.watch(until, &mut { EFFORT });
        let impacts = simulation.impact_count() - before.0;
        if let Some(last) = simulation.last_impact().filter(|_| impacts > 0) {
            let pierced = simulation.pierce_count() - before.1;
            events.tell(|| {
                format!(
                    "impacts: {impacts}, strips pierced: {pierced}; last impact at {} s with {} m/s",
                    last.time, last.velocity
                )
            });
        }
        match outcome {
            Ok(ControlFlow::Continue(())) => Ok(Advance::Arrived),
            Ok(ControlFlow::Break(())) => Ok(Advance::Short {
                reason: format!("{impacts} impacts so far"),
                before: simulation
                    .before_advance()
                    .map(|before| Box::new(Self::new(before))),
            }),
            // The motion has not left the point at which the step begins.
            Err(
                error @ (MotionError::Unbounded { .. }
                | MotionError::Stalled { .. }
                | MotionError::Endless { .. }),
            ) => Ok(Advance::Short {
                reason: error.to_string(),
                before: Some(Box::new(self.clone())),
            }),
            Err(error) => Err(error.into()),
        }
    }

    fn drive(&mut self, _force: usize, derivatives: &Derivatives) -> Outcome<()> {
        Ok(self.change().set_force(derivatives)?)
    }

    fn check_reach(&self, until: f64) -> Outcome<()> {
        Ok(self.simulation().check_reach(until)?)
    }

    fn law(&self) -> i32 {
        self.phase()
    }

    fn mark(&mut self) {
        self.change().mark();
    }

    fn has_tangent(&self, known: Known) -> bool {
        match known {
            Known::Signal(_) => true,
            Known::Parameter(slot) => {
                [slot::INITIAL_POSITION, slot::INITIAL_VELOCITY].contains(&slot)
                    && self.simulation().is_marked_at_start()
            }
        }
    }

    fn tangent(&self, direction: &[(Known, f64)]) -> Outcome<Sensitivity> {
        let mut by = Perturbation::default();
        for &(known, seed) in direction {
            match known {
                Known::Signal(_) => by.force += seed,
                Known::Parameter(slot::INITIAL_POSITION) => by.position += seed,
                Known::Parameter(_) => by.velocity += seed,
            }
        }
        Ok(self.simulation().sensitivity(&by)?)
    }
}

/// What keeps a motion from beginning or going on, in the names of the variables.
fn in_names(error: MotionError) -> Box<dyn Error> {
    match error {
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
