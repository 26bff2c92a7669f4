//! Ways to bring a machine into its motion, as records.

use softstop::{Dimension, Machine};
use softstop_console::column::Column;
use softstop_console::columns;
use softstop_dynamics::MotionKind;
use softstop_dynamics::run_up::{Attempt, RunUp, RunUpPeaks, Way};

use crate::page::quantity;

type AttemptRow<'a> = (&'a Machine, &'a RunUp, &'a Attempt);

/// What came of a way of a machine.
pub(crate) fn columns<'a>() -> [Column<AttemptRow<'a>>; 8] {
    columns! { AttemptRow<'a>, (machine, run_up, attempt);
        "way" [None] Plain, "what is done" => attempt.way.name();
        "reaches" [None] Plain, "whether the machine then moves as designed" => attempt.share == 1.0;
        "share" [None], "share of the runs that end on the motion" => attempt.share;
        "periods" [None] Plain, "drive periods that it takes" => attempt.periods;
        "stop_force" [Force] Six, "peak force of the stop on the way" => peak(machine, attempt, Dimension::Force, |it| it.stop_force);
        "max_position" [Length] Six, "largest position on the way" => peak(machine, attempt, Dimension::Length, |it| it.highest);
        "allowed" [None] Plain, "whether that force is allowed" => run_up.is_gentle(attempt);
        "note" [None] Plain, "what else is to be known" => note(machine, attempt);
    }
}

fn peak(
    machine: &Machine,
    attempt: &Attempt,
    dimension: Dimension,
    of: impl Fn(&RunUpPeaks) -> f64,
) -> Option<f64> {
    let value = of(attempt.peaks.as_ref()?);
    value.is_finite().then(|| machine.to_own(dimension, value))
}

fn note(machine: &Machine, attempt: &Attempt) -> String {
    let angle = attempt.angle.filter(|_| attempt.share < 1.0);
    let own = |value: f64| {
        let dimension = attempt.way.changed_parameter()?.about().dimension;
        let value = machine.to_own(dimension, value);
        Some(quantity(value, machine.unit(dimension)))
    };
    let strikes = attempt.peaks.is_some_and(|it| it.stop_force.is_infinite());
    let note = match (attempt.way, angle, attempt.lost) {
        _ if strikes => Some("strikes the rigid stop".to_owned()),
        (Way::SwitchedOn, Some(angle), _) if attempt.share > 0.0 => Some(format!(
            "from {:.0} % of the drive angles, best at {angle:.2} rad",
            100.0 * attempt.share
        )),
        (Way::SwitchedOn, ..) if attempt.share == 0.0 => Some("from no drive angle".to_owned()),
        (Way::SwitchedOn, ..) => None,
        (_, _, Some(lost)) => own(lost).map(|lost| format!("z = 1 is lost at {lost}")),
        _ => match &attempt.ends {
            Some(MotionKind::Unsettled) if attempt.share < 1.0 => {
                Some("has not settled by then".to_owned())
            }
            Some(motion) if attempt.share < 1.0 => Some(format!("ends in {motion}")),
            _ => attempt
                .from
                .and_then(own)
                .map(|from| format!("begun at {from}")),
        },
    };
    note.unwrap_or_default()
}
