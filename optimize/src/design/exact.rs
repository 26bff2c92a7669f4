//! Exact derivatives of figures by the coordinates of the search: the implicit function theorem on the motion and on the
//! ends of its zone, and the chain rule through links and the place in the zone.

use softstop::{Machine, Parameter};
use softstop_dynamics::Zone;
use softstop_dynamics::continuation::{Direction, TestFunction};
use softstop_dynamics::derivatives::{self, Border, OrbitDerivatives};
use softstop_dynamics::zone::{ZoneEnd, loss_of_stability};

use super::Design;
use super::differences::{differences, machine_differences};
use super::figure::Figure;
use super::judge::ZoneMotion;
use super::operating_point::SearchPoint;
use super::problem::Problem;
use crate::robust::{dot, rates};

/// A motion of the search with its derivatives by the coordinates.
pub(super) struct Linearization<'a> {
    pub(super) problem: &'a Problem,
    pub(super) at: &'a SearchPoint<'a>,
    pub(super) point: &'a Design,
    slopes: OrbitDerivatives,
    /// By each coordinate, what changes of the parameters of `slopes` but the last, the frequency, while that stays, in SI
    /// units.
    directions: Vec<Vec<f64>>,
    /// Derivatives by the frequency of these parameters, which follow it, and of itself.
    along: Vec<f64>,
    /// Derivatives of the drive's frequency by the coordinates, and of the upper end of the zone.
    pub(super) frequency: Vec<f64>,
    high: Vec<f64>,
    /// Derivatives of the place in the zone.
    place: Vec<f64>,
}

/// Change of a parameter, as a share of its range, by which what follows it is told: links are linear in what they
/// follow, or its product with one more parameter.
const CHANGE: f64 = 1e-2;
/// Change by which what follows others by expressions is told: central differences of smooth ones are off by its square.
const SMALL_CHANGE: f64 = 1e-5;

