//! Where all lanes are.

use pulp::Simd;

use super::lanes::{Lanes, Mask};
use super::law::Law;
use super::machine::Machine;
use super::taylor::Drive;
use crate::integrator::Start;

/// The state of all lanes.
#[derive(Debug, Clone, Copy)]
pub(super) struct State<S: Simd> {
    pub x: Lanes<S>,
    pub v: Lanes<S>,
    pub drive: Drive<S>,
    /// cos and sin of the drive angle at the beginning of a period.
    pub begin: (Lanes<S>, Lanes<S>),
    /// The phase each is in.
    pub phase: Lanes<S>,
    /// Ends of windows since the beginning of the period: the one at which a lane stands or, if it
    /// stands between two, the next one.
    pub node: Lanes<S>,
    /// Time to that node, and how much of it is looked at.
    pub toward: Lanes<S>,
    pub span: Lanes<S>,
    /// Drive periods left.
    pub left: Lanes<S>,
    /// Impacts so far.
    pub impacts: Lanes<S>,
    /// Lanes that stand at a node and scan from there.
    pub scanning: Mask<S>,
    /// Lanes that have to look closely at what lies ahead.
    pub pending: Mask<S>,
}

impl<S: Simd> State<S> {
    /// No lane does anything.
    #[inline(always)]
    pub fn idle(simd: S) -> Self {
        let (none, one) = (Lanes::splat(simd, 0.0), Lanes::splat(simd, 1.0));
        Self {
            x: none,
            v: none,
            drive: Drive {
                amplitude: none,
                frequency: one,
                cos: one,
                sin: none,
            },
            begin: (one, none),
            phase: none,
            node: none,
            toward: one,
            span: one,
            left: none,
            impacts: none,
            scanning: none.equals(one),
            pending: none.equals(one),
        }
    }

    /// Gives a lane the drive of a machine.
    #[inline(always)]
    pub fn install(&mut self, lane: usize, machine: &Machine) {
        self.drive.amplitude.set(lane, machine.amplitude);
        self.drive.frequency.set(lane, machine.frequency);
        self.begin.0.set(lane, machine.angle.0);
        self.begin.1.set(lane, machine.angle.1);
    }

    /// Puts a lane at the beginning of a period.
    #[inline(always)]
    pub fn resume(&mut self, lane: usize, state: Start, phase: usize, left: u64) {
        self.x.set(lane, state.position);
        self.v.set(lane, state.velocity);
        self.drive.cos.set(lane, self.begin.0.get(lane));
        self.drive.sin.set(lane, self.begin.1.get(lane));
        self.phase.set(lane, phase as f64);
        self.node.set(lane, 0.0);
        self.left.set(lane, left as f64);
        self.scanning.set(lane, true);
        self.pending.set(lane, false);
    }

    /// Takes a lane out of the work.
    #[inline(always)]
    pub fn stop(&mut self, lane: usize) {
        self.scanning.set(lane, false);
        self.pending.set(lane, false);
    }

    /// Position and velocity of a lane.
    #[inline(always)]
    pub fn state(&self, lane: usize) -> Start {
        Start {
            position: self.x.get(lane),
            velocity: self.v.get(lane),
        }
    }

    /// Seconds of a pending lane since the beginning of the period.
    #[inline(always)]
    pub fn offset(&self, lane: usize, law: &Law<S>) -> f64 {
        let node = self.node.get(lane) * law.window.get(lane);
        (node - self.toward.get(lane)).max(0.0)
    }

    /// The impacts that a lane has counted, once.
    #[inline(always)]
    pub fn take_impacts(&mut self, lane: usize) -> u64 {
        let impacts = self.impacts.get(lane) as u64;
        self.impacts.set(lane, 0.0);
        impacts
    }

    /// Puts the lanes `at` on the node that they have come to, and begins a new period where it is the
    /// last one; those lanes.
    #[inline(always)]
    pub fn arrive(&mut self, at: Mask<S>, law: &Law<S>) -> Mask<S> {
        let ends = at & self.node.equals(law.windows);
        let one = self.left.like(1.0);
        self.node = ends.choose(self.node.like(0.0), self.node);
        self.left = ends.choose(self.left - one, self.left);
        self.drive.cos = ends.choose(self.begin.0, self.drive.cos);
        self.drive.sin = ends.choose(self.begin.1, self.drive.sin);
        ends
    }
}
