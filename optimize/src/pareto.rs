//! The designs of a front, as records, a table and text.

use std::collections::BTreeMap;

use serde::Serialize;
use softstop::Parameter;
use softstop_console::number::NumberStyle::Seven;
use softstop_console::record::Record;
use softstop_console::sheet::Sheet;
use softstop_console::table::aligned;

use crate::design::Problem;
use crate::design::figure::{Figure, Sense};
use crate::design::judge::RequirementValue;
use crate::design::pareto::{Alternative, FrontTally, Pareto};
use crate::design::problem::Objective;

/// A quantity of all designs, in the machine's own units.
struct FrontColumn {
    name: &'static str,
    meaning: &'static str,
    unit: &'static str,
    /// Whether the text has it.
    is_shown: bool,
    values: Vec<Option<f64>>,
}

impl FrontColumn {
    fn head(&self) -> String {
        match self.unit {
            "" => self.name.to_owned(),
            unit => format!("{} ({unit})", self.name),
        }
    }
}

/// The designs of a front, in the machine's own units.
#[derive(Debug, Serialize)]
pub struct FrontReport {
    /// What is sought.
    objectives: Vec<Record>,
    #[serde(flatten)]
    tally: FrontTally,
    /// Machines within the tolerances that were looked at about each design.
    #[serde(skip_serializing_if = "Option::is_none")]
    machines: Option<usize>,
    /// The number of the design that is nearest to the best of each objective.
    nearest: usize,
    /// The units of the designs' values by their names.
    units: BTreeMap<&'static str, &'static str>,
    /// What these values are, by their names.
    meanings: BTreeMap<&'static str, &'static str>,
    /// What people read of them: what is sought, and what was searched.
    shown: Vec<&'static str>,
    /// The designs, the best by the first objective first.
    points: Vec<Record>,
    /// The designs as a sheet, with units in the heads.
    #[serde(skip)]
    pub(crate) sheet: Sheet,
    /// What was sought, in words.
    #[serde(skip)]
    words: Vec<String>,
    #[serde(skip)]
    table: String,
}

impl FrontReport {
    /// The report on a front of a problem.
    pub(crate) fn new(problem: &Problem, front: &Pareto) -> Self {
        let Pareto {
            objectives,
            tally,
            nearest,
            points,
            machines,
        } = front;
        let columns = columns(problem, front);
        let record = |index: usize| {
            let number = Record::default().with("number", "", index + 1);
            columns.iter().fold(number, |record, it| {
                record.with(it.name, "", it.values[index])
            })
        };
        let records: Vec<Record> = (0..points.len()).map(record).collect();
        let heads = columns.iter().map(FrontColumn::head);
        let heads = ["number".to_owned()].into_iter().chain(heads).collect();
        let sought = objectives.iter().map(|it| sought(problem, it));
        Self {
            objectives: sought.collect(),
            tally: *tally,
            machines: *machines,
            nearest: nearest + 1,
            units: columns.iter().map(|it| (it.name, it.unit)).collect(),
            meanings: columns.iter().map(|it| (it.name, it.meaning)).collect(),
            shown: columns
                .iter()
                .filter(|it| it.is_shown)
                .map(|it| it.name)
                .collect(),
            sheet: Sheet {
                heads,
                ..Sheet::of_records("pareto", &records)
            },
            points: records,
            words: objectives.iter().map(Objective::words).collect(),
            table: table(&columns, points.len(), *nearest),
        }
    }

    /// What was sought and found, with a line for each design.
    pub(crate) fn text(&self) -> String {
        let machines = self.machines.map_or_else(String::new, |machines| {
            format!(
                "violating: the share of {machines} machines within the tolerances of each design that lose the motion or violate a \
                 requirement.\n"
            )
        });
        let first = self.words.first().map_or("", String::as_str);
        format!(
            "\nFront of {}: {}\n{}\n{}{machines}The design of the files is number 1, with the {first}; number {} is nearest to the \
             best of each. The values of another one go to --vary.\n",
            self.points.len(),
            self.words.join(", "),
            format_tally(&self.tally),
            self.table,
            self.nearest,
        )
    }
}

/// What became of the problems of a front, in a sentence.
pub(crate) fn format_tally(tally: &FrontTally) -> String {
    let FrontTally {
        problems,
        solved,
        implied,
        failed,
        dominated,
    } = tally;
    let open = problems.saturating_sub(solved + implied + failed);
    let open = match open {
        0 => String::new(),
        open => format!(", {open} were not searched"),
    };
    format!(
        "Of {problems} problems {solved} led to a design, {implied} followed from a looser one, {failed} had no design as \
         asked{open}; {dominated} designs were the same as others or dominated by them."
    )
}

