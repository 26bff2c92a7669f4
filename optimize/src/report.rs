//! The report of `optimize`: design, references and search.

use std::collections::BTreeMap;

use serde::Serialize;
use softstop::{Dimension, Machine, Parameter};
use softstop_console::column::{Column, Told, Units};
use softstop_console::columns;
use softstop_console::export::Report;
use softstop_console::interrupt;
use softstop_console::number::NumberStyle::Six;
use softstop_console::record::{Record, below, beside};
use softstop_console::report::{Stated, motion, state};
use softstop_console::table::{heading, sections};
use softstop_dynamics::Orbit;
use softstop_dynamics::zone::{Stretch, stretches_watched};

use crate::design::judge::Met;
use crate::design::problem::Objective;
use crate::design::{Design, Problem};
use crate::limits::{Limit, at_limits};
use crate::optimize::outcome::Outcome;
use crate::optimize::reference::Reference;
use crate::optimize::study::Study;
use crate::searched::SearchReport;
use crate::tolerated::Tolerated;
use crate::verdict;

/// A motion and its machine, in the machine's own units.
#[derive(Debug, Serialize)]
struct Found {
    #[serde(flatten)]
    machine: Stated,
    #[serde(flatten)]
    motion: Record,
}

/// What `softstop optimize` reports and writes.
#[derive(Debug, Serialize)]
pub struct OptimizeReport {
    /// With its place in its zone and the limits that hold it back.
    design: Found,
    /// The motions beside it, the paper's points A and B or the machine as it was given, with the gain in velocity.
    reference: BTreeMap<&'static str, Found>,
    /// What was required, and what the design has of it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    requirements: Vec<Record>,
    /// Designs far from this one in the box and nearly as good.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    rivals: Vec<Record>,
    /// What more of one good costs of another.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    fronts: Vec<Record>,
    /// Its machines within the tolerances.
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerances: Option<Tolerated>,
    /// Stretches of stable z = 1 of the same machine outside its zone: the search leaves them out.
    left_out: Vec<Record>,
    search: SearchReport,
    /// The same for people.
    #[serde(skip)]
    text: String,
}

impl OptimizeReport {
    /// The report on the solution of this problem.
    pub fn new(
        problem: &Problem,
        found: &Outcome,
        references: &[Reference],
        search: SearchReport,
        study: Option<&Study>,
    ) -> Self {
        let design = &found.design;
        let tolerances = study.map(|it| Tolerated::of(&design.machine, it));
        let limits = at_limits(problem, found);
        let one = |machine: &Machine, orbit: &Orbit, more: Record| Found {
            machine: Stated::of(machine),
            motion: motion(machine, orbit).and(more),
        };
        let left_out = left_out(design);
        let reference = |it: &Reference| (it.name, one(&it.machine, &it.orbit, gain(design, it)));
        let requirement = |it: &Met| verdict::required(&design.machine, it);
        let requirements: Vec<Record> = found.met.iter().map(requirement).collect();
        let rivals = found.rivals.iter();
        let rivals: Vec<Record> = rivals.map(|it| verdict::rival(problem, it)).collect();
        let units = Units::of(&design.machine);
        let beside = sections([
            ("What was required", below(&requirements, &units)),
            (
                "Nearly as good, but far from it: a small change of the task may lead there",
                below(&rivals, &units),
            ),
            (
                "Other ranges of stable z = 1, left out because they are no part of the zone",
                below(&left_out, &units),
            ),
        ]);
        let tolerated = tolerances.as_ref().map(|it| it.text(&units));
        Self {
            design: one(
                &design.machine,
                &design.orbit,
                Record::of(&place(), &(problem, design, &limits)),
            ),
            reference: references.iter().map(reference).collect(),
            text: search.text()
                + &text(problem, design, references, &limits)
                + &beside
                + &tolerated.unwrap_or_default(),
            tolerances,
            requirements,
            rivals,
            fronts: found
                .fronts
                .iter()
                .map(|it| verdict::traded(problem, it))
                .collect(),
            left_out,
            search,
        }
    }
}

impl Report for OptimizeReport {
    fn text(&self) -> String {
        self.text.clone()
    }
}

type Placed<'a> = (&'a Problem, &'a Design, &'a [Limit]);

