//! `drive.fmu`: a rotating unbalance on a motor of finite power.
//!
//! J w' = T(voltage, w) - c w - P / w, where P is the power that the load takes. Of the load the unit is told the work, by
//! value and derivatives: where the value jumps from what the derivatives before it have led to, the rest is taken evenly
//! over the next step, so that nothing of it is ever lost.

mod motor;
mod table;

use std::sync::OnceLock;

use serde::{Deserialize, Serialize};
use softstop_fmi::{About, Advance, Block, Derivatives, Events, Known, Outcome, Table, Unit};

use crate::difference::Direction;
use crate::extrapolation::integrate;
use crate::package;
use crate::signal::Signal;
use motor::Motor;

/// The drive under way.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Drive {
    motor: Motor,
    time: f64,
    /// Speed in rad/s, angle in rad, and work in J: of the motor, of friction, of the load.
    state: [f64; 5],
    voltage: Signal,
    /// Work in J that the load has taken, as it is told.
    load: Signal,
    /// Where the last step began.
    origin: Option<Box<Drive>>,
    begun: bool,
}

const VOLTAGE: usize = 0;
const LOAD: usize = 1;

/// Places in the state.
const SPEED: usize = 0;
const ANGLE: usize = 1;
const SUPPLIED: usize = 2;
const DISSIPATED: usize = 3;
const PAID: usize = 4;

mod slot {
    softstop_fmi::slots! {
        MODEL = 1.0;
        VOLTAGE = 1.0;
        TORQUE = 60.0;
        SPEED = 1.22;
        SLIP = 0.2;
        INERTIA = 40.0;
        FRICTION = 0.0;
        // 1 N at 1.15 rad/s, as the drive of softstop.fmu does by itself.
        UNBALANCE = 1.0 / (1.15 * 1.15);
        INITIAL_SPEED = 1.15;
        INITIAL_ANGLE = 0.0;
    }
}

#[used]
static BLOCK: Block<[u64; slot::SLOTS]> = Block::new(
    "drive",
    "drive",
    "Rotating unbalance on a motor of finite power",
    &slot::START,
);

static ABOUT: About<Drive> = About {
    identifier: "drive",
    version: env!("CARGO_PKG_VERSION"),
    license: env!("CARGO_PKG_LICENSE"),
    author: env!("CARGO_PKG_AUTHORS"),
    copyright: package::COPYRIGHT,
    date: package::DATE,
    events: "",
    knowns: "the inputs motor.voltage.added and load.work, over the first step also by initial.speed and initial.angle",
    experiment: package::EXPERIMENT,
    quantities: table::QUANTITIES,
    enumerations: &[&motor::MODEL],
    terminals: table::TERMINALS,
    table: Table::new(table::GROUPS),
    state_space: None,
    clock: None,
    page: include_str!("../../assets/drive.html"),
    files: package::FILES,
    guid: OnceLock::new(),
};

impl Drive {
    /// How the state changes while the load takes a power in W.
    fn rates(&self, time: f64, speed: f64, load: f64) -> [f64; 5] {
        let torque = self.motor.torque(self.voltage_at(time), speed);
        let friction = self.motor.friction * speed;
        let braking = self.motor.braking(load, speed);
        [
            (torque - friction - braking) / self.motor.inertia,
            speed,
            torque * speed,
            friction * speed,
            braking * speed,
        ]
    }

    fn voltage_at(&self, time: f64) -> f64 {
        self.motor.voltage + self.voltage.at(time, 0)
    }

    /// The rates now, the load as its derivatives say.
    fn now(&self) -> [f64; 5] {
        self.rates(self.time, self.speed(), self.load.at(self.time, 1))
    }

    fn speed(&self) -> f64 {
        self.state[SPEED]
    }

    fn torque(&self) -> f64 {
        self.motor.torque(self.voltage_at(self.time), self.speed())
    }

    fn kinetic(&self) -> f64 {
        0.5 * self.motor.inertia * self.speed() * self.speed()
    }

