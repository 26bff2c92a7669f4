//! Table 1 as data: rows beside those of the paper, with remarks.

use crate::transitions::{Cause, Rules, Transition};
use serde::Serialize;
use softstop_dynamics::{MotionKind, Regime};

use super::matching::{Match, find};
use super::paper::PaperRow;
use super::swept::{self, SweptEnd};
use softstop_console::column::{self, Units};
use softstop_console::columns;
use softstop_console::table::heading;

/// The table.
#[derive(Debug, Serialize)]
pub struct TableReport {
    /// Its rows, in the paper's order.
    pub rows: Vec<RowReport>,
}

/// One row. Of a row that was not found only the number, the paper's figure and the remark are there.
#[derive(Debug, Default, Serialize)]
pub struct RowReport {
    /// The paper's number.
    pub number: usize,
    /// The paper's frequency ratio.
    pub paper: f64,
    /// Ours.
    pub eta: Option<f64>,
    /// What it is, in the paper's symbols.
    #[serde(rename = "type")]
    pub kind: Option<String>,
    /// True if going back does not lead to the first motion again.
    pub hysteresis: Option<bool>,
    /// What ends.
    pub from: Option<String>,
    /// What follows, everything on the way named.
    pub to: Option<String>,
    /// Where the branch of the first motion ends, if it repeats.
    pub branch_ends: Option<f64>,
    /// `hard` if it ends by a flip whose doubled motion is unstable, `soft` if by one that goes on doubled.
    pub flip: Option<&'static str>,
    /// Where the last motion first follows, if others come before it.
    pub follows_from: Option<f64>,
    /// Decimals that are known of it.
    #[serde(skip)]
    pub follows_decimals: usize,
    /// How the figure was found, and why it differs.
    pub remark: String,
}

/// Difference from the paper's figure that its digits explain.
const ROUNDING: f64 = 1e-5;
/// Decimals to which ends of branches are known.
const LOCATED: usize = 10;

impl TableReport {
    /// The rows of the paper that are among some transitions.
    pub fn new(rows: &[PaperRow], transitions: &[Transition], rules: &Rules) -> Self {
        let report = |row: &PaperRow| RowReport::new(row, find(row, transitions).as_ref(), rules);
        Self {
            rows: rows.iter().map(report).collect(),
        }
    }

    /// For people: the rows one under the other, their remarks below.
    pub fn text(&self) -> String {
        let columns = columns! { RowReport, it;
            "No." [None] Plain, "" => it.number;
            "eta" [None] Plain, "" => it.figure();
            "paper" [None] Plain, "" => it.paper;
            "hyst." [None] Plain, "" => it.hysteresis;
            "type" [None] Plain, "" => it.kind.clone();
            "transition" [None] Plain, "" => it.transition(" -> ", " <-> ");
        };
        let title = heading("Table 1 of Peterka 2003, found anew (unloaded, rho = 10)");
        let rows = column::text(&columns, &self.rows, &Units::SI);
        let remarks = self.rows.iter();
        let remarks = remarks.map(|row| format!("{:>3}  {}\n", row.number, row.remark));
        format!("{title}\n{rows}\nRemarks\n{}", remarks.collect::<String>())
    }
}

impl RowReport {
    /// The frequency with the digits that are known of it: of chaos that ends, by the lifetimes of some motions, five.
    pub fn figure(&self) -> Option<String> {
        let decimals = match self.kind.as_deref() {
            Some("OCH") => 5,
            _ if self.eta == self.follows_from => self.follows_decimals,
            _ => LOCATED,
        };
        self.eta.map(|eta| format!("{eta:.decimals$}"))
    }

    /// Where the last motion first follows, with the digits that are known of it.
    pub fn follows(&self) -> Option<String> {
        let decimals = self.follows_decimals;
        self.follows_from.map(|eta| format!("{eta:.decimals$}"))
    }

    fn new(row: &PaperRow, found: Option<&Match<'_>>, rules: &Rules) -> Self {
        let missing =
            "not found: no transition between these motions was met near the paper's figure";
        let missing = Self {
            number: row.number,
            paper: row.eta,
            follows_decimals: LOCATED,
            remark: missing.to_owned(),
            ..Self::default()
        };
        let Some(found) = found else {
            return missing;
        };
        let transition = found.transition;
        let first = name(&transition.from);
        let path = || transition.path.iter().map(name).collect::<Vec<_>>();
        let (from, to) = match found.is_reversed {
            true => (name(transition.to()), first),
            false => (first, path().join(" -> ")),
        };
        Self {
            eta: Some(found.eta),
            kind: Some(transition.symbols()),
            hysteresis: Some(transition.hysteresis),
            from: Some(from),
            to: Some(to),
            branch_ends: transition.state.map(|_| transition.value),
            flip: flip(transition),
            follows_from: transition.settled_at.filter(|_| transition.hysteresis),
            follows_decimals: follows_decimals(transition),
            remark: remark(row, found, rules),
            ..missing
        }
    }

