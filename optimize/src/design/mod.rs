//! The search for the hardest impact inside the hysteresis zone.
//!
//! Stiffness k4/k1 and clearance rho are searched in a box; the frequency is written as
//! eta = g0 + s (eta_SN - g0) with s in [M, 1 - M], so that every point that has a zone is
//! feasible. The zone does not depend on s: for each (k4, rho) it is computed once and the
//! best s is then found along it ([`along`]). [`search`] drives the outer search.

pub mod along;
pub mod search;
pub mod space;

use softstop::Ratios;
use softstop_dynamics::orbit::Orbit;
use softstop_dynamics::zone::{self, Zone, ZoneError};

use softstop_console::machine::Machine;
use space::Interval;

/// What is searched, and where.
#[derive(Debug, Clone, Copy)]
pub struct Problem {
    /// The machine; its own stiffness, clearance and frequency play no part.
    pub machine: Machine,
    /// Least distance M of s from 0 and 1, in [0, 0.5].
    pub margin: f64,
    /// Stop stiffness k4/k1.
    pub stiffness: Interval,
    /// Clearance rho.
    pub clearance: Interval,
    /// Drive frequency eta, intersected with the zone.
    pub frequency: Interval,
}

/// A feasible point and the motion there.
#[derive(Debug, Clone)]
pub struct Design {
    /// The machine at the design's stiffness, clearance and frequency.
    pub ratios: Ratios,
    /// Place in the zone: 0 at g0, 1 at s_SN.
    pub place: f64,
    /// The zone of the design's stiffness and clearance.
    pub zone: Zone,
    /// The z = 1 motion.
    pub orbit: Orbit,
}

impl Design {
    /// Velocity at which the mass reaches the clearance, in units of sqrt(F0^2/(m k1)).
    #[must_use]
    pub fn before_impact_velocity(&self) -> f64 {
        self.orbit.before_impact_velocity()
    }
}

/// A point without a feasible motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Infeasible {
    /// How far from feasible, finite and >= 0: what the search descends along.
    pub gap: f64,
    /// Why, in words.
    pub reason: String,
}

impl Problem {
    /// The best frequency at one stiffness and clearance.
    ///
    /// # Errors
    /// [`Infeasible`] if there is no zone, or none of it is allowed and stable.
    pub fn at(&self, stiffness: f64, clearance: f64) -> Result<Design, Infeasible> {
        let ratios = self.machine.at(stiffness, clearance);
        let zone = ratios.scene().map_err(ZoneError::from);
        let zone = zone.and_then(|scene| zone::hysteresis(&scene));
        let zone = zone.map_err(|error| Infeasible {
            gap: self.distance_from_zones(&ratios),
            reason: error.to_string(),
        })?;
        let window = self.window(&zone)?;
        let (place, orbit) = along::best(&zone, window)?;
        let ratios = Ratios {
            frequency: zone.frequency_at(place),
            ..ratios
        };
        Ok(Design {
            ratios,
            place,
            zone,
            orbit,
        })
    }

    /// The places s that margin and frequency bounds leave of a zone.
    fn window(&self, zone: &Zone) -> Result<Interval, Infeasible> {
        let width = zone.frequency_sn - zone.frequency_g0;
        let place = |frequency: f64| (frequency - zone.frequency_g0) / width;
        let low = self.margin.max(place(self.frequency.low));
        let high = (1.0 - self.margin).min(place(self.frequency.high));
        if low <= high {
            return Ok(Interval { low, high });
        }
        Err(Infeasible {
            gap: finite_or(low - high, DISTANT),
            reason: format!(
                "the frequencies allowed by bounds and margin ({}) lie outside the zone {:.6} to {:.6}",
                self.frequency, zone.frequency_g0, zone.frequency_sn
            ),
        })
    }

    /// A grade for points without a zone. Above resonance g0 exists only for clearances between
    /// 0 and the resonance peak of the motion without impacts, 1/(2 beta1 sqrt(1 - beta1^2)):
    /// the farther from there, the worse. Elsewhere all points count as equally distant.
    fn distance_from_zones(&self, ratios: &Ratios) -> f64 {
        let beta1 = ratios.damping;
        let peak = 1.0 / (2.0 * beta1 * (1.0 - beta1 * beta1).sqrt());
        let beyond = (ratios.clearance / peak - 1.0)
            .max(-ratios.clearance)
            .max(0.0);
        DISTANT + finite_or(beyond, 0.0)
    }
}

/// The gap of a point of which nothing better is known.
const DISTANT: f64 = 10.0;

fn finite_or(value: f64, otherwise: f64) -> f64 {
    if value.is_finite() { value } else { otherwise }
}
