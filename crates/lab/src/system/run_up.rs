//! Running up: which torque passes the resonance and lands in z = 1, and how the motor is held and jumps.

use std::f64::consts::TAU;

use anyhow::Result;
use rayon::prelude::*;
use serde::Serialize;
use softstop_console::progress::Progress;

use super::coupled::{Coupling, Motor, Point, System};

/// Step of the master in s.
const STEP: f64 = 0.1;
/// Time in s after which it is judged what the voltage has led to, and over how long.
const SETTLED: f64 = 400.0;
const JUDGED: f64 = 150.0;
/// Share by which the mean speed may differ from that of the z = 1 motion, with what a part of a turn makes of it.
const ALIKE: f64 = 5e-3;
/// Torques at rest in units of that which z = 1 takes on the mean, and times in s in which the voltage rises.
pub(super) const TORQUES: (f64, f64) = (1.1, 30.0);
pub(super) const RISES: (f64, f64) = (20.0, 1000.0);
/// Voltages of the way up and down, and the torque of the motor that goes it.
const VOLTAGES: (f64, f64) = (0.6, 2.2);
const SOFT: f64 = 3.0;

/// What a run from rest ends in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum End {
    /// The z = 1 motion that the motor is made for.
    Lands,
    /// No impacts: the resonance was passed too fast.
    Passes,
    /// Impacts at a lower speed, or in another motion.
    Other,
}

impl End {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lands => "lands in z = 1",
            Self::Passes => "no impacts",
            Self::Other => "another motion",
        }
    }
}

/// A run from rest.
#[derive(Debug, Clone, Serialize)]
pub(super) struct RunUp {
    /// Torque at rest in N m.
    pub torque: f64,
    /// Time in s in which the voltage rises to the rated one.
    pub rise: f64,
    /// Mean speed in rad/s in the end.
    pub speed: f64,
    /// Impacts in a turn in the end.
    pub impacts: f64,
    pub end: End,
}

/// A plateau of the voltage.
#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Plateau {
    pub up: bool,
    /// As a share of the rated voltage.
    pub voltage: f64,
    /// Mean speed in rad/s.
    pub speed: f64,
    /// Impacts in a turn.
    pub impacts: f64,
}

/// How fine it is looked at: torques, rises, plateaus, time of each of these in s.
#[derive(Debug, Clone, Copy)]
pub(super) struct Detail {
    pub torques: usize,
    pub rises: usize,
    pub plateaus: usize,
    pub plateau: f64,
}

/// Runs up from rest, torque by torque.
pub(super) fn run_ups(detail: Detail, progress: &Progress) -> Result<Vec<RunUp>> {
    let point = Point::b()?;
    let between = |(low, high): (f64, f64), k: usize, count: usize| {
        low * f64::powf(high / low, k as f64 / (count - 1) as f64)
    };
    let torques = (0..detail.torques).map(|k| point.torque * between(TORQUES, k, detail.torques));
    let rises = (0..detail.rises).map(|k| between(RISES, k, detail.rises));
    let cases: Vec<(f64, f64)> = torques
        .flat_map(|torque| rises.clone().map(move |rise| (torque, rise)))
        .collect();
    let run = |&(torque, rise): &(f64, f64)| {
        progress.step()?;
        run_up(&point, torque, rise)
    };
    cases.par_iter().map(run).collect()
}

fn run_up(point: &Point, torque: f64, rise: f64) -> Result<RunUp> {
    let motor = Motor {
        torque,
        voltage: 0.0,
        ..Motor::SYSTEM
    };
    let mut system = System::new(point.at_rest(), Some(motor), &[], Coupling::RollBack)?;
    system.lead_voltage(&[0.0, 1.0 / rise])?;
    system.go_to(rise, STEP)?;
    system.lead_voltage(&[1.0])?;
    system.go_to(rise + SETTLED, STEP)?;
    let (speed, impacts) = means(&mut system, JUDGED)?;
    let turns = speed * JUDGED / TAU;
    let is_single = (impacts - 1.0).abs() * turns <= 1.0;
    let end = match impacts {
        0.0 => End::Passes,
        _ if is_single && (speed / point.speed() - 1.0).abs() < ALIKE => End::Lands,
        _ => End::Other,
    };
    Ok(RunUp {
        torque,
        rise,
        speed,
        impacts,
        end,
    })
}

/// Goes with the voltage up and down again in steps, from rest.
pub(super) fn up_and_down(detail: Detail, progress: &Progress) -> Result<Vec<Plateau>> {
    let share = |k: usize| k as f64 / (detail.plateaus - 1) as f64;
    let voltage = |k: usize| VOLTAGES.0 + (VOLTAGES.1 - VOLTAGES.0) * share(k);
    let up = (0..detail.plateaus).map(|k| (true, voltage(k)));
    let down = (0..detail.plateaus).rev().map(|k| (false, voltage(k)));
    let point = Point::b()?;
    let motor = Motor {
        torque: SOFT * point.torque,
        voltage: 0.0,
        ..Motor::SYSTEM
    };
    let mut system = System::new(point.at_rest(), Some(motor), &[], Coupling::RollBack)?;
    let plateau = |(up, voltage)| {
        progress.step()?;
        system.lead_voltage(&[voltage])?;
        system.go_to(system.time + 0.6 * detail.plateau, STEP)?;
        let (speed, impacts) = means(&mut system, 0.4 * detail.plateau)?;
        Ok(Plateau {
            up,
            voltage,
            speed,
            impacts,
        })
    };
    up.chain(down).map(plateau).collect()
}

/// Mean speed in rad/s over a time in s, and impacts in a turn.
fn means(system: &mut System, time: f64) -> Result<(f64, f64)> {
    let seen = |system: &System| {
        let press = &system.press;
        anyhow::Ok((press.get("drive.angle")?, press.get("impact.count")?))
    };
    let before = seen(system)?;
    system.go_to(system.time + time, STEP)?;
    let after = seen(system)?;
    let turned = after.0 - before.0;
    Ok((turned / time, (after.1 - before.1) / (turned / TAU)))
}
