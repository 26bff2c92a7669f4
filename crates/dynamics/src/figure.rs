//! Figures that a motion of a machine is judged by: one list of their names, units, senses and meanings.

use crate::cycle_metrics::{CycleMetrics, depth_beyond_strip, peak_stop_force};
use crate::orbit::Orbit;
use softstop::{Dimension, MotionError, Scene, Stop};

/// The sense in which a figure is better: the side of a bound on which its values are good.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Sense {
    /// The bound is a least value: more is better.
    Least,
    /// The bound is a largest value: less is better.
    Most,
}

macro_rules! figures {
    ($($figure:ident $name:literal, $dimension:ident, $sense:ident, $trial:literal, $meaning:literal;)*) => {
        /// A figure of a motion and of its machine, which studies tell and tasks of optimisation bound or improve.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum Figure {
            $(#[doc = concat!("`", $name, "`: ", $meaning, ".")] $figure,)*
        }

        impl Figure {
            /// All figures.
            pub const ALL: &[Self] = &[$(Self::$figure),*];

            /// The key of the figure in task files and in JSON.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$figure => $name),* }
            }

            /// The physical dimension of the figure.
            pub const fn dimension(self) -> Dimension {
                match self { $(Self::$figure => Dimension::$dimension),* }
            }

            /// The side of a bound on which the figure is good, where a task gives a bare number.
            pub const fn sense(self) -> Sense {
                match self { $(Self::$figure => Sense::$sense),* }
            }

            /// True if the figure takes many simulated motions: it has no derivative.
            pub const fn is_trial(self) -> bool {
                match self { $(Self::$figure => $trial),* }
            }

            /// What the figure is, in a few words.
            pub const fn meaning(self) -> &'static str {
                match self { $(Self::$figure => $meaning),* }
            }
        }
    };
}

figures! {
    Velocity "velocity", Velocity, Least, false, "before-impact velocity";
    ImpactEnergy "impact_energy", Energy, Least, false, "kinetic energy before the impact";
    ImpactPower "impact_power", Power, Least, false, "impact energy per second";
    StrokeWork "stroke_work", Energy, Least, false, "work done on the strip in a stroke";
    DriveForce "drive_force", Force, Most, false, "drive amplitude";
    DrivePower "drive_power", Power, Most, false, "mean power of the drive";
    MaxPosition "max_position", Length, Most, false, "largest position X_m";
    Stroke "stroke", Length, Most, false, "largest less smallest position";
    StopForce "stop_force", Force, Most, false, "peak contact force while a stop is touched";
    StopDeflection "stop_deflection", Length, Most, false, "largest deflection of a stop";
    CutThrough "cut_through", Length, Least, false, "depth of X_m beyond the end of the strip";
    RigidGap "rigid_gap", Length, Least, false, "distance from X_m to the rigid stop behind";
    Multiplier "largest_multiplier", Number, Most, false, "largest multiplier |mu|";
    Share "margin", Number, Least, false, "distance from both ends of the zone, as a share of it";
    FrequencyG0 "margin_g0", Frequency, Least, false, "frequency above the grazing boundary g0";
    FrequencySn "margin_sn", Frequency, Least, false, "frequency below the fold s_SN";
    FrequencyPd "margin_pd", Frequency, Least, false, "frequency above the flip s_PD";
    ClearanceG0 "clearance_margin_g0", Length, Least, false, "clearance above the grazing boundary g0";
    ClearanceSn "clearance_margin_sn", Length, Least, false, "clearance below the fold s_SN";
    ClearancePd "clearance_margin_pd", Length, Least, false, "clearance above the flip s_PD, or where else the motion ends";
    Certainty "certainty", Number, Least, true, "share of starts that lead to the motion";
    Integrity "integrity", Number, Least, true, "largest ball of starts about the motion that all lead to it, in halves of their box";
    RunUp "run_up", Number, Least, true, "ways to run up from rest into the motion";
    MissingStrips "missing_strips", Number, Least, true, "strips in a row that may be missing at every drive angle";
    Cost "cost", Number, Most, false, "cost by the task's formula";
}

