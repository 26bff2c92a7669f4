//! `feeder.fmu`: strips for the press, one for each turn of a shaft, by a pattern or by chance, and jams.
//!
//! The shaft turns at a speed of its own, or an input tells its angle, by value and derivatives: where the value jumps from
//! what the derivatives before it have led to, the shaft turns the rest evenly over the next step. So no output depends
//! on an input at once.

mod shaft;
mod supply;
mod table;

use std::sync::OnceLock;

use serde::{Deserialize, Serialize};
use softstop_fmi::{About, Advance, Block, Derivatives, Events, Known, Outcome, Table, Unit};

use crate::difference::Direction;
use crate::package;
use shaft::Shaft;
use supply::{Line, Supply};

/// Strokes that one step may take.
const MOST_STROKES: i64 = 1 << 20;

/// The feeder under way.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Feeder {
    supply: Supply,
    shaft: Shaft,
    line: Line,
    /// An input holds the strips back.
    held: bool,
    /// Time in s of the last stroke.
    fed: f64,
    /// Where the last step began.
    origin: Option<Box<Feeder>>,
    begun: bool,
}

const ANGLE: usize = 0;

/// Elements of `supply.pattern.strokes`.
const PATTERN: usize = 16;

mod slot {
    softstop_fmi::slots! {
        SPEED = 1.15;
        ANGLE = std::f64::consts::PI;
        TAKES_ANGLE = 0.0;
        MODEL = super::supply::ALWAYS as f64;
        COUNT = 2.0;
        STROKES[super::PATTERN] = 9.0, 1.0;
        PROBABILITY = 0.9;
        SEED = 0.0;
        JAM_PROBABILITY = 0.0;
        JAM_STROKES = 5.0;
        INITIAL_ANGLE = 0.0;
        HELD = 0.0;
        HELD_SHARE = 0.0;
    }
}

#[used]
static BLOCK: Block<[u64; slot::SLOTS]> = Block::new(
    "feeder",
    "feeder",
    "Supply of strips: by a pattern or by chance, with jams",
    &slot::START,
);

static ABOUT: About<Feeder> = About {
    identifier: "feeder",
    version: env!("CARGO_PKG_VERSION"),
    license: env!("CARGO_PKG_LICENSE"),
    author: env!("CARGO_PKG_AUTHORS"),
    copyright: package::COPYRIGHT,
    date: package::DATE,
    events: "strokes without a strip, one line for each step that has any",
    knowns: "the input angle, over the first step also by initial.angle",
    experiment: package::EXPERIMENT,
    quantities: table::QUANTITIES,
    enumerations: &[&supply::MODEL],
    terminals: table::TERMINALS,
    table: Table::new(table::GROUPS),
    state_space: None,
    clock: None,
    page: include_str!("../../assets/feeder.html"),
    files: package::FILES,
    guid: OnceLock::new(),
};

impl Feeder {
    /// Goes on without telling; otherwise than all the way, why.
    fn go_to(&mut self, until: f64) -> Result<(), String> {
        let turn = self.shaft.turn_at(until);
        let Some(turn) = turn else {
            return Err("the shaft turns beyond all numbers".to_owned());
        };
        let strokes = turn.saturating_sub(self.shaft.turn);
        if strokes > MOST_STROKES {
            return Err(format!("{strokes} strokes in one step"));
        }
        for _ in 0..strokes {
            self.line.feed(&self.supply, self.held);
        }
        if strokes > 0 {
            self.fed = self.shaft.time_of(turn, until);
            self.shaft.turn = turn;
        }
        self.shaft.go_to(until);
        Ok(())
    }

    /// The last step again, from a beginning that was moved by `step` along a direction; nothing if other strokes come.
    fn repeated(&self, direction: &[(Known, f64)], step: f64) -> Option<Self> {
        let mut feeder = self.origin.as_deref().unwrap_or(self).clone();
        for &(known, seed) in direction {
            match known {
                Known::Signal(_) => feeder.shaft.move_told(step * seed),
                _ => feeder.shaft.move_start(step * seed),
            }
        }
        feeder.go_to(self.shaft.time).ok()?;
        (feeder.line == self.line).then_some(feeder)
    }
}

fn is_held(values: &[f64]) -> bool {
    values[slot::HELD.0] != 0.0 || values[slot::HELD_SHARE.0] >= 0.5
}

impl Unit for Feeder {
    type Tangent = Direction<Self>;

    fn about() -> &'static About<Self> {
        &ABOUT
    }

    fn block() -> &'static Block {
        &BLOCK
    }

    fn begin(values: &[f64], time: f64) -> Outcome<Self> {
        let (supply, held) = (Supply::of(values)?, is_held(values));
        Ok(Self {
            line: Line::begin(&supply, held),
            supply,
            shaft: Shaft::begin(values, time),
            held,
            fed: time,
            origin: None,
            begun: false,
        })
    }

    fn time(&self) -> f64 {
        self.shaft.time
    }

    fn tune(&mut self, values: &[f64]) -> Outcome<()> {
        self.supply = Supply::of(values)?;
        self.held = is_held(values);
        self.shaft.tune(values);
        self.origin = None;
        Ok(())
    }

    fn drive(&mut self, _signal: usize, derivatives: &Derivatives) -> Outcome<()> {
        self.shaft.tell(derivatives);
        self.origin = None;
        Ok(())
    }

    fn advance(
        &mut self,
        until: f64,
        _: Option<f64>,
        events: &mut Events,
    ) -> Outcome<Advance<Self>> {
        self.origin = None;
        let before = Box::new(self.clone());
        if let Err(reason) = self.go_to(until) {
            return Ok(Advance::Short {
                reason,
                before: Some(before),
            });
        }
        let missing = self.line.missing - before.line.missing;
        if missing > 0 {
            events.tell(|| {
                format!(
                    "strokes without a strip: {missing}; last stroke at {} s",
                    self.fed
                )
            });
        }
        (self.origin, self.begun) = (Some(before), true);
        Ok(Advance::Arrived)
    }

    /// Across another first stroke no differences are taken.
    fn law(&self) -> i32 {
        i32::from(self.line.strip)
    }

    fn set_checkpoint(&mut self) {
        self.origin = None;
    }

    fn has_tangent(&self, known: Known) -> bool {
        let begun = self
            .origin
            .as_ref()
            .map_or(self.begun, |origin| origin.begun);
        match known {
            Known::Signal(_) => true,
            Known::Parameter(slot) => !begun && slot == slot::INITIAL_ANGLE,
            Known::State(_) => false,
        }
    }

    fn tangent(&self, direction: &[(Known, f64)]) -> Outcome<Direction<Self>> {
        Ok(Direction::new(self, direction, |_| 1.0, Self::repeated))
    }
}
