//! The report of `optimize`: one struct, which text, JSON, CSV and the page are written from.

use std::collections::BTreeMap;

use serde::Serialize;
use softstop::Machine;
use softstop_console::column::{Column, Units};
use softstop_console::columns;
use softstop_console::interrupt;
use softstop_console::record::{Record, below};
use softstop_console::report::{motion, stated};
use softstop_console::sheet::Sheet;
use softstop_console::table::{heading, sections};
use softstop_dynamics::Orbit;
use softstop_dynamics::zone::{StableRange, stable_ranges_with_monitor};

use crate::comparison::comparison;
use crate::design::problem::Objective;
use crate::design::{Design, Problem};
use crate::limits::{NamedLimit, at_limits};
use crate::optimize::outcome::Outcome;
use crate::optimize::reference::Reference;
use crate::optimize::study::ToleranceStudy;
use crate::optimize::title::{Source, Title};
use crate::page::figure::Figure;
use crate::pareto::FrontReport;
use crate::searched::SearchReport;
use crate::tolerated::ToleranceReport;
use crate::{cases, placed, started, verdict};

/// What `softstop optimize` reports and writes.
#[derive(Debug, Serialize)]
pub struct OptimizeReport {
    /// What its user has put above it.
    #[serde(rename = "report", skip_serializing_if = "Title::is_empty")]
    pub title: Title,
    /// What is sought, and its value.
    objective: Record,
    /// Its machine and motion, with its place in its zone and the limits that hold it back.
    design: Record,
    /// The motions beside it, the paper's points A and B or the machine as it was given, with the gain in velocity.
    reference: BTreeMap<&'static str, Record>,
    /// All of them side by side, a record for each quantity.
    comparison: Vec<Record>,
    /// What holds the design back.
    limits: Vec<NamedLimit>,
    /// Keys of what was searched and changes nothing of what is sought and required of the motion.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    without_effect: Vec<&'static str>,
    /// What its user should know before it is built, and of this report.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// What was required, and what the design has of it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    requirements: Vec<Record>,
    /// The design in the drawing's operating point and in each case, if there are any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    cases: Vec<Record>,
    /// Designs far from this one in the box and nearly as good.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    rivals: Vec<Record>,
    /// What more of one good costs of another.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    fronts: Vec<Record>,
    /// The designs among which one can choose, if more than one thing is sought.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) pareto: Option<FrontReport>,
    /// Its machines within the tolerances.
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerances: Option<ToleranceReport>,
    /// Ways to run the machine up.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    run_up: Vec<Record>,
    /// What is proven of its motion, if that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proof: Option<Record>,
    /// Stretches of stable z = 1 of the same machine outside its zone: the search leaves them out.
    left_out: Vec<Record>,
    search: SearchReport,
    /// The design's machine.
    #[serde(skip)]
    pub machine: Machine,
    /// What the design is, in a line.
    #[serde(skip)]
    heading: String,
    /// Where it stands, in sentences.
    #[serde(skip)]
    stands: String,
    /// The picture of the velocity over the drive's frequency.
    #[serde(skip)]
    pub response: Option<Figure>,
    /// That of the designs among which one can choose.
    #[serde(skip)]
    pub front: Option<Figure>,
    /// The other pictures, if there is a page.
    #[serde(skip)]
    pub figures: Vec<Figure>,
    /// The texts that state the task.
    #[serde(skip)]
    pub sources: Vec<Source>,
}

impl OptimizeReport {
    /// The report on the solution of this problem, searched with so many zones at most; without title and pictures.
    pub fn new(
        problem: &Problem,
        outcome: &Outcome,
        references: &[Reference],
        study: Option<&ToleranceStudy>,
        evaluations: u64,
    ) -> Self {
        let solution = &outcome.solution;
        let found = &solution.found;
        let design = &found.design;
        let machine = &design.machine;
        let limits = at_limits(problem, found);
        let one = |machine: &Machine, orbit: &Orbit| stated(machine).and(motion(machine, orbit));
        let reference =
            |it: &Reference| (it.name, one(&it.machine, &it.orbit).and(gain(design, it)));
        let place = Record::of(&placed::columns(), &(problem, design, &limits));
        let mut met = outcome.met.clone();
        if let Some(study) = study {
            study.note_violating(problem, &mut met);
        }
        let met = met.iter();
        let met = met.map(|it| verdict::required(problem, machine, it));
        let rivals = found.rivals.iter().map(|it| verdict::rival(problem, it));
        let fronts = solution
            .fronts
            .iter()
            .map(|it| verdict::traded(problem, it));
        let idle = outcome.without_effect.iter();
        let idle = idle.map(|it| machine.name(*it));
        let ways = outcome.run_up.iter();
        let ways = ways.flat_map(|all| all.ways.iter().map(move |it| (machine, all, it)));
        let ways = ways.map(|it| Record::of(&started::columns(), &it));
        Self {
            title: Title::default(),
            objective: Record::of(&objective(), &(problem, design)),
            design: one(machine, &design.orbit).and(place),
            reference: references.iter().map(reference).collect(),
            comparison: comparison(problem, design, references),
            limits,
            without_effect: idle.collect(),
            warnings: [placed::warning(design), placed::inner_fold_warning(design)]
                .into_iter()
                .flatten()
                .collect(),
            requirements: met.collect(),
            cases: cases::records(problem, design, study),
            rivals: rivals.collect(),
            fronts: fronts.collect(),
            pareto: solution
                .pareto
                .as_ref()
                .map(|it| FrontReport::new(problem, it)),
            tolerances: study.map(|it| ToleranceReport::of(problem, design, it)),
            run_up: ways.collect(),
            proof: None,
            left_out: left_out(design),
            search: SearchReport::new(problem, evaluations, outcome),
            machine: machine.clone(),
            heading: head(problem),
            stands: placed::sentences(design),
            response: None,
            front: None,
            figures: Vec::new(),
            sources: Vec::new(),
        }
    }

