//! Range checks: a scene that passes them can be simulated.

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
}
