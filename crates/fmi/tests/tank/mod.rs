//! Another unit in a page: a tank that fills, level' = gain * inflow while it is open.

use std::sync::OnceLock;

use serde::{Deserialize, Serialize};
use softstop_fmi::variable::{Access, Dependencies, Kind, RealKind, Slot, Variable};
use softstop_fmi::{
    About, Advance, Block, Derivatives, Events, Flow, Known, Outcome, Quantity, Table, Terminal,
    Unit,
};

const LEVEL: Slot = Slot(0);
const GAIN: Slot = Slot(1);
const OPEN: Slot = Slot(2);

/// It fills for so many seconds at a time, and no further than to this time.
const SPAN: f64 = 100.0;
const FAR: f64 = 1e6;
/// Steps up to this size in s can be repeated.
const SHORT: f64 = 1e3;

static VOLUME: Quantity = Quantity {
    type_name: "Volume",
    quantity: "Volume",
    unit: "m3",
    base: &[("m", 3)],
    display: &[("l", 1e3)],
};

#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Tank {
    time: f64,
    level: f64,
    gain: f64,
    inflow: Derivatives,
    since: f64,
    steps: i32,
    /// How long the last step was.
    span: f64,
}

const REAL: Kind = Kind::Real(RealKind::any(Some(&VOLUME)));
const NOTHING: &[&str] = &[];

#[rustfmt::skip]
static ROWS: &[Variable<Tank, [f64; 2]>] = &[
    Variable { reference: 0, name: "inflow", description: "What flows in", kind: REAL,
        access: Access::Signal(0) },
    Variable { reference: 1, name: "open", description: "Whether it flows", kind: Kind::Boolean,
        access: Access::Input(OPEN) },
    Variable { reference: 2, name: "start", description: "Level at the start", kind: REAL,
        access: Access::Parameter { slot: LEVEL, tunable: false } },
    Variable { reference: 3, name: "gain", description: "Share that arrives",
        kind: Kind::Real(RealKind { min: Some(0.0), max: Some(9.0), ..RealKind::any(None) }),
        access: Access::Parameter { slot: GAIN, tunable: true } },
    Variable { reference: 200, name: "level", description: "Level", kind: REAL,
        access: Access::Continuous {
            value: |tank| tank.level,
            derivatives: &[Tank::rate],
            tangent: |by, _| by[0],
            depends: Dependencies { inputs: NOTHING, initial: &["start"] },
        } },
    Variable { reference: 201, name: "steps", description: "Steps so far",
        kind: Kind::Count { min: 0, max: None },
        access: Access::Integer {
            value: |tank| tank.steps,
            depends: Dependencies { inputs: NOTHING, initial: NOTHING },
        } },
];

static BLOCK: Block<[u64; 3]> = Block::new("tank", "tank", "A tank that fills", &[1.5, 1.0, 1.0]);

static ABOUT: About<Tank> = About {
    identifier: "tank",
    version: "1",
    license: "MIT",
    author: "A. Plumber",
    copyright: "Nobody",
    date: "2026-01-01T00:00:00Z",
    events: "one line for each step",
    knowns: "inflow, over the first step also by start",
    experiment: &[("startTime", "0"), ("stopTime", "10")],
    quantities: &[&VOLUME],
    enumerations: &[],
    terminals: &[Terminal {
        name: "inlet",
        description: "Where it is filled",
        members: &[("flow", Flow::Inflow, "inflow")],
    }],
    table: Table::new(&[ROWS]),
    state_space: None,
    clock: None,
    page: "<h1><!--name--></h1><table><!--variables--></table>",
    files: &[],
    guid: OnceLock::new(),
};

/// Sum of derivatives[k] t^(k + 1) / (k + 1)!.
fn integral(derivatives: &Derivatives, t: f64) -> f64 {
    let terms = derivatives.iter().enumerate().rev();
    terms.fold(0.0, |sum, (k, derivative)| {
        (sum + derivative) * t / (k + 1) as f64
    })
}

impl Tank {
    fn rate(&self) -> f64 {
        let (t, terms) = (self.time - self.since, self.inflow.iter().enumerate().rev());
        self.gain
            * terms.fold(0.0, |sum, (k, derivative)| {
                derivative + sum * t / (k + 1) as f64
            })
    }
}

impl Unit for Tank {
    /// Derivatives of level and of nothing.
    type Tangent = [f64; 2];

    fn about() -> &'static About<Self> {
        &ABOUT
    }

    fn block() -> &'static Block {
        &BLOCK
    }

    fn begin(values: &[f64], time: f64) -> Outcome<Self> {
        let mut tank = Self {
            time,
            level: values[LEVEL.0],
            gain: 0.0,
            inflow: Derivatives::default(),
            since: time,
            steps: 0,
            span: 0.0,
        };
        tank.tune(values)?;
        Ok(tank)
    }

    fn time(&self) -> f64 {
        self.time
    }

    fn tune(&mut self, values: &[f64]) -> Outcome<()> {
        if values[GAIN.0] > 5.0 {
            return Err("gain: more arrives than the pipe can take".into());
        }
        self.gain = values[GAIN.0] * values[OPEN.0];
        Ok(())
    }

    fn drive(&mut self, _signal: usize, derivatives: &Derivatives) -> Outcome<()> {
        (self.inflow, self.since) = (*derivatives, self.time);
        Ok(())
    }

    fn check_reach(&self, until: f64) -> Outcome<()> {
        if until > FAR {
            return Err(format!("{until} s is beyond {FAR} s").into());
        }
        Ok(())
    }

    fn advance(
        &mut self,
        until: f64,
        _halt: Option<f64>,
        events: &mut Events,
    ) -> Outcome<Advance<Self>> {
        let before = self.clone();
        let end = until.min(self.time + SPAN);
        let inflow = |time: f64| integral(&self.inflow, time - self.since);
        self.level += self.gain * (inflow(end) - inflow(self.time));
        (self.span, self.time) = (end - self.time, end);
        self.steps += 1;
        events.tell(|| format!("level {}", self.level));
        if end == until {
            return Ok(Advance::Arrived);
        }
        Ok(Advance::Short {
            reason: format!("{SPAN} s at a time"),
            before: (until - before.time <= SHORT).then(|| Box::new(before)),
        })
    }

    fn set_checkpoint(&mut self) {
        self.span = 0.0;
    }

    fn has_tangent(&self, known: Known) -> bool {
        known == Known::Signal(0) || (known == Known::Parameter(LEVEL) && self.steps <= 1)
    }

    fn tangent(&self, direction: &[(Known, f64)]) -> Outcome<[f64; 2]> {
        let by = direction.iter().map(|&(known, seed)| match known {
            Known::Signal(_) => seed * self.gain * self.span,
            _ => seed,
        });
        Ok([by.sum(), 0.0])
    }
}