impl<'a> Linearization<'a> {
    /// Of a drawing's motion, or of a case's, with the derivatives of the drawing's frequency by the coordinates. None where the
    /// motion has no derivatives.
    pub(super) fn of(
        problem: &'a Problem,
        at: &'a SearchPoint<'a>,
        (point, given): (&'a Design, Option<&[f64]>),
    ) -> Option<Self> {
        let followers = point.orbit.scene.rates_of_followers();
        let all = directions(problem, at, (&Parameter::ALL, point.drive_frequency()));
        let is_moved = |parameter: &Parameter| {
            let mut followers = followers.iter();
            *parameter != Parameter::Frequency
                && (all.iter().any(|row| row[*parameter as usize] != 0.0)
                    || followers.any(|(follower, _)| follower == parameter))
        };
        let mut parameters: Vec<Parameter> = Parameter::ALL.to_vec();
        parameters.retain(is_moved);
        let mut rows = directions(problem, at, (&parameters, point.drive_frequency()));
        let moved = |end: fn(&Zone) -> &ZoneEnd| {
            let border = Border::at_end(&point.zone.scene, end(&point.zone), &parameters);
            let by_normal = |border: Border| {
                let rows = directions(problem, at, (&parameters, border.frequency()));
                let moved = rows.iter().map(|row| -dot(&border.normal, row));
                moved.collect::<Vec<f64>>()
            };
            let frequency = |other: &Design| Some(vec![end(&other.zone).frequency]);
            let differenced = || Some(differences(problem, at, &frequency)?.concat());
            border.ok().map(by_normal).or_else(differenced)
        };
        let low = moved(|zone| &zone.low)?;
        let mut high = moved(|zone| &zone.high)?;
        high.truncate(rows.len());
        let width = point.zone.frequency_width();
        let share = point.place;
        let ends = low.iter().zip(&high);
        // How the frequency of this place changes.
        let mut moved: Vec<f64> = ends.map(|(low, high)| low + share * (high - low)).collect();
        let mut frequency = match at.place {
            Some(_) => moved.clone(),
            None => vec![0.0; moved.len()],
        };
        if at.place.is_some() {
            rows.push(vec![0.0; parameters.len()]);
            high.push(0.0);
            moved.push(0.0);
            frequency.push(width);
        }
        if let Some(given) = given {
            given.clone_into(&mut frequency);
        }
        let pairs = frequency.iter().zip(&moved);
        let place = pairs.map(|(own, moved)| (own - moved) / width).collect();
        let rate = |parameter: &Parameter| {
            let known = followers.iter().find(|(own, _)| own == parameter);
            known.map_or(0.0, |(_, rate)| *rate)
        };
        let along = parameters.iter().map(rate).chain([1.0]).collect();
        parameters.push(Parameter::Frequency);
        Some(Self {
            problem,
            at,
            point,
            slopes: derivatives::differentiate_orbit(&point.orbit, &parameters).ok()?,
            directions: rows,
            along,
            frequency,
            high,
            place,
        })
    }

    /// The derivatives of a figure by the coordinates; none if it is not among those that have exact ones.
    pub(super) fn by(&self, figure: Figure, motion: &ZoneMotion<'_>) -> Option<Vec<f64>> {
        let minus = |a: &[f64], b: &[f64]| Some(a.iter().zip(b).map(|(a, b)| a - b).collect());
        let (_, parameters) = self.slopes.parameters.split_last()?;
        let above = |border: &Border| {
            let rows = directions(self.problem, self.at, (parameters, border.frequency()));
            let place = self.at.place.map(|_| Vec::new());
            let moved = rows
                .iter()
                .chain(&place)
                .map(|row| dot(&border.normal, row));
            let both = moved.zip(&self.frequency);
            both.map(|(moved, own)| own + moved).collect::<Vec<f64>>()
        };
        match figure {
            Figure::FrequencySn if motion.ends_within_zone() => None,
            Figure::FrequencyG0 => {
                let border = Border::at_g0(&motion.orbit.scene, true, parameters);
                Some(above(&border.ok()?))
            }
            Figure::FrequencySn if motion.zone.high.is_critical(TestFunction::Fold) => {
                minus(&self.high, &self.frequency)
            }
            Figure::FrequencyPd if motion.is_flip_above() => minus(&self.high, &self.frequency),
            Figure::FrequencyPd => {
                let flip =
                    loss_of_stability(motion.orbit, Direction::Down, TestFunction::Flip).ok()??;
                let scene = &motion.orbit.scene;
                let border = Border::at_special(scene, 1, (TestFunction::Flip, &flip), parameters);
                Some(above(&border.ok()?))
            }
            Figure::Share if motion.place < 0.5 => Some(self.place.clone()),
            Figure::Share => Some(self.place.iter().map(|by| -by).collect()),
            _ => {
                let motion = (motion.orbit, &motion.stroke);
                let cost = self.problem.cost.as_ref();
                rates((figure, cost), &self.slopes, motion).map(|by| self.total(&by))
            }
        }
    }

    /// The chain rule.
    fn total(&self, by: &[f64]) -> Vec<f64> {
        let by_frequency = dot(by, &self.along);
        let pairs = self.directions.iter().zip(&self.frequency);
        pairs
            .map(|(row, frequency)| dot(by, row) + frequency * by_frequency)
            .collect()
    }
}

/// By each coordinate of the cube that is moved, the change of some parameters in SI units at a frequency of the drive.
fn directions(
    problem: &Problem,
    at: &SearchPoint<'_>,
    (parameters, frequency): (&[Parameter], f64),
) -> Vec<Vec<f64>> {
    let change = match problem.machine.ties.is_empty() {
        true => CHANGE,
        false => SMALL_CHANGE,
    };
    let values = |machine: Machine| {
        let scene = machine.scene.at_frequency(frequency);
        let values = parameters.iter().map(|it| it.get(&scene).unwrap_or(0.0));
        Some(values.collect())
    };
    machine_differences((problem, at), change, values).unwrap_or_default()
}
