//! What the tolerances do to a design, as records.

use serde::Serialize;
use softstop::{Dimension, Machine, Parameter};
use softstop_console::column::{Column, Units};
use softstop_console::columns;
use softstop_console::number::NumberStyle::Six;
use softstop_console::record::{Record, below};
use softstop_console::table::sections;

use softstop_explore::zone::lost_by;

use crate::design::figure::Figure;
use crate::design::{Design, Problem};
use crate::optimize::study::{Study, Without};
use crate::page::capital;
use crate::robust::{Index, Manifold, Nearest};

/// The machines within the tolerances of a design.
#[derive(Debug, Serialize)]
pub(crate) struct Tolerated {
    /// All of them.
    machines: Record,
    /// Where the motion is lost as all tolerances grow, the nearest first.
    manifolds: Vec<Record>,
    /// What each tolerance does.
    pub(crate) parameters: Vec<Record>,
    /// The best design without tolerances.
    #[serde(skip_serializing_if = "Option::is_none")]
    without: Option<Record>,
    /// What keeping them costs, in a sentence.
    #[serde(skip_serializing_if = "Option::is_none")]
    price: Option<String>,
}

type Studied<'a> = (&'a Study, &'a Design);

fn machines<'a>() -> [Column<Studied<'a>>; 6] {
    columns! { Studied<'a>, it;
        "looked_at" [None] Plain, "machines looked at" => it.0.verdict.machines;
        "lost" [None] Plain, "machines that lose the motion" => it.0.verdict.drawing.lost;
        "nominal" [Velocity] Six, "before-impact velocity of the design" => it.1.before_impact_velocity();
        "worst" [Velocity] Six, "least within the tolerances" => it.0.slowest;
        "factor" [None] Six, "factor by which all tolerances may grow" => it.0.factor(None);
        "normal_distance" [None] Six, "normal distance in units of the tolerances" => it.0.normal_distance;
    }
}

type Counted<'a> = (&'a Study, &'a Problem);

/// Of machines with normal tolerances.
fn counted<'a>() -> [Column<Counted<'a>>; 6] {
    columns! { Counted<'a>, it;
        "rejected" [None] Plain, "machines that lose the motion or violate a requirement" => it.0.verdict.rejected;
        "share_rejected" [None] Six, "their share" => it.0.verdict.rejected_share();
        "interval_low" [None] Six, "lower end of its 95 % interval" => it.0.verdict.share_rejected()[0];
        "interval_high" [None] Six, "upper end" => it.0.verdict.share_rejected()[1];
        "share_allowed" [None] Six, "share that may" => it.1.violating;
        "deviations" [None] Six, "standard deviations of normal tolerances within which none does" => it.1.deviations;
    }
}

fn manifolds<'a>() -> [Column<&'a Nearest>; 2] {
    columns! { &'a Nearest, it;
        "manifold" [None] Plain, "what is lost there" => match &it.manifold {
            Manifold::Hysteresis => "g0: the motion without impacts strikes".to_owned(),
            Manifold::Motion(loss) => lost_by(loss),
        };
        "factor" [None] Six, "factor by which all tolerances may grow" => it.distance;
    }
}

type One<'a> = (&'a Machine, &'a Study, usize, &'a Problem);

fn parameters<'a>() -> [Column<One<'a>>; 11] {
    columns! { One<'a>, it;
        "parameter" [None] Plain, "which" => it.0.name(parameter(it));
        "meaning" [None], "what it is" => it.0.meaning_of(parameter(it)).0;
        "unit" [None], "unit of value and tolerance" => it.0.unit_of(parameter(it));
        "value" [None], "its value" => it.0.value(parameter(it));
        "tolerance" [None] Seven, "half-width" => it.3.half_width(it.0, parameter(it));
        "velocity" [Velocity] Seven, "change of the velocity at its upper end" => it.1.sensitivities.velocity[it.2];
        "to_fold" [Frequency] Seven, "of the margin to s_SN" => margin(it, it.1.sensitivities.to_fold.as_ref());
        "to_g0" [Frequency] Seven, "of the margin to g0" => margin(it, it.1.sensitivities.to_free.as_ref());
        "first_index" [None] Fixed(4), "Sobol index of the velocity" => indices(it).map(|all| all[0].first.value);
        "total_index" [None] Fixed(4), "with all others" => indices(it).map(|all| all[0].total.value);
        "margin_index" [None] Fixed(4), "of the place in the zone, with all others; g0 and s_SN as fitted polynomials" => indices(it).map(|all| all[1].total.value);
    }
}

