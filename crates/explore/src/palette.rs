//! The colours of motions and phases, and what explains them.

use softstop::PhaseKind;
use softstop_draw::style::{self, motion, phase};
use softstop_draw::{Layer, Sign};
use softstop_dynamics::motion_kind::MotionClass;
use softstop_dynamics::orbit::ImpactPattern;
use softstop_dynamics::{MotionKind, Regime};

/// The colour of motions.
pub const fn motion_color(class: MotionClass) -> &'static str {
    match class {
        MotionClass::Zero => motion::ZERO,
        MotionClass::One => motion::ONE,
        MotionClass::Doubled => motion::DOUBLED,
        MotionClass::TwoThirds => motion::TWO_THIRDS,
        MotionClass::Between => motion::BETWEEN,
        MotionClass::Half => motion::HALF,
        MotionClass::Paired => motion::PAIRED,
        MotionClass::Few => motion::FEW,
        MotionClass::Many => motion::MANY,
        MotionClass::Rest => motion::REST,
        MotionClass::Chaos => motion::CHAOS,
        MotionClass::Unsettled => motion::UNSETTLED,
        MotionClass::Lost => motion::LOST,
    }
}

/// The colour of a motion's line, which is seen on white.
pub const fn line_color(class: MotionClass) -> &'static str {
    match class {
        MotionClass::Zero | MotionClass::Lost => style::ASIDE,
        class => motion_color(class),
    }
}

/// The colours of motions in one picture: where two are of one class, the second has another colour.
pub fn distinct_colors(classes: impl IntoIterator<Item = MotionClass>) -> Vec<&'static str> {
    let mut taken: Vec<&'static str> = Vec::new();
    for class in classes {
        let own = motion_color(class);
        let mut colors = [own].into_iter().chain(motion::OTHERS);
        let free = colors.find(|color| !taken.contains(color));
        taken.push(free.unwrap_or(own));
    }
    taken
}

/// The class of a regime whose order of impacts is not known.
pub fn regime_class(regime: Regime) -> MotionClass {
    let order = ImpactPattern::new(&[], &[], regime.periods, 1.0);
    MotionKind::from_regime(regime, order).class()
}

/// Entries of a legend for the classes that occur.
pub fn motion_keys(occurs: impl Fn(MotionClass) -> bool) -> impl Iterator<Item = Layer> {
    let classes = MotionClass::ALL.iter().copied();
    let classes = classes.filter(move |class| occurs(*class));
    classes.map(|class| Layer::key(Sign::Patch(motion_color(class)), class.name()))
}

/// The tint of a phase, behind the line of a motion; free flight has none.
pub const fn phase_color(kind: PhaseKind) -> Option<&'static str> {
    match kind {
        PhaseKind::Free => None,
        PhaseKind::Pierce => Some(phase::PIERCE),
        PhaseKind::Cut => Some(phase::CUT),
        PhaseKind::Gap => Some(phase::GAP),
        PhaseKind::Stop => Some(phase::STOP),
        PhaseKind::Released => Some(phase::RELEASED),
        PhaseKind::Chatter => Some(phase::CHATTER),
        PhaseKind::Stuck => Some(phase::STUCK),
        PhaseKind::Resting => Some(phase::RESTING),
    }
}
