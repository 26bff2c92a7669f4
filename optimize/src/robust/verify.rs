//! Machines that are built, one by one: how many lose the z = 1 motion, how many are not as required, and how hard the others
//! strike.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::spread::{MotionOutcome, PolynomialModel, Settled, ToleranceBox};
use softstop_dynamics::Orbit;
use softstop_dynamics::monitor::Monitor;
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::parallel;
use softstop_dynamics::points::{SEQUENCE_LENGTH, sobol_point};
use softstop_dynamics::zone::Loss;

use super::Tolerances;
use super::indices::Estimate;
use super::screen::Screen;
use crate::design::requirement::Requirement;

/// Machines between two looks at how many are lost, and those that one thread looks at in a row.
const GROUP: usize = 1 << 14;
const ROW: usize = 1 << 8;
/// Lost machines that are told of one by one.
const TOLD: usize = 8;

/// How many machines are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settings {
    /// As many.
    pub machines: usize,
    /// With so many lost, in all cases together, it is enough: each of them has to be followed.
    pub enough: usize,
    /// The first of the points that are drawn, a multiple of 65,536: others give an independent count.
    pub first: usize,
}

impl Default for Settings {
    /// 16 sequences of 65,536 points, and no more than a thousand lost.
    fn default() -> Self {
        Self {
            machines: 16 * SEQUENCE_LENGTH,
            enough: 1000,
            first: 0,
        }
    }
}

impl Settings {
    /// So many machines, and no more than a thousand lost.
    pub fn of_machines(machines: usize) -> Self {
        Self {
            machines,
            ..Self::default()
        }
    }
}

/// A machine that has lost the motion.
#[derive(Debug, Clone)]
pub struct LostMachine {
    /// Its coordinates in the box.
    pub at: Vec<f64>,
    /// Share of the way there from the nominal machine up to which the motion goes on.
    pub share: f64,
    /// What ends it there.
    pub loss: Loss,
}

/// A range of velocities and how many machines lie in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bin {
    /// Its lower end in m/s.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
    /// Machines.
    pub machines: usize,
}

/// What the machines have shown.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Verdict {
    /// Machines looked at: fewer than asked for if enough were lost, or somebody asked to stop.
    pub machines: usize,
    /// Those without a stable z = 1 motion that goes on from the nominal one.
    pub lost: usize,
    /// The first of them.
    pub examples: Vec<LostMachine>,
    /// Machines that violate each requirement, those that are lost among them.
    pub violating: Vec<usize>,
    /// Machines that are lost or violate any of them, in any case.
    pub rejected: usize,
    /// What the same machines have shown in each case.
    pub cases: Vec<CaseVerdict>,
    /// Where the slowest impact was, if all are not lost.
    pub slowest: Option<(Vec<f64>, Settled)>,
    /// Before-impact velocities in m/s of all that are not lost, in rising order.
    velocities: Vec<f64>,
    /// The same of each sequence of points.
    sequences: Vec<Vec<f64>>,
}

/// What the machines have shown in a case.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseVerdict {
    /// Those without a stable z = 1 motion that goes on from the nominal one.
    pub lost: usize,
    /// Machines that violate each requirement, those that are lost among them.
    pub violating: Vec<usize>,
    /// The slowest impact in m/s of those that are not lost; infinite if all are.
    pub slowest: f64,
}

impl CaseVerdict {
    fn take(&mut self, (fate, violated): (MotionOutcome, Vec<bool>)) {
        match fate {
            MotionOutcome::Lost { .. } => self.lost += 1,
            MotionOutcome::Kept(settled) => self.slowest = self.slowest.min(settled.velocity),
        }
        count(&mut self.violating, &violated);
    }
}

fn count(violating: &mut [usize], violated: &[bool]) {
    for (count, is_violated) in violating.iter_mut().zip(violated) {
        *count += usize::from(*is_violated);
    }
}

impl Verdict {
    /// The velocity in m/s that this share of the machines stays below, with its standard error, which is none for
    /// fewer than two sequences of points; none if all are lost.
    pub fn quantile(&self, share: f64) -> Option<(f64, Option<f64>)> {
        let of = |velocities: &[f64]| {
            let last = velocities.len().checked_sub(1)?;
            let index = (share.clamp(0.0, 1.0) * last as f64).round() as usize;
            velocities.get(index).copied()
        };
        self.figure(of)
    }

    /// The mean velocity in m/s, and its standard error.
    pub fn mean(&self) -> Option<(f64, Option<f64>)> {
        let of = |velocities: &[f64]| {
            let sum: f64 = velocities.iter().sum();
            (!velocities.is_empty()).then(|| sum / velocities.len() as f64)
        };
        self.figure(of)
    }

    fn figure(&self, of: impl Fn(&[f64]) -> Option<f64>) -> Option<(f64, Option<f64>)> {
        let whole = of(&self.velocities)?;
        let each: Vec<f64> = self.sequences.iter().filter_map(|one| of(one)).collect();
        let error = (each.len() > 1).then(|| Estimate::of(&each).error);
        Some((whole, error))
    }

    /// How many machines lie in each of so many equal ranges of the velocity.
    pub fn histogram(&self, bins: usize) -> Vec<Bin> {
        let (Some(low), Some(high)) = (self.velocities.first(), self.velocities.last()) else {
            return Vec::new();
        };
        let end = |index: usize| low + (high - low) * index as f64 / bins as f64;
        let mut counted = 0;
        let bin = |index: usize| {
            let (low, high) = (end(index), end(index + 1));
            let until = match index + 1 == bins {
                true => self.velocities.len(),
                false => self.velocities.partition_point(|velocity| *velocity < high),
            };
            let machines = until - std::mem::replace(&mut counted, until);
            Bin {
                low,
                high,
                machines,
            }
        };
        (0..bins).map(bin).collect()
    }
}

