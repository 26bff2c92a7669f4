//! What a page is told.

use serde::Serialize;
use softstop_dynamics::motion_kind::MotionClass;
use softstop_dynamics::{MotionKind, Regime};

/// An answer: what is named, and numbers too many for a text.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// JSON.
    pub text: String,
    /// Their order is the task's.
    pub numbers: Vec<f64>,
}

/// An answer, or what is wrong.
pub(crate) type Answered = Result<Answer, String>;

impl Answer {
    pub(crate) fn new(told: &impl Serialize, numbers: Vec<f64>) -> Self {
        let text = serde_json::to_string(told).unwrap_or_default();
        Self { text, numbers }
    }
}

/// A motion in three numbers: its class, by its place in [`MotionClass::ALL`], and its regime p/n, both 0 without one.
pub(crate) fn kind(motion: &MotionKind) -> [f64; 3] {
    let class = motion.class();
    let place = MotionClass::ALL.iter().position(|it| *it == class);
    let none = Regime {
        impacts: 0,
        periods: 0,
    };
    let Regime { impacts, periods } = motion.regime().unwrap_or(none);
    [place.unwrap_or(0) as f64, impacts as f64, periods as f64]
}