    /// The pictures of the page.
    pub(crate) fn pictures(&self) -> impl Iterator<Item = &Figure> + Clone {
        let others = self.figures.iter();
        others.chain(&self.front).chain(&self.response)
    }

    /// The tables of the report and of its pictures.
    pub fn sheets(&self) -> Vec<Sheet> {
        let tolerances = self.tolerances.as_ref();
        let parameters = tolerances.map_or(&[][..], |it| &it.parameters);
        let tables = [
            Sheet::of_records("comparison", &self.comparison),
            Sheet::of_records("requirements", &self.requirements),
            Sheet::of_records("sensitivities", parameters),
        ];
        let cases = Sheet::of_records("cases", &self.cases);
        let cases = (!self.cases.is_empty()).then_some(cases);
        let figures = self.pictures().flat_map(|it| it.sheets.clone());
        tables.into_iter().chain(cases).chain(figures).collect()
    }

    /// Where the design stands, and what holds it back.
    fn stands(&self) -> String {
        let mut text = format!("\n{}", self.stands);
        for warning in &self.warnings {
            text += &format!("Warning: {warning}.\n");
        }
        if !self.limits.is_empty() {
            let limits: Vec<&str> = self.limits.iter().map(|it| it.words.as_str()).collect();
            text += &format!("Held back by: {}.\n", limits.join("; "));
        }
        if !self.without_effect.is_empty() {
            let all = self.without_effect.join(", ");
            text +=
                &format!("Without effect on what is sought and required of the motion: {all}.\n");
        }
        text
    }

    /// What people read.
    pub fn text(&self) -> String {
        let units = Units::of(&self.machine);
        let tolerances = self.tolerances.as_ref().map(|it| it.text(&units));
        let proof = self.proof.as_ref();
        let proof = proof.map_or_else(String::new, |it| it.text(&units));
        let tables = sections([
            ("Proven by interval arithmetic", proof),
            ("What was required", below(&self.requirements, &units)),
            ("In each case", below(&self.cases, &units)),
            ("How to run the machine up", below(&self.run_up, &units)),
            (
                "Nearly as good, but far from it: a small change of the task may lead there",
                below(&self.rivals, &units),
            ),
            (
                "Other ranges of stable z = 1, which are no part of the design's zone",
                below(&self.left_out, &units),
            ),
        ]);
        let mut text = self.search.text() + &heading(&self.heading);
        text += &below(&self.comparison, &units);
        let front = self.pareto.as_ref().map(FrontReport::text);
        text += &self.stands();
        text += &front.unwrap_or_default();
        text + &tables + &tolerances.unwrap_or_default()
    }
}

/// What was sought of which machine.
fn head(problem: &Problem) -> String {
    let name = problem
        .machine
        .name
        .as_deref()
        .unwrap_or("the given machine");
    let what = match problem.objective == Objective::default() {
        true => format!("Hardest impact{}", problem.over_cases()),
        false => problem.words(),
    };
    let margin = match problem.margin {
        0.0 => String::new(),
        margin => format!(", margin M = {margin} from both ends of the zone"),
    };
    crate::page::capital(&format!("{what}: {name}{margin}"))
}

type Sought<'a> = (&'a Problem, &'a Design);

fn objective<'a>() -> [Column<Sought<'a>>; 5] {
    columns! { Sought<'a>, (problem, design);
        "figure" [None], "what is sought" => problem.objective.figure.name();
        "meaning" [None], "what it is" => problem.objective.figure.meaning();
        "words" [None], "what is sought of it" => problem.words();
        "value" [None], "what the design has" => problem.machine.to_own(problem.objective.figure.dimension(), problem.sought_of(design));
        "unit" [None], "its unit" => problem.machine.unit(problem.objective.figure.dimension());
    }
}

/// The stretches of the design's machine that are no part of its zone.
fn left_out(design: &Design) -> Vec<Record> {
    let all =
        stable_ranges_with_monitor(&design.machine.scene, &interrupt::watch).unwrap_or_default();
    let others = all.iter().filter(|one| !one.is_part_of(&design.zone));
    others
        .map(|one| Record::of(&stretch(), &(design, one)))
        .collect()
}

fn stretch<'a>() -> [Column<(&'a Design, &'a StableRange)>; 3] {
    columns! { (&'a Design, &'a StableRange), (design, range);
        "from" [Frequency] Six, "lower end" => design.own_frequency(range.low.frequency);
        "to" [Frequency] Six, "upper end" => design.own_frequency(range.high.frequency);
        "hardest" [Velocity] Six, "highest before-impact velocity" => range.hardest.before_impact_velocity();
    }
}

/// Before-impact velocity of the design over that of a reference.
fn gain(design: &Design, reference: &Reference) -> Record {
    let gain = design.before_impact_velocity() / reference.orbit.before_impact_velocity();
    Record::default().with("gain", "velocity, design over this one", gain)
}