fn sought(problem: &Problem, objective: &Objective) -> Record {
    let figure = objective.figure;
    let sense = match objective.sense {
        Sense::Least => "maximise",
        Sense::Most => "minimise",
    };
    let record = Record::default().with("figure", "", figure.name());
    let record = record.with("sense", "", sense);
    let unit = problem.machine.unit(figure.dimension());
    record
        .with("words", "", objective.words())
        .with("unit", "", unit)
}

/// What is sought, the searched parameters and the others, and all figures that take no trials; trials that are required.
fn columns(problem: &Problem, front: &Pareto) -> Vec<FrontColumn> {
    let (machine, points) = (&problem.machine, &front.points);
    let objectives = &front.objectives;
    let figure = |figure: Figure, is_shown: bool, values: Vec<f64>| FrontColumn {
        name: figure.name(),
        meaning: figure.meaning(),
        unit: machine.unit(figure.dimension()),
        is_shown,
        values: values
            .into_iter()
            .map(|it| Some(machine.to_own(figure.dimension(), it)).filter(|it| it.is_finite()))
            .collect(),
    };
    let sought = objectives.iter().enumerate().map(|(index, it)| {
        let values = points.iter().map(|point| point.values[index]);
        figure(it.figure, true, values.collect())
    });
    let is_searched = |parameter: Parameter| {
        let range = problem.range_of(parameter);
        range.is_some_and(|range| !range.is_held())
    };
    let parameter = |parameter: Parameter| {
        let value = |it: &Alternative| it.found.design.machine.value(parameter);
        FrontColumn {
            name: machine.name(parameter),
            meaning: machine.meaning_of(parameter).0,
            unit: machine.unit_of(parameter),
            is_shown: is_searched(parameter),
            values: points.iter().map(value).collect(),
        }
    };
    let mut parameters: Vec<Parameter> = machine.parameters().collect();
    parameters.sort_by_key(|it| !is_searched(*it));
    let is_other = |it: &&Figure| {
        let is_sought = objectives.iter().any(|objective| objective.figure == **it);
        !it.is_trial() && !is_sought
    };
    let others = Figure::ALL.iter().filter(is_other).map(|it| {
        let value = |point: &Alternative| {
            let motion = point.found.design.judged();
            motion.map_or(f64::NAN, |motion| problem.value(&motion, *it))
        };
        figure(*it, false, points.iter().map(value).collect())
    });
    let trials = points.first().map_or(&[][..], |it| &it.met).iter();
    let trials = trials.enumerate();
    let trials = trials.filter(|(_, it)| it.requirement.figure.is_trial());
    let trials = trials.map(|(index, it)| {
        let values = points.iter().map(|point| point.met.get(index));
        let values = values.map(|it| it.map_or(f64::NAN, RequirementValue::judged));
        figure(it.requirement.figure, false, values.collect())
    });
    let violating = front.machines.map(|_| FrontColumn {
        name: "violating",
        meaning: "share of machines that lose the motion or violate a requirement",
        unit: "",
        is_shown: true,
        values: points.iter().map(|it| it.violating).collect(),
    });
    let parameters = parameters.into_iter().map(parameter);
    let all = sought.chain(parameters).chain(others).chain(trials);
    let has_values = |it: &FrontColumn| it.values.iter().any(Option::is_some);
    all.filter(has_values).chain(violating).collect()
}

/// The shown columns, a line for each design.
fn table(columns: &[FrontColumn], count: usize, nearest: usize) -> String {
    let shown: Vec<&FrontColumn> = columns.iter().filter(|it| it.is_shown).collect();
    let heads = shown.iter().map(|it| it.head());
    let heads = ["number".to_owned()].into_iter().chain(heads).collect();
    let line = |index: usize| {
        let mark = if index == nearest { "* " } else { "" };
        let value =
            |it: &&FrontColumn| it.values[index].map_or_else(String::new, |it| Seven.format(it));
        let values = shown.iter().map(value);
        let number = format!("{mark}{}", index + 1);
        [number].into_iter().chain(values).collect()
    };
    let lines: Vec<Vec<String>> = [heads].into_iter().chain((0..count).map(line)).collect();
    aligned(&lines, |_| false)
}
