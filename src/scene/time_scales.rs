//! How far the time scales of a machine may lie apart.

use super::{Parameter, Scene, Slope, Stop};
use crate::error::SceneError;

/// Largest rate sqrt(k/m) of a spring, in units of the drive's frequency: up to it a contact keeps eight digits of the motion,
/// as positions are rounded to 2^-53 of the clearance and a contact is this many times shallower than a motion is wide.
pub const MAX_SPRING_RATE: f64 = 1e7;
/// Largest rate b/m of a damper, in units of the drive's frequency: beyond it nothing is left of a contact, as a mass that creeps
/// back leaves so slowly that only its position tells when. Up to 1e6 eight digits hold.
pub const MAX_DAMPER_RATE: f64 = 1e9;

impl Scene {
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
                check_slopes("stop.loading", loading, spring)?;
                check_slopes("stop.unloading", unloading, spring)
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

fn check_slopes(name: &'static str, slopes: &[Slope], most: f64) -> Result<(), SceneError> {
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
