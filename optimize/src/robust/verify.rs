//! Machines that are built, one by one: how many lose the z = 1 motion, how many are not as required, and how hard the others
//! strike.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::spread::{PolynomialModel, StableMotion};
use softstop_dynamics::Orbit;
use softstop_dynamics::monitor::Monitor;
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::parallel;
use softstop_dynamics::spread_points::{SEQUENCE_LENGTH, sobol_point};

use super::Tolerances;
use super::screen::Screen;
use crate::design::requirement::Requirement;

/// Machines between two looks at how many are lost, and those that one thread looks at in a row.
const GROUP: usize = 1 << 14;
const ROW: usize = 1 << 8;

/// How many machines are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct VerifySettings {
    /// As many.
    pub machines: usize,
    /// With so many lost, in all cases together, it is enough: each of them has to be followed.
    pub enough: usize,
    /// The first of the points that are drawn, a multiple of 65,536: others give an independent count.
    pub first: usize,
}

impl Default for VerifySettings {
    /// 16 sequences of 65,536 points, and no more than a thousand lost.
    fn default() -> Self {
        Self {
            machines: 16 * SEQUENCE_LENGTH,
            enough: 1000,
            first: 0,
        }
    }
}

impl VerifySettings {
    /// So many machines, and no more than a thousand lost.
    pub fn of_machines(machines: usize) -> Self {
        Self {
            machines,
            ..Self::default()
        }
    }
}

/// What the machines have shown.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Verdict {
    /// Machines looked at: fewer than asked for if enough were lost, or somebody asked to stop.
    pub machines: usize,
    /// Machines that are lost or violate any requirement, in any case.
    pub rejected: usize,
    /// What they have shown in the drawing's operating point.
    pub drawing: CaseVerdict,
    /// What they have shown in each case.
    pub cases: Vec<CaseVerdict>,
    /// Before-impact velocities in m/s of all that are not lost, in rising order.
    pub velocities: Vec<f64>,
}

/// What the machines have shown in an operating point.
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
    fn take(&mut self, motion: Option<StableMotion>, violated: &[bool]) {
        match motion {
            None => self.lost += 1,
            Some(settled) => self.slowest = self.slowest.min(settled.velocity),
        }
        for (count, is_violated) in self.violating.iter_mut().zip(violated) {
            *count += usize::from(*is_violated);
        }
    }
}

impl Verdict {
    /// Machines that lose the motion, counted in each case.
    fn all_lost(&self) -> usize {
        let cases = self.cases.iter().map(|it| it.lost);
        self.drawing.lost + cases.sum::<usize>()
    }

    /// What they have shown in the drawing's operating point or in a case.
    pub fn for_case(&self, case: Option<usize>) -> &CaseVerdict {
        case.map_or(&self.drawing, |index| &self.cases[index])
    }

    /// So many equal ranges of the velocity in m/s, and how many machines lie in each.
    pub fn histogram(&self, bins: usize) -> Vec<([f64; 2], usize)> {
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
            ([low, high], until - std::mem::replace(&mut counted, until))
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
    (settings, required): (VerifySettings, &[Requirement]),
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
    (settings, required): (VerifySettings, &[Requirement]),
    watcher: Monitor<'_>,
) -> Result<Verdict, OrbitError> {
    let spread = &points[0].0;
    let dimensions = spread.dimensions();
    // A sequence of their own: the first that the machines do not use.
    let first = settings.first + settings.machines.next_multiple_of(SEQUENCE_LENGTH);
    let known = first..first + PolynomialModel::wanted(dimensions);
    let known: Vec<Vec<f64>> = known.map(|index| sobol_point(index, dimensions)).collect();
    let screens = points.iter();
    let screens =
        screens.map(|(spread, nominal)| Screen::new((spread, nominal), (&known, required)));
    let screens: Vec<Screen<'_>> = screens.collect::<Result<_, _>>()?;
    let case = CaseVerdict {
        lost: 0,
        violating: vec![0; required.len()],
        slowest: f64::INFINITY,
    };
    let mut verdict = Verdict {
        machines: 0,
        rejected: 0,
        cases: vec![case.clone(); points.len() - 1],
        drawing: case,
        velocities: Vec::new(),
    };
    let done = AtomicU64::new(0);
    while verdict.machines < settings.machines && verdict.all_lost() < settings.enough {
        let machines = verdict.machines..(verdict.machines + GROUP).min(settings.machines);
        let rows: Vec<_> = machines.clone().step_by(ROW).collect();
        let judged = parallel::try_map(&rows, |first| {
            let row = *first..(first + ROW).min(machines.end);
            let judge = |index| {
                let at = spread.draw(&sobol_point(settings.first + index, dimensions));
                screens.iter().map(|it| it.judge(&at)).collect::<Vec<_>>()
            };
            let judged: Vec<_> = row.clone().map(judge).collect();
            let looked = row.len() as u64;
            let done = done.fetch_add(looked, Ordering::Relaxed) + looked;
            let go_on = watcher(done, settings.machines as u64);
            go_on.is_continue().then_some(judged).ok_or(())
        });
        let Ok(judged) = judged else {
            break;
        };
        for judged in judged.into_iter().flatten() {
            let is_rejected = |(motion, violated): &(Option<StableMotion>, Vec<bool>)| {
                motion.is_none() || violated.contains(&true)
            };
            verdict.machines += 1;
            verdict.rejected += usize::from(judged.iter().any(is_rejected));
            if let Some((Some(settled), _)) = judged.first() {
                verdict.velocities.push(settled.velocity);
            }
            let points = [&mut verdict.drawing].into_iter().chain(&mut verdict.cases);
            for (point, (motion, violated)) in points.zip(judged) {
                point.take(motion, &violated);
            }
        }
    }
    verdict.velocities.sort_by(f64::total_cmp);
    Ok(verdict)
}
