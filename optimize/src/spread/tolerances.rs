//! A machine with its tolerances: a box about it.

use softstop::{Allowed, Machine, Parameter, Scene, SceneError};
use softstop_dynamics::Orbit;
use softstop_dynamics::figure::Figure;

use super::distribution::Distribution;
use crate::design::cost::{Cost, value_of_orbit};

/// How far a parameter may lie from its design value, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AbsoluteTolerance {
    /// Which one; the drive's frequency may be one of them.
    pub parameter: Parameter,
    /// By so much to either side, in SI units: in m for a preload that is stated as a deflection.
    pub half_width: f64,
    /// How the values of the machines lie that are built.
    pub distribution: Distribution,
}

/// A machine with its tolerances. What is linked stays so: a preload stated as a deflection follows the stiffness.
#[derive(Debug, Clone)]
pub struct Tolerances {
    machine: Machine,
    tolerances: Vec<AbsoluteTolerance>,
    cost: Option<Cost>,
}

impl Tolerances {
    /// Tolerances about a machine whose drive runs at its design frequency.
    ///
    /// # Errors
    /// [`SceneError`] for a machine that is none or lacks one of the parameters, or a half-width that is not positive.
    pub fn new(machine: &Machine, tolerances: &[AbsoluteTolerance]) -> Result<Self, SceneError> {
        machine.validate()?;
        for tolerance in tolerances {
            let name = machine.name(tolerance.parameter);
            let value = machine.value(tolerance.parameter);
            value.ok_or(SceneError::Lacks(name))?;
            Allowed::Positive.check(name, tolerance.half_width)?;
        }
        Ok(Self {
            machine: Machine {
                name: None,
                description: None,
                ..machine.clone()
            },
            tolerances: tolerances.to_vec(),
            cost: None,
        })
    }

    /// With the formula of what its machines cost.
    #[must_use]
    pub fn with_cost(self, cost: Option<Cost>) -> Self {
        Self { cost, ..self }
    }

    /// The value of a figure of a motion of one of the machines; none if it has none, or not by itself.
    pub(crate) fn value(&self, figure: Figure, orbit: &Orbit) -> Option<f64> {
        value_of_orbit((figure, self.cost.as_ref()), orbit)
    }

    /// The formula of what its machines cost.
    pub(crate) fn cost(&self) -> Option<&Cost> {
        self.cost.as_ref()
    }

    /// The tolerances, in the order of the coordinates.
    pub fn all(&self) -> &[AbsoluteTolerance] {
        &self.tolerances
    }

    /// The box with normal tolerances of so many standard deviations to either side.
    #[must_use]
    pub fn over(&self, deviations: f64) -> Self {
        let mut all = self.clone();
        for tolerance in &mut all.tolerances {
            let (distribution, factor) = tolerance.distribution.over(deviations);
            tolerance.half_width *= factor;
            tolerance.distribution = distribution;
        }
        all
    }

    /// The machine at some coordinates.
    pub fn machine(&self, at: &[f64]) -> Machine {
        let mut machine = self.machine.clone();
        for (tolerance, at) in self.tolerances.iter().zip(at) {
            let parameter = tolerance.parameter;
            let change = machine.to_own(parameter.about().dimension, at * tolerance.half_width);
            if let Some(value) = machine.value(parameter) {
                machine.set(parameter, value + change);
            }
        }
        machine
    }

    /// How many coordinates there are.
    pub fn dimensions(&self) -> usize {
        self.tolerances.len()
    }

    /// The scene of the machine at some coordinates, its drive included; it need not be valid.
    pub fn scene(&self, at: &[f64]) -> Scene {
        self.machine(at).scene
    }

    /// The coordinates of a machine that is built, from ones that are spread evenly between -1 and 1.
    pub fn draw(&self, even: &[f64]) -> Vec<f64> {
        let pairs = self.tolerances.iter().zip(even);
        pairs
            .map(|(it, even)| it.distribution.draw(*even))
            .collect()
    }
}
