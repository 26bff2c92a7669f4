//! What a sweep came to.

use softstop::Machine;
use softstop_console::column::{Column, Unit, Units};
use softstop_console::columns;
use softstop_console::record::{Record, below};
use softstop_console::report::{MotionName, stated_machine};
use softstop_console::table::sections;
use softstop_console::units;
use softstop_dynamics::sweep::{Coexistence, Jump, find_coexistences};
use softstop_dynamics::{Chain, Direction, MotionKind, Plan};

use super::steps::clearance;

fn plans<'a>() -> [Column<(&'a Machine, &'a Plan)>; 6] {
    columns! { (&'a Machine, &'a Plan), it;
        "parameter" [None], "what is swept" => it.0.name(it.1.parameter);
        "unit" [None], "of it" => units::of_parameter(it.0, it.1.parameter);
        "range" [Of("own")], "least and largest value" => [it.1.range.0, it.1.range.1];
        "steps" [None], "values" => it.1.steps;
        "periods" [None], "drive periods at each" => it.1.periods;
        "rate_per_period" [Of("own")], "mean change per drive period" => it.1.sweep_rate();
    }
}

fn chains<'a>() -> [Column<(&'a Plan, &'a Chain)>; 6] {
    columns! { (&'a Plan, &'a Chain), it;
        "clearance" [Length] Plain, "of the machine, unless it is swept" => clearance(it.0, it.1);
        "direction" [None] Plain, "up or down" => it.1.direction.name();
        "steps" [None] Plain, "done" => it.1.steps.len();
        "chaotic" [None] Plain, "steps of chaos" => count(it.1, MotionKind::Chaos);
        "unsettled" [None] Plain, "steps that have not settled" => count(it.1, MotionKind::Unsettled);
        "error" [None] Plain, "why it ended early" => it.1.error.clone();
    }
}

fn count(chain: &Chain, motion: MotionKind) -> usize {
    let steps = chain.steps.iter();
    steps.filter(|step| step.motion == motion).count()
}

fn jumps(digits: usize) -> [Column<Jump>; 5] {
    columns! { Jump, it;
        "from" [None] Fixed(digits), "value before" => it.from;
        "to" [None] Fixed(digits), "value after" => it.to;
        "before" [None] Plain, "motion before" => name(&it.before);
        "after" [None] Plain, "motion after" => name(&it.after);
        "before_impact_velocities" [Velocity] Fixed(4), "hardest before and after" => [it.velocities.0, it.velocities.1];
    }
}

type Zone = (Option<f64>, Coexistence);

fn zones(digits: usize) -> [Column<Zone>; 5] {
    columns! { Zone, it;
        "clearance" [Length] Plain, "of the machine, unless it is swept" => it.0;
        "from" [None] Fixed(digits), "least value" => it.1.from;
        "to" [None] Fixed(digits), "largest value" => it.1.to;
        "up" [None] Plain, "motion on the way up" => name(&it.1.up);
        "down" [None] Plain, "motion on the way down" => name(&it.1.down);
    }
}

/// A motion; people read the order of its impacts, too, where there are several of them.
fn name(motion: &MotionKind) -> MotionName {
    let mut name = MotionName::of(motion);
    if let Some(order) = motion.order_beyond_regime()
        && motion.regime().is_none_or(|it| it.impacts > 1)
    {
        name.text += &format!(" ({order})");
    }
    name
}

/// Decimals that tell one value of the parameter from the next.
fn digits(plan: &Plan) -> usize {
    let step = (plan.range.1 - plan.range.0).abs() / (plan.steps - 1) as f64;
    (1.0 - step.log10()).clamp(6.0, 15.0) as usize
}

/// Jumps of a sweep that are told; the file holds all.
const MOST: usize = 12;

/// The sweeps with their jumps, and where up and down differ; and the text of it.
pub(super) fn report(machine: &Machine, plan: &Plan, all: &[Chain]) -> (Record, String) {
    let (digits, units) = (digits(plan), Units::of(machine));
    let goes = |way| all.iter().any(|chain| chain.direction == way);
    let goes_both = goes(Direction::Up) && goes(Direction::Down);
    let of_machine = |pair: &[Chain]| match pair {
        [up, down] if goes_both => {
            let clearance = clearance(plan, up);
            let zones = find_coexistences(up, down).into_iter();
            zones.map(|zone| (clearance, zone)).collect()
        }
        _ => Vec::new(),
    };
    let zones_found: Vec<Zone> = all.chunks(2).flat_map(of_machine).collect();
    let zones = Record::all(&zones(digits), &zones_found);
    let figures = all
        .iter()
        .map(|chain| Record::of(&chains(), &(plan, chain)));
    let figures: Vec<Record> = figures.collect();

    let parameter = Unit::Of(units::of_parameter(machine, plan.parameter));
    let mut text = format!(
        "{} from {} to {}: {} values of {} drive periods, {:.3e} per period\n\n{}",
        units.label(machine.name(plan.parameter), parameter),
        plan.range.0,
        plan.range.1,
        plan.steps,
        plan.periods,
        plan.sweep_rate(),
        below(&figures, &units),
    );
    let sweep = |(chain, figures): (&Chain, Record)| {
        let clearance = clearance(plan, chain).map(|it| format!("clearance {it}, "));
        let name = clearance.unwrap_or_default() + chain.direction.name();
        let put = chain.steps.iter().filter(|step| step.is_put_on_wall);
        let put = put.count();
        if put > 0 {
            text += &format!(
                "\nBegun at rest on a rigid stop, as the state before lay beyond it: {put} of the values, {name}\n"
            );
        }
        let jumps = Record::all(&jumps(digits), &chain.find_jumps());
        if !jumps.is_empty() {
            let told = below(&jumps[..jumps.len().min(MOST)], &units);
            text += &format!("\nJumps, {name}\n{told}");
        }
        if jumps.len() > MOST {
            text += &format!("and {} more\n", jumps.len() - MOST);
        }
        figures.hidden("put_on_stop", put).hidden("jumps", jumps)
    };
    let sweeps: Vec<Record> = all.iter().zip(figures).map(sweep).collect();
    text += &sections([("Hysteresis", below(&zones, &units))]);

    let result = Record::default()
        .hidden("machine", stated_machine(machine))
        .and(Record::of(&plans(), &(machine, plan)))
        .hidden("sweeps", sweeps)
        .hidden("hysteresis", zones);
    (result, text)
}