/// Looks at machines as they are built, about the z = 1 motion of the nominal one, and whether each is as required, by what its
/// motion tells by itself. A box is filled evenly; normal tolerances should reach over [`FITTED`](super::FITTED) standard
/// deviations. The watcher is told how many are done; the verdict does not depend on the number of threads.
///
/// # Errors
/// [`OrbitError`] if the nominal motion is not one to start from.
pub fn verify(
    spread: &Tolerances,
    nominal: &Orbit,
    (settings, required): (Settings, &[Requirement]),
    watcher: Monitor<'_>,
) -> Result<Verdict, OrbitError> {
    verify_in_cases(&[(spread.clone(), nominal)], (settings, required), watcher)
}

/// [`verify`] with further cases of each machine that is drawn, at the same coordinates of their tolerances; the first is that of
/// the drawing.
///
/// # Errors
/// As [`verify`].
pub fn verify_in_cases(
    points: &[(Tolerances, &Orbit)],
    (settings, required): (Settings, &[Requirement]),
    watcher: Monitor<'_>,
) -> Result<Verdict, OrbitError> {
    let spread = &points[0].0;
    let dimensions = spread.dimensions();
    // A sequence of their own: the first that the machines do not use.
    let first = settings.first + settings.machines.next_multiple_of(SEQUENCE_LENGTH);
    let known = first..first + PolynomialModel::wanted(dimensions);
    let known: Vec<Vec<f64>> = known.map(|index| sobol_point(index, dimensions)).collect();
    let screen = |(spread, nominal)| Screen::new((spread, nominal), (&known, required));
    let screens = points
        .iter()
        .map(|(spread, nominal)| screen((spread, *nominal)));
    let screens: Vec<Screen<'_>> = screens.collect::<Result<_, _>>()?;
    let case = CaseVerdict {
        lost: 0,
        violating: vec![0; required.len()],
        slowest: f64::INFINITY,
    };
    let mut verdict = Verdict {
        machines: 0,
        lost: 0,
        examples: Vec::new(),
        violating: vec![0; required.len()],
        rejected: 0,
        cases: vec![case; points.len() - 1],
        slowest: None,
        velocities: Vec::new(),
        sequences: Vec::new(),
    };
    let done = AtomicU64::new(0);
    while verdict.machines < settings.machines && verdict.all_lost() < settings.enough {
        let machines = verdict.machines..(verdict.machines + GROUP).min(settings.machines);
        let rows: Vec<_> = machines.clone().step_by(ROW).collect();
        let fates = parallel::try_map(&rows, |first| {
            let row = *first..(first + ROW).min(machines.end);
            let fate = |index| {
                let at = drawn(spread, settings.first + index);
                screens.iter().map(|it| it.judge(&at)).collect::<Vec<_>>()
            };
            let fates: Vec<_> = row.clone().map(fate).collect();
            let looked = row.len() as u64;
            let done = done.fetch_add(looked, Ordering::Relaxed) + looked;
            let go_on = watcher(done, settings.machines as u64);
            go_on.is_continue().then_some(fates).ok_or(())
        });
        let Ok(fates) = fates else {
            break;
        };
        for (index, judged) in machines.zip(fates.into_iter().flatten()) {
            let is_rejected = |(fate, violated): &(MotionOutcome, Vec<bool>)| {
                matches!(fate, MotionOutcome::Lost { .. }) || violated.contains(&true)
            };
            verdict.rejected += usize::from(judged.iter().any(is_rejected));
            let mut judged = judged.into_iter();
            if let Some((fate, violated)) = judged.next() {
                verdict.take(settings.first + index, spread, fate);
                count(&mut verdict.violating, &violated);
            }
            for (case, judged) in verdict.cases.iter_mut().zip(judged) {
                case.take(judged);
            }
        }
    }
    verdict.velocities = verdict.sequences.concat();
    verdict.velocities.sort_by(f64::total_cmp);
    for sequence in &mut verdict.sequences {
        sequence.sort_by(f64::total_cmp);
    }
    Ok(verdict)
}

/// The coordinates of a machine that is drawn.
fn drawn(spread: &dyn ToleranceBox, index: usize) -> Vec<f64> {
    spread.draw(&sobol_point(index, spread.dimensions()))
}

impl Verdict {
    /// Machines that lose the motion, counted in each case.
    fn all_lost(&self) -> usize {
        self.lost + self.cases.iter().map(|it| it.lost).sum::<usize>()
    }

    fn take(&mut self, index: usize, spread: &dyn ToleranceBox, fate: MotionOutcome) {
        if index.is_multiple_of(SEQUENCE_LENGTH) {
            self.sequences.push(Vec::new());
        }
        self.machines += 1;
        let here = || drawn(spread, index);
        match fate {
            MotionOutcome::Lost { share, loss } => {
                self.lost += 1;
                if self.examples.len() < TOLD {
                    let at = here();
                    self.examples.push(LostMachine { at, share, loss });
                }
            }
            MotionOutcome::Kept(settled) => {
                let slowest = self.slowest.as_ref();
                if slowest.is_none_or(|(_, slowest)| settled.velocity < slowest.velocity) {
                    self.slowest = Some((here(), settled));
                }
                if let Some(sequence) = self.sequences.last_mut() {
                    sequence.push(settled.velocity);
                }
            }
        }
    }
}