    fn amplitude(&self) -> f64 {
        self.motor.unbalance * self.speed() * self.speed()
    }

    /// Goes on without telling.
    fn go_to(&mut self, until: f64) -> bool {
        let (time, span) = (self.time, until - self.time);
        if span <= 0.0 {
            return true;
        }
        let left = (self.load.at(time, 0) - self.state[PAID]) / span;
        let of = &*self;
        let rates = |time: f64, y: &[f64; 5]| of.rates(time, y[0], of.load.at(time, 1) + left);
        let Some(state) = integrate((time, until), self.state, rates) else {
            return false;
        };
        (self.time, self.state) = (until, state);
        true
    }

    /// The last step again, from a beginning that was moved by `step` along a direction.
    fn repeated(&self, direction: &[(Known, f64)], step: f64) -> Option<Self> {
        let mut drive = self.origin.as_deref().unwrap_or(self).clone();
        for &(known, seed) in direction {
            match known {
                Known::Signal(VOLTAGE) => drive.voltage.derivatives[0] += step * seed,
                Known::Signal(_) => drive.load.derivatives[0] += step * seed,
                Known::Parameter(slot::INITIAL_SPEED) => drive.state[SPEED] += step * seed,
                _ => drive.state[ANGLE] += step * seed,
            }
        }
        drive.go_to(self.time).then_some(drive)
    }
}

impl Unit for Drive {
    type Tangent = Direction<Self>;

    fn about() -> &'static About<Self> {
        &ABOUT
    }

    fn block() -> &'static Block {
        &BLOCK
    }

    fn begin(values: &[f64], time: f64) -> Outcome<Self> {
        let mut state = [0.0; 5];
        state[SPEED] = values[slot::INITIAL_SPEED.0];
        state[ANGLE] = values[slot::INITIAL_ANGLE.0];
        Ok(Self {
            motor: Motor::of(values),
            time,
            state,
            voltage: Signal::default(),
            load: Signal::default(),
            origin: None,
            begun: false,
        })
    }

    fn time(&self) -> f64 {
        self.time
    }

    fn tune(&mut self, values: &[f64]) -> Outcome<()> {
        let motor = Motor::of(values);
        if motor != self.motor {
            (self.motor, self.origin) = (motor, None);
        }
        Ok(())
    }

    fn drive(&mut self, signal: usize, derivatives: &Derivatives) -> Outcome<()> {
        let signal = match signal {
            VOLTAGE => &mut self.voltage,
            _ => &mut self.load,
        };
        *signal = Signal::new(*derivatives, self.time);
        self.origin = None;
        Ok(())
    }

    fn advance(&mut self, until: f64, _: Option<f64>, _: &mut Events) -> Outcome<Advance<Self>> {
        self.origin = None;
        let before = Box::new(self.clone());
        if !self.go_to(until) {
            return Ok(Advance::Short {
                reason: "the speed changes too fast to be followed".to_owned(),
                before: Some(before),
            });
        }
        (self.origin, self.begun) = (Some(before), true);
        Ok(Advance::Arrived)
    }

    fn set_checkpoint(&mut self) {
        self.origin = None;
    }

    fn has_tangent(&self, known: Known) -> bool {
        let first = self.origin.as_ref().map_or(!self.begun, |one| !one.begun);
        match known {
            Known::Signal(_) => true,
            Known::Parameter(slot) => {
                first && [slot::INITIAL_SPEED, slot::INITIAL_ANGLE].contains(&slot)
            }
            Known::State(_) => false,
        }
    }

    fn tangent(&self, direction: &[(Known, f64)]) -> Outcome<Direction<Self>> {
        let typical = |known| match known {
            Known::Signal(VOLTAGE) => 1.0,
            Known::Signal(_) => self.motor.typical_energy(),
            Known::Parameter(slot::INITIAL_SPEED) => self.motor.speed,
            _ => 1.0,
        };
        Ok(Direction::new(self, direction, typical, Self::repeated))
    }
}
