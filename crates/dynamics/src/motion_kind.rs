//! What motions settle on: one vocabulary of names, colours and JSON for all that tell of motions.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::orbit::{ImpactCount, ImpactPattern, Orbit, Regime};

/// The kind of motion that a start settles on: periodic with its regime, periodic with chatter, at rest, chaotic,
/// transiently chaotic, unsettled, or lost (it cannot be computed).
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MotionKind {
    /// It repeats: z = p/n.
    Periodic {
        /// The regime.
        regime: Regime,
        /// Its impacts in each of the n drive periods.
        order: ImpactPattern,
    },
    /// It repeats with infinitely many impacts, ever weaker ones that end in rest.
    Chatter {
        /// Drive periods after which it repeats.
        periods: u64,
        /// Its impacts in each of them.
        order: ImpactPattern,
    },
    /// It comes to rest for good, wherever dry friction holds the mass.
    Rest,
    /// It never repeats, and small differences grow.
    Chaos,
    /// It looks chaotic for long, but settles on something else in the end.
    TransientChaos,
    /// It neither repeats nor is surely chaotic: it settles slowly, goes elsewhere just now, or is quasi-periodic.
    Unsettled,
    /// It cannot be computed.
    Lost,
}

impl MotionKind {
    /// The kind of motion of a periodic orbit.
    pub fn of(orbit: &Orbit) -> Self {
        Self::from_regime(orbit.regime(), orbit.pattern())
    }

    /// The kind of a motion that repeats, by its regime (of chatter: of impacts before summed ones) and impacts in each period.
    pub fn from_regime(regime: Regime, order: ImpactPattern) -> Self {
        let periods = regime.periods;
        match order.counts_per_period().contains(&ImpactCount::Infinite) {
            true => Self::Chatter { periods, order },
            false => Self::Periodic { regime, order },
        }
    }

    /// The regime z = p/n of the motion; none if it does not repeat or chatters completely.
    pub fn regime(&self) -> Option<Regime> {
        match self {
            Self::Periodic { regime, .. } => Some(*regime),
            _ => None,
        }
    }

    /// The regime z = p/n as text in JSON and CSV: `2/3`, `1` for 1/1, `∞/n` for complete chatter; none if it does not repeat.
    pub fn z(&self) -> Option<String> {
        match self {
            Self::Periodic { regime, .. } => Some(regime.to_string()),
            Self::Chatter { periods: 1, .. } => Some("∞".to_owned()),
            Self::Chatter { periods, .. } => Some(format!("∞/{periods}")),
            _ => None,
        }
    }

    /// Number of drive periods after which the motion repeats; none if it does not.
    pub fn periods(&self) -> Option<u64> {
        match self {
            Self::Periodic { regime, .. } => Some(regime.periods),
            Self::Chatter { periods, .. } => Some(*periods),
            _ => None,
        }
    }

    /// Numbers of impacts of the motion in each drive period; none if it does not repeat.
    pub fn order(&self) -> Option<&ImpactPattern> {
        match self {
            Self::Periodic { order, .. } | Self::Chatter { order, .. } => Some(order),
            _ => None,
        }
    }

    /// Numbers of impacts in each drive period of a motion of several periods, where the regime alone does not tell them.
    pub fn order_beyond_regime(&self) -> Option<&ImpactPattern> {
        self.order()
            .filter(|order| order.counts_per_period().len() > 1)
    }

    /// True if the motion is chaotic, permanently or transiently.
    pub fn is_chaotic(&self) -> bool {
        matches!(self, Self::Chaos | Self::TransientChaos)
    }

    /// The kind of motion as a key in JSON.
    pub const fn json_key(&self) -> &'static str {
        match self {
            Self::Periodic { .. } => "periodic",
            Self::Chatter { .. } => "chatter",
            Self::Rest => "rest",
            Self::Chaos => "chaos",
            Self::TransientChaos => "transient_chaos",
            Self::Unsettled => "unsettled",
            Self::Lost => "lost",
        }
    }

    /// The class of the motion, which has one colour in charts.
    pub fn class(&self) -> MotionClass {
        let (regime, order) = match self {
            Self::Periodic { regime, order } => (regime, order),
            Self::Chatter { .. } => return MotionClass::Many,
            Self::Rest => return MotionClass::Rest,
            Self::Chaos | Self::TransientChaos => return MotionClass::Chaos,
            Self::Unsettled => return MotionClass::Unsettled,
            Self::Lost => return MotionClass::Lost,
        };
        let (p, n) = (regime.impacts, regime.periods);
        match () {
            () if p == 0 => MotionClass::Zero,
            () if p == 1 && n == 1 => MotionClass::One,
            () if p == n => MotionClass::Doubled,
            () if p > n => MotionClass::Many,
            () if 3 * p == 2 * n => MotionClass::TwoThirds,
            () if 2 * p > n => MotionClass::Between,
            () if 2 * p == n && order.has_pair() => MotionClass::Paired,
            () if 2 * p == n => MotionClass::Half,
            () => MotionClass::Few,
        }
    }
}

