//! Stretches of drive periods in which a motion has the order of impacts that another one has, between bursts (Pomeau
//! and Manneville 1980).

use std::collections::VecDeque;

use softstop::{CheckedScene, Instant, MotionError, Start};
use softstop_dynamics::StroboscopicMap;
use softstop_dynamics::internals::{HasMember, Member};

/// Shortest stretch, in periods of the other motion, that is not chance.
const CALM: u64 = 5;

/// A motion and its stretches with the order of impacts of another one, from wherever that begins.
pub(crate) struct Stretches {
    pub member: Member,
    /// Those that are not chance, in drive periods; the first one begins where the motion was started, not where chaos
    /// throws it.
    pub lengths: Vec<u64>,
    /// Shortest one that counts.
    pub calm: u64,
    /// The longest one, the present one included.
    pub longest: u64,
    /// Drive periods since the last one.
    pub since: u64,
    /// Whether enough is known.
    pub is_known: fn(&Self) -> bool,
    /// Drive periods of the present one.
    length: u64,
    /// Impacts in each drive period of the other motion, twice in a row.
    twice: Vec<usize>,
    /// Those in the last drive periods of this one, and in the present.
    last: VecDeque<usize>,
    impacts: usize,
}

impl Stretches {
    /// None yet of a motion beside that of a scene from a state, which repeats after so many drive periods.
    pub fn new(
        member: Member,
        scene: &CheckedScene,
        mut start: Start,
        periods: u64,
        is_known: fn(&Self) -> bool,
    ) -> Result<Self, MotionError> {
        let map = StroboscopicMap::new(scene, 1);
        let mut order = Vec::new();
        for _ in 0..periods {
            let passage = map.apply(start.into())?;
            start = passage.end.into();
            order.push(passage.impacts.len());
        }
        Ok(Self {
            member,
            lengths: Vec::new(),
            calm: CALM * periods,
            longest: 0,
            since: 0,
            is_known,
            length: 0,
            twice: order.repeat(2),
            last: VecDeque::new(),
            impacts: 0,
        })
    }
}

impl HasMember for Stretches {
    fn member_mut(&mut self) -> &mut Member {
        &mut self.member
    }

    fn record_impact(&mut self, _: Instant, _: f64) {
        self.impacts += 1;
    }

    fn record_state(&mut self, _: Start) {
        let impacts = std::mem::take(&mut self.impacts);
        if (self.is_known)(self) {
            return;
        }
        self.last.push_back(impacts);
        let periods = self.twice.len() / 2;
        if self.last.len() > periods {
            self.last.pop_front();
        }
        let mut orders = self.twice.windows(periods);
        if orders.any(|order| self.last.iter().eq(order)) {
            self.length += 1;
            self.longest = self.longest.max(self.length);
            self.since = 0;
            return;
        }
        self.since += 1;
        let length = std::mem::take(&mut self.length);
        let is_calm = |length: &u64| *length >= self.calm;
        self.lengths.extend(Some(length).filter(is_calm));
    }
}
