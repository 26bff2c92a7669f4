//! Tries one way to run a machine up into a motion.

use std::f64::consts::TAU;

use super::{Attempt, RunUpPeaks, RunUpSettings, STEP_PERIODS, Way};
use crate::basin::{BasinTest, bring_to_section};
use crate::monitor::{Monitor, stop_if};
use crate::motion_kind::MotionKind;
use crate::orbit::{Orbit, OrbitError, Regime};
use crate::sweep::{Chain, Plan};
use crate::tolerance::SIMILAR;
use softstop::{Machine, MotionError, Scene, Start};

/// Tries one way to run up; none if the machine has no such way, as a clearance that cannot be smaller.
pub(super) fn try_way(
    orbit: &Orbit,
    basin_test: &BasinTest,
    (settings, way, angles): (&RunUpSettings, Way, usize),
    monitor: Monitor<'_>,
) -> Result<Option<Attempt>, OrbitError> {
    match way {
        Way::SwitchedOn => {
            try_switching_on(orbit, basin_test, (settings, angles), monitor).map(Some)
        }
        _ => try_slow_way(orbit, basin_test, (settings, way), monitor),
    }
}

/// The state before the drive is switched on: at the suspension's rest, or at a stop that stands before it.
fn rest_state(scene: &Scene) -> Start {
    let below = scene.below.as_ref();
    let lowest = below.map_or(f64::NEG_INFINITY, |below| -below.clearance);
    Start::new(scene.clearance.min(0.0).max(lowest), 0.0)
}

/// Tries to run up by switching the drive on at evenly spread drive angles.
fn try_switching_on(
    orbit: &Orbit,
    basin_test: &BasinTest,
    (settings, angles): (&RunUpSettings, usize),
    monitor: Monitor<'_>,
) -> Result<Attempt, OrbitError> {
    let (scene, rest) = (&orbit.scene, rest_state(&orbit.scene));
    let angles = angles.max(1);
    let angles: Vec<f64> = (0..angles)
        .map(|index| TAU * index as f64 / angles as f64)
        .collect();
    let states = angles.iter();
    let states = states.map(|angle| bring_to_section(scene, rest, *angle));
    let states = states.collect::<Result<Vec<Start>, _>>()?;
    let reached = basin_test.test_starts(&states, monitor)?;
    let peaks = || {
        let mut peaks = RunUpPeaks::default();
        for state in states {
            peaks.take_peaks(scene, state, STEP_PERIODS)?;
        }
        Ok::<_, MotionError>(peaks)
    };
    let all = reached.iter().filter(|reached| **reached).count();
    Ok(Attempt {
        way: Way::SwitchedOn,
        share: all as f64 / angles.len() as f64,
        angle: middle_of_longest_row(&reached)
            .map(|place| (TAU * place / angles.len() as f64).rem_euclid(TAU)),
        from: None,
        ends: None,
        lost: None,
        periods: None,
        peaks: settings.computes_peaks().then(peaks).transpose()?,
    })
}

/// The middle of the longest row of true values on a circle, as a share of the circle, the first of equals; none if none is true.
fn middle_of_longest_row(circle: &[bool]) -> Option<f64> {
    let count = circle.len();
    let row = |first: usize| {
        let row = (0..count).take_while(|further| circle[(first + further) % count]);
        (row.count(), first)
    };
    let longest = (0..count)
        .map(row)
        .max_by_key(|(length, first)| (*length, count - first))?;
    let (length, first) = longest;
    (length > 0).then_some(first as f64 + 0.5 * (length as f64 - 1.0))
}

/// Runs up from rest by slowly changing the parameter of `way` to its working value, and tests whether the end lies in the basin
/// of the orbit; none if the machine lacks that parameter, or it follows others.
fn try_slow_way(
    orbit: &Orbit,
    basin_test: &BasinTest,
    (settings, way): (&RunUpSettings, Way),
    monitor: Monitor<'_>,
) -> Result<Option<Attempt>, OrbitError> {
    let scene = &orbit.scene;
    let Some((parameter, from, direction)) = way.slow_change(scene) else {
        return Ok(None);
    };
    let Some(at_work) = parameter.get(scene) else {
        return Ok(None);
    };
    let mut followers = scene.followers.parameters();
    if followers.any(|it| it == parameter) {
        return Ok(None);
    }
    let range = (from.min(at_work), from.max(at_work));
    let (steps, periods) = settings.sweep_steps(parameter, range);
    let Ok(plan) = Plan::new(parameter, range, steps, periods) else {
        return Ok(None);
    };
    let plan = Plan {
        tolerance: SIMILAR,
        heights: false,
        start: rest_state(scene),
        ..plan
    };
    let mut chains = [Chain::new(Scene::clone(scene), direction)];
    if !plan.run_chains(&mut chains, &|_, _| stop_if(monitor(0, 0).is_break())) {
        return Err(OrbitError::Stopped);
    }
    let [chain] = chains;
    let last = chain.steps.last().filter(|_| chain.error.is_none());
    let reached = match last {
        Some(last) => basin_test.test_starts(&[last.end], monitor)?[0],
        None => false,
    };
    let peaks = || {
        let (mut peaks, mut state) = (RunUpPeaks::default(), plan.start);
        for step in 0..steps {
            let mut machine = Machine::from(Scene::clone(scene));
            machine.set(parameter, plan.value_at(step, direction));
            state = peaks.take_peaks(&machine.scene.check()?, state, periods)?;
            OrbitError::ask_monitor(monitor)?;
        }
        peaks.take_peaks(scene, state, STEP_PERIODS)?;
        Ok::<_, OrbitError>(peaks)
    };
    let is_one = |motion: &MotionKind| motion.regime() == Some(Regime::ONE);
    let mut ones = chain.steps.iter().rev().filter(|step| is_one(&step.motion));
    Ok(Some(Attempt {
        way,
        share: f64::from(u8::from(reached)),
        angle: None,
        from: Some(from),
        ends: last.map(|last| last.motion.clone()),
        lost: ones.next().map(|step| step.value).filter(|_| !reached),
        periods: Some(steps as u64 * periods),
        // A way that cannot be computed to its end has none.
        peaks: settings.computes_peaks().then(peaks).and_then(Result::ok),
    }))
}
