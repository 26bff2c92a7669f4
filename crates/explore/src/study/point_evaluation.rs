//! What the outputs of a point of a study are told from.

use std::cell::OnceCell;

use softstop::{Machine, Scene};
use softstop_console::interrupt;
use softstop_dynamics::continuation::{Direction, TestFunction};
use softstop_dynamics::settled::{SettledMotion, Settling};
use softstop_dynamics::zone::{ZoneEnd, grazing_frequencies, loss_of_stability};
use softstop_dynamics::{
    CycleMetrics, LyapunovExponents, MotionKind, Orbit, Regime, StroboscopicMap, Zone,
};

use super::certainty::Certainty;

/// What the outputs of a point are told from, each made when the first of them asks.
pub(super) struct PointEvaluation<'a> {
    pub settling: Settling,
    pub certainty: Certainty,
    pub machine: &'a Machine,
    pub is_valid: bool,
    /// The motion from the start, if an output takes it and it can be followed.
    pub seen: Option<SettledMotion>,
    /// The hysteresis zone, if an output takes it and there is one.
    pub zone: Option<Zone>,
    pub map: OnceCell<Option<StroboscopicMap>>,
    pub motion: OnceCell<Option<(MotionKind, Option<f64>)>>,
    pub orbit: OnceCell<Option<(Orbit, CycleMetrics)>>,
}

impl PointEvaluation<'_> {
    pub fn scene(&self) -> &Scene {
        &self.machine.scene
    }

    /// The drive frequency in rad/s.
    pub fn frequency(&self) -> f64 {
        self.scene().excitation.frequency
    }

    /// The frequency of g0 in rad/s.
    pub fn grazing(&self) -> Option<f64> {
        Some(grazing_frequencies(self.scene()).ok()?.1)
    }

    /// The fold s_SN, where the hysteresis zone ends.
    pub fn fold(&self) -> Option<&ZoneEnd> {
        Some(&self.zone.as_ref()?.high)
    }

    /// The share of starts that lead to z = 1.
    pub fn certainty(&self) -> Option<f64> {
        let Certainty { starts, .. } = self.certainty;
        let region = self.certainty.region();
        self.settling
            .single_impact_certainty(self.scene(), starts, region, &interrupt::watch)
    }

    pub fn map(&self) -> Option<&StroboscopicMap> {
        let map = || Some(self.seen.as_ref()?.watched_map(&self.scene().check().ok()?));
        self.map.get_or_init(map).as_ref()
    }

    pub fn motion(&self) -> Option<&(MotionKind, Option<f64>)> {
        let motion = || self.seen.as_ref()?.motion_kind(self.map()?).ok();
        self.motion.get_or_init(motion).as_ref()
    }

    /// The larger Lyapunov exponent per drive period.
    pub fn exponent(&self) -> Option<f64> {
        match self.seen.as_ref()?.periods {
            Some(_) => Some(LyapunovExponents::of(self.orbit()?).per_period[0]),
            None => self.wandering_exponent(),
        }
    }

    /// The larger exponent of a motion that does not return: of chaos the growth of small differences; of an unsettled motion
    /// by the larger multiplier, in which differences that turn or shear without growth do not count.
    fn wandering_exponent(&self) -> Option<f64> {
        let (kind, growth) = self.motion()?;
        if *kind != MotionKind::Unsettled {
            return *growth;
        }
        let map = self.map()?;
        let passage = map.apply(self.seen.as_ref()?.from.into()).ok()?;
        let [larger, _] = passage.monodromy.multipliers();
        Some(larger.norm().ln() / map.periods() as f64)
    }

    /// z = p/n as impacts and drive periods; complete chatter has no end of impacts.
    pub fn z(&self) -> Option<[f64; 2]> {
        let seen = self.seen.as_ref()?;
        let regime = seen.regime()?;
        let chatters =
            self.scene().wall().is_some() && matches!(self.motion()?.0, MotionKind::Chatter { .. });
        let impacts = match chatters {
            true => f64::INFINITY,
            false => regime.impacts as f64,
        };
        Some([impacts, regime.periods as f64])
    }

    /// The motion that returns, by Newton's method, and its figures.
    pub fn periodic(&self) -> Option<&(Orbit, CycleMetrics)> {
        let find = || {
            let seen = self.seen.as_ref()?;
            let orbit = Orbit::find_periodic(self.scene(), seen.end.into(), seen.periods?).ok()?;
            let is_same = Some(orbit.regime()) == seen.regime();
            let stroke = CycleMetrics::of(&orbit).ok()?;
            is_same.then_some((orbit, stroke))
        };
        self.orbit.get_or_init(find).as_ref()
    }

    pub fn orbit(&self) -> Option<&Orbit> {
        self.periodic().map(|(orbit, _)| orbit)
    }

    /// The frequency of s_PD in rad/s, minus infinity if there is none; nothing without a z = 1 motion to follow.
    pub fn flip(&self) -> Option<f64> {
        let is_one = self.seen.as_ref()?.regime() == Some(Regime::ONE);
        let in_zone = || {
            let (zone, place) = (self.zone.as_ref()?, self.place()?);
            zone.orbit_at(place).ok()
        };
        let orbit = match is_one {
            true => self.orbit().cloned(),
            false => in_zone(),
        };
        let flip = loss_of_stability(&orbit?, Direction::Down, TestFunction::Flip).ok()?;
        Some(flip.map_or(f64::NEG_INFINITY, |flip| flip.parameter))
    }

    /// The frequency in rad/s of the fold up to which the motion goes on, or the hardest motion of the zone here; outside the zone that
    /// of its upper end.
    pub fn own_fold(&self) -> Option<f64> {
        let zone = self.zone.as_ref()?;
        let holding = |orbit: &Orbit| zone.range_holding(orbit);
        let own = self.orbit().and_then(holding);
        let hardest = || holding(&zone.orbit_at(self.place()?).ok()?);
        let range = own.or_else(hardest);
        Some(range.as_ref().unwrap_or(zone).high.frequency)
    }

    /// Place in the zone: 0 at g0, 1 at s_SN.
    pub fn place(&self) -> Option<f64> {
        let zone = self.zone.as_ref()?;
        Some((self.frequency() - zone.frequency_g0) / (zone.high.frequency - zone.frequency_g0))
    }
}
