//! Where a design stands among the motions that were searched, and what that means for starting it.

use softstop::{Dimension, Parameter};
use softstop_console::column::{Column, Told};
use softstop_console::columns;
use softstop_console::number::NumberStyle::Six;
use softstop_dynamics::Zone;
use softstop_dynamics::continuation::TestFunction;
use softstop_dynamics::zone::{ZoneEnd, ZoneKind};

use crate::design::conflict::{format_in_own_unit, short};
use crate::design::{Design, Problem};
use crate::limits::{NamedLimit, end_name};

type Placed<'a> = (&'a Problem, &'a Design, &'a [NamedLimit]);

/// Where a design stands.
pub(crate) fn columns<'a>() -> [Column<Placed<'a>>; 11] {
    columns! { Placed<'a>, (problem, design, limits);
        "frequency_g0" [Frequency], "grazing g0, above which the motion without impacts exists" => grazing(&design.zone).map(|at| design.own_frequency(at));
        "frequency_sn" [Frequency], "fold s_SN, if the zone ends there" => fold(&design.zone).map(|at| design.own_frequency(at));
        "margin" [None], "least distance M from both ends, as a share of the zone" => problem.margin;
        "s" [None], "place in the zone, in [M, 1 - M]" => design.place;
        "at_limits" [None], "what holds it back" => keys(limits);
        "zone" [None], "which motions were searched" => searched(design);
        "zone_from" [Frequency], "lower end of the zone" => design.own_frequency(design.zone.low.frequency);
        "zone_from_by" [None], "what ends it there" => end_name(&design.zone.low);
        "zone_to" [Frequency], "upper end of the zone" => design.own_frequency(design.zone.high.frequency);
        "zone_to_by" [None], "what ends it there" => end_name(&design.zone.high);
        "starting" [None], "what that means for starting the machine" => starting(design);
    }
}

/// Where a design stands, in sentences.
pub(crate) fn sentences(design: &Design) -> String {
    let zone = &design.zone;
    let what = match zone.is_hysteresis() {
        true => "Zone of the design",
        false => "Range of stable z = 1 of the design",
    };
    let end = |end: &ZoneEnd| {
        let frequency = Six.format(design.own_frequency(end.frequency));
        format!("{frequency} ({})", end_name(end))
    };
    format!(
        "{what}: {} from {} to {}; the design stands at {:.1} % of the way.\n{}\n",
        design.machine.label_of(Parameter::Frequency),
        end(&zone.low),
        end(&zone.high),
        100.0 * design.place,
        starting(design)
    )
}

/// Warns of a motion that ends at a fold within the zone, where the machine jumps to another motion.
pub(crate) fn inner_fold_warning(design: &Design) -> Option<String> {
    let zone = &design.zone;
    let range = zone.range_holding(&design.orbit)?;
    let [low, high] = [&range.low, &range.high].map(|end| end.frequency);
    let is_whole = low == zone.low.frequency && high == zone.high.frequency;
    let of = match zone.range {
        Some(_) => "this range",
        None if is_whole => return None,
        None => "the whole zone",
    };
    let own = |frequency| Six.format(design.own_frequency(frequency));
    Some(format!(
        "the zone holds several motions: that of the design goes on from {} to {} only, to where margin_sn reaches; \
         M and s are shares of {of}",
        own(low),
        own(high)
    ))
}

/// Width of a zone, as a share of its frequency, below which hardly a drive keeps within it.
const NARROW: f64 = 1e-3;

/// Warns of a zone that is so narrow that hardly a drive keeps within it, unless the bounds of the frequency make it so.
pub(crate) fn warning(design: &Design) -> Option<String> {
    let Zone {
        kind, low, high, ..
    } = &design.zone;
    let (low, high) = (low.frequency, high.frequency);
    let name = design.machine.name(Parameter::Frequency);
    let remedy = match kind {
        ZoneKind::Hysteresis => "require.margin_g0, the least distance from g0,".to_owned(),
        ZoneKind::SingleImpact { between } if between.0 < low && high < between.1 => {
            format!("tolerance.{name}, what the drive keeps to,")
        }
        ZoneKind::SingleImpact { .. } => return None,
    };
    let share = (high - low) / high;
    (share < NARROW).then(|| {
        format!(
            "the zone is {} wide, {} of its frequency: hardly a drive keeps within it; {remedy} excludes zones as narrow",
            format_in_own_unit(&design.machine, Dimension::Frequency, high - low),
            short(share)
        )
    })
}

/// g0 in rad/s, if there is one.
pub(crate) fn grazing(zone: &Zone) -> Option<f64> {
    let g0 = zone.frequency_g0;
    (g0 > 0.0 && g0.is_finite()).then_some(g0)
}

/// The fold in rad/s, if the zone ends there.
pub(crate) fn fold(zone: &Zone) -> Option<f64> {
    let high = &zone.high;
    high.is_critical(TestFunction::Fold)
        .then_some(high.frequency)
}

fn searched(design: &Design) -> &'static str {
    match design.zone.is_hysteresis() {
        true => "hysteresis",
        false => "z = 1",
    }
}

/// Whether the machine strikes by itself.
fn starting(design: &Design) -> &'static str {
    let (zone, frequency) = (&design.zone, design.orbit.scene.excitation.frequency);
    let is_below = zone.frequency_g0_below.is_some_and(|g0| frequency < g0);
    match frequency > zone.frequency_g0 || is_below {
        true => {
            "Starting: the machine may as well stay without impacts; a push or a run-up has to bring it into its \
             motion."
        }
        false => {
            "Starting: there is no motion without impacts, so the machine strikes however it is started; whether it \
             settles on one impact a period, run-up and certainty tell."
        }
    }
}

fn keys(limits: &[NamedLimit]) -> Told {
    Told {
        value: limits.iter().map(|it| it.key.as_str()).collect(),
        words: String::new(),
    }
}
