//! Press, drive and feeder, stepped by a master.

use std::f64::consts::TAU;

use anyhow::Result;
use serde::Serialize;
use softstop::internals::samples::LOADED;
use softstop::{Begin, Scene, Simulation, Start};
use softstop_dynamics::orbit::find;
use softstop_fmi::Imprint;
use softstop_fmu::{Machine, StartValues};
use softstop_units::{Drive, Feeder};

use super::part::Part;

/// What the master tells the units about the time between two steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Coupling {
    /// Inputs stand still over a step; what they missed is made up for in the next.
    Plain,
    /// Inputs go on with the rates that outputs have at its beginning.
    Derivatives,
    /// Steps are repeated, with cubics through both ends, until the drive pays what the press receives.
    RollBack,
}

impl Coupling {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Derivatives => "input derivatives",
            Self::RollBack => "roll back",
        }
    }
}

/// Most repeats of a step, and the work in J by which the last one may differ from the one before.
const REPEATS: usize = 20;
const SAME: f64 = 1e-12;

/// A motor whose torque is, at the speed of a z = 1 motion, what this takes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Motor {
    /// Torque at rest in N m.
    pub torque: f64,
    /// Voltage as a share of the rated one.
    pub voltage: f64,
    /// Moment of inertia in kg m^2.
    pub inertia: f64,
}

impl Motor {
    /// That of piercing-machine.ssp.
    pub const SYSTEM: Self = Self {
        torque: 60.0,
        voltage: 1.0,
        inertia: 40.0,
    };
}

/// A z = 1 motion of the paper's loaded machine.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub scene: Scene,
    pub start: Start,
    /// Torque in N m that it takes on the mean.
    pub torque: f64,
}

impl Point {
    /// Point B.
    pub fn b() -> Result<Self> {
        let start = Start::new(LOADED.position, LOADED.velocity);
        Self::new(LOADED.ratios.scene()?, start)
    }

    /// That at another frequency of the drive in rad/s.
    pub fn at(frequency: f64) -> Result<Self> {
        let scene = LOADED.ratios.scene()?.at_frequency(frequency);
        let orbit = find(&scene)?;
        Self::new(scene, Start::new(orbit.position, orbit.velocity))
    }

    fn new(scene: Scene, start: Start) -> Result<Self> {
        let mut run = Simulation::new(&scene, Begin::from(start))?;
        run.advance(scene.period())?;
        Ok(Self {
            torque: run.energy().supplied / TAU,
            scene,
            start,
        })
    }

    /// Speed of its drive in rad/s.
    pub fn speed(&self) -> f64 {
        self.scene.excitation.frequency
    }

    /// The same machine at rest, its drive too.
    pub fn at_rest(&self) -> Begun<'_> {
        Begun {
            point: self,
            start: Start::REST,
            speed: 0.0,
        }
    }

    /// The motion itself.
    pub fn in_motion(&self) -> Begun<'_> {
        Begun {
            point: self,
            start: self.start,
            speed: self.speed(),
        }
    }
}

/// How a machine begins.
#[derive(Debug, Clone, Copy)]
pub(super) struct Begun<'a> {
    point: &'a Point,
    start: Start,
    /// Speed of a motor in rad/s.
    speed: f64,
}

/// The machine under way.
pub(super) struct System {
    pub press: Part<Machine>,
    /// None: the drive is ideal.
    pub drive: Option<Part<Drive>>,
    pub feeder: Part<Feeder>,
    coupling: Coupling,
    unbalance: f64,
    pub time: f64,
}

impl System {
    /// The machine on a motor, or on an ideal drive, with a feeder.
    pub fn new(
        begun: Begun<'_>,
        motor: Option<Motor>,
        supply: &[(&str, f64)],
        coupling: Coupling,
    ) -> Result<Self> {
        let Point { scene, torque, .. } = begun.point;
        let speed = scene.excitation.frequency;
        let unbalance = scene.excitation.amplitude / (speed * speed);
        let press = Imprint::from(StartValues::from_scene(scene, begun.start)?);
        let takes = f64::from(u8::from(motor.is_some()));
        let takes = ["drive.takes.speed", "drive.takes.amplitude"].map(|name| (name, takes));
        let drive = motor.map(|motor| {
            let values = [
                ("motor.torque", motor.torque),
                ("motor.voltage", motor.voltage),
                ("motor.speed", speed / (1.0 - torque / motor.torque)),
                ("inertia", motor.inertia),
                ("unbalance", unbalance),
                ("initial.speed", begun.speed),
            ];
            Part::begin(&Imprint::library(), &values)
        });
        let mut feeder = vec![("feed.takes.angle", 1.0)];
        feeder.extend(supply);
        let mut system = Self {
            press: Part::begin(&press, &takes)?,
            drive: drive.transpose()?,
            feeder: Part::begin(&Imprint::library(), &feeder)?,
            coupling,
            unbalance,
            time: 0.0,
        };
        if system.drive.is_some() {
            system.lead_press(&[begun.speed])?;
        }
        Ok(system)
    }

    /// Speed of the motor in rad/s, if there is one.
    pub fn speed(&self) -> Result<f64> {
        self.drive
            .as_ref()
            .map_or(Ok(f64::NAN), |drive| drive.get("speed"))
    }

