//! Running a method and taking its time.

use std::time::{Duration, Instant};

use serde::Serialize;

use crate::methods::{Integrator, MethodError, Task, Work};

use super::errors::Scale;
use super::family::Family;
use super::truth::Truth;
use softstop_console::failure::{Failure, check_interrupt};
use softstop_console::median::median;

/// How much is run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Longest run that is begun, in s, as far as can be foreseen.
    pub longest: f64,
    /// Runs are repeated until they have taken so much together, in s.
    pub repeat: f64,
    /// Most runs.
    pub most: usize,
}

/// One setting of a method and what came of it: a row of the tables.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Row {
    /// The method.
    pub method: String,
    /// Step in drive periods or tolerance.
    pub knob: Option<f64>,
    /// `done`, `failed` or `skipped`.
    pub status: &'static str,
    /// Why there is no answer.
    pub reason: Option<String>,
    /// Median time of a run, in s.
    pub seconds: Option<f64>,
    /// Runs that the median is of.
    pub runs: Option<usize>,
    /// Steps of a run.
    pub steps: Option<u64>,
    /// Evaluations of the law of force in a run.
    pub evaluations: Option<u64>,
    /// Error of the state at the end.
    pub end_error: Option<f64>,
    /// Largest error of the time of an impact, in drive periods.
    pub impact_time_error: Option<f64>,
    /// Largest error of a before-impact velocity.
    pub impact_velocity_error: Option<f64>,
    /// Impacts found.
    pub impacts: Option<usize>,
    /// Impacts found less those that are.
    pub impact_difference: Option<i64>,
}

impl Row {
    /// The largest of the errors.
    pub fn worst_error(&self) -> Option<f64> {
        let errors = [
            self.end_error,
            self.impact_time_error,
            self.impact_velocity_error,
        ];
        errors.into_iter().flatten().reduce(f64::max)
    }

    /// The method gave up or ended with numbers that are none (`failed`), or takes too long (`skipped`).
    fn without(self, status: &'static str, reason: String) -> Self {
        Self {
            status,
            reason: Some(reason),
            ..self
        }
    }
}

/// Time in s that a step is taken to last before any has been measured.
const STEP: f64 = 1e-6;
/// Steps that are always allowed.
const FEW_STEPS: u64 = 100_000;

/// A method at work on a task.
pub struct Bench<'a> {
    /// What to compute.
    pub task: &'a Task,
    /// What is true.
    pub truth: &'a Truth,
    /// How large the motion is.
    pub scale: Scale,
    /// How much to run.
    pub effort: Effort,
}

impl Bench<'_> {
    /// Runs all settings of a family, as far as they do not take too long; `done` hears of each.
    ///
    /// # Errors
    /// [`Failure::Interrupted`] after Ctrl-C.
    pub fn family(&self, family: &Family, done: &dyn Fn()) -> Result<Vec<Row>, Failure> {
        let mut pace = Pace::default();
        let mut rows = Vec::new();
        for (knob, method) in &family.settings {
            check_interrupt()?;
            let row = Row {
                method: family.name.clone(),
                knob: *knob,
                status: "done",
                ..Row::default()
            };
            rows.push(self.run(row, &**method, &mut pace));
            done();
        }
        Ok(rows)
    }

    fn run(&self, row: Row, method: &dyn Integrator, pace: &mut Pace) -> Row {
        let longest = self.effort.longest;
        let foreseen = pace.foreseen();
        if foreseen > longest {
            let reason = format!("would take some {foreseen:.1e} s, more than {longest} s");
            return row.without("skipped", reason);
        }
        let most_steps = (2.0 * longest / pace.step.unwrap_or(STEP)) as u64;
        let most_steps = most_steps.max(FEW_STEPS);
        let task = Task {
            most_steps,
            ..self.task.clone()
        };
        let begin = Instant::now();
        let first = method.integrate(&task);
        let taken = begin.elapsed();
        let solution = match first {
            Ok(solution) => solution,
            Err(error) => {
                pace.failed(taken);
                return match error {
                    MethodError::Stuck { steps, .. } if steps >= most_steps => {
                        let reason = format!("broken off after {steps} steps: takes too long");
                        row.without("skipped", reason)
                    }
                    _ => row.without("failed", error.to_string()),
                };
            }
        };
        pace.ran(taken, &solution.work);
        let errors = self.truth.errors_of(&solution, &self.scale);
        if !errors.end.is_finite() {
            return row.without("failed", "ends in numbers that are none".to_owned());
        }
        let mut times = vec![taken.as_secs_f64()];
        while times.iter().sum::<f64>() < self.effort.repeat && times.len() < self.effort.most {
            let begin = Instant::now();
            let again = method.integrate(&task);
            times.push(begin.elapsed().as_secs_f64());
            std::hint::black_box(&again);
        }
        Row {
            runs: Some(times.len()),
            seconds: Some(median(times)),
            steps: Some(solution.work.steps),
            evaluations: Some(solution.work.evaluations),
            end_error: Some(errors.end),
            impact_time_error: errors.impact_time,
            impact_velocity_error: errors.impact_velocity,
            impacts: Some(self.scale.told(&solution.impacts).len()),
            impact_difference: Some(errors.impact_difference),
            ..row
        }
    }
}

/// How long the runs of a family take.
#[derive(Debug, Default)]
struct Pace {
    last: Option<f64>,
    /// The last run over the one before.
    growth: Option<f64>,
    /// Time of a step, in s.
    step: Option<f64>,
}

impl Pace {
    /// What the next run will take, in s.
    fn foreseen(&self) -> f64 {
        let growth = self.growth.unwrap_or(2.0).clamp(1.0, 4.0);
        self.last.map_or(0.0, |last| growth * last)
    }

    fn ran(&mut self, taken: Duration, work: &Work) {
        let seconds = taken.as_secs_f64();
        self.step = Some(seconds / work.steps.max(1) as f64);
        self.growth = self.last.map(|last| seconds / last);
        self.last = Some(seconds);
    }

    /// A run that broke off says little about the next; one that took long says enough.
    fn failed(&mut self, taken: Duration) {
        let seconds = taken.as_secs_f64();
        self.growth = None;
        self.last = Some(self.last.unwrap_or(0.0).max(seconds));
    }
}

#[cfg(test)]
mod tests {
    use super::{Duration, Pace, Work};
    use approx::assert_abs_diff_eq;
    use softstop_testing::tolerance::MOTION;

    #[test]
    fn the_next_run_is_foreseen_from_the_last_two() {
        let mut pace = Pace::default();
        assert_eq!(pace.foreseen(), 0.0);
        let work = Work {
            steps: 10,
            evaluations: 40,
        };
        pace.ran(Duration::from_millis(100), &work);
        assert_abs_diff_eq!(pace.foreseen(), 0.2, epsilon = MOTION);
        pace.ran(Duration::from_millis(300), &work);
        assert_abs_diff_eq!(pace.foreseen(), 0.9, epsilon = MOTION);
        assert_abs_diff_eq!(pace.step.expect("a value"), 0.03, epsilon = MOTION);
    }
}
