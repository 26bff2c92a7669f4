//! The frequencies at which a whole box of tolerances stays inside the zone: each end of the zone is taken at the corner of
//! the box that brings it nearest, which the signs of its normal name (Moennigmann and Marquardt 2002).

use softstop::{Dimension, Machine, Parameter};
use softstop_dynamics::Zone;
use softstop_dynamics::continuation::Test;
use softstop_dynamics::slopes::Border;
use softstop_dynamics::zone::grazing_frequencies;

use super::Infeasible;
use super::problem::{Problem, Tolerance, Width};

/// An end of the zone at the corner of the box where it is nearest.
#[derive(Debug, Clone)]
pub(super) struct Edge {
    /// Its frequency in rad/s, less the tolerance of the frequency itself.
    pub frequency: f64,
    /// Its derivatives by the parameters of the nominal machine, in SI units, in the order of `Parameter::ALL`.
    pub by: Vec<f64>,
}

impl Edge {
    fn stretch(&mut self, factor: f64) {
        self.frequency *= factor;
        self.by.iter_mut().for_each(|by| *by *= factor);
    }
}

/// Both ends.
#[derive(Debug, Clone)]
pub(super) struct BoxWindow {
    /// That of g0.
    pub low: Edge,
    /// That of `s_SN`.
    pub high: Edge,
}

/// How often a corner is chosen anew by the normal there.
const CORNERS: usize = 3;

impl BoxWindow {
    /// Of a machine with this zone.
    ///
    /// # Errors
    /// [`Infeasible`] if a corner has no zone.
    pub(super) fn of(
        problem: &Problem,
        machine: &Machine,
        zone: &Zone,
    ) -> Result<Self, Infeasible> {
        let corner = Corner { problem, machine };
        let mut low = corner.g0(machine)?;
        let mut high = corner.sn(zone)?;
        for _ in 0..CORNERS {
            let signs = signs(&low.by);
            low = corner.g0(&corner.at(&signs))?;
            if self::signs(&low.by) == signs {
                corner.scale(&mut low, &signs);
                break;
            }
        }
        for _ in 0..CORNERS {
            let signs = signs(&high.by).map(|sign| -sign);
            let machine = corner.at(&signs);
            let zone = problem.zone(&machine).map_err(|error| Infeasible {
                gap: super::DISTANT,
                reason: format!("a machine within the tolerances has no zone: {error}"),
            })?;
            high = corner.sn(&zone)?;
            if self::signs(&high.by).map(|sign| -sign) == signs {
                corner.scale(&mut high, &signs);
                break;
            }
        }
        let is_speed = |it: &&Tolerance| it.parameter == Parameter::Frequency;
        match problem.tolerances.iter().find(is_speed).map(|it| it.width) {
            Some(Width::Own(width)) => {
                let width = machine.to_si(Dimension::Frequency, width);
                low.frequency += width;
                high.frequency -= width;
            }
            // w (1 - share) stays above the lower edge, w (1 + share) below the upper one.
            Some(Width::Share(share)) => {
                low.stretch(1.0 / (1.0 - share));
                high.stretch(1.0 / (1.0 + share));
            }
            None => {}
        }
        Ok(Self { low, high })
    }
}

const COUNT: usize = Parameter::ALL.len();

/// Signs of derivatives.
fn signs(by: &[f64]) -> [f64; COUNT] {
    std::array::from_fn(|index| if by[index] < 0.0 { -1.0 } else { 1.0 })
}

struct Corner<'a> {
    problem: &'a Problem,
    machine: &'a Machine,
}

impl Corner<'_> {
    /// The machine at a corner.
    fn at(&self, signs: &[f64; COUNT]) -> Machine {
        let mut corner = self.machine.clone();
        for tolerance in self
            .problem
            .tolerances
            .iter()
            .filter(|it| it.parameter != Parameter::Frequency)
        {
            if let Some(value) = self.machine.value(tolerance.parameter) {
                let sign = signs[tolerance.parameter as usize];
                corner.set(
                    tolerance.parameter,
                    value + sign * tolerance.width.around(value),
                );
            }
        }
        corner
    }

    /// Parameters that the machine has, but the frequency.
    fn parameters(&self) -> Vec<Parameter> {
        let all = self.machine.scene.clone();
        let has = |it: &Parameter| {
            *it != Parameter::Frequency && *it != Parameter::Phase && it.get(&all).is_some()
        };
        Parameter::ALL.into_iter().filter(has).collect()
    }

    fn edge(&self, frequency: f64, border: &Border) -> Edge {
        let mut by = vec![0.0; COUNT];
        for (parameter, normal) in border.parameters.iter().zip(&border.normal) {
            by[*parameter as usize] = -normal;
        }
        Edge { frequency, by }
    }

    fn g0(&self, machine: &Machine) -> Result<Edge, Infeasible> {
        let lost = |reason: String| Infeasible {
            gap: super::DISTANT,
            reason,
        };
        let border = Border::free(&machine.scene, true, &self.parameters())
            .map_err(|error| lost(error.to_string()))?;
        let (_, above) =
            grazing_frequencies(&machine.scene).map_err(|error| lost(error.to_string()))?;
        Ok(self.edge(above, &border))
    }

    fn sn(&self, zone: &Zone) -> Result<Edge, Infeasible> {
        let fold = (Test::Fold, &zone.fold);
        let border =
            Border::critical(&zone.scene, 1, fold, &self.parameters()).map_err(|error| {
                Infeasible {
                    gap: super::DISTANT,
                    reason: error.to_string(),
                }
            })?;
        Ok(self.edge(zone.frequency_sn, &border))
    }

    /// A tolerance that is a share of its value grows with that.
    fn scale(&self, edge: &mut Edge, signs: &[f64; COUNT]) {
        for tolerance in &self.problem.tolerances {
            if let Width::Share(share) = tolerance.width {
                let index = tolerance.parameter as usize;
                edge.by[index] *= 1.0 + signs[index] * share;
            }
        }
    }
}
