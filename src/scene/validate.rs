//! Range checks, also of how far time scales lie apart: a scene that passes them can be simulated.

use super::{Allowed, Parameter, Scene, Slope, Stop, force_of};
use crate::error::SceneError;

/// Refuses slopes out of order, and a way back that would give more than the way forward took.
fn check_slopes(loading: &[Slope], unloading: &[Slope]) -> Result<(), SceneError> {
    if loading.is_empty() {
        return Err(SceneError::NoSlope);
    }
    check_order("stop.loading", loading)?;
    check_order("stop.unloading", unloading)?;
    if unloading.is_empty() {
        return Ok(());
    }
    let ends = loading.iter().chain(unloading).map(|slope| slope.from);
    let last = ends.clone().fold(0.0, f64::max);
    for deflection in ends.chain([2.0 * last + 1.0]) {
        let (taken, given) = (
            force_of(loading, deflection),
            force_of(unloading, deflection),
        );
        // Curves that coincide may differ by rounding.
        if given > taken * (1.0 + 1e-12) {
            return Err(SceneError::GivesEnergy {
                deflection,
                given,
                taken,
            });
        }
    }
    Ok(())
}

fn check_order(list: &'static str, slopes: &[Slope]) -> Result<(), SceneError> {
    for (index, slope) in slopes.iter().enumerate() {
        let fits = match index.checked_sub(1) {
            None => slope.from == 0.0,
            Some(previous) => slope.from > slopes[previous].from,
        };
        let allowed = [slope.from, slope.stiffness].map(|value| Allowed::NotNegative.holds(value));
        if !fits || allowed != [true; 2] {
            return Err(SceneError::Slope {
                list,
                index,
                from: slope.from,
                stiffness: slope.stiffness,
            });
        }
    }
    Ok(())
}

impl Scene {
    /// Checks every parameter against its range.
    ///
    /// # Errors
    /// [`SceneError`] naming the first parameter that is out of range.
    pub fn validate(&self) -> Result<(), SceneError> {
        self.validate_parameters(&Parameter::ALL)
    }

    /// Checks a scene whose other parameters are known to be in their ranges.
    pub(crate) fn validate_parameters(&self, changed: &[Parameter]) -> Result<(), SceneError> {
        for parameter in changed {
            if let Some(value) = parameter.get(self) {
                parameter.check(value)?;
            }
        }
        self.validate_stop()?;
        self.validate_piercing()?;
        self.validate_below()
    }

    fn validate_stop(&self) -> Result<(), SceneError> {
        if let Stop::PiecewiseLinear { loading, unloading } = &self.stop {
            check_slopes(loading, unloading)?;
        }
        self.validate_time_scales()
    }

    fn validate_below(&self) -> Result<(), SceneError> {
        let Some(mirrored) = self.mirrored() else {
            return Ok(());
        };
        let (clearance, below) = (self.clearance, mirrored.clearance);
        let both_stand = self.has_stop() && mirrored.has_stop();
        if both_stand && clearance + below <= 0.0 {
            return Err(SceneError::NoWay { clearance, below });
        }
        let below = mirrored.validate_stop();
        below.map_err(|error| SceneError::Below(Box::new(error)))
    }

    fn validate_piercing(&self) -> Result<(), SceneError> {
        let Some(strip) = self.piercing else {
            return Ok(());
        };
        if strip.thickness + strip.travel == 0.0 {
            return Err(SceneError::EmptyPiercing {
                thickness: strip.thickness,
                travel: strip.travel,
            });
        }
        Ok(())
    }

    /// Refuses springs and dampers so fast beside the drive that doubles do not resolve them.
    pub(super) fn validate_time_scales(&self) -> Result<(), SceneError> {
        let frequency = self.excitation.frequency;
        let least = SPRING.least_frequency(self.stiffness / self.mass);
        if frequency < least {
            return Err(SceneError::TimeScales {
                name: Parameter::Frequency.name(),
                value: frequency,
                bound: "at least",
                limit: least,
            });
        }
        for (name, value, rate) in self.springs_and_dampers() {
            check_at_most(name, value, self.mass * rate.largest_constant(frequency))?;
        }
        match self.stop {
            Stop::Hertz {
                stiffness,
                exponent,
                dissipation,
            } => self.validate_power_law(stiffness, exponent, dissipation),
            _ => Ok(()),
        }
    }

