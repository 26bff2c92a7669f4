//! Settings of the extrapolation of settled motions.

/// When returns of a lane are recorded, and how close they have to be for their limit to be extrapolated. Distances are of
/// velocities in units of the first return's, and of times as angles of the drive in rad.
pub(super) struct ReturnSettings {
    /// Drive periods from the beginning of a job to the first recording of returns, and from a failed attempt to the next one,
    /// before the first growth.
    pub periods_before_recording: f64,
    pub first_pause_periods: f64,
    /// Ratio of the length of each pause to that of the one before.
    pub pause_growth: f64,
    /// Most drive periods between two returns, and the largest difference from a whole number of them.
    pub max_periods: f64,
    pub max_time_offset: f64,
    /// Largest distance of a return from the first one that counts as a recurrence, as a share of the distance of the return next
    /// to the first.
    pub max_recurrence_ratio: f64,
    /// Fewest drive periods left, per period of the cycle, with which their extrapolation is worth a trial.
    pub min_periods_left: f64,
    /// Drive periods at the end of a job that are never extrapolated.
    pub followed_last_periods: f64,
    /// Largest distances between two returns from which the number of returns until they are close is predicted, and from which
    /// their limit is extrapolated.
    pub max_prediction_distance: f64,
    pub max_extrapolation_distance: f64,
    /// Largest last step of Newton's method, and the largest ratio of a step to the one before with which it goes on.
    pub max_last_step: f64,
    pub max_step_ratio: f64,
}

pub(super) const SETTINGS: ReturnSettings = ReturnSettings {
    periods_before_recording: 28.0,
    first_pause_periods: 6.0,
    pause_growth: 1.5,
    max_periods: 4.0,
    max_time_offset: 0.25,
    max_recurrence_ratio: 0.3,
    min_periods_left: 24.0,
    followed_last_periods: 2.0,
    max_prediction_distance: 0.3,
    max_extrapolation_distance: 0.02,
    max_last_step: 1e-7,
    max_step_ratio: 0.3,
};
