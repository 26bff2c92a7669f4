//! Points of a study, block by block: the piece of work that is done, kept and merged as one.

use std::cell::OnceCell;

use softstop::Machine;
use softstop::internals::budget;
use softstop_console::failure::{Failure, check_interrupt};
use softstop_console::interrupt;
use softstop_dynamics::parallel;
use softstop_dynamics::zone::hysteresis_batch;

use super::file::Study;
use super::outputs::{Need, StudyOutput};
use super::point_evaluation::PointEvaluation;

/// Points whose motions go together in the lanes: it may not depend on how many threads there are.
const TOGETHER: usize = 256;

impl Study {
    /// All outputs of a block, column by column, in the machine's own units; NaN where there is nothing.
    ///
    /// # Errors
    /// [`Failure::Interrupted`].
    pub(super) fn evaluate(&self, block: u64) -> Result<Vec<f64>, Failure> {
        let machines: Vec<Machine> = self.block(block).map(|it| self.machine_at(it)).collect();
        let groups: Vec<&[Machine]> = machines.chunks(TOGETHER).collect();
        let told = parallel::try_map(&groups, |machines| {
            let mut told = Vec::with_capacity(machines.len() * self.width());
            for evaluation in self.prepare(machines)? {
                told.extend(self.row(evaluation.as_ref()));
            }
            Ok::<_, Failure>(told)
        });
        let rows = told?.concat();
        check_interrupt()?;
        let width = self.width();
        let column = |column| rows.iter().skip(column).step_by(width);
        Ok((0..width).flat_map(column).copied().collect())
    }

    /// Numbers that a point takes in a block.
    pub(super) fn width(&self) -> usize {
        self.outputs.iter().map(|output| output.width()).sum()
    }

    /// The outputs of a point, none of which is there if they are over the budget.
    fn row(&self, evaluation: Option<&PointEvaluation<'_>>) -> Vec<f64> {
        let told = |value: &dyn Fn(StudyOutput) -> [f64; 2]| {
            let mut row = Vec::with_capacity(self.width());
            for output in &self.outputs {
                row.extend(&value(*output)[..output.width()]);
            }
            row
        };
        let within = evaluation.and_then(|evaluation| {
            let (row, spent) = budget::run_within(self.budget.windows(), || {
                told(&|output| output.value(evaluation))
            });
            (spent < self.budget.windows()).then_some(row)
        });
        within.unwrap_or_else(|| told(&|output| output.over_budget()))
    }

    /// What all outputs of some points are told from; nothing of those over the budget.
    ///
    /// Points that go together may cost what one of them may: then so may each of them alone. If they cost more, they
    /// are halved, so a point's answer does not depend on the points beside it.
    fn prepare<'a>(
        &'a self,
        machines: &'a [Machine],
    ) -> Result<Vec<Option<PointEvaluation<'a>>>, Failure> {
        let (prepared, spent) =
            budget::run_within(self.budget.windows(), || self.prepare_together(machines));
        check_interrupt()?;
        if spent < self.budget.windows() {
            return Ok(prepared?.into_iter().map(Some).collect());
        }
        let (first, rest) = machines.split_at(machines.len() / 2);
        if first.is_empty() {
            return Ok(rest.iter().map(|_| None).collect());
        }
        let mut prepared = self.prepare(first)?;
        prepared.extend(self.prepare(rest)?);
        Ok(prepared)
    }

    fn prepare_together<'a>(
        &'a self,
        machines: &'a [Machine],
    ) -> Result<Vec<PointEvaluation<'a>>, Failure> {
        let wanted = |need| self.outputs.iter().any(|output| output.needs(need));
        let motions: Vec<_> = machines.iter().map(|it| (&it.scene, it.start)).collect();
        let seen = match wanted(Need::Motion) {
            true => {
                let seen = self.settling.follow_motions(&motions, &interrupt::watch);
                seen.ok_or(Failure::Interrupted)?
            }
            false => Vec::new(),
        };
        let zones = match wanted(Need::Zone) {
            true => {
                let scenes = machines.iter().map(|machine| machine.scene.clone());
                hysteresis_batch(&scenes.collect::<Vec<_>>(), &interrupt::watch)
            }
            false => Vec::new(),
        };
        let mut seen = seen.into_iter().map(Result::ok);
        let mut zones = zones.into_iter().map(Result::ok);
        let prepared = machines.iter().map(|machine| PointEvaluation {
            settling: self.settling,
            certainty: self.certainty,
            machine,
            is_valid: machine.validate().is_ok(),
            seen: seen.next().flatten(),
            zone: zones.next().flatten(),
            map: OnceCell::new(),
            motion: OnceCell::new(),
            orbit: OnceCell::new(),
        });
        Ok(prepared.collect())
    }
}
