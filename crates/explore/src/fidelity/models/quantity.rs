//! What is asked of a model, and how far its answer is from the scene's own.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::Observation;
use softstop::{Dimension, Scene};
use softstop_dynamics::orbit::{OrbitError, Regime};
use softstop_dynamics::zone::Bounds;

macro_rules! quantities {
    ($($(#[$what:meta])* $quantity:ident $name:literal $dimension:ident;)*) => {
        /// A quantity that a model should give.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case")]
        pub enum Quantity {
            $($(#[$what])* $quantity),*
        }

        impl Quantity {
            /// All quantities.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$quantity),*];

            /// Its name, as on the command line and in JSON.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$quantity => $name),*
                }
            }

            /// What it measures.
            pub const fn dimension(self) -> Dimension {
                match self {
                    $(Self::$quantity => Dimension::$dimension),*
                }
            }
        }
    };
}

quantities! {
    /// Mean velocity in m/s at which the clearance is passed.
    BeforeImpactVelocity "before_impact_velocity" Velocity;
    /// Drive angle in rad at impact; its error is a share of the drive period.
    ImpactPhase "impact_phase" Angle;
    /// Largest position in m.
    MaxPosition "max_position" Length;
    /// Largest contact force in N.
    PeakForce "peak_force" Force;
    /// Time in s in contact per impact.
    ContactTime "contact_time" Time;
    /// Energy in J lost per impact.
    EnergyPerImpact "energy_per_impact" Energy;
    /// Mean power in W that the drive supplies.
    MeanPower "mean_power" Power;
    /// Impacts per drive period; its error is 0 for the same z = p/n and infinite for another.
    Regime "regime" Number;
    /// Frequency g0 in rad/s at which the motion without impacts grazes.
    GrazingFrequency "grazing_frequency" Frequency;
    /// Frequency s_PD in rad/s at which the z = 1 motion doubles its period.
    FlipFrequency "flip_frequency" Frequency;
    /// Frequency s_SN in rad/s at which the z = 1 motion ends.
    FoldFrequency "fold_frequency" Frequency;
}

/// All that is known of a model's motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Answers {
    /// Of its settled motion.
    pub observed: Observation,
    /// Bounds of its z = 1 motion, if they were asked for.
    pub bounds: Option<Bounds>,
}

impl Answers {
    /// What is known of a scene whose settled motion has been observed; its bounds if they are `wanted`, those of
    /// z = 1 only if the motion is one.
    ///
    /// # Errors
    /// [`OrbitError`] if a bound cannot be followed.
    pub fn of(scene: &Scene, observed: Observation, wanted: bool) -> Result<Self, OrbitError> {
        let is_one = observed.regime == Some(Regime::ONE);
        let near = is_one.then_some(observed.start);
        let bounds = wanted.then(|| Bounds::of_scene(scene, near)).transpose()?;
        Ok(Self { observed, bounds })
    }
}

impl Quantity {
    /// Whether it is one of the [`Bounds`].
    pub const fn is_bound(self) -> bool {
        matches!(
            self,
            Self::GrazingFrequency | Self::FlipFrequency | Self::FoldFrequency
        )
    }

    /// Its value; none if the motion has none.
    pub fn value(self, answers: &Answers) -> Option<f64> {
        let Answers { observed, bounds } = answers;
        match self {
            Self::BeforeImpactVelocity => observed.before_impact_velocity,
            Self::ImpactPhase => observed.impact_phase,
            Self::MaxPosition => Some(observed.max_position),
            Self::PeakForce => observed.peak_force,
            Self::ContactTime => observed.contact_time,
            Self::EnergyPerImpact => observed.energy_per_impact,
            Self::MeanPower => Some(observed.mean_power),
            Self::Regime => observed
                .regime
                .map(|Regime { impacts, periods }| impacts as f64 / periods as f64),
            Self::GrazingFrequency => bounds.and_then(|bounds| bounds.grazing),
            Self::FlipFrequency => bounds.and_then(|bounds| bounds.flip),
            Self::FoldFrequency => bounds.and_then(|bounds| bounds.fold),
        }
    }

    /// How far a model is from the truth: relative to the truth, for a drive angle as a share of a turn,
    /// for a regime 0 or infinite. None if one of the two has no value.
    pub fn error(self, truth: &Answers, model: &Answers) -> Option<f64> {
        let (truth_value, value) = (self.value(truth)?, self.value(model)?);
        let gap = (value - truth_value).abs();
        Some(match self {
            Self::ImpactPhase => gap.min(TAU - gap) / TAU,
            Self::Regime if truth.observed.regime != model.observed.regime => f64::INFINITY,
            _ if gap == 0.0 => 0.0,
            _ => gap / truth_value.abs(),
        })
    }
}

/// The place of the cheapest among models, given as error and cost, whose error is within `tolerance`;
/// of two that cost the same, the first.
pub fn cheapest(models: &[(Option<f64>, f64)], tolerance: f64) -> Option<usize> {
    let models = models.iter().enumerate();
    let fit = models.filter(|(_, it)| it.0.is_some_and(|error| error <= tolerance));
    let best = fit.min_by(|(_, a), (_, b)| a.1.total_cmp(&b.1));
    best.map(|(place, _)| place)
}
