//! What is asked of a model, and which model is the cheapest.

use softstop::Dimension;

macro_rules! quantities {
    ($($(#[$what:meta])* $quantity:ident $name:literal $dimension:ident;)*) => {
        /// A quantity that a model should give.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
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

impl Quantity {
    /// Whether it is one of the [`StabilityBounds`](softstop_dynamics::zone::StabilityBounds).
    pub const fn is_bound(self) -> bool {
        matches!(
            self,
            Self::GrazingFrequency | Self::FlipFrequency | Self::FoldFrequency
        )
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
