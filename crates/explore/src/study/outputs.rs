//! What a study tells of each of its points: one list of names, units and meanings.

use softstop_console::column::{Unit, Units};
use softstop_dynamics::MotionKind;
use softstop_dynamics::figure::Figure;

/// A column of a study's results.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Output {
    /// What it tells.
    pub kind: OutputKind,
    /// Its name.
    pub name: &'static str,
    /// What it is one of.
    pub unit: Unit,
    /// What it is, in a few words.
    pub meaning: &'static str,
}

/// What an output tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum OutputKind {
    Observable(Observable),
    Figure(Figure),
}

macro_rules! outputs {
    (@unit None) => { Unit::None };
    (@unit $dimension:ident) => { Unit::Own(softstop::Dimension::$dimension) };
    ($($observable:ident $name:literal [$unit:ident], $meaning:literal;)*) => {
        /// What is observed of a point besides the figures that tasks know, too.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub(super) enum Observable { $($observable),* }

        const OBSERVABLES: &[Output] = &[$(Output {
            kind: OutputKind::Observable(Observable::$observable),
            name: $name,
            unit: outputs!(@unit $unit),
            meaning: $meaning,
        }),*];
    };
}

outputs! {
    Kind "kind" [None], "what the motion from the start settles on: periodic or chatter; chaos if it has not within motion.longest drive periods and small differences grow, unsettled if they do not; lost; over budget";
    SettledWithin "settled_within" [None], "drive periods within which it settles, seen after motion.periods and twice, four times ... as many; nothing if it does not";
    Z "z" [None], "regime z = p/n, if the motion repeats";
    Impacts "impacts_per_period" [None], "its impacts per drive period";
    Exponent "exponent" [None], "its larger Lyapunov exponent per drive period";
    Trace "trace" [None], "trace of its monodromy, if it repeats";
    Determinant "determinant" [None], "determinant of that";
    G0 "frequency_g0" [Frequency], "grazing g0, where the hysteresis zone begins";
    Sn "frequency_sn" [Frequency], "fold s_SN, where it ends";
    Pd "frequency_pd" [Frequency], "flip s_PD, followed down from the z = 1 motion";
    AtSn "velocity_sn" [Velocity], "before-impact velocity at the fold";
}

/// True if a study can have a figure: neither a task's formula tells it, nor zones of other machines, nor more motions than
/// those of certainty.
fn is_output(figure: Figure) -> bool {
    !matches!(
        figure,
        Figure::ClearanceSn
            | Figure::ClearancePd
            | Figure::Integrity
            | Figure::RunUp
            | Figure::MissingStrips
            | Figure::Cost
    )
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

impl Output {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        let figures = Figure::ALL.iter().filter(|figure| is_output(**figure));
        let figures = figures.map(|figure| Self {
            kind: OutputKind::Figure(*figure),
            name: figure.name(),
            unit: Unit::Own(figure.dimension()),
            meaning: figure.meaning(),
        });
        OBSERVABLES.iter().copied().chain(figures)
    }

    /// The one of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|output| output.name == name)
    }

    /// True if it is a word, not a number.
    pub const fn is_word(self) -> bool {
        matches!(
            self.kind,
            OutputKind::Observable(Observable::Kind | Observable::Z)
        )
    }

    /// Numbers that it takes in files of blocks.
    pub const fn width(self) -> usize {
        match self.kind {
            OutputKind::Observable(Observable::Z) => 2,
            _ => 1,
        }
    }

    /// True if it takes the motion from the start.
    pub const fn is_of_motion(self) -> bool {
        use Figure as F;
        match self.kind {
            OutputKind::Observable(it) => {
                !matches!(it, Observable::G0 | Observable::Sn | Observable::AtSn)
            }
            OutputKind::Figure(figure) => !matches!(
                figure,
                F::Share | F::FrequencyG0 | F::FrequencySn | F::ClearanceG0 | F::Certainty
            ),
        }
    }

    /// True if it takes the hysteresis zone.
    pub const fn is_of_zone(self) -> bool {
        use Figure as F;
        match self.kind {
            OutputKind::Observable(it) => {
                matches!(it, Observable::Sn | Observable::Pd | Observable::AtSn)
            }
            OutputKind::Figure(figure) => {
                matches!(figure, F::Share | F::FrequencySn | F::FrequencyPd)
            }
        }
    }

    /// True if it takes other drive frequencies than that of the point.
    pub const fn is_of_other_frequencies(self) -> bool {
        let is_grazing = matches!(
            self.kind,
            OutputKind::Observable(Observable::G0) | OutputKind::Figure(Figure::FrequencyG0)
        );
        is_grazing || self.is_of_zone()
    }

    /// Its numbers at a point over the budget.
    pub fn over_budget(self) -> [f64; 2] {
        let place = KINDS.iter().position(|kind| *kind == OVER_BUDGET);
        match (self.kind, place) {
            (OutputKind::Observable(Observable::Kind), Some(place)) => [place as f64, f64::NAN],
            _ => [OVER; 2],
        }
    }

    /// Its word, from its numbers in a file of blocks.
    pub fn word(self, [first, second]: [f64; 2]) -> Option<String> {
        match self.kind {
            OutputKind::Observable(Observable::Kind) if first >= 0.0 => {
                KINDS.get(first as usize).map(|&kind| kind.to_owned())
            }
            OutputKind::Observable(Observable::Z) if second >= 1.0 => {
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
pub(super) fn kind(motion: &MotionKind) -> f64 {
    let place = KINDS.iter().position(|kind| *kind == motion.json_key());
    place.map_or(f64::NAN, |place| place as f64)
}

/// What outputs mean: a paragraph at the end of `--help`.
pub(super) fn help() -> String {
    let lines = Output::all().map(|output| {
        let unit = match Units::SI.name(output.unit) {
            "" => "-",
            unit => unit,
        };
        format!("  {:<22} {unit:<6} {}\n", output.name, output.meaning)
    });
    "\n\nOutputs:\n".to_owned() + &lines.collect::<String>()
}