    /// From one motion to the other by an arrow, or one in both directions where there is no hysteresis.
    pub(super) fn transition(&self, there: &str, both: &str) -> String {
        let arrow = match self.hysteresis {
            Some(false) => both,
            _ => there,
        };
        let motions = self.from.as_ref().zip(self.to.as_ref());
        motions.map_or("not found".to_owned(), |(from, to)| {
            format!("{from}{arrow}{to}")
        })
    }
}

/// A motion by its regime, and by the paper's letter where there are two of one regime.
pub(crate) fn name(motion: &MotionKind) -> String {
    match motion {
        MotionKind::Periodic {
            regime: Regime {
                impacts: 2,
                periods: 4,
            },
            order,
        } => match order.to_string().as_str() {
            "1-1-0-0" => "z = (2/4)B".to_owned(),
            "1-0-1-0" => "z = (2/4)A".to_owned(),
            other => format!("z = 2/4 ({other})"),
        },
        _ => motion.to_string(),
    }
}

fn remark(row: &PaperRow, found: &Match<'_>, rules: &Rules) -> String {
    let transition = found.transition;
    let mut parts = vec![origin(transition, rules)];
    parts.extend(succession(transition));
    let gap = found.eta - row.eta;
    if gap.abs() > ROUNDING {
        parts.push(format!("{gap:+.1e} from the paper"));
        parts.extend(reason(row, transition, gap));
    }
    if transition.symbols() != row.kind || transition.hysteresis != row.hysteresis {
        let way = if row.hysteresis { "with" } else { "without" };
        parts.push(format!("the paper has {} {way} hysteresis", row.kind));
    }
    parts.join("; ")
}

/// How the figure was found.
fn origin(transition: &Transition, rules: &Rules) -> String {
    match transition.causes[..] {
        [Cause::OutOfChaos] => format!(
            "chaos ends by its lifetime, which falls steadily: here half of {} motions settle within {} drive periods",
            rules.motions, rules.lifetime
        ),
        _ => format!(
            "the stable branch ends at {:.10}, located to 1e-10",
            transition.value
        ),
    }
}

/// Decimals that are known of where the last motion first follows, the last of them to a few units.
fn follows_decimals(transition: &Transition) -> usize {
    let known = -transition.settled_within.log10();
    LOCATED.min(known.round() as usize)
}

/// Which kind of flip ends the first motion, if one does.
fn flip(transition: &Transition) -> Option<&'static str> {
    transition.doubled_until?;
    match transition.is_soft() {
        true => Some("soft"),
        false => Some("hard"),
    }
}

/// What comes between the first motion and the last.
fn succession(transition: &Transition) -> Vec<String> {
    let mut parts = Vec::new();
    if let Some(until) = transition.doubled_until {
        let what = match flip(transition) {
            Some("soft") => "it goes on doubled until",
            _ => "the flip is hard: the doubled branch is unstable and runs back to",
        };
        parts.push(format!("{what} {until:.10}"));
    }
    if let Some(settled) = transition.settled_at
        && transition.hysteresis
    {
        let last = name(transition.to());
        let decimals = follows_decimals(transition);
        parts.push(format!("{last} follows from {settled:.decimals$} on"));
    }
    parts
}

/// Why the paper's figure is another.
fn reason(row: &PaperRow, transition: &Transition, gap: f64) -> Option<String> {
    if transition.causes[..] == [Cause::OutOfChaos] {
        let time = if (gap > 0.0) == transition.rising {
            "longer"
        } else {
            "shorter"
        };
        return Some(format!(
            "as a run that gives chaos a {time} time to settle would have it"
        ));
    }
    let is_last = |settled: f64| (settled - row.eta).abs() <= ROUNDING;
    if transition.settled_at.is_some_and(is_last) {
        return Some("the paper gives where the last motion follows".to_owned());
    }
    let swept = SweptEnd::over(transition, gap)?;
    let way = if transition.rising { "up" } else { "down" };
    let step = format!("{:e} per {} drive periods", swept.step, swept::PERIODS);
    let digits = (1.0 - swept.step.log10()) as usize;
    let mut reason = format!(
        "a sweep {way} by {step} loses the motion at {:.digits$}",
        swept.lost
    );
    if let Some(arrived) = swept.arrived {
        let last = name(transition.to());
        reason += &format!(" and has come to {last} at {arrived:.digits$}");
    }
    Some(reason)
}
