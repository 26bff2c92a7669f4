//! From a motion of the engine, in floating point, to the sequence and the guess from which a proof sets out.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, Vector2};
use softstop::{Crossing, CrossingKind, Scene, Start, Trajectory};

use crate::ProofError;
use crate::interval::Interval;
use crate::machine::{Guard, Machine};
use crate::motion::{Event, Kind, Motion, Problem, UNKNOWNS};

/// Velocity, in units of the fastest of the motion, and drive angle in rad, below which crossings about a touch are a part of
/// it.
const TOUCHING: (f64, f64) = (0.05, 0.5);
/// Share of a position within which two surfaces are the same.
const SAME: f64 = 1e-9;

/// Where a motion grazes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Drive angle in rad.
    pub angle: f64,
    /// Position of the surface in m.
    pub position: f64,
}

/// An event with the phase that follows and a guess of its unknowns.
struct Guess {
    kind: Kind,
    phase: usize,
    unknowns: [f64; UNKNOWNS],
}

/// The motion from a state at time 0 over its period, with a touch if it grazes; a guess of the unknowns of its events.
pub(crate) fn motion(
    scene: &Scene,
    state: Vector2<f64>,
    periods: u64,
    touch: Option<Touch>,
) -> Result<(Motion, Vec<f64>), ProofError> {
    let machine = Machine::new(scene)?;
    let trajectory = scene.trajectory(Start::from(state), periods)?;
    let drive = scene.excitation;
    let begin = drive.reduced_phase();
    let span = TAU * periods as f64;
    let mut guesses = Vec::new();
    let reach = drive.frequency * state.x.abs();
    let crossings: Vec<&Crossing> = trajectory.crossings().collect();
    let speeds = crossings.iter().map(|it| it.velocity.abs());
    let fastest = speeds.fold(reach.max(state.y.abs()), f64::max);
    for (index, crossing) in crossings.iter().enumerate() {
        if matches!(crossing.kind, CrossingKind::Rest | CrossingKind::Release) {
            return Err(ProofError::Unsupported(
                "the motion rests for a while (dry friction, chatter, or a force below the preload)",
            ));
        }
        let angle = drive.frequency * trajectory.clock.time(crossing.instant) + begin;
        let is_of_touch = touch.is_some_and(|touch| {
            let apart = (angle - touch.angle).rem_euclid(span);
            let near = (crossing.position - touch.position).abs() <= SAME * touch.position.abs();
            near && crossing.velocity.abs() < TOUCHING.0 * fastest
                && apart.min(span - apart) < TOUCHING.1
        });
        if !is_of_touch {
            guesses.push(Guess {
                kind: Kind::Crossing,
                phase: phase_after(&machine, &trajectory, &crossings[index..]),
                unknowns: [angle, crossing.position, crossing.velocity],
            });
        }
    }
    if let Some(touch) = touch {
        let angle = begin + (touch.angle - begin).rem_euclid(span);
        let at = guesses.partition_point(|it| it.unknowns[0] < angle);
        let below = touch.position - SAME * touch.position.abs();
        let phase = machine.phase_at(below, 0.0);
        if machine.phases[phase]
            .guards
            .iter()
            .any(|it| it.position == 0.0)
        {
            return Err(ProofError::Unsupported(
                "under dry friction the mass turns on the very surface that it grazes",
            ));
        }
        let guess = Guess {
            kind: Kind::Touch,
            phase,
            unknowns: [angle, touch.position, 0.0],
        };
        guesses.insert(at, guess);
    }
    if guesses.is_empty() {
        let until = (-begin).rem_euclid(TAU) / drive.frequency;
        let until = trajectory.clock.instant(until);
        let Start { position, velocity } = scene.trajectory_until(Start::from(state), until)?.end;
        guesses.push(Guess {
            kind: Kind::Section,
            phase: machine.phase_at(position, velocity),
            unknowns: [0.0, position, velocity],
        });
    }
    let count = guesses.len();
    let before = (0..count).map(|it| guesses[(it + count - 1) % count].phase);
    let events = before.zip(&guesses).map(|(before, it)| Event {
        event: it.kind,
        guard: guard_at(&machine, before, it),
        phase: it.phase,
    });
    let motion = Motion {
        periods,
        events: events.collect(),
        machine,
    };
    Ok((motion, guesses.iter().flat_map(|it| it.unknowns).collect()))
}

/// The phase of the arc after the first of some crossings, by the state in its middle.
fn phase_after(machine: &Machine, trajectory: &Trajectory, crossings: &[&Crossing]) -> usize {
    let begin = crossings[0].instant;
    let next = crossings.get(1).map(|it| it.instant);
    let last = trajectory
        .arcs
        .last()
        .map(|it| trajectory.clock.after(it.start, it.duration));
    let end = next.or(last).unwrap_or(begin);
    let half = 0.5 * trajectory.clock.elapsed(begin, end);
    let middle = trajectory
        .at(trajectory.clock.after(begin, half))
        .unwrap_or(trajectory.end);
    machine.phase_at(middle.position, middle.velocity)
}

/// The guard of a phase that is nearest to zero at an event, of those that lead to the phase that follows.
fn guard_at(machine: &Machine, phase: usize, event: &Guess) -> usize {
    let [_, x, v] = event.unknowns.map(Interval::point);
    let guards = machine.phases[phase].guards.iter().enumerate();
    let leads = |guard: &Guard| event.kind != Kind::Crossing || guard.to.contains(&event.phase);
    let value = |guard: &Guard| guard.value(&x, &v).magnitude();
    let leading = guards.filter(|it| leads(it.1));
    leading
        .min_by(|a, b| value(a.1).total_cmp(&value(b.1)))
        .map_or(0, |it| it.0)
}

/// The problem of a fold or a flip with a guess of its unknowns, from those of the events: the tangent is that which the
/// motion's equations stretch least.
pub(crate) fn critical(
    motion: &Motion,
    events: &[f64],
    frequency: f64,
    problem: fn(usize) -> Problem,
) -> Option<(Problem, Vec<f64>)> {
    let count = events.len();
    let columns = (0..count).flat_map(|column| {
        let tangent = (0..count).map(|it| if it == column { 1.0 } else { 0.0 });
        let all = events.iter().copied().chain(tangent).chain([frequency]);
        let all: Vec<Interval> = all.map(Interval::point).collect();
        let values = motion.residuals(problem(0), &all);
        let images = values[count..2 * count].iter().map(|it| it.middle());
        images.collect::<Vec<f64>>()
    });
    let matrix = DMatrix::from_iterator(count, count, columns);
    let right = matrix.try_svd(false, true, f64::EPSILON, 1000)?.v_t?;
    let tangent = right.row(count - 1);
    let pinned = tangent.transpose().icamax();
    let tangent = tangent.iter().map(|it| it / tangent[pinned]);
    let all = events.iter().copied().chain(tangent).chain([frequency]);
    Some((problem(pinned), all.collect()))
}
