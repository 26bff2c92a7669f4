//! What a study tells of each of its points: one list of names, units, meanings and values.

use softstop_console::column::{Unit, Units};
use softstop_console::columns;
use softstop_dynamics::MotionKind;
use softstop_dynamics::figure::Figure;
use softstop_dynamics::zone::free_amplitude;

use super::point_evaluation::PointEvaluation;
use OutputKind::{Cycle, Kind, Number, Z};

/// A column of a study's results.
#[derive(Debug, Clone, Copy)]
pub(super) struct StudyOutput {
    /// Its name.
    pub name: &'static str,
    /// What it is one of.
    pub unit: Unit,
    /// What it takes.
    needs: &'static [Need],
    /// What it is, in a few words.
    pub meaning: &'static str,
    kind: OutputKind,
}

/// What an output takes besides the machine itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Need {
    /// The motion from the start.
    Motion,
    /// The hysteresis zone.
    Zone,
    /// The grazing frequencies.
    Grazing,
}

/// What an output tells.
#[derive(Debug, Clone, Copy)]
enum OutputKind {
    /// What the motion from the start settles on, a word.
    Kind,
    /// z = p/n, a word.
    Z,
    /// A number in SI units.
    Number(OutputValue),
    /// A figure of the cycle of a motion that repeats.
    Cycle(Figure),
}

