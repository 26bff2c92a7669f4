//! The words and symbols of a report, told once.

use super::data::Report;

/// A word and what it means.
type Entry = (&'static str, &'static str);

/// Words of every report about a motion.
const MOTION: [Entry; 6] = [
    (
        "before-impact velocity",
        "the velocity at which the mass reaches the clearance: how hard it strikes",
    ),
    (
        "one impact a period, z = 1",
        "the mass strikes once in each period of its drive: the motion that is wanted",
    ),
    (
        "hysteresis zone",
        "the drive frequencies at which that motion and one without impacts are both possible; the start decides",
    ),
    (
        "g₀",
        "grazing: the lower end of the zone, where the motion without impacts just reaches the clearance",
    ),
    (
        "s_SN",
        "fold (saddle-node bifurcation): the upper end of the zone, where the motion with impacts ends and the mass drops out of it",
    ),
    (
        "s_PD",
        "flip (period doubling): below it strokes differ from one to the next",
    ),
];
const PLACE: Entry = (
    "place s",
    "where a frequency stands in the zone: 0 at g₀, 1 at s_SN",
);
const INTEGRITY: Entry = (
    "integrity",
    "radius of the largest ball of initial states about the motion that all lead to it, in units of half of each axis of the plane of states",
);
const SHARE: Entry = (
    "share",
    "how many of the initial states of a plane lead to the motion: the establishing certainty",
);
const MARGIN: Entry = (
    "margin",
    "how far the design's value is from what is required, in the unit of the value; negative if it is not met",
);
const SOBOL: Entry = (
    "share alone, with others, of the margin",
    "Sobol indices: how much of the variance of the before-impact velocity comes from one value by itself, and together with all others; and of the variance of the place in the zone",
);

/// What the parts of a report speak of.
pub(super) fn of(report: &Report) -> Vec<Entry> {
    let mut entries = Vec::new();
    if report.comparison.is_some() || report.response.is_some() || !report.maps.is_empty() {
        entries.extend(MOTION);
    }
    if report.erosion.is_some() {
        entries.push(PLACE);
    }
    if report.erosion.is_some() || report.basin.is_some() {
        entries.extend([SHARE, INTEGRITY]);
    }
    if !report.requirements.is_empty() {
        entries.push(MARGIN);
    }
    if report
        .sensitivities
        .iter()
        .any(|it| it.share.is_some() || it.total.is_some())
    {
        entries.push(SOBOL);
    }
    entries
}
