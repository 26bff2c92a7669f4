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
use crate::optimize::study::{DesignWithoutTolerances, ToleranceStudy};
use crate::page::capital;
use crate::robust::{Manifold, Nearest, SobolIndex};

/// The machines within the tolerances of a design.
#[derive(Debug, Serialize)]
pub(crate) struct ToleranceReport {
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

fn machines<'a>() -> [Column<(&'a ToleranceStudy, &'a Design)>; 6] {
    columns! { (&'a ToleranceStudy, &'a Design), (study, design);
        "looked_at" [None] Plain, "machines looked at" => study.verdict.machines;
        "lost" [None] Plain, "machines that lose the motion" => study.verdict.drawing.lost;
        "nominal" [Velocity] Six, "before-impact velocity of the design" => design.before_impact_velocity();
        "worst" [Velocity] Six, "least within the tolerances" => study.slowest(None);
        "factor" [None] Six, "factor by which all tolerances may grow" => study.factor(None);
        "normal_distance" [None] Six, "normal distance in units of the tolerances" => study.normal_distance;
    }
}

/// Of machines with normal tolerances.
fn counted<'a>() -> [Column<(&'a ToleranceStudy, &'a Problem)>; 6] {
    columns! { (&'a ToleranceStudy, &'a Problem), (study, problem);
        "rejected" [None] Plain, "machines that lose the motion or violate a requirement" => study.verdict.rejected;
        "share_rejected" [None] Six, "their share" => study.verdict.rejected_share();
        "interval_low" [None] Six, "lower end of its 95 % interval" => study.verdict.share_rejected()[0];
        "interval_high" [None] Six, "upper end" => study.verdict.share_rejected()[1];
        "share_allowed" [None] Six, "share that may" => problem.violating;
        "deviations" [None] Six, "standard deviations of normal tolerances within which none does" => problem.deviations;
    }
}

fn manifolds() -> [Column<Nearest>; 2] {
    columns! { Nearest, it;
        "manifold" [None] Plain, "what is lost there" => match &it.manifold {
            Manifold::Hysteresis => "g0: the motion without impacts strikes".to_owned(),
            Manifold::Motion(loss) => lost_by(loss),
        };
        "factor" [None] Six, "factor by which all tolerances may grow" => it.distance;
    }
}

/// A tolerance of a design's machine, and what it does.
struct ToleranceEffect<'a> {
    machine: &'a Machine,
    parameter: Parameter,
    /// In the machine's own units.
    half_width: Option<f64>,
    /// Change of the velocity, in m/s, and of the margins to `s_SN` and g0, in rad/s, at its upper end.
    velocity: f64,
    to_fold: Option<f64>,
    to_free: Option<f64>,
    /// Sobol indices of the velocity and of the place in the zone.
    indices: Option<[SobolIndex; 2]>,
}

impl<'a> ToleranceEffect<'a> {
    /// What each tolerance of a study does, about a design of the problem with tolerances as they are stated.
    fn all(built: &Problem, machine: &'a Machine, study: &ToleranceStudy) -> Vec<Self> {
        let effects = &study.sensitivities;
        let own = |by: f64| machine.to_own(Dimension::Frequency, by);
        let tolerances = study.tolerances.iter().enumerate();
        let effect = tolerances.map(|(index, it)| Self {
            machine,
            parameter: it.parameter,
            half_width: built.half_width(machine, it.parameter),
            velocity: effects.velocity[index],
            to_fold: effects.to_fold.as_ref().map(|by| own(by[index])),
            to_free: effects.to_free.as_ref().map(|by| own(by[index])),
            indices: study
                .scatter
                .as_ref()
                .map(|all| [all.velocity[index], all.place[index]]),
        });
        effect.collect()
    }
}

fn parameters<'a>() -> [Column<ToleranceEffect<'a>>; 11] {
    columns! { ToleranceEffect<'a>, it;
        "parameter" [None] Plain, "which" => it.machine.name(it.parameter);
        "meaning" [None], "what it is" => it.machine.meaning_of(it.parameter).0;
        "unit" [None], "unit of value and tolerance" => it.machine.unit_of(it.parameter);
        "value" [None], "its value" => it.machine.value(it.parameter);
        "tolerance" [None] Seven, "half-width" => it.half_width;
        "velocity" [Velocity] Seven, "change of the velocity at its upper end" => it.velocity;
        "to_fold" [Frequency] Seven, "of the margin to s_SN" => it.to_fold;
        "to_g0" [Frequency] Seven, "of the margin to g0" => it.to_free;
        "first_index" [None] Fixed(4), "Sobol index of the velocity" => it.indices.map(|all| all[0].first.value);
        "total_index" [None] Fixed(4), "with all others" => it.indices.map(|all| all[0].total.value);
        "margin_index" [None] Fixed(4), "of the place in the zone, with all others; g0 and s_SN as fitted polynomials" => it.indices.map(|all| all[1].total.value);
    }
}

fn withouts() -> [Column<DesignWithoutTolerances>; 4] {
    columns! { DesignWithoutTolerances, it;
        "velocity" [None] Six, "before-impact velocity" => it.design.before_impact_velocity();
        "machines" [None] Six, "machines within the tolerances" => it.verdict.machines;
        "lost" [None] Six, "that lose the motion" => it.verdict.drawing.lost;
        "slowest" [None] Six, "least velocity seen of the others" => it.slowest;
    }
}

/// What the tolerances cost: what is sought, and the velocity in the worst machine, of the best design without them and of the
/// one with them.
fn price(
    problem: &Problem,
    design: &Design,
    study: &ToleranceStudy,
    without: &DesignWithoutTolerances,
) -> String {
    let machine = &design.machine;
    let unit = machine.unit(Dimension::Velocity);
    let own = |velocity| Six.format(machine.to_own(Dimension::Velocity, velocity));
    let slowest = own(without.slowest);
    let worst = match without.verdict.drawing.lost {
        0 => format!("{slowest} worst"),
        lost => format!(
            "where {lost} of {} machines lose the motion ({slowest} the least seen of the others)",
            without.verdict.machines
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
        own(study.slowest(None)),
    );
    told.replace("  ", " ") + "."
}

impl ToleranceReport {
    /// Those of a study.
    pub(crate) fn of(problem: &Problem, design: &Design, study: &ToleranceStudy) -> Self {
        let built = problem.as_built();
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
            manifolds: Record::all(&manifolds(), &study.nearest[0]),
            parameters: Record::all(
                &parameters(),
                &ToleranceEffect::all(&built, &design.machine, study),
            ),
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
