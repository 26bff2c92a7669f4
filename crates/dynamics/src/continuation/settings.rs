//! Settings of a continuation.

use softstop::SceneError;

/// Settings of a continuation: how it steps along a branch or a curve, and what it takes for a border. Lengths and distances
/// are those of scaled unknowns, position, velocity and parameters in units of the family's scales; all values are > 0.
/// [`Continuation::follow_points`](super::Continuation::follow_points), which looks for no special points, takes longer steps
/// and has values of its own for `first_step`, `largest_step`, `step_growth` and `min_turn_cosine`.
///
/// ```
/// use softstop::{Parameter, Ratios};
/// use softstop_dynamics::continuation::ContinuationSettings;
/// use softstop_dynamics::{Continuation, ParameterFamily};
///
/// let family = ParameterFamily::new(Ratios::unloaded().scene()?, [Parameter::Frequency])?;
/// let settings = ContinuationSettings { largest_step: 0.05, ..Default::default() };
/// let continuation = Continuation::new(&family, 1).with_settings(settings)?;
/// # Ok::<(), softstop::SceneError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContinuationSettings {
    /// First step along a curve.
    pub first_step: f64,
    /// Smallest step: a curve that asks for a smaller one ends.
    pub smallest_step: f64,
    /// Largest step; where the unknowns are more than a hundred in size, a hundredth of it times as long.
    pub largest_step: f64,
    /// Factor by which steps grow at most.
    pub step_growth: f64,
    /// Cosine of the largest turn of the direction in a step.
    pub min_turn_cosine: f64,
    /// Step below which something stands in the way of a branch: a grazing is looked for ahead.
    pub doubtful_step: f64,
    /// Step below which a branch crawls, as beside grazing: changes of test functions no longer shorten it, and after sixty
    /// such steps in a row it ends. The first step after a corner.
    pub crawling_step: f64,
    /// Largest change of a scaled test function in a step.
    pub max_test_change: f64,
    /// Smallest share that a step may leave of the distance to a grazing at which the force jumps.
    pub min_distance_left: f64,
    /// Distance from a border (a grazing, an end of the range, a rest where orbits come to lie side by side) within which it
    /// counts as reached where no step leads to it.
    pub border_distance: f64,
    /// Distance within which what Newton's method finds belongs to a node: the same orbit at another section, a grazing ahead.
    pub newton_reach: f64,
    /// Drive periods from the section of a branch to a crossing within which the crossing may stand in the way.
    pub section_margin: f64,
}

impl Default for ContinuationSettings {
    fn default() -> Self {
        Self {
            first_step: 0.02,
            smallest_step: 1e-11,
            largest_step: 0.25,
            step_growth: 1.6,
            min_turn_cosine: 0.96,
            doubtful_step: 1e-3,
            crawling_step: 1e-5,
            max_test_change: 0.3,
            min_distance_left: 0.3,
            border_distance: 1e-4,
            newton_reach: 1e-2,
            section_margin: 0.05,
        }
    }
}

impl ContinuationSettings {
    /// Settings of curves in two parameters with steps of at most `largest`, in units of the family's scales.
    #[must_use]
    pub fn of_curves(largest: f64) -> Self {
        Self {
            largest_step: largest,
            crawling_step: 1e-4 * largest,
            ..Self::default()
        }
    }

    /// Refuses settings with which no curve can be followed.
    ///
    /// # Errors
    /// [`SceneError::OutOfRange`] that names the setting.
    pub fn validate(&self) -> Result<(), SceneError> {
        const POSITIVE: (f64, f64, &str) = (0.0, f64::INFINITY, "finite and > 0");
        const SHARE: (f64, f64, &str) = (0.0, 1.0, "in (0, 1)");
        const GROWTH: (f64, f64, &str) = (1.0, f64::INFINITY, "finite and > 1");
        let mut all = [
            ("first_step", self.first_step, POSITIVE),
            ("smallest_step", self.smallest_step, POSITIVE),
            ("largest_step", self.largest_step, POSITIVE),
            ("step_growth", self.step_growth, GROWTH),
            ("min_turn_cosine", self.min_turn_cosine, SHARE),
            ("doubtful_step", self.doubtful_step, POSITIVE),
            ("crawling_step", self.crawling_step, POSITIVE),
            ("max_test_change", self.max_test_change, POSITIVE),
            ("min_distance_left", self.min_distance_left, SHARE),
            ("border_distance", self.border_distance, POSITIVE),
            ("newton_reach", self.newton_reach, POSITIVE),
            ("section_margin", self.section_margin, POSITIVE),
        ]
        .into_iter();
        let refused = |(_, value, (low, high, _)): &(_, f64, (f64, f64, _))| {
            value.is_nan() || value <= low || value >= high
        };
        match all.find(refused) {
            Some((name, value, (.., allowed))) => Err(SceneError::OutOfRange {
                name,
                value,
                allowed,
            }),
            None => Ok(()),
        }
    }

    /// These settings with few long steps, for smooth curves of which special points alone matter.
    pub(super) fn with_long_steps(self) -> Self {
        Self {
            first_step: 0.05,
            largest_step: 1.0,
            step_growth: 2.5,
            min_turn_cosine: 0.85,
            ..self
        }
    }
}
