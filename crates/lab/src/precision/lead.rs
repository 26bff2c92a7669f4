//! By how much the exact method leads: the time of the next best at equal accuracy over its own.

use serde::Serialize;

use super::measure::Row;

/// How the figures come about, for the reader of the JSON.
pub const HOW: &str = "Accuracy is the larger of the target and the exact method's own error. A method's time \
    at this accuracy lies on the straight lines through its points in log time over log error, in the order of its \
    knob; the least time wins. Nothing is extrapolated: a method that does not get there has no time. worst is the \
    largest of the errors at the end, in impact times and in impact velocities, and infinite where the number of \
    impacts is wrong.";

/// Accuracies at which methods are compared; the last is about the least that others can reach, and the next to
/// that of the exact method.
pub const TARGETS: [f64; 5] = [1e-3, 1e-6, 1e-9, 1e-12, 1e-13];
/// An error of zero counts as this.
const FLOOR: f64 = 1e-17;

/// By which error methods are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Of the state at the end.
    End,
    /// The largest of all, of runs with the right number of impacts.
    Worst,
}

impl Quantity {
    /// Both.
    pub const ALL: [Self; 2] = [Self::End, Self::Worst];

    fn of(self, row: &Row) -> Option<f64> {
        match self {
            Self::End => row.end_error,
            Self::Worst if row.impact_difference == Some(0) => row.worst_error(),
            Self::Worst => None,
        }
    }
}

/// The lead at one accuracy.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Lead {
    /// By which error.
    pub quantity: Quantity,
    /// The target.
    pub target: f64,
    /// The accuracy of the comparison.
    pub accuracy: f64,
    /// The exact method's time, in s.
    pub exact_seconds: f64,
    /// The next best method, if any gets there.
    pub next: Option<Rival>,
    /// The most accurate other method, for when none gets there.
    pub closest: Option<Rival>,
}

/// Another method beside the exact one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rival {
    /// Its name.
    pub method: String,
    /// Its error, if it does not get there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<f64>,
    /// Its time, in s: at this accuracy, or for this error.
    pub seconds: f64,
    /// Its time over the exact method's.
    pub ratio: f64,
}

/// Error and time of one run.
type Point = (f64, f64);

/// The lead at all targets; empty if the exact method has no answer.
pub fn leads(rows: &[Row], exact: &str) -> Vec<Lead> {
    let both = Quantity::ALL.map(|quantity| {
        let curves = curves(rows, quantity);
        let leads = TARGETS.map(|target| lead(&curves, exact, quantity, target));
        leads.into_iter().flatten().collect::<Vec<_>>()
    });
    both.concat()
}

fn lead(
    curves: &[(String, Vec<Point>)],
    exact: &str,
    quantity: Quantity,
    target: f64,
) -> Option<Lead> {
    let own = curves.iter().find(|(name, _)| name == exact)?;
    let &(error, seconds) = own.1.first()?;
    let accuracy = target.max(error);
    let others = || curves.iter().filter(|(name, _)| name != exact);
    let times = others().filter_map(|(name, points)| Some((name, time_at(points, accuracy)?)));
    let next = times.min_by(|a, b| a.1.total_cmp(&b.1));
    let points = others().flat_map(|(name, points)| points.iter().map(move |point| (name, *point)));
    let closest = points.min_by(|a, b| a.1.partial_cmp(&b.1).unwrap_or(std::cmp::Ordering::Equal));
    let rival = |method: &String, error: Option<f64>, time: f64| Rival {
        method: method.clone(),
        error,
        seconds: time,
        ratio: time / seconds,
    };
    Some(Lead {
        quantity,
        target,
        accuracy,
        exact_seconds: seconds,
        next: next.map(|(method, time)| rival(method, None, time)),
        closest: closest.map(|(method, (error, time))| rival(method, Some(error), time)),
    })
}

/// The points of each method with a finite error, in the order of its knob.
fn curves(rows: &[Row], quantity: Quantity) -> Vec<(String, Vec<Point>)> {
    let point = |row: &Row| {
        let (error, seconds) = quantity.of(row).zip(row.seconds)?;
        let error = error.max(FLOOR);
        error.is_finite().then_some((error, seconds))
    };
    let runs = rows.chunk_by(|a, b| a.method == b.method);
    let curves = runs.map(|runs| {
        let points: Vec<Point> = runs.iter().filter_map(point).collect();
        (runs[0].method.clone(), points)
    });
    curves.filter(|(_, points)| !points.is_empty()).collect()
}

/// The least time at which a curve is as accurate as this.
fn time_at(points: &[Point], accuracy: f64) -> Option<f64> {
    let there = points.iter().filter(|point| point.0 <= accuracy);
    let crossings = points.windows(2).filter_map(|pair| {
        let [coarse, fine] = [pair[0], pair[1]];
        (coarse.0 > accuracy && fine.0 <= accuracy).then(|| between(coarse, fine, accuracy))
    });
    let times = there.map(|point| point.1).chain(crossings);
    times.min_by(f64::total_cmp)
}

/// The time on the line through two points in log time over log error.
fn between(coarse: Point, fine: Point, accuracy: f64) -> f64 {
    let share = (accuracy / coarse.0).ln() / (fine.0 / coarse.0).ln();
    (coarse.1.ln() + share * (fine.1 / coarse.1).ln()).exp()
}

#[cfg(test)]
mod tests {
    use super::{Quantity, Row, leads, time_at};
    use approx::assert_abs_diff_eq;
    use softstop_testing::tolerance::MOTION;

    fn row(method: &str, end: f64, seconds: f64, impact_difference: i64) -> Row {
        Row {
            method: method.into(),
            seconds: Some(seconds),
            end_error: Some(end),
            impact_difference: Some(impact_difference),
            ..Row::default()
        }
    }

    #[test]
    fn between_two_points_time_is_a_power_of_error() {
        let points = [(1e-2, 1.0), (1e-4, 10.0), (1e-8, 100.0)];
        let time = time_at(&points, 1e-3).expect("a value");
        assert_abs_diff_eq!(time, 10.0_f64.sqrt(), epsilon = MOTION);
        assert_eq!(time_at(&points, 1.0), Some(1.0));
        assert_eq!(time_at(&points, 1e-9), None);
    }

    #[test]
    fn the_least_time_of_the_others_is_compared() {
        let rows = [
            row("exact", 1e-15, 1.0, 0),
            row("slow", 1e-10, 50.0, 0),
            row("lucky", 1e-10, 30.0, 1),
        ];
        let leads = leads(&rows, "exact");
        let at = |quantity| {
            let mut own = leads.iter().filter(|lead| lead.quantity == quantity);
            let found = own.find(|lead| lead.target == 1e-9);
            let next = found.and_then(|lead| lead.next.as_ref()).expect("a value");
            (next.method.as_str(), next.ratio)
        };
        assert_eq!(at(Quantity::End), ("lucky", 30.0));
        assert_eq!(at(Quantity::Worst), ("slow", 50.0));
    }

    #[test]
    fn a_method_that_does_not_get_there_is_named_as_the_closest() {
        let rows = [row("exact", 1e-15, 1.0, 0), row("coarse", 1e-5, 7.0, 0)];
        let leads = leads(&rows, "exact");
        let finest = leads.iter().find(|lead| lead.target == 1e-9);
        let finest = finest.expect("a value");
        assert_eq!(finest.next, None);
        assert_eq!(finest.closest.as_ref().expect("a value").error, Some(1e-5));
    }
}
