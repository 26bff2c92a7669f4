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
        let least = (self.stiffness / self.mass).sqrt() / MAX_SPRING_RATE;
        if frequency < least {
            return Err(SceneError::TimeScales {
                name: Parameter::Frequency.name(),
                value: frequency,
                bound: "at least",
                limit: least,
            });
        }
        let rate = MAX_SPRING_RATE * frequency;
        let spring = self.mass * rate * rate;
        let damper = self.mass * MAX_DAMPER_RATE * frequency;
        for parameter in Parameter::ALL {
            use Parameter as P;
            let most = match parameter {
                P::StopStiffness if matches!(self.stop, Stop::Hertz { .. }) => continue,
                P::StopStiffness | P::PiercingStiffness | P::PiercingFriction => spring,
                P::Damping | P::ContactDamping => damper,
                _ => continue,
            };
            if let Some(value) = parameter.get(self) {
                check_at_most(parameter.name(), value, most)?;
            }
        }
        match &self.stop {
            Stop::PiecewiseLinear { loading, unloading } => {
                check_stiffnesses("stop.loading", loading, spring)?;
                check_stiffnesses("stop.unloading", unloading, spring)
            }
            Stop::Hertz {
                stiffness,
                exponent,
                dissipation,
            } => self.validate_power_law(*stiffness, *exponent, *dissipation),
            _ => Ok(()),
        }
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

fn check_stiffnesses(name: &'static str, slopes: &[Slope], most: f64) -> Result<(), SceneError> {
    let each = |slope: &Slope| check_at_most(name, slope.stiffness, most);
    slopes.iter().try_for_each(each)
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
