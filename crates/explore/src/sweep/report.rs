//! What a sweep came to.

use serde::Serialize;
use softstop::Machine;
use softstop_console::column::{Column, Unit, Units, text};
use softstop_console::columns;
use softstop_console::export::Report;
use softstop_console::report::{MachineReport, MotionName};
use softstop_console::units;
use softstop_dynamics::motion::MotionKind;
use softstop_dynamics::sweep::{Chain, Coexistence, Direction, Jump, Plan, hysteresis};

use super::steps::clearance;

/// The result.
#[derive(Debug, Serialize)]
pub struct SweepReport {
    /// The machine.
    pub machine: MachineReport,
    /// What was swept.
    pub parameter: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Its least and largest value.
    pub range: [f64; 2],
    /// Number of values.
    pub steps: usize,
    /// Drive periods at each.
    pub periods: u64,
    /// Mean change of the parameter per drive period.
    pub rate_per_period: f64,
    /// A sweep each.
    pub sweeps: Vec<ChainReport>,
    /// Where up and down differ.
    pub hysteresis: Vec<ZoneReport>,
    #[serde(skip)]
    units: Units,
}

/// One sweep.
#[derive(Debug, Serialize)]
pub struct ChainReport {
    /// Clearance of the machine; none if that is swept.
    pub clearance: Option<f64>,
    /// Which way.
    pub direction: &'static str,
    /// Steps done.
    pub steps: usize,
    /// Steps of chaos.
    pub chaotic: usize,
    /// Steps that have not settled.
    pub unsettled: usize,
    /// Why it ended early.
    pub error: Option<String>,
    /// Where it jumps.
    pub jumps: Vec<JumpReport>,
}

/// One jump: between these two values.
#[derive(Debug, Serialize)]
pub struct JumpReport {
    /// Value before.
    pub from: f64,
    /// Value after.
    pub to: f64,
    /// Motion before.
    pub before: MotionName,
    /// Motion after.
    pub after: MotionName,
    /// Largest before-impact velocities before and after.
    pub before_impact_velocities: [f64; 2],
}

/// One range in which up and down differ.
#[derive(Debug, Serialize)]
pub struct ZoneReport {
    /// Clearance of the machine; none if that is swept.
    pub clearance: Option<f64>,
    /// Least value.
    pub from: f64,
    /// Largest value.
    pub to: f64,
    /// Motion on the way up.
    pub up: MotionName,
    /// Motion on the way down.
    pub down: MotionName,
}

impl SweepReport {
    pub(super) fn new(machine: &Machine, plan: &Plan, chains: &[Chain]) -> Self {
        let of_machine = |pair: &[Chain]| match pair {
            [up, down] if up.direction != down.direction => {
                let clearance = clearance(plan, up);
                let zones = hysteresis(up, down);
                zones
                    .iter()
                    .map(|zone| ZoneReport::new(clearance, zone))
                    .collect()
            }
            _ => Vec::new(),
        };
        let goes = |way| chains.iter().any(|chain| chain.direction == way);
        let together = if goes(Direction::Up) && goes(Direction::Down) {
            2
        } else {
            1
        };
        Self {
            machine: MachineReport::of(machine),
            parameter: machine.name(plan.parameter),
            unit: units::of_parameter(machine, plan.parameter),
            range: plan.range.into(),
            steps: plan.steps,
            periods: plan.periods,
            rate_per_period: plan.rate(),
            sweeps: chains
                .iter()
                .map(|chain| ChainReport::new(plan, chain))
                .collect(),
            hysteresis: chains.chunks(together).flat_map(of_machine).collect(),
            units: Units::of(machine),
        }
    }

    /// Decimals that tell one value of the parameter from the next.
    fn digits(&self) -> usize {
        let step = (self.range[1] - self.range[0]).abs() / (self.steps - 1) as f64;
        (1.0 - step.log10()).clamp(6.0, 15.0) as usize
    }
}

