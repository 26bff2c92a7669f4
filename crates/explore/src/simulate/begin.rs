//! What is to be run: the machine, its start, and the strips that it does not get.

use std::ops::RangeInclusive;

use clap::Args;
use softstop::internals::Motion;
use softstop::{Allowed, Machine, MotionError, Start};

use softstop_console::arguments::CommandArguments;
use softstop_console::failure::Failure;
use softstop_console::range::require;

/// Which machine runs, and from where.
#[derive(Debug, Args)]
pub struct MotionArguments {
    /// Position to start from [default: that of the machine]
    #[arg(long, value_name = "X")]
    pub position: Option<f64>,
    /// Velocity to start with [default: that of the machine]
    #[arg(long, value_name = "V")]
    pub velocity: Option<f64>,
    /// Drive periods, counted from 1, in which no strip is fed: a stroke that begins in them finds none, and the stop
    /// stays where it is
    #[arg(long, value_name = "FIRST:LAST", value_parser = counted)]
    pub missing_strips: Option<RangeInclusive<u64>>,
    /// How it prints its summary, the machine, and what it may cost.
    #[command(flatten)]
    pub common: CommandArguments,
}

/// What to run.
pub(crate) struct RunPlan {
    /// With the start that counts.
    pub machine: Machine,
    /// Drive periods without a strip, counted from 1.
    missing: Option<RangeInclusive<u64>>,
    pub periods: u64,
    /// In each period.
    pub samples: u64,
    /// Periods that are drawn, the last ones.
    pub drawn: u64,
}

impl MotionArguments {
    /// The run over so many periods, with so many samples in each; the last ones are drawn.
    pub(crate) fn plan(&self, periods: u64, samples: u64, drawn: u64) -> Result<RunPlan, Failure> {
        for (flag, value) in [("position", self.position), ("velocity", self.velocity)] {
            Allowed::Finite.check(flag, value.unwrap_or(0.0))?;
            if value.is_some() {
                self.common.machine.refuse_start_beside(flag)?;
            }
        }
        let mut machine = self.common.machine.machine()?;
        let missing = self.missing_strips.clone();
        if let Some(missing) = &missing {
            let given = format!("{}:{}", missing.start(), missing.end());
            let has_strip = machine.scene.piercing.is_some();
            let within = format!("within the {periods} drive periods of the run");
            for (is_met, allowed) in [
                (has_strip, "left out: the machine has no strip"),
                (*missing.start() <= periods, &within),
            ] {
                require(is_met, "missing-strips", &given, allowed)?;
            }
        }
        let Start { position, velocity } = machine.start;
        machine.start.position = self.position.unwrap_or(position);
        machine.start.velocity = self.velocity.unwrap_or(velocity);
        let plan = RunPlan {
            machine,
            missing,
            periods,
            samples,
            drawn,
        };
        match plan.machine.scene.motion(plan.machine.start) {
            Err(error @ MotionError::BeyondStop { .. }) if self.position.is_none() => {
                Err(Failure::usage(format!("initial.{error}")))
            }
            begun => Ok(begun.map(|_| plan)?),
        }
    }
}

impl RunPlan {
    /// The motion that begins there.
    pub(crate) fn motion(&self) -> Result<Motion, Failure> {
        Ok(self.machine.scene.motion(self.machine.start)?)
    }

    /// Time in s from which on the motion is drawn.
    pub(crate) fn drawn_from(&self) -> f64 {
        self.periods.saturating_sub(self.drawn) as f64 * self.machine.scene.period()
    }

    /// Whether strips come in a drive period, counted from 0.
    pub(crate) fn is_fed(&self, period: u64) -> bool {
        let missing = self.missing.as_ref();
        !missing.is_some_and(|missing| missing.contains(&(period + 1)))
    }
}

/// `FIRST:LAST`.
fn counted(text: &str) -> Result<RangeInclusive<u64>, String> {
    let number = |part: &str| part.trim().parse::<u64>().ok();
    let pair = text.split_once(':');
    match pair.and_then(|(first, last)| Some((number(first)?, number(last)?))) {
        Some((first, last)) if 1 <= first && first <= last => Ok(first..=last),
        _ => Err("must be FIRST:LAST, two whole numbers with 1 <= FIRST <= LAST, as in 5:7".into()),
    }
}