impl Figure {
    /// The figure with this key; none if no figure has it.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|it| it.name() == name)
    }

    /// Why the value of the figure is infinite, where it is.
    pub const fn unbounded_reason(self) -> &'static str {
        match self {
            Self::FrequencyPd => "no flip on this branch",
            Self::ClearanceSn => {
                "no fold on this branch, and no other end up to 32 times the clearance"
            }
            Self::ClearancePd => {
                "no flip on this branch, and no other end down to a quarter of the clearance"
            }
            Self::StopForce => "a rigid stop is struck",
            _ => "nothing bounds it",
        }
    }

    /// The figure's value in SI units by an orbit and its `stroke`, the metrics of its cycle: NaN if the motion has none; none if
    /// the figure takes a zone, trials or a formula.
    pub fn of_motion(self, orbit: &Orbit, stroke: &CycleMetrics) -> Option<f64> {
        Some(match self {
            Self::Velocity => stroke.impact_velocity,
            Self::ImpactEnergy => stroke.impact_energy,
            Self::ImpactPower => stroke.impact_power,
            Self::StrokeWork => stroke.losses.strip,
            Self::DriveForce => orbit.scene.excitation.amplitude,
            Self::DrivePower => stroke.mean_power,
            Self::MaxPosition => stroke.highest,
            Self::Stroke => stroke.length,
            Self::StopForce if stroke.impulse > 0.0 => f64::INFINITY,
            Self::StopForce => stroke.stop_force,
            Self::StopDeflection => {
                let above = stop_deflection(&orbit.scene, stroke.highest);
                let below = orbit.scene.mirrored();
                let below = below.and_then(|below| stop_deflection(&below, -stroke.lowest));
                let both = above.into_iter().chain(below);
                both.fold(f64::NAN, f64::max)
            }
            Self::CutThrough => stroke.beyond_strip.unwrap_or(f64::NAN),
            Self::RigidGap => stroke.before_wall.unwrap_or(f64::NAN),
            Self::Multiplier => {
                let moduli = orbit.monodromy.multipliers().map(|it| it.norm());
                moduli.into_iter().fold(0.0, f64::max)
            }
            _ => return None,
        })
    }

    /// The figure's value in SI units as [`Figure::of_motion`] has it, computing only what this figure needs of the orbit.
    ///
    /// # Errors
    /// [`MotionError`] if the motion cannot be computed.
    pub fn of_orbit(self, orbit: &Orbit) -> Result<Option<f64>, MotionError> {
        Ok(match self {
            Self::Velocity => Some(orbit.before_impact_velocity()),
            Self::MaxPosition => Some(orbit.max_position),
            Self::CutThrough => Some(depth_beyond_strip(orbit).unwrap_or(f64::NAN)),
            Self::StopForce => Some(peak_stop_force(&orbit.trajectory()?)),
            _ => self.of_motion(orbit, &CycleMetrics::of(orbit)?),
        })
    }

    /// True if the motion alone determines the figure, without its zone and without trials.
    pub const fn is_of_motion(self) -> bool {
        !self.is_trial() && !self.is_margin()
    }

    /// True if the figure is a distance in frequency or another parameter from where the motion is lost.
    pub const fn is_margin(self) -> bool {
        matches!(
            self,
            Self::Share
                | Self::FrequencyG0
                | Self::FrequencySn
                | Self::FrequencyPd
                | Self::ClearanceG0
                | Self::ClearanceSn
                | Self::ClearancePd
        )
    }
}

/// The figure of the stop's deflection in m at a position of the mass; none if no stop of the scene gives way.
fn stop_deflection(scene: &Scene, position: f64) -> Option<f64> {
    match scene.stop {
        Stop::None | Stop::Rigid { .. } => None,
        _ => Some((position - scene.stop_position()).max(0.0)),
    }
}