/// Tells a number of a point in SI units.
type OutputValue = fn(&PointEvaluation<'_>) -> Option<f64>;

macro_rules! outputs {
    ($($name:literal [$unit:ident] [$($need:ident)*], $meaning:literal => $kind:expr;)*) => {
        &[$(StudyOutput {
            name: $name,
            unit: columns!(@unit $unit),
            needs: &[$(Need::$need),*],
            meaning: $meaning,
            kind: $kind,
        }),*]
    };
}

/// What is told of a point besides the figures that tasks know, too.
const OBSERVABLES: &[StudyOutput] = outputs! {
    "kind" [None] [Motion], "what the motion from the start settles on: periodic or chatter; chaos if it has not within motion.longest drive periods and small differences grow, unsettled if they do not; lost; over budget"
        => Kind;
    "settled_within" [None] [Motion], "drive periods within which it settles, seen after motion.periods and twice, four times ... as many; nothing if it does not"
        => Number(|it| it.seen.as_ref().filter(|seen| seen.periods.is_some()).map(|seen| seen.followed as f64));
    "z" [None] [Motion], "regime z = p/n, if the motion repeats"
        => Z;
    "impacts_per_period" [None] [Motion], "its impacts per drive period"
        => Number(|it| Some(it.seen.as_ref()?.impacts_per_period()));
    "exponent" [None] [Motion], "its larger Lyapunov exponent per drive period"
        => Number(|it| it.exponent());
    "trace" [None] [Motion], "trace of its monodromy, if it repeats"
        => Number(|it| Some(it.orbit()?.monodromy.trace()));
    "determinant" [None] [Motion], "determinant of that"
        => Number(|it| Some(it.orbit()?.monodromy.determinant()));
    "frequency_g0" [Frequency] [Grazing], "grazing g0, where the hysteresis zone begins"
        => Number(|it| it.grazing());
    "frequency_sn" [Frequency] [Zone], "fold s_SN, where it ends"
        => Number(|it| Some(it.fold()?.frequency));
    "frequency_pd" [Frequency] [Motion Zone], "flip s_PD, followed down from the z = 1 motion"
        => Number(|it| it.flip().filter(|flip| flip.is_finite()));
    "velocity_sn" [Velocity] [Zone], "before-impact velocity at the fold"
        => Number(|it| Some(it.fold()?.point.before_impact_velocity()));
};

/// What a figure takes, and its value; none of those that a task's formula tells, that take zones of other machines, or more motions
/// than those of certainty.
fn figure_output(figure: Figure) -> Option<(&'static [Need], OutputKind)> {
    use Need::{Grazing, Motion, Zone};
    let number = |needs: &'static [Need], value: OutputValue| Some((needs, Number(value)));
    match figure {
        Figure::Velocity => number(&[Motion], |it| Some(it.seen.as_ref()?.hardest_impact())),
        Figure::MaxPosition => number(&[Motion], |it| {
            it.seen.as_ref()?.max_position(it.map()?).ok()
        }),
        Figure::Share => number(&[Zone], |it| it.place().map(|place| place.min(1.0 - place))),
        Figure::FrequencyG0 => number(&[Grazing], |it| Some(it.frequency() - it.grazing()?)),
        Figure::FrequencySn => number(&[Motion, Zone], |it| Some(it.own_fold()? - it.frequency())),
        Figure::FrequencyPd => number(&[Motion, Zone], |it| Some(it.frequency() - it.flip()?)),
        Figure::ClearanceG0 => number(&[], |it| {
            let free = free_amplitude(it.scene(), it.frequency());
            Some(it.scene().least_clearance() - free)
        }),
        Figure::Certainty => number(&[], |it| it.certainty()),
        Figure::ClearanceSn
        | Figure::ClearancePd
        | Figure::Integrity
        | Figure::RunUp
        | Figure::MissingStrips
        | Figure::Cost => None,
        figure => Some((&[Motion], Cycle(figure))),
    }
}

/// Kinds of motions, by their numbers in files of blocks.
const KINDS: [&str; 7] = [
    "periodic",
    "chatter",
    "rest",
    "chaos",
    "unsettled",
    "lost",
    OVER_BUDGET,
];
/// The word for a point over the budget, in the column of kinds.
pub(super) const OVER_BUDGET: &str = "over budget";
/// What a point over the budget has in files of blocks in every other column: a NaN of its own.
const OVER: f64 = f64::from_bits(0x7ff8_0000_0000_0b0d);

/// True if an output is missing since its point is over the budget.
pub(super) fn is_over_budget(number: f64) -> bool {
    number.to_bits() == OVER.to_bits()
}

impl StudyOutput {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        let figures = Figure::ALL.iter().filter_map(|figure| {
            let (needs, kind) = figure_output(*figure)?;
            Some(Self {
                name: figure.name(),
                unit: Unit::Own(figure.dimension()),
                needs,
                meaning: figure.meaning(),
                kind,
            })
        });
        OBSERVABLES.iter().copied().chain(figures)
    }

    /// The one of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|output| output.name == name)
    }

    /// True if it is a word, not a number.
    pub const fn is_word(self) -> bool {
        matches!(self.kind, Kind | Z)
    }

    /// Numbers that it takes in files of blocks.
    pub const fn width(self) -> usize {
        match self.kind {
            Z => 2,
            _ => 1,
        }
    }

    /// True if it takes this.
    pub fn needs(self, need: Need) -> bool {
        self.needs.contains(&need)
    }

    /// Its numbers at a point, in the machine's own units; NaN where there is nothing.
    pub fn value(self, point: &PointEvaluation<'_>) -> [f64; 2] {
        let value = match self.kind {
            Kind => {
                let motion = point.motion().filter(|_| point.is_valid);
                Some(kind(motion.map_or(&MotionKind::Lost, |it| &it.0)))
            }
            _ if !point.is_valid => None,
            Z => return point.z().unwrap_or([f64::NAN; 2]),
            Number(number) => number(point),
            Cycle(figure) => point.periodic().and_then(|(orbit, metrics)| {
                let value = figure.of_motion(orbit, metrics);
                value.filter(|it| !it.is_nan())
            }),
        };
        let own = |value| match self.unit {
            Unit::Own(dimension) => point.machine.to_own(dimension, value),
            _ => value,
        };
        [value.map_or(f64::NAN, own), f64::NAN]
    }

    /// Its numbers at a point over the budget.
    pub fn over_budget(self) -> [f64; 2] {
        let place = KINDS.iter().position(|kind| *kind == OVER_BUDGET);
        match (self.kind, place) {
            (Kind, Some(place)) => [place as f64, f64::NAN],
            _ => [OVER; 2],
        }
    }

    /// Its word, from its numbers in a file of blocks.
    pub fn word(self, [first, second]: [f64; 2]) -> Option<String> {
        match self.kind {
            Kind if first >= 0.0 => KINDS.get(first as usize).map(|&kind| kind.to_owned()),
            Z if second >= 1.0 => {
                let impacts = match first.is_finite() {
                    true => first.to_string(),
                    false => "∞".to_owned(),
                };
                Some(match second {
                    1.0 => impacts,
                    periods => format!("{impacts}/{periods}"),
                })
            }
            _ => None,
        }
    }
}

/// The number of a kind.
fn kind(motion: &MotionKind) -> f64 {
    let place = KINDS.iter().position(|kind| *kind == motion.json_key());
    place.map_or(f64::NAN, |place| place as f64)
}

/// What outputs mean: a paragraph at the end of `--help`.
pub(super) fn help() -> String {
    let lines = StudyOutput::all().map(|output| {
        let unit = match Units::SI.name(output.unit) {
            "" => "-",
            unit => unit,
        };
        format!("  {:<22} {unit:<6} {}\n", output.name, output.meaning)
    });
    "\n\nOutputs:\n".to_owned() + &lines.collect::<String>()
}
