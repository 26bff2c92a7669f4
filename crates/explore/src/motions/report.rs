//! What `softstop motions` reports.

use serde::Serialize;
use serde_json::json;
use softstop::{Dimension, Machine};
use softstop_dynamics::attractors::{Attractor, Certainty, Chaos, SearchOptions};
use softstop_dynamics::{Exponents, MotionKind, Orbit, Survey};

use softstop_console::arguments::title;
use softstop_console::column::{Column, Told, Unit, Units};
use softstop_console::columns;
use softstop_console::export::Report;
use softstop_console::record::Record;
use softstop_console::report::{MachineReport, MotionName, multipliers};
use softstop_console::table::heading;

/// All motions of a machine.
#[derive(Debug, Serialize)]
pub(super) struct MotionsReport {
    machine: MachineReport,
    /// The motions, that with the largest share of starts first.
    motions: Vec<SettledReport>,
    /// Starts that the shares count.
    starts: usize,
    /// Starts whose motion could not be carried on.
    lost: usize,
    /// Why not the first of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    /// Least and largest position of the starts.
    region_position: [f64; 2],
    /// Least and largest velocity of the starts.
    region_velocity: [f64; 2],
    seed: u64,
    /// Drive periods computed.
    periods_computed: u64,
    #[serde(skip)]
    title: String,
    #[serde(skip)]
    units: Units,
}

/// One motion.
#[derive(Debug, Serialize)]
struct SettledReport {
    /// Share of the starts that were on it in the end.
    share: f64,
    /// How many that were.
    starts: usize,
    #[serde(flatten)]
    name: MotionName,
    #[serde(flatten)]
    figures: Record,
}

impl MotionsReport {
    pub(super) fn new(machine: &Machine, options: &SearchOptions, survey: &Survey) -> Self {
        let lost = survey.lost.as_ref();
        let motions = survey.attractors.iter().map(|attractor| SettledReport {
            share: attractor.share,
            starts: attractor.starts,
            name: MotionName::of(&attractor.motion),
            figures: figures(attractor),
        });
        Self {
            machine: MachineReport::of(machine),
            motions: motions.collect(),
            starts: survey.starts,
            lost: lost.map_or(0, |(count, _)| *count),
            reason: lost.map(|(_, error)| error.to_string()),
            region_position: survey.region.position,
            region_velocity: survey.region.velocity,
            seed: options.seed,
            periods_computed: survey.periods,
            title: title(machine),
            units: Units::of(machine),
        }
    }
}

impl Report for MotionsReport {
    /// One motion after the other, then where they were looked for.
    fn text(&self) -> String {
        let mut text = heading(&format!("All motions of {}", self.title));
        for motion in &self.motions {
            let (name, share) = (&motion.name.text, 100.0 * motion.share);
            let order = motion.name.order.as_ref();
            let order =
                order.map_or_else(String::new, |order| format!(", order of impacts {order}"));
            text += &format!("\n{name}{order} ({share:.1} % of starts)\n");
            text += &motion.figures.text(&self.units);
        }
        let range = |name: &str, [low, high]: [f64; 2], dimension| {
            let sign = self.units.name(Unit::Own(dimension));
            let told = format!("{low:.4} <= {name} <= {high:.4} {sign}");
            told.trim_end().to_owned()
        };
        text += &format!(
            "\n{} starts with {} and {}; {} drive periods computed.\n",
            self.starts,
            range("x", self.region_position, Dimension::Length),
            range("x'", self.region_velocity, Dimension::Velocity),
            self.periods_computed
        );
        if let Some(reason) = &self.reason {
            text += &format!("{} starts were lost: {reason}\n", self.lost);
        }
        text
    }
}

/// What is told of a motion, by its kind.
fn figures(attractor: &Attractor) -> Record {
    let mut figures = Record::default();
    if let (Some(orbit), Some(certainty)) = (&attractor.orbit, &attractor.certainty) {
        figures = figures.and(Record::of(&periodic(), &(orbit, certainty)));
    }
    if let Some(chaos) = &attractor.chaos {
        figures = figures.and(Record::of(&chaotic(), chaos));
        if chaos.lifetime.is_some() {
            figures = figures.and(Record::of(&transient(), chaos));
        }
    }
    if let Some(positions) = attractor.positions {
        let resting: [Column<[f64; 2]>; 1] = columns! { [f64; 2], it;
            "positions" [Length] Fixed(6), "held at, least and largest" => *it;
        };
        figures = figures.and(Record::of(&resting, &positions));
    }
    if attractor.motion == MotionKind::Unsettled
        && let Some(exponents) = &attractor.exponents
    {
        figures = figures.and(Record::of(&unsettled(), &(attractor, exponents)));
    }
    figures
}

