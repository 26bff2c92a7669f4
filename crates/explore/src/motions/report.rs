//! What `softstop motions` reports.

use serde_json::json;
use softstop::{Dimension, Machine};
use softstop_dynamics::attractors::{Attractor, Chaos, OrbitResiduals, SearchOptions};
use softstop_dynamics::{LyapunovExponents, MotionKind, Orbit, Survey};

use softstop_console::arguments::title;
use softstop_console::column::{Column, Told, Unit, Units};
use softstop_console::columns;
use softstop_console::record::Record;
use softstop_console::report::{MotionName, multipliers, stated_machine};
use softstop_console::table::heading;

/// All motions of a machine, that with the largest share of starts first, and where they were looked for; and the text of it.
pub(super) fn report(
    machine: &Machine,
    options: &SearchOptions,
    survey: &Survey,
) -> (Record, String) {
    let Survey {
        region,
        starts,
        periods,
        ..
    } = survey;
    let units = Units::of(machine);
    let mut text = heading(&format!("All motions of {}", title(machine)));
    let mut motions = Vec::new();
    for attractor in &survey.attractors {
        let (name, figures) = (MotionName::of(&attractor.motion), figures(attractor));
        let order = name.order.iter();
        let order: String = order
            .map(|order| format!(", order of impacts {order}"))
            .collect();
        let share = 100.0 * attractor.share;
        text += &format!("\n{}{order} ({share:.1} % of starts)\n", name.text);
        text += &figures.text(&units);
        let found = Record::default().hidden("share", attractor.share);
        let found = found.hidden("starts", attractor.starts);
        motions.push(found.and(name.figures()).and(figures));
    }
    let range = |name: &str, [low, high]: [f64; 2], dimension| {
        let sign = units.name(Unit::Own(dimension));
        let told = format!("{low:.4} <= {name} <= {high:.4} {sign}");
        told.trim_end().to_owned()
    };
    text += &format!(
        "\n{starts} starts with {} and {}; {periods} drive periods computed.\n",
        range("x", region.position, Dimension::Length),
        range("x'", region.velocity, Dimension::Velocity),
    );
    let lost = survey.lost.as_ref();
    let mut result = Record::default()
        .hidden("machine", stated_machine(machine))
        .hidden("motions", motions)
        .hidden("starts", *starts)
        .hidden("lost", lost.map_or(0, |(count, _)| *count));
    if let Some((count, reason)) = lost {
        text += &format!("{count} starts were lost: {reason}\n");
        result = result.hidden("reason", reason.to_string());
    }
    let result = result
        .hidden("region_position", region.position)
        .hidden("region_velocity", region.velocity)
        .hidden("seed", options.seed)
        .hidden("periods_computed", *periods);
    (result, text)
}

/// What is told of a motion, by its kind.
fn figures(attractor: &Attractor) -> Record {
    let mut figures = Record::default();
    if let (Some(orbit), Some(residuals)) = (&attractor.orbit, &attractor.residuals) {
        figures = figures.and(Record::of(&periodic(), &(orbit, residuals)));
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

type Periodic<'a> = (&'a Orbit, &'a OrbitResiduals);

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
        "multipliers" [None] Plain, "multipliers" => multipliers(it.0.monodromy.multipliers());
        "exponents" [None] Plain, "Lyapunov exponents" => both(&LyapunovExponents::of(it.0));
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
        "dimension" [None] Fixed(3), "Kaplan-Yorke dimension of its states at drive angle phi" => it.exponents.kaplan_yorke_dimension();
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

fn unsettled<'a>() -> [Column<(&'a Attractor, &'a LyapunovExponents)>; 3] {
    columns! { (&'a Attractor, &'a LyapunovExponents), it;
        "position" [Length], "position at drive angle phi" => it.0.state.position;
        "velocity" [Velocity], "velocity there" => it.0.state.velocity;
        "exponents" [None] Plain, "Lyapunov exponent" => larger(it.1);
    }
}

/// Exponents with the words for all of them.
fn both(exponents: &LyapunovExponents) -> Told {
    let [first, second] = exponents.per_period.map(|it| match it.is_finite() {
        true => format!("{it:.6}"),
        false => "-infinity".to_owned(),
    });
    format_exponents(exponents, format!("{first}, {second} per drive period"))
}

/// Exponents with the words for the larger one.
fn larger(exponents: &LyapunovExponents) -> Told {
    let ([period, _], [second, _]) = (exponents.per_period, exponents.per_second());
    let error = exponents.error;
    let words = format!("{period:.4} +- {error:.4} per drive period, {second:.5} per unit of time");
    format_exponents(exponents, words)
}

fn format_exponents(exponents: &LyapunovExponents, words: String) -> Told {
    Told {
        value: json!({
            "per_period": exponents.per_period,
            "per_second": exponents.per_second(),
            "error": exponents.error,
        }),
        words,
    }
}