fn place<'a>() -> [Column<Placed<'a>>; 5] {
    columns! { Placed<'a>, it;
        "frequency_g0" [Frequency], "lower end of the design's zone" => own(it.1, it.1.zone.frequency_g0);
        "frequency_sn" [Frequency], "its upper end" => own(it.1, it.1.zone.frequency_sn);
        "margin" [None], "least distance M from both ends, as a share of the zone" => it.0.margin;
        "s" [None], "place in the zone, in [M, 1 - M]" => it.1.place;
        "at_limits" [None], "what holds it back" => keys(it.2);
    }
}

fn keys(limits: &[Limit]) -> Told {
    Told {
        value: limits.iter().map(|it| it.key.as_str()).collect(),
        words: String::new(),
    }
}

/// The stretches of the design's machine that are no part of its zone.
fn left_out(design: &Design) -> Vec<Record> {
    let all = stretches_watched(&design.machine.scene, &interrupt::watch).unwrap_or_default();
    let others = all.iter().filter(|one| !one.is_part_of(&design.zone));
    others
        .map(|one| Record::of(&stretch(), &(design, one)))
        .collect()
}

fn stretch<'a>() -> [Column<(&'a Design, &'a Stretch)>; 3] {
    columns! { (&'a Design, &'a Stretch), it;
        "from" [Frequency] Six, "lower end" => own(it.0, it.1.low.frequency);
        "to" [Frequency] Six, "upper end" => own(it.0, it.1.high.frequency);
        "hardest" [Velocity] Six, "highest before-impact velocity" => it.1.hardest.before_impact_velocity();
    }
}

/// Before-impact velocity of the design over that of a reference.
fn gain(design: &Design, reference: &Reference) -> Record {
    let gain = design.before_impact_velocity() / reference.orbit.before_impact_velocity();
    Record::default().with("gain", "velocity, design over this one", gain)
}

fn own(design: &Design, frequency: f64) -> f64 {
    design.machine.to_own(Dimension::Frequency, frequency)
}

/// The design beside its references, then what holds it back.
fn text(
    problem: &Problem,
    design: &Design,
    references: &[Reference],
    at_limits: &[Limit],
) -> String {
    let name = problem.machine.name.as_deref().unwrap_or("given");
    let what = match problem.objective == Objective::default() {
        true => format!("Hardest impact of the {name} machine"),
        false => format!("The {name} machine with the {}", problem.objective.words()),
    };
    let margin = match problem.margin {
        0.0 => String::new(),
        margin => format!(", margin M = {margin} from both ends of the zone"),
    };
    let mut text = heading(&(what + &margin));
    text += &comparison(problem, design, references);
    text += &format!(
        "\nZone of the design: {} from {} (g0) to {} (s_SN); the design stands at {:.1} % of the way.\n",
        design.machine.label_of(Parameter::Frequency),
        Six.format(own(design, design.zone.frequency_g0)),
        Six.format(own(design, design.zone.frequency_sn)),
        100.0 * design.place,
    );
    if !at_limits.is_empty() {
        let limits: Vec<&str> = at_limits.iter().map(|it| it.words.as_str()).collect();
        text += &format!("Held back by: {}.\n", limits.join("; "));
    }
    text
}

fn comparison(problem: &Problem, design: &Design, references: &[Reference]) -> String {
    let searched = problem.axes.iter().map(|axis| axis.parameter);
    let preload = design.machine.value(Parameter::Preload);
    let preload = preload.map(|_| Parameter::Preload);
    let shown = searched.chain(preload).chain([Parameter::Frequency]);
    let shown: Vec<Parameter> = shown.collect();
    let column = |name: String, machine: &Machine, orbit: &Orbit, gain: Record| {
        let head = Record::default().with("name", "", name).and(gain);
        let values = shown.iter().fold(head, |record, it| {
            record.with(it.name(), &design.machine.label_of(*it), machine.value(*it))
        });
        let moduli = orbit.multipliers().map(|it| it.norm());
        let largest = moduli.into_iter().fold(0.0, f64::max);
        let motion = values.and(state(machine, orbit));
        motion.with("largest", "largest multiplier |mu|", largest)
    };
    let none = Record::default().with("gain", "velocity, design over this one", "");
    let own = column("design".to_owned(), &design.machine, &design.orbit, none);
    let others = references.iter().map(|it| {
        let name = match it.machine.name.as_deref() {
            Some(name) if name != it.name => format!("{} ({name})", it.name),
            _ => it.name.to_owned(),
        };
        column(name, &it.machine, &it.orbit, gain(design, it))
    });
    let all: Vec<Record> = [own].into_iter().chain(others).collect();
    beside(&all, &Units::of(&design.machine))
}