    /// Gives the press the speed as a polynomial from now on, and the amplitude with it.
    fn lead_press(&mut self, speed: &[f64]) -> Result<()> {
        let mut amplitude = vec![0.0; 2 * speed.len() - 1];
        for (i, a) in speed.iter().enumerate() {
            for (j, b) in speed.iter().enumerate() {
                amplitude[i + j] += self.unbalance * a * b;
            }
        }
        self.press.lead("drive.speed", &derivatives(speed))?;
        self.press.lead("drive.amplitude", &derivatives(&amplitude))
    }

    /// Lets the voltage go on from now with this value and these derivatives.
    pub fn lead_voltage(&mut self, known: &[f64]) -> Result<()> {
        self.drive
            .as_mut()
            .map_or(Ok(()), |drive| drive.lead("voltage", known))
    }

    /// Goes on to a time in s in even steps of about this size.
    pub fn go_to(&mut self, until: f64, size: f64) -> Result<()> {
        let (begin, steps) = (self.time, ((until - self.time) / size).ceil());
        (1..=steps as u64)
            .try_for_each(|k| self.step(begin + (until - begin) * (k as f64 / steps) - self.time))
    }

    /// One step of the master.
    pub fn step(&mut self, size: f64) -> Result<()> {
        let until = self.time + size;
        self.press.put("material", self.feeder.get("material")?)?;
        let begin = self.press.get_moving("drive.angle")?;
        match self.drive.take() {
            None => self.press.advance(until)?,
            Some(drive) => {
                self.drive = Some(match self.coupling {
                    Coupling::Plain => self.once(drive, until, 1)?,
                    Coupling::Derivatives => self.once(drive, until, 2)?,
                    Coupling::RollBack => self.repeated(&drive, until)?,
                });
            }
        }
        let turned = cubic(size, begin, self.press.get_moving("drive.angle")?);
        self.feeder.lead("angle", &derivatives(&turned))?;
        self.feeder.advance(until)?;
        self.time = until;
        Ok(())
    }

    /// A step that is taken once, with so many derivatives of what is known at its beginning.
    fn once(&mut self, mut drive: Part<Drive>, until: f64, known: usize) -> Result<Part<Drive>> {
        let (work, power) = self.press.get_moving("drive.work")?;
        let (speed, rate) = drive.get_moving("speed")?;
        drive.lead("load.work", &[work, power][..known])?;
        drive.advance(until)?;
        self.lead_press(&[speed, rate][..known])?;
        self.press.advance(until)?;
        Ok(drive)
    }

    /// A step that is repeated until both units agree.
    fn repeated(&mut self, drive: &Part<Drive>, until: f64) -> Result<Part<Drive>> {
        let size = until - self.time;
        let (press, begin) = (self.press.clone(), self.press.get_moving("drive.work")?);
        let speed = drive.get_moving("speed")?;
        let mut end = (begin.0 + size * begin.1, begin.1);
        let mut repeats = 0;
        loop {
            repeats += 1;
            let mut turned = drive.clone();
            turned.lead("load.work", &derivatives(&cubic(size, begin, end)))?;
            turned.advance(until)?;
            self.press = press.clone();
            self.lead_press(&cubic(size, speed, turned.get_moving("speed")?))?;
            self.press.advance(until)?;
            let before = std::mem::replace(&mut end, self.press.get_moving("drive.work")?);
            if repeats == REPEATS || (end.0 - before.0).abs() < SAME {
                return Ok(turned);
            }
        }
    }
}

/// Coefficients of the cubic over a step through two values with their rates.
fn cubic(size: f64, (a, rate_a): (f64, f64), (b, rate_b): (f64, f64)) -> [f64; 4] {
    let rise = (b - a) / size;
    [
        a,
        rate_a,
        (3.0 * rise - 2.0 * rate_a - rate_b) / size,
        (rate_a + rate_b - 2.0 * rise) / (size * size),
    ]
}

/// The derivatives of a polynomial at 0.
fn derivatives(coefficients: &[f64]) -> Vec<f64> {
    let mut factorial = 1.0;
    let derivative = |(k, coefficient): (usize, &f64)| {
        factorial *= k.max(1) as f64;
        factorial * coefficient
    };
    coefficients.iter().enumerate().map(derivative).collect()
}

#[cfg(test)]
mod tests {
    use super::{Coupling, Motor, Point, System};

    /// What the motor has supplied over a thousand periods, strips failing by chance, is in the rotor or in the press, or
    /// dissipated there.
    #[test]
    fn the_energies_of_all_units_balance() -> anyhow::Result<()> {
        let point = Point::b()?;
        let supply = [("supply.model", 3.0), ("supply.probability", 0.9)];
        let motor = Some(Motor::SYSTEM);
        let mut system = System::new(point.in_motion(), motor, &supply, Coupling::RollBack)?;
        let kept = |system: &System| {
            let kinetic = system
                .drive
                .as_ref()
                .map(|drive| drive.get("energy.kinetic"));
            let of_press = |name| system.press.get(name);
            let press = of_press("energy.mechanical")? + of_press("energy.dissipated")?;
            anyhow::Ok(press + kinetic.transpose()?.unwrap_or_default())
        };
        let begin = kept(&system)?;
        system.go_to(1000.0 * point.scene.period(), point.scene.period() / 16.0)?;
        let drive = system
            .drive
            .as_ref()
            .map(|drive| drive.get("energy.supplied"));
        let supplied = drive.transpose()?.unwrap_or_default();
        let defect = (supplied - (kept(&system)? - begin)).abs();
        assert!(supplied > 1e4, "{supplied}");
        assert!(system.press.get("impact.count")? > 990.0);
        assert!(defect < 1e-6 * supplied, "{defect} of {supplied}");
        Ok(())
    }
}