type Periodic<'a> = (&'a Orbit, &'a Certainty);

fn periodic<'a>() -> [Column<Periodic<'a>>; 12] {
    columns! { Periodic<'a>, it;
        "impacts" [None], "p; of complete chatter those before the summed ones" => it.0.regime().impacts;
        "periods" [None], "drive periods n" => it.0.regime().periods;
        "chatter" [None], "true for complete chatter" => it.0.chatters();
        "before_impact_velocities" [Velocity] Fixed(6), "before impact" => velocities(it.0);
        "impact_angles" [Angle], "drive angles of the impacts" => it.0.impact_angles().collect::<Vec<_>>();
        "position" [Length] Fixed(9), "position at drive angle phi" => it.0.position;
        "velocity" [Velocity] Fixed(9), "velocity there" => it.0.velocity;
        "max_position" [Length] Fixed(6), "largest position" => it.0.max_position;
        "multipliers" [None] Plain, "multipliers" => multipliers(it.0.multipliers());
        "exponents" [None] Plain, "Lyapunov exponents" => both(&Exponents::of(it.0));
        "returned" [None] Power(1), "returns to within, when met" => it.1.returned;
        "residual" [None] Power(1), "and when polished" => it.1.residual;
    }
}

fn velocities(orbit: &Orbit) -> Vec<f64> {
    orbit.before_impact_velocities().collect()
}

fn chaotic() -> [Column<Chaos>; 8] {
    columns! { Chaos, it;
        "exponents" [None] Plain, "Lyapunov exponent" => larger(&it.exponents);
        "dimension" [None] Fixed(3), "Kaplan-Yorke dimension of its states at drive angle phi" => it.exponents.dimension();
        "impacts_per_period" [None] Fixed(3), "impacts per drive period" => it.impacts_per_period;
        "least_before_impact_velocity" [Velocity] Fixed(4), "before impact, least" => it.velocities.map(|it| it[0]);
        "before_impact_velocity" [Velocity] Fixed(4), "and largest" => it.velocities.map(|it| it[1]);
        "position" [Length], "position at drive angle phi of a state on it" => it.state.position;
        "velocity" [Velocity], "velocity there" => it.state.velocity;
        "watched" [None] Plain, "drive periods watched; a third of them bounds the lifetime (95 %)" => it.watched;
    }
}

fn transient() -> [Column<Chaos>; 2] {
    columns! { Chaos, it;
        "lifetime" [None] Fixed(0), "lifetime in drive periods, on average" => it.lifetime;
        "entered" [None] Plain, "starts that came here first" => it.entered;
    }
}

fn unsettled<'a>() -> [Column<(&'a Attractor, &'a Exponents)>; 3] {
    columns! { (&'a Attractor, &'a Exponents), it;
        "position" [Length], "position at drive angle phi" => it.0.state.position;
        "velocity" [Velocity], "velocity there" => it.0.state.velocity;
        "exponents" [None] Plain, "Lyapunov exponent" => larger(it.1);
    }
}

/// Exponents with the words for all of them.
fn both(exponents: &Exponents) -> Told {
    let [first, second] = exponents.per_period.map(|it| match it.is_finite() {
        true => format!("{it:.6}"),
        false => "-infinity".to_owned(),
    });
    format_exponents(exponents, format!("{first}, {second} per drive period"))
}

/// Exponents with the words for the larger one.
fn larger(exponents: &Exponents) -> Told {
    let ([period, _], [second, _]) = (exponents.per_period, exponents.per_second());
    let error = exponents.error;
    let words = format!("{period:.4} +- {error:.4} per drive period, {second:.5} per unit of time");
    format_exponents(exponents, words)
}

fn format_exponents(exponents: &Exponents, words: String) -> Told {
    Told {
        value: json!({
            "per_period": exponents.per_period,
            "per_second": exponents.per_second(),
            "error": exponents.error,
        }),
        words,
    }
}
