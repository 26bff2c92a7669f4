//! What a design costs: an expression of its task over the machine's parameters and figures of its motion.

use std::fmt::{self, Debug, Formatter};
use std::sync::Arc;

use softstop::internals::{Differentiated, Expression, chain_rule_product};
use softstop::{Machine, Parameter};
use softstop_dynamics::derivatives::OrbitDerivatives;
use softstop_dynamics::{CycleMetrics, Orbit};

use super::figure::Figure;

/// A cost, a bare number.
#[derive(Clone)]
pub struct Cost(Arc<Formula>);

struct Formula {
    text: String,
    expression: Expression,
    /// What the names of the expression stand for, with the unit of each in SI units.
    terms: Vec<(Term, f64)>,
}

/// What a name stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Term {
    /// A figure that a motion tells by itself.
    Figure(Figure),
    /// A parameter of the machine.
    Parameter(Parameter),
    /// The preload as a deflection of the stop.
    PreloadDeflection,
}

/// The text alone: a problem states its machine beside it.
impl Debug for Cost {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        Debug::fmt(&self.0.text, formatter)
    }
}

impl Term {
    /// What a name stands for in a machine, and its unit in SI units; none for what is no figure of a motion and no parameter.
    pub fn named(machine: &Machine, name: &str) -> Option<(Self, f64)> {
        let si = |dimension| machine.to_si(dimension, 1.0);
        if let Some(figure) = Figure::named(name) {
            let is_allowed = figure.is_of_motion() && figure != Figure::Cost;
            return is_allowed.then(|| (Self::Figure(figure), si(figure.dimension())));
        }
        let (parameter, unit) = machine.stated(name).ok()?;
        let is_deflection = parameter == Parameter::Preload && machine.preload_deflection.is_some();
        Some(match is_deflection {
            true => (Self::PreloadDeflection, 1.0),
            false => (
                Self::Parameter(parameter),
                si(parameter.about().dimension) * unit,
            ),
        })
    }

    /// Its value in SI units; NaN if there is none.
    fn value(self, (orbit, stroke): (&Orbit, &CycleMetrics)) -> f64 {
        let own = |parameter: Parameter| parameter.get(&orbit.scene).unwrap_or(f64::NAN);
        match self {
            Self::Figure(figure) => figure.of_motion(orbit, stroke).unwrap_or(f64::NAN),
            Self::Parameter(parameter) => own(parameter),
            Self::PreloadDeflection => own(Parameter::Preload) / own(Parameter::StopStiffness),
        }
    }

    /// Its derivatives by the parameters of slopes, those of figures being given by `rates`.
    fn by(
        self,
        slopes: &OrbitDerivatives,
        orbit: &Orbit,
        rates: impl Fn(Figure) -> Option<Vec<f64>>,
    ) -> Option<Vec<f64>> {
        let none = vec![0.0; slopes.parameters.len()];
        match self {
            Self::Figure(figure) => rates(figure),
            Self::Parameter(parameter) => Some(plus(slopes, none, parameter, 1.0)),
            Self::PreloadDeflection => {
                let preload = Parameter::Preload.get(&orbit.scene)?;
                let stiffness = Parameter::StopStiffness.get(&orbit.scene)?;
                let by_stiffness = -preload / (stiffness * stiffness);
                let by = plus(slopes, none, Parameter::StopStiffness, by_stiffness);
                Some(plus(slopes, by, Parameter::Preload, stiffness.recip()))
            }
        }
    }
}

impl Cost {
    /// A cost by an expression and what its names stand for, each with its unit.
    pub fn new(text: &str, expression: Expression, terms: Vec<(Term, f64)>) -> Self {
        let text = text.to_owned();
        Self(Arc::new(Formula {
            text,
            expression,
            terms,
        }))
    }

    /// Its value and its derivatives by its terms, each in its own unit.
    fn at(&self, motion: (&Orbit, &CycleMetrics)) -> Differentiated {
        let values = self.0.terms.iter();
        let values = values.map(|(term, unit)| term.value(motion) / unit);
        self.0.expression.eval(&values.collect::<Vec<f64>>())
    }

    /// Its value; NaN if it has none.
    pub fn value(&self, orbit: &Orbit, stroke: &CycleMetrics) -> f64 {
        self.at((orbit, stroke)).value
    }

    /// Its derivatives by the parameters of slopes, by the chain rule on those of figures; none if a figure has none.
    pub fn rates(
        &self,
        slopes: &OrbitDerivatives,
        (orbit, stroke): (&Orbit, &CycleMetrics),
        rates: impl Fn(Figure) -> Option<Vec<f64>>,
    ) -> Option<Vec<f64>> {
        let outer = self.at((orbit, stroke)).by;
        let mut total = vec![0.0; slopes.parameters.len()];
        for ((term, unit), outer) in self.0.terms.iter().zip(outer) {
            let inner = term.by(slopes, orbit, &rates)?;
            for (total, inner) in total.iter_mut().zip(inner) {
                *total += chain_rule_product(outer, inner / unit);
            }
        }
        Some(total)
    }
}

/// Derivatives by parameters, with one more by one of them.
pub(crate) fn plus(
    slopes: &OrbitDerivatives,
    mut by: Vec<f64>,
    parameter: Parameter,
    more: f64,
) -> Vec<f64> {
    let mut pairs = slopes.parameters.iter().zip(&mut by);
    if let Some((_, by)) = pairs.find(|(own, _)| **own == parameter) {
        *by += more;
    }
    by
}

/// The value as of [`value_of_motion`] of an orbit whose metrics are not known.
pub fn value_of_orbit((figure, cost): (Figure, Option<&Cost>), orbit: &Orbit) -> Option<f64> {
    let value = match figure {
        Figure::Cost => cost?.value(orbit, &CycleMetrics::of(orbit).ok()?),
        _ => figure.of_orbit(orbit).ok()??,
    };
    (!value.is_nan()).then_some(value)
}

/// The value of a figure that a motion tells by itself, or of what its design costs, in SI units, infinite if nothing
/// bounds it; none if there is none.
pub fn value_of_motion(
    (figure, cost): (Figure, Option<&Cost>),
    orbit: &Orbit,
    stroke: &CycleMetrics,
) -> Option<f64> {
    let value = match figure {
        Figure::Cost => cost?.value(orbit, stroke),
        _ => figure.of_motion(orbit, stroke)?,
    };
    (!value.is_nan()).then_some(value)
}
