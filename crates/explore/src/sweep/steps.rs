//! The table of a sweep: a row for each step.

use softstop::Parameter;
use softstop_console::column::Column;
use softstop_console::columns;
use softstop_dynamics::{Chain, Direction, Plan, SweepStep};

/// A row of `sweep.csv`.
pub(super) struct SweepRow<'a> {
    clearance: Option<f64>,
    direction: Direction,
    step: &'a SweepStep,
}

/// The columns of `sweep.csv`.
pub(super) fn columns<'a>() -> [Column<SweepRow<'a>>; 14] {
    columns! { SweepRow<'a>, row;
        "clearance" [Length], "of the machine, unless it is swept" => row.clearance;
        "direction" [None], "up or down" => row.direction.name();
        "value" [Of("own")], "of the parameter, in its own unit" => row.step.value;
        "kind" [None], "of the motion" => row.step.motion.json_key();
        "z" [None], "regime z = p/n, if the motion repeats" => row.step.motion.z();
        "order" [None], "impacts in each drive period of n" => row.step.motion.order_beyond_regime().map(ToString::to_string);
        "impacts_per_period" [None], "mean per drive period" => row.step.impacts_per_period;
        "growth_per_period" [None], "ln of that of small differences, unless p/n" => row.step.growth;
        "least_before_impact_velocity" [Velocity], "of all watched" => row.step.velocities.first().copied();
        "before_impact_velocity" [Velocity], "the largest of them" => row.step.velocities.last().copied();
        "max_position" [Length], "largest position meanwhile: over one period of what repeats, else over all watched" => row.step.max_position;
        "end_position" [Length], "at the end, at drive angle phi" => row.step.end.position;
        "end_velocity" [Velocity], "there" => row.step.end.velocity;
        "before_impact_velocities" [Velocity], "all of them, rising" => velocities(row.step);
    }
}

/// The rows of `sweep.csv`: one for each step.
pub(super) fn rows<'a>(plan: &Plan, chains: &'a [Chain]) -> impl Iterator<Item = SweepRow<'a>> {
    chains.iter().flat_map(|chain| {
        let clearance = clearance(plan, chain);
        chain.steps.iter().map(move |step| SweepRow {
            clearance,
            direction: chain.direction,
            step,
        })
    })
}

fn velocities(step: &SweepStep) -> String {
    let velocities = step.velocities.iter();
    let written = velocities.map(|velocity| format!("{velocity:.9}"));
    written.collect::<Vec<_>>().join(" ")
}

/// The clearance of a chain, unless it is swept.
pub(super) fn clearance(plan: &Plan, chain: &Chain) -> Option<f64> {
    let swept = plan.parameter == Parameter::Clearance;
    chain.machine.value(Parameter::Clearance).filter(|_| !swept)
}