impl fmt::Display for MotionKind {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Periodic { regime, .. } => write!(formatter, "z = {regime}"),
            Self::Chatter { periods: 1, .. } => {
                formatter.write_str("complete chatter every drive period")
            }
            Self::Chatter { periods, .. } => {
                write!(formatter, "complete chatter every {periods} drive periods")
            }
            Self::TransientChaos => formatter.write_str("transient chaos"),
            other => formatter.write_str(other.json_key()),
        }
    }
}

macro_rules! classes {
    ($($(#[$what:meta])* $class:ident $name:literal;)*) => {
        /// A class of motions that have one colour in charts.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum MotionClass {
            $($(#[$what])* $class),*
        }

        impl MotionClass {
            /// All, in the order of legends.
            pub const ALL: &[Self] = &[$(Self::$class),*];

            /// The name of the class in legends, in a word or two.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$class => $name),*
                }
            }
        }
    };
}

classes! {
    /// No impacts.
    Zero "z = 0";
    /// One impact in each drive period.
    One "z = 1";
    /// As many impacts as drive periods, but two or more.
    Doubled "z = n/n, n > 1";
    /// Other regimes between 1/2 and 1.
    Between "1/2 < z < 1 but 2/3";
    /// z = 2/3 = 4/6 = ...
    TwoThirds "z = 2/3";
    /// z = 1/2, (2/4)A and others whose impacts are apart.
    Half "z = 1/2, (2/4)A";
    /// (2/4)B and others whose impacts are in pairs.
    Paired "z = (2/4)B";
    /// 0 < z < 1/2.
    Few "0 < z < 1/2";
    /// z > 1, complete chatter among them.
    Many "z > 1";
    /// Held by dry friction.
    Rest "rest";
    /// No regime.
    Chaos "chaos";
    /// Not settled.
    Unsettled "unsettled";
    /// Not computed.
    Lost "lost";
}

#[cfg(test)]
mod tests {
    use super::*;
    use softstop::Instant;

    fn motion(periods: u64, impacts: &[f64], rests: &[f64]) -> MotionKind {
        let instant = |cycles: &f64| Instant {
            cycles: *cycles,
            offset: 0.4,
        };
        let [impacts, rests] =
            [impacts, rests].map(|all| all.iter().map(instant).collect::<Vec<_>>());
        let regime = Regime {
            impacts: impacts.len() as u64,
            periods,
        };
        MotionKind::from_regime(regime, ImpactPattern::new(&impacts, &rests, periods, 1.0))
    }

    #[test]
    fn a_motion_has_one_name_one_colour_and_one_json() {
        for (motion, name, class) in [
            (motion(1, &[], &[]), "z = 0", MotionClass::Zero),
            (motion(1, &[0.0], &[]), "z = 1", MotionClass::One),
            (motion(4, &[0.0, 2.0], &[]), "z = 2/4", MotionClass::Half),
            (motion(4, &[0.0, 1.0], &[]), "z = 2/4", MotionClass::Paired),
            (
                motion(2, &[0.0, 1.0], &[1.0]),
                "complete chatter every 2 drive periods",
                MotionClass::Many,
            ),
            (
                MotionKind::TransientChaos,
                "transient chaos",
                MotionClass::Chaos,
            ),
        ] {
            assert_eq!(
                (motion.to_string(), motion.class()),
                (name.to_owned(), class)
            );
            let json = serde_json::to_value(&motion).expect("JSON");
            let kind = json.as_str().map(str::to_owned);
            let kind = kind.or_else(|| Some(json.as_object()?.keys().next()?.clone()));
            assert_eq!(kind.as_deref(), Some(motion.json_key()));
            assert_eq!(
                serde_json::from_value::<MotionKind>(json).ok(),
                Some(motion)
            );
        }
    }

    #[test]
    fn chatter_is_one_motion_however_many_impacts_are_counted() {
        let more = motion(2, &[0.0, 1.0, 1.0], &[1.0]);
        assert_eq!(more, motion(2, &[0.0, 1.0], &[1.0]));
        assert_eq!((more.regime(), more.periods()), (None, Some(2)));
    }
}
