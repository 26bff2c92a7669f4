//! What basins along a parameter came to.

use serde_json::json;
use softstop_console::column::{Column, Told, Unit, Units};
use softstop_console::columns;
use softstop_console::record::{Record, below};
use softstop_console::report::{MotionName, stated_machine};
use softstop_console::table::heading;
use softstop_console::units;
use softstop_dynamics::attractors::Attractor;
use softstop_dynamics::basin::{BasinBall, BasinsAt};

use super::GlobalContinuation;

/// A row of `attractors.csv`: a value, one of its basins, and the largest ball inside it.
pub(super) struct AttractorRow<'a> {
    pub(super) at: &'a BasinsAt,
    pub(super) attractor: usize,
    pub(super) class: &'a Attractor,
    pub(super) ball: Option<BasinBall>,
}

/// The rows, value by value, the attractors of each in the order of their numbers.
pub(super) fn rows<'a>(found: &'a GlobalContinuation<'_>) -> Vec<AttractorRow<'a>> {
    let of_place = |at: &'a BasinsAt| {
        let basins = at.attractors.iter().zip(&at.basins.classes).enumerate();
        let row = |(index, (attractor, class)): (usize, (&usize, &'a Attractor))| AttractorRow {
            at,
            attractor: *attractor,
            class,
            ball: at.basins.largest_ball(index),
        };
        let mut rows: Vec<AttractorRow<'a>> = basins.map(row).collect();
        rows.sort_by_key(|row| row.attractor);
        rows
    };
    found.places.iter().flat_map(of_place).collect()
}

/// The columns of `attractors.csv`.
pub(super) fn columns<'a>() -> [Column<AttractorRow<'a>>; 13] {
    columns! { AttractorRow<'a>, it;
        "value" [Of("own")], "of the parameter, in its own unit" => it.at.value;
        "attractor" [None], "its number, from 1, the same at all values" => it.attractor;
        "kind" [None], "of its motion" => it.class.motion.json_key();
        "z" [None], "regime z = p/n, if the motion repeats" => it.class.motion.z();
        "order" [None], "impacts in each of its drive periods" => it.class.motion.order().map(ToString::to_string);
        "before_impact_velocity" [Velocity], "of its hardest impact" => it.class.orbit.as_ref().map(|it| it.before_impact_velocity());
        "exponent" [None], "Lyapunov's, per drive period, unless periodic" => it.class.exponents.map(|it| it.per_period[0]);
        "share" [None], "of all cells" => it.class.share;
        "share_low" [None], "lower end of its 95 % interval" => it.class.interval[0];
        "share_high" [None], "upper end of it" => it.class.interval[1];
        "integrity" [None], "radius of the largest ball, in half axes" => it.ball.map(|it| it.radius);
        "basin_entropy" [None], "S_b of all basins at this value" => it.at.entropy.basin;
        "boundary_entropy" [None], "S_bb, that of the boxes with several basins" => it.at.entropy.boundary;
    }
}

/// An attractor over all values.
pub(super) struct FollowedAttractor {
    /// Its number.
    pub(super) attractor: usize,
    /// Its motions, in the order of the values.
    pub(super) motions: Vec<MotionName>,
    /// The first and the last value at which it is there.
    from: f64,
    to: f64,
    /// Its largest share.
    largest_share: f64,
}

/// The attractors in the order of their numbers.
pub(super) fn attractors(rows: &[AttractorRow<'_>]) -> Vec<FollowedAttractor> {
    let mut all: Vec<FollowedAttractor> = Vec::new();
    for row in rows {
        if row.attractor > all.len() {
            all.push(FollowedAttractor {
                attractor: row.attractor,
                motions: Vec::new(),
                from: row.at.value,
                to: row.at.value,
                largest_share: 0.0,
            });
        }
        let own = &mut all[row.attractor - 1];
        let motion = MotionName::of(&row.class.motion);
        if own.motions.last() != Some(&motion) {
            own.motions.push(motion);
        }
        own.to = row.at.value;
        own.largest_share = own.largest_share.max(row.class.share);
    }
    all
}

impl FollowedAttractor {
    /// Its motions in words.
    pub(super) fn name(&self) -> String {
        let names = self.motions.iter().map(|motion| motion.text.as_str());
        names.collect::<Vec<_>>().join(", then ")
    }
}

fn figures() -> [Column<FollowedAttractor>; 5] {
    columns! { FollowedAttractor, it;
        "attractor" [None] Plain, "number" => it.attractor;
        "from" [None] Six, "first value" => it.from;
        "to" [None] Six, "last value" => it.to;
        "largest_share" [None] Percent(1), "of all starts" => it.largest_share;
        "motions" [None] Plain, "what it is" => Told { value: json!(it.motions), words: it.name() };
    }
}

/// The attractors and basins along a parameter, and the text of them: a row for each attractor.
pub(super) fn report(
    found: &GlobalContinuation<'_>,
    rows: &[AttractorRow<'_>],
) -> (Record, String) {
    let GlobalContinuation {
        machine, parameter, ..
    } = found;
    let (units, name) = (Units::of(machine), machine.name(*parameter));
    let unit = units::of_parameter(machine, *parameter);
    let attractors = Record::all(&figures(), &attractors(rows));
    let label = units.label(name, Unit::Of(unit));
    let title = format!("Attractors of {} along {label}", found.title());
    let text = heading(&title) + &below(&attractors, &units);
    let result = Record::default()
        .hidden("machine", stated_machine(machine))
        .hidden("parameter", name)
        .hidden("unit", unit)
        .hidden("grid", json!(found.places[0].basins.grid))
        .hidden("attractors", attractors)
        .hidden("basins", Record::all(&columns(), rows));
    (result, text)
}
