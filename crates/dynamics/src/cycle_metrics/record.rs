//! What is recorded along the arcs of a period.

use super::Losses;
use crate::orbit::StroboscopicMap;
use crate::orbit::turn::turns;
use softstop::internals::{Phase, largest, shares};
use softstop::{Arc, Crossing, CrossingKind, MotionError, Observer, PhaseKind, Scene, Start};

/// Records what a motion does over some drive periods.
pub(crate) struct PeriodRecorder<'a> {
    scene: &'a Scene,
    pub lowest: f64,
    pub highest: f64,
    pub strips: u64,
    pub contact_force: f64,
    pub stop_force: f64,
    pub strip_force: f64,
    pub impulse: f64,
    pub supplied: f64,
    pub power: f64,
    pub losses: Losses,
}

impl<'a> PeriodRecorder<'a> {
    /// What the motion from a state at drive angle phi does, and the state after it.
    ///
    /// # Errors
    /// [`MotionError`] if the motion cannot be computed.
    pub fn over(
        scene: &'a Scene,
        start: Start,
        periods: u64,
    ) -> Result<(Self, Start), MotionError> {
        let mut seen = Self {
            scene,
            lowest: start.position,
            highest: start.position,
            strips: 0,
            contact_force: 0.0,
            stop_force: 0.0,
            strip_force: 0.0,
            impulse: 0.0,
            supplied: 0.0,
            power: 0.0,
            losses: Losses::default(),
        };
        let end = StroboscopicMap::new(scene, periods)?.observe(start.into(), &mut seen)?;
        Ok((seen, end.into()))
    }

    fn reach(&mut self, position: f64) {
        self.lowest = self.lowest.min(position);
        self.highest = self.highest.max(position);
    }

    /// Force of the drive in N.
    fn drive(&self, arc: &Arc<'_>, elapsed: f64) -> f64 {
        self.scene.excitation.amplitude * arc.drive(elapsed).cos
    }

    /// Force of contact in N on an arc; a mass that is held is pressed by what would move it.
    fn contact(&self, arc: &Arc<'_>, elapsed: f64) -> f64 {
        let Start { position, velocity } = arc.at(elapsed);
        match arc.phase {
            Some(phase) => phase.contact_force(position, velocity),
            None => self.drive(arc, elapsed) - self.scene.stiffness * position,
        }
    }

    fn press(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let of_kind = match arc.kind {
            PhaseKind::Free | PhaseKind::Chatter => return,
            PhaseKind::Pierce | PhaseKind::Cut | PhaseKind::Stuck => Some(true),
            PhaseKind::Stop | PhaseKind::Released | PhaseKind::Resting => Some(false),
            PhaseKind::Gap => None,
        };
        let force = peak(self.scene, arc, elapsed, |elapsed| {
            arc.side * self.contact(arc, elapsed)
        });
        self.contact_force = self.contact_force.max(force);
        match of_kind {
            Some(true) => self.strip_force = self.strip_force.max(force),
            Some(false) => self.stop_force = self.stop_force.max(force),
            None => {}
        }
    }
}

/// The largest value of a quantity on an arc, by the time in s since its start.
pub fn peak(scene: &Scene, arc: &Arc<'_>, elapsed: f64, value: impl Fn(f64) -> f64) -> f64 {
    let rate = |phase: &Phase| (phase.law.stiffness.abs() / scene.mass).sqrt();
    let rate = scene.excitation.frequency + arc.phase.map_or(0.0, rate);
    largest((0.0, elapsed), rate, value)
}

impl Observer for PeriodRecorder<'_> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let lasting = shares(arc, self.scene.mass, elapsed);
        let losses = &mut self.losses;
        self.supplied += lasting.supplied;
        losses.impacts += lasting.bounces;
        let is_undamped = |phase: &Phase| phase.law.damping == self.scene.damping;
        *match arc.kind {
            PhaseKind::Free => &mut losses.free_damping,
            PhaseKind::Released if arc.phase.is_some_and(is_undamped) => &mut losses.free_damping,
            _ => &mut losses.contact_damping,
        } += lasting.damper;
        *match arc.kind {
            PhaseKind::Pierce | PhaseKind::Cut => &mut losses.strip,
            _ => &mut losses.stop,
        } += lasting.law;
        for back in [true, false] {
            for turn in turns(arc.course, elapsed, back) {
                self.reach(turn.position);
            }
        }
        let power = |elapsed| self.drive(arc, elapsed) * arc.at(elapsed).velocity;
        self.power = self.power.max(peak(self.scene, arc, elapsed, power));
        self.press(arc, elapsed);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.reach(crossing.position);
        self.strips += u64::from(crossing.pierces());
        self.losses.impacts += crossing.lost_energy(self.scene.mass);
        if let CrossingKind::Rebound { .. } = crossing.kind {
            let change = crossing.velocity - crossing.velocity_after;
            self.impulse = self.impulse.max(self.scene.mass * change);
        }
    }
}
