//! Who watches the motion: tallies, the table of crossings, what is drawn.

use std::ops::ControlFlow;

use softstop::internals::{Motion, Phase, budget, work};
use softstop::{Arc, Clock, Crossing, CrossingKind, DriveAngle, Observer, PhaseKind, Scene, Start};

use super::name;
use super::tally::{MotionTally, RestInterval};
use crate::simulate::chart::DrawnMotion;
use softstop_console::column::Column;
use softstop_console::columns;
use softstop_console::failure::Failure;
use softstop_console::interrupt;

/// Points that one period is drawn with, at least.
const FINENESS: f64 = 250.0;
/// Steps that an arc is drawn with, at least.
const FEWEST: f64 = 8.0;

/// What it costs to write a crossing down, in scan windows.
const WRITTEN: u64 = 64;

/// A row of crossings.csv.
pub(crate) struct CrossingRow {
    pub time: f64,
    pub before: PhaseKind,
    pub crossing: Crossing,
}

impl CrossingRow {
    /// The crossing's kind as in the table.
    pub(crate) fn kind(&self) -> &'static str {
        match self.crossing.kind {
            CrossingKind::Surface { forward: true, .. } => "forward",
            CrossingKind::Surface { forward: false, .. } => "backward",
            CrossingKind::Rebound { .. } => "rebound",
            CrossingKind::Reversal => "reversal",
            CrossingKind::Switch => "switch",
            CrossingKind::Rest => "rest",
            CrossingKind::Release => "release",
        }
    }
}

/// The columns of crossings.csv.
pub(crate) fn crossing_columns() -> [Column<CrossingRow>; 10] {
    columns! { CrossingRow, it;
        "time" [Time], "when" => it.time;
        "kind" [None], "of the crossing" => it.kind();
        "phase_before" [None], "phase that it ends" => name(it.before);
        "position" [Length], "where" => it.crossing.position;
        "velocity_before" [Velocity], "before it" => it.crossing.velocity;
        "velocity_after" [Velocity], "after it" => it.crossing.velocity_after;
        "acceleration_before" [Of("own")], "before it" => it.crossing.acceleration_before;
        "acceleration_after" [Of("own")], "after it" => it.crossing.acceleration_after;
        "impact" [None], "1 if it is an impact" => u64::from(it.crossing.impact_velocity().is_some());
        "pierces" [None], "1 if it pierces the strip" => u64::from(it.crossing.pierces());
    }
}

/// Watches a motion.
pub(super) struct MotionRecorder<'a, F> {
    scene: &'a Scene,
    clock: Clock,
    crossed: F,
    /// The first thing that went wrong while writing.
    failure: Option<Failure>,
    /// Phase of the arc that ended last.
    before: PhaseKind,
    pub(super) tally: MotionTally,
    pub(super) drawing: DrawnMotion,
    /// Time in s from which on the motion is drawn.
    drawn_from: f64,
}

impl<'a, F> MotionRecorder<'a, F> {
    pub(super) fn new(scene: &'a Scene, motion: &Motion, crossed: F, drawn_from: f64) -> Self {
        Self {
            scene,
            clock: *motion.clock(),
            crossed,
            failure: None,
            before: motion.kind(),
            tally: MotionTally::default(),
            drawing: DrawnMotion::default(),
            drawn_from,
        }
    }

    /// Passes on what went wrong while writing.
    pub(super) fn check(&mut self) -> Result<(), Failure> {
        self.failure.take().map_or(Ok(()), Err)
    }

    /// Takes up the arc that is under way at the end.
    pub(super) fn finish(mut self, motion: &Motion) -> (MotionTally, DrawnMotion) {
        let arc = motion.arc();
        let elapsed = motion.clock().elapsed(arc.start, motion.now());
        self.take(&arc, elapsed, true);
        (self.tally, self.drawing)
    }

    fn take(&mut self, arc: &Arc<'_>, elapsed: f64, last: bool) {
        self.before = arc.kind;
        self.tally.work += work(arc, self.scene.mass, elapsed);
        let begin = arc.begin();
        if elapsed > 0.0 {
            self.tally.arc(arc.kind, elapsed);
        }
        if elapsed > 0.0 && matches!(arc.kind, PhaseKind::Resting | PhaseKind::Stuck) {
            self.tally.rest(RestInterval {
                phase: arc.kind,
                begin,
                end: (!last).then_some(begin + elapsed),
                position: arc.course.departure.position,
            });
        }
        if begin + elapsed > self.drawn_from && !self.drawing.is_full() {
            self.draw(arc, begin, elapsed);
        }
    }

    fn draw(&mut self, arc: &Arc<'_>, begin: f64, elapsed: f64) {
        let skipped = (self.drawn_from - begin).max(0.0);
        let shown = elapsed - skipped;
        let steps = (FINENESS * shown / self.clock.period()).ceil().max(FEWEST);
        for step in 0..=steps as u32 {
            let after = skipped + shown * f64::from(step) / steps;
            let state = arc.at(after);
            let force = contact_force(self.scene, arc.phase, state, arc.drive(after));
            let point = [begin + after, state.position, state.velocity, force];
            self.drawing.points.push(point);
        }
        let (from, to) = (begin + skipped, begin + elapsed);
        match self.drawing.phases.last_mut() {
            Some((kind, _, end)) if *kind == arc.kind => *end = to,
            _ => self.drawing.phases.push((arc.kind, from, to)),
        }
    }
}

impl<F: FnMut(&CrossingRow) -> Result<(), Failure>> Observer for MotionRecorder<'_, F> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.take(arc, elapsed, false);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        budget::charge(WRITTEN);
        let time = self.clock.time(crossing.instant);
        self.tally.crossing(crossing, time, self.scene.mass);
        let taken = (self.crossed)(&CrossingRow {
            time,
            before: self.before,
            crossing: *crossing,
        });
        if let Err(failure) = taken {
            self.failure.get_or_insert(failure);
        }
    }

    fn progress(&mut self, _: u64) -> ControlFlow<()> {
        if self.failure.is_some() {
            return ControlFlow::Break(());
        }
        interrupt::go_on()
    }
}

/// Force in N of stop and strip in a state; on a mass that is held, the one that holds it.
pub fn contact_force(
    scene: &Scene,
    phase: Option<&Phase>,
    Start { position, velocity }: Start,
    drive: DriveAngle,
) -> f64 {
    match phase {
        Some(phase) => phase.contact_force(position, velocity),
        None => scene.excitation.amplitude * drive.cos - scene.stiffness * position,
    }
}