    /// Springs and dampers but the suspension and power laws: names, constants and limits of their rates.
    fn springs_and_dampers(&self) -> Vec<(&'static str, f64, LargestRate)> {
        use Parameter as P;
        let parameters = P::ALL.into_iter().filter_map(|parameter| {
            let rate = match parameter {
                P::StopStiffness if matches!(self.stop, Stop::Hertz { .. }) => return None,
                P::StopStiffness | P::PiercingStiffness | P::PiercingFriction => SPRING,
                P::Damping | P::ContactDamping => DAMPER,
                _ => return None,
            };
            Some((parameter.name(), parameter.get(self)?, rate))
        });
        let slopes: &[(&'static str, &[Slope])] = match &self.stop {
            Stop::PiecewiseLinear { loading, unloading } => {
                &[("stop.loading", loading), ("stop.unloading", unloading)]
            }
            _ => &[],
        };
        let slopes = slopes.iter().flat_map(|(name, slopes)| {
            let stiffnesses = slopes.iter().map(|slope| slope.stiffness);
            stiffnesses.map(|stiffness| (*name, stiffness, SPRING))
        });
        parameters.chain(slopes).collect()
    }

    /// The error of time scales that lie too far apart, as one of a parameter that was changed while all others are as they were:
    /// the mass or the frequency is too small, or the suspension too stiff. None if the parameter is none of these, or is not.
    pub(crate) fn time_scale_error_of(&self, changed: Parameter) -> Option<SceneError> {
        let (value, frequency) = (changed.get(self)?, self.excitation.frequency);
        let least = |limit_of: &dyn Fn(f64, LargestRate) -> f64| {
            let below = self.mirrored();
            let sides = [Some(self), below.as_ref()].into_iter().flatten();
            let all = sides.flat_map(Self::springs_and_dampers);
            let limits = all.map(|(_, constant, rate)| limit_of(constant, rate));
            limits.fold(limit_of(self.stiffness, SPRING), f64::max)
        };
        let (bound, limit) = match changed {
            Parameter::Mass => {
                let mass =
                    |constant, rate: LargestRate| constant / rate.largest_constant(frequency);
                ("at least", least(&mass))
            }
            Parameter::Frequency => {
                let frequency =
                    |constant, rate: LargestRate| rate.least_frequency(constant / self.mass);
                ("at least", least(&frequency))
            }
            Parameter::Suspension => ("at most", self.mass * SPRING.largest_constant(frequency)),
            _ => return None,
        };
        let is_beyond = match bound {
            "at least" => value < limit,
            _ => value > limit,
        };
        is_beyond.then_some(SceneError::TimeScales {
            name: changed.name(),
            value,
            bound,
            limit,
        })
    }

    /// Refuses a power law that takes all of the energy, or of the speed, of a motion within too small a depth.
    fn validate_power_law(
        &self,
        stiffness: f64,
        exponent: f64,
        dissipation: f64,
    ) -> Result<(), SceneError> {
        let motion = self.motion_scales();
        let speed = motion.speed();
        let depth = motion.length / MAX_SPRING_RATE;
        let taken = (exponent + 1.0) * self.mass * speed / depth.powf(exponent + 1.0);
        check_at_most(
            Parameter::StopStiffness.name(),
            stiffness,
            0.5 * taken * speed,
        )?;
        if stiffness * dissipation > taken {
            check_at_most(
                Parameter::Dissipation.name(),
                dissipation,
                taken / stiffness,
            )?;
        }
        Ok(())
    }
}

/// Largest rate sqrt(k/m) of a spring, in units of the drive's frequency: up to it a contact keeps eight digits of the motion,
/// as positions are rounded to 2^-53 of the clearance and a contact is this many times shallower than a motion is wide.
pub const MAX_SPRING_RATE: f64 = 1e7;
/// Largest rate b/m of a damper, in units of the drive's frequency: beyond it nothing is left of a contact, as a mass that creeps
/// back leaves so slowly that only its position tells when. Up to 1e6 eight digits hold.
pub const MAX_DAMPER_RATE: f64 = 1e9;

/// The largest rate of a spring or damper of unit mass, in units of the drive's frequency; its constant is a power of the rate.
#[derive(Clone, Copy)]
struct LargestRate {
    rate: f64,
    power: i32,
}

const SPRING: LargestRate = LargestRate {
    rate: MAX_SPRING_RATE,
    power: 2,
};
const DAMPER: LargestRate = LargestRate {
    rate: MAX_DAMPER_RATE,
    power: 1,
};

impl LargestRate {
    /// The largest constant for one unit of mass, at a frequency of the drive.
    fn largest_constant(self, frequency: f64) -> f64 {
        (self.rate * frequency).powi(self.power)
    }

    /// The least frequency of the drive with this constant for one unit of mass.
    fn least_frequency(self, constant: f64) -> f64 {
        constant.powf(1.0 / f64::from(self.power)) / self.rate
    }
}

fn check_at_most(name: &'static str, value: f64, most: f64) -> Result<(), SceneError> {
    if value <= most {
        return Ok(());
    }
    Err(SceneError::TimeScales {
        name,
        value,
        bound: "at most",
        limit: most,
    })
}