fn parameter((_, study, index, _): &One<'_>) -> Parameter {
    study.tolerances[*index].parameter
}

/// Sobol indices of the velocity and of the place in the zone.
fn indices((_, study, index, _): &One<'_>) -> Option<[Index; 2]> {
    let all = study.scatter.as_ref()?;
    Some([all.velocity[*index], all.place[*index]])
}

/// The change of a margin in the machine's own units.
fn margin((machine, _, index, _): &One<'_>, all: Option<&Vec<f64>>) -> Option<f64> {
    Some(machine.to_own(Dimension::Frequency, all?[*index]))
}

fn withouts() -> [Column<Without>; 4] {
    columns! { Without, it;
        "velocity" [None] Six, "before-impact velocity" => it.design.before_impact_velocity();
        "machines" [None] Six, "machines within the tolerances" => it.machines;
        "lost" [None] Six, "that lose the motion" => it.lost;
        "slowest" [None] Six, "least velocity seen of the others" => it.slowest;
    }
}

/// What the tolerances cost: what is sought, and the velocity in the worst machine, of the best design without them and of the
/// one with them.
fn price(problem: &Problem, design: &Design, study: &Study, without: &Without) -> String {
    let machine = &design.machine;
    let unit = machine.unit(Dimension::Velocity);
    let own = |velocity| Six.format(machine.to_own(Dimension::Velocity, velocity));
    let slowest = own(without.slowest);
    let worst = match without.lost {
        0 => format!("{slowest} worst"),
        lost => format!(
            "where {lost} of {} machines lose the motion ({slowest} the least seen of the others)",
            without.machines
        ),
    };
    let figure = problem.objective.figure;
    let sought = [&without.design, design]
        .map(|design| problem.nominal_of(figure, design))
        .map(|value| value.map(|it| machine.to_own(figure.dimension(), it)));
    let sought = match sought {
        [Some(without), Some(robust)]
            if figure != Figure::Velocity || !problem.over_cases().is_empty() =>
        {
            format!(
                "{}{}: without tolerances {} {unit}, robust design {} {unit}. ",
                capital(figure.meaning()),
                problem.over_cases(),
                Six.format(without),
                Six.format(robust),
                unit = machine.unit(figure.dimension()),
            )
        }
        _ => String::new(),
    };
    let told = format!(
        "{sought}Without tolerances {} {unit} nominal, {worst}; robust design {} nominal, {} worst",
        own(without.design.before_impact_velocity()),
        own(design.before_impact_velocity()),
        own(study.slowest),
    );
    told.replace("  ", " ") + "."
}

impl Tolerated {
    /// Those of a study.
    pub(crate) fn of(problem: &Problem, design: &Design, study: &Study) -> Self {
        let built = problem.as_built();
        let all = 0..study.tolerances.len();
        let all = all.map(|index| (&design.machine, study, index, &built));
        let without = study.without.as_ref();
        let rejected = match problem.has_normal_tolerances() {
            true => Record::of(&counted(), &(study, problem)),
            false if problem.cases.is_empty() => Record::default(),
            false => Record::default().with(
                "rejected",
                "machines that lose the motion or violate a requirement in any case",
                study.verdict.rejected,
            ),
        };
        Self {
            machines: Record::of(&machines(), &(study, design)).and(rejected),
            manifolds: study.nearest[0]
                .iter()
                .map(|it| Record::of(&manifolds(), &it))
                .collect(),
            parameters: all.map(|it| Record::of(&parameters(), &it)).collect(),
            without: without.map(|it| Record::of(&withouts(), it)),
            price: without.map(|it| price(problem, design, study, it)),
        }
    }

    /// The text for people.
    pub(crate) fn text(&self, units: &Units) -> String {
        let mut machines = self.machines.text(units);
        if self.machines.number("lost") > 0.0 && self.machines.cell("share_allowed").is_none() {
            machines += "Warning: not all machines within the tolerances keep the motion.\n";
        }
        let without = self.without.as_ref().map(|it| it.text(units));
        let price = self.price.as_ref().map(|price| format!("{price}\n"));
        sections([
            ("Within the tolerances", machines),
            (
                "Where the motion is lost as all tolerances grow",
                below(&self.manifolds, units),
            ),
            ("What each tolerance does", below(&self.parameters, units)),
            (
                "The best design without tolerances, and what becomes of it with them",
                without.unwrap_or_default(),
            ),
        ]) + &price.unwrap_or_default()
    }
}
