//! A problem in its cases, and what is sought over all of them. A case is a problem of its own, whose drive runs at the frequency
//! of the drawing's, or at its own if that is held.

use softstop::{Dimension, Parameter};
use softstop_dynamics::Orbit;
use softstop_dynamics::zone::ZoneKind;

use super::Design;
use super::case::Case;
use super::figure::Figure;
use super::problem::{Objective, Problem};
use super::requirement::Scope;
use super::slope::{Slope, unit_row};
use super::space::Interval;
use crate::robust::{FITTED, Tolerances};

impl Problem {
    /// The problem of each case alone.
    pub fn in_cases(&self) -> Vec<Self> {
        self.cases.iter().map(|case| self.in_case(case)).collect()
    }

    fn in_case(&self, case: &Case) -> Self {
        let drawing = Self {
            cases: Vec::new(),
            ..self.clone()
        };
        let own = case.value(Parameter::Frequency).map(Interval::held);
        let frequency = match own {
            Some(own) => own,
            None if self.frequency.is_held() => self.frequency,
            None => Interval::ANY,
        };
        let si = |value: f64| self.machine.to_si(Dimension::Frequency, value);
        let zone = match (self.zone, own) {
            (ZoneKind::SingleImpact { .. }, Some(own)) => ZoneKind::SingleImpact {
                between: (si(own.low), si(own.high)),
            },
            (zone, _) => zone,
        };
        let mut objective = self.objective;
        if case.weight == 0.0 {
            objective.scope = Scope::Drawing;
        }
        Self {
            changes: case.changes.clone(),
            zone,
            frequency,
            objective,
            drawing: (!frequency.is_held()).then(|| Box::new(drawing.clone())),
            ..drawing
        }
    }

    /// True if the frequency is given, so that the place in the zone follows from it.
    pub(super) fn has_given_frequency(&self) -> bool {
        self.frequency.is_held() || self.drawing.is_some()
    }

    /// The weights of the drawing and of each case.
    pub(super) fn weights(&self) -> impl Iterator<Item = f64> {
        [1.0]
            .into_iter()
            .chain(self.cases.iter().map(|it| it.weight))
    }

    /// The tolerances from which machines about a design are drawn, each with the nominal motion, of the drawing and of each case;
    /// none if all is exact.
    pub fn drawn<'a>(&'a self, design: &'a Design) -> Option<Vec<(Tolerances, &'a Orbit)>> {
        let drawn = self.operating_points(design).into_iter().map(|it| {
            let spread = it.problem.spread(&it.design.machine)?;
            Some((spread.over(FITTED), &it.design.orbit))
        });
        drawn.collect()
    }

    /// What is sought, as a phrase after "the design with".
    pub fn words(&self) -> String {
        self.objective.words() + &self.over_cases()
    }

    /// Over which operating points that is meant, in words that follow it; empty if only the drawing counts.
    pub fn over_cases(&self) -> String {
        match self.weights().filter(|it| *it > 0.0).count() {
            1 => String::new(),
            count => format!(", weighted mean of {count} operating points"),
        }
    }

    /// What a design has of what is sought, in SI units: the weighted mean over the drawing and the cases.
    pub fn sought_of(&self, design: &Design) -> f64 {
        let values = design.points();
        self.mean(values.map(|it| it.value))
    }

    /// The weighted mean of a figure of the own machines of a design, in SI units; none if a motion has none.
    pub fn nominal_of(&self, figure: Figure, design: &Design) -> Option<f64> {
        let all = design.points();
        let values = all.map(|it| self.value_of_motion(figure, &it.orbit));
        Some(self.mean(values.collect::<Option<Vec<f64>>>()?.into_iter()))
    }

    /// The weighted mean of values of the drawing and of the cases.
    pub(super) fn mean(&self, values: impl Iterator<Item = f64>) -> f64 {
        let weighed: f64 = self
            .weights()
            .zip(values)
            .map(|(weight, it)| weight * it)
            .sum();
        weighed / self.weights().sum::<f64>()
    }
}

impl Objective {
    /// The score of the weighted mean of values by their weights and scores, with its derivatives by the scores.
    pub(super) fn mean_of(&self, scores: &[(f64, f64)]) -> Slope {
        let count = scores.len();
        let scores = scores.iter().enumerate();
        let scores = scores.map(|(index, (weight, value))| {
            let by = unit_row(count, Some(index)).collect();
            (*weight, Slope { value: *value, by })
        });
        self.mean(&scores.collect::<Vec<_>>())
    }

    /// The score of the weighted mean of values by their weights and scores.
    pub(super) fn mean(&self, scores: &[(f64, Slope)]) -> Slope {
        if let [(_, only)] = scores {
            return only.clone();
        }
        let sum: f64 = scores.iter().map(|(weight, _)| weight).sum();
        let mut mean = Slope {
            value: 0.0,
            by: vec![0.0; scores[0].1.by.len()],
        };
        for (weight, score) in scores {
            // The value of a score is the score of that.
            let value = self.slope(score.clone());
            mean.value += weight / sum * value.value;
            for (mean, by) in mean.by.iter_mut().zip(value.by) {
                *mean += weight / sum * by;
            }
        }
        self.slope(mean)
    }
}