impl ChainReport {
    fn new(plan: &Plan, chain: &Chain) -> Self {
        let count = |motion| {
            let steps = chain.steps.iter();
            steps.filter(|step| step.motion == motion).count()
        };
        Self {
            clearance: clearance(plan, chain),
            direction: chain.direction.name(),
            steps: chain.steps.len(),
            chaotic: count(MotionKind::Chaos),
            unsettled: count(MotionKind::Unsettled),
            error: chain.error.as_ref().map(ToString::to_string),
            jumps: chain.jumps().iter().map(JumpReport::new).collect(),
        }
    }
}

impl JumpReport {
    fn new(jump: &Jump) -> Self {
        Self {
            from: jump.from,
            to: jump.to,
            before: name(&jump.before),
            after: name(&jump.after),
            before_impact_velocities: jump.velocities.into(),
        }
    }
}

impl ZoneReport {
    fn new(clearance: Option<f64>, zone: &Coexistence) -> Self {
        Self {
            clearance,
            from: zone.from,
            to: zone.to,
            up: name(&zone.up),
            down: name(&zone.down),
        }
    }
}

/// A motion; people read the order of its impacts, too, where there are several of them.
fn name(motion: &MotionKind) -> MotionName {
    let mut name = MotionName::of(motion);
    if let Some(order) = motion.told_order()
        && motion.regime().is_none_or(|it| it.impacts > 1)
    {
        name.text += &format!(" ({order})");
    }
    name
}

/// Jumps of a sweep that are told; the file holds all.
const MOST: usize = 12;

impl Report for SweepReport {
    fn text(&self) -> String {
        let ([from, to], digits) = (self.range, self.digits());
        let mut text = format!(
            "{} from {from} to {to}: {} values of {} drive periods, {:.3e} per period\n",
            self.units.label(self.parameter, Unit::Of(self.unit)),
            self.steps,
            self.periods,
            self.rate_per_period,
        );
        for sweep in &self.sweeps {
            text += &sweep.text(digits, &self.units);
        }
        if !self.hysteresis.is_empty() {
            text += "\nHysteresis\n";
            text += &self::text(&zones(digits), &self.hysteresis, &self.units);
        }
        text
    }
}

impl ChainReport {
    fn text(&self, digits: usize, units: &Units) -> String {
        let clearance = self.clearance.map(|value| format!("clearance {value}, "));
        let mut text = format!(
            "\n{}{}: {} steps, {} of chaos, {} unsettled\n",
            clearance.unwrap_or_default(),
            self.direction,
            self.steps,
            self.chaotic,
            self.unsettled
        );
        if !self.jumps.is_empty() {
            let told = self.jumps.iter().take(MOST);
            text += &self::text(&jumps(digits), told, units);
        }
        if self.jumps.len() > MOST {
            text += &format!("and {} more\n", self.jumps.len() - MOST);
        }
        if let Some(error) = &self.error {
            text += &format!("ended early: {error}\n");
        }
        text
    }
}

fn jumps(digits: usize) -> [Column<JumpReport>; 6] {
    columns! { JumpReport, jump;
        "jump_from" [None] Fixed(digits), "value before" => jump.from;
        "to" [None] Fixed(digits), "value after" => jump.to;
        "before" [None] Plain, "motion" => jump.before.text.as_str();
        "after" [None] Plain, "motion" => jump.after.text.as_str();
        "impact_before" [Velocity] Fixed(4), "hardest" => jump.before_impact_velocities[0];
        "impact_after" [Velocity] Fixed(4), "hardest" => jump.before_impact_velocities[1];
    }
}

fn zones(digits: usize) -> [Column<ZoneReport>; 5] {
    columns! { ZoneReport, zone;
        "clearance" [Length] Plain, "of the machine" => zone.clearance;
        "from" [None] Fixed(digits), "least value" => zone.from;
        "to" [None] Fixed(digits), "largest value" => zone.to;
        "up" [None] Plain, "motion" => zone.up.text.as_str();
        "down" [None] Plain, "motion" => zone.down.text.as_str();
    }
}
