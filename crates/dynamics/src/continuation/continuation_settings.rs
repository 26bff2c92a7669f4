//! Settings of a continuation, and how far it follows a branch.

use softstop::SceneError;

/// Open range of a setting, and how it is told.
type Allowed = (f64, f64, &'static str);
const POSITIVE: Allowed = (0.0, f64::INFINITY, "finite and > 0");
const SHARE: Allowed = (0.0, 1.0, "in (0, 1)");
const ABOVE_ONE: Allowed = (1.0, f64::INFINITY, "finite and > 1");

/// Makes the struct of the settings of a table of rows `name: default, allowed range;`.
macro_rules! settings {
    ($(#[$of_all:meta])* $name:ident { $($(#[$doc:meta])* $field:ident: $default:expr, $allowed:expr;)* }) => {
        $(#[$of_all])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $name {
            $($(#[$doc])* pub $field: f64,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default,)* }
            }
        }

        impl $name {
            /// Name, value and allowed range of each setting.
            fn table(&self) -> impl Iterator<Item = (&'static str, f64, Allowed)> {
                [$((stringify!($field), self.$field, $allowed),)*].into_iter()
            }
        }
    };
}

/// Limits of a branch: how far it is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BranchLimits {
    /// Lowest and highest value of the parameter.
    pub range: (f64, f64),
    /// Points in each direction.
    pub points: usize,
}

settings! {
/// Settings of a continuation: how it steps along a branch or a curve, and what it takes for a border. Lengths and distances
/// are those of scaled unknowns, position and velocity in units of the family's scales and parameters as
/// `scaled_parameters` of a [`Family`](super::Family) has them; all values are > 0.
/// [`Continuation::follow_points`](super::Continuation::follow_points), which looks for no special points, takes longer steps
/// and has values of its own for `first_step`, `largest_step`, `step_monodromy_norm` and `min_turn_cosine`.
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
ContinuationSettings {
    /// First step along a curve.
    first_step: 0.02, POSITIVE;
    /// Smallest step: a curve that asks for a smaller one ends.
    smallest_step: 1e-11, POSITIVE;
    /// Largest step; where the state is more than a hundred in size, a hundredth of it times as long.
    largest_step: 0.25, POSITIVE;
    /// Factor by which steps grow at most.
    step_growth: 1.6, ABOVE_ONE;
    /// Cosine of the largest turn of the direction in a step.
    min_turn_cosine: 0.96, SHARE;
    /// Step below which something stands in the way of a branch: a grazing is looked for ahead.
    doubtful_step: 1e-3, POSITIVE;
    /// Step below which a branch crawls, as beside grazing: changes of test functions no longer shorten it, and after sixty
    /// such steps in a row it ends. The first step after a corner.
    crawling_step: 1e-5, POSITIVE;
    /// Largest change of a scaled test function in a step.
    max_test_change: 0.3, POSITIVE;
    /// Smallest share that a step may leave of the distance to a grazing at which the force jumps.
    min_distance_left: 0.3, SHARE;
    /// Distance from a border (a grazing, an end of the range, a rest where orbits come to lie side by side) within which it
    /// counts as reached where no step leads to it.
    border_distance: 1e-4, POSITIVE;
    /// Distance within which what Newton's method finds belongs to a node: the same orbit at another section, a grazing ahead.
    newton_reach: 1e-2, POSITIVE;
    /// Drive periods from the section of a branch to a crossing within which the crossing may stand in the way.
    section_margin: 0.05, POSITIVE;
}
}

impl ContinuationSettings {
    /// Settings of curves in two parameters with steps of at most `largest`, in scaled unknowns.
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
        let refused = |(_, value, (low, high, _)): &(_, f64, Allowed)| {
            value.is_nan() || *value <= *low || *value >= *high
        };
        let crawls = ("largest_step", self.largest_step, "at least crawling_step");
        let crawls = (self.largest_step < self.crawling_step).then_some(crawls);
        let refused = self.table().find(refused);
        let refused = refused.map(|(name, value, (.., allowed))| (name, value, allowed));
        match refused.or(crawls) {
            Some((name, value, allowed)) => Err(SceneError::OutOfRange {
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
