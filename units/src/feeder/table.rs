//! The variables of the feeder.

use softstop_fmi::Flow::Signal;
use softstop_fmi::rows::{
    LARGE, bare, count, discrete, fixed, real, row, shown_in, tunable, within,
};
use softstop_fmi::si;
use softstop_fmi::variable::{Access, Dependencies, Kind, Variable};
use softstop_fmi::{Quantity, Terminal};

use super::supply::MODEL;
use super::{ANGLE, Feeder, PATTERN, slot};
use crate::difference::Direction;

type FeederVariable = Variable<Feeder, Direction<Feeder>>;

pub(super) static QUANTITIES: &[&Quantity] = &[&si::ANGLE, &si::ANGULAR_FREQUENCY, &si::TIME];

pub(super) const TERMINALS: &[Terminal] = &[
    Terminal {
        name: "drive",
        description: "Shaft that the feeder follows",
        members: &[("angle", Signal, "angle")],
    },
    Terminal {
        name: "strip",
        description: "Feed of strips: softstop.fmu",
        members: &[
            ("material", Signal, "material"),
            ("material_real", Signal, "material_real"),
        ],
    },
];

pub(super) const GROUPS: &[&[FeederVariable]] =
    &[INPUTS, FEED_AND_SUPPLY, STROKES, CHANCE_AND_JAMS, OUTPUTS];

const SHARE: Kind = bare(0.0, 1.0);
/// A number of strokes.
const fn strokes(min: i32) -> Kind {
    let max = Some(1_000_000_000);
    Kind::Count { min, max }
}

/// What decides on the first stroke.
const FIRST: Dependencies = Dependencies {
    inputs: &[],
    initial: &[
        "held",
        "held_real",
        "supply.model",
        "supply.pattern.count",
        "supply.pattern.strokes",
        "supply.probability",
        "supply.seed",
        "jam.probability",
    ],
};

#[rustfmt::skip]
const INPUTS: &[FeederVariable] = &[
    row(100, "angle", shown_in(within(&si::ANGLE, -LARGE, LARGE), "deg"), Access::Signal(ANGLE),
        "Angle of the shaft if feed.takes.angle is true: drive.angle of softstop.fmu, or angle of drive.fmu, with its derivatives of order 1 to 7 if they are known. What it jumps by the shaft turns evenly over the next step"),
    row(101, "held", Kind::Boolean, Access::Input(slot::HELD),
        "Strips are held back: strokes get none as long as this is true"),
    row(102, "held_real", SHARE, Access::Input(slot::HELD_SHARE),
        "The same for masters that know Real inputs only: held back from 0.5 on. Strips are held back if either of both says so"),
];

#[rustfmt::skip]
const FEED_AND_SUPPLY: &[FeederVariable] = &[
    tunable(fixed(0, "feed.speed", slot::SPEED, shown_in(within(&si::ANGULAR_FREQUENCY, -LARGE, LARGE), "Hz"),
        "Speed of the shaft if feed.takes.angle is false; when it is tuned, the angle goes on without a jump")),
    fixed(1, "feed.angle", slot::ANGLE, shown_in(within(&si::ANGLE, -LARGE, LARGE), "deg"),
        "Angle of the shaft, and each full turn on, at which a stroke begins and its strip comes or fails to come; shafts that turn back begin none"),
    fixed(2, "feed.takes.angle", slot::TAKES_ANGLE, Kind::Boolean,
        "The input angle leads the shaft; otherwise it turns at feed.speed"),
    fixed(3, "supply.model", slot::MODEL, Kind::Enumeration(&MODEL),
        "Which strokes get a strip"),
    fixed(4, "supply.pattern.count", slot::COUNT, Kind::Count { min: 1, max: Some(PATTERN as i32) },
        "Number of elements of the pattern; further ones are ignored"),
];

macro_rules! pattern {
    ($($number:literal)*) => {
        [$(fixed(
            9 + $number,
            concat!("supply.pattern.strokes[", $number, "]"),
            slot::STROKES.element($number - 1),
            strokes(0),
            "Strokes in a row that get a strip (odd elements) or none (even elements)",
        )),*]
    };
}

const STROKES: &[FeederVariable] = &{
    const ROWS: [FeederVariable; PATTERN] = pattern!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16);
    ROWS
};

#[rustfmt::skip]
const CHANCE_AND_JAMS: &[FeederVariable] = &[
    tunable(fixed(5, "supply.probability", slot::PROBABILITY, SHARE,
        "Probability that a stroke gets a strip (random)")),
    fixed(6, "supply.seed", slot::SEED, Kind::Count { min: 0, max: None },
        "Seed of all chance, that of jams included: the same seed, the same strokes, however the steps are chosen"),
    tunable(fixed(7, "jam.probability", slot::JAM_PROBABILITY, SHARE,
        "Probability that the feeder jams at a stroke, whatever the model of supply")),
    fixed(8, "jam.strokes", slot::JAM_STROKES, strokes(1),
        "Strokes that get no strip because of a jam, from the one on at which it begins"),
    row(206, "jam.count", strokes(0), Access::Integer { value: |feeder| clamp(feeder.line.jams), depends: FIRST },
        "Jams so far"),
    fixed(9, "initial.angle", slot::INITIAL_ANGLE, shown_in(within(&si::ANGLE, -LARGE, LARGE), "deg"),
        "Angle of the shaft at the start time, excitation.phase of softstop.fmu"),
];

fn clamp(count: u64) -> i32 {
    i32::try_from(count).unwrap_or(i32::MAX)
}

#[rustfmt::skip]
const OUTPUTS: &[FeederVariable] = &[
    row(200, "material", Kind::Boolean,
        Access::Integer { value: |feeder| i32::from(feeder.line.strip), depends: FIRST },
        "A strip lies in the press since the last stroke: material of softstop.fmu"),
    row(201, "material_real", SHARE, Access::Discrete { value: |feeder| f64::from(u8::from(feeder.line.strip)), tangent: Direction::of, depends: FIRST },
        "The same as 1 or 0: material_real of softstop.fmu"),
    row(202, "strip.count", strokes(0), Access::Integer { value: |feeder| clamp(feeder.line.strips), depends: FIRST },
        "Strips so far, the one at the start included"),
    row(203, "missing.count", strokes(0), Access::Integer { value: |feeder| clamp(feeder.line.missing), depends: FIRST },
        "Strokes without a strip so far"),
    count(204, "stroke.count", |feeder| clamp(feeder.line.strokes),
        "Strokes so far, the one at the start included"),
    discrete(205, "fed.time", real(&si::TIME), (|feeder| feeder.fed, Direction::of),
        "Time at which the last stroke began; at first the start time"),
];
