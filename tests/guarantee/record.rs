//! What the library says: a motion as legs between crossings.

use std::ops::ControlFlow;

use softstop::{Arc, Crossing, MotionError, Observer, PhaseKind, Scene, Start};

/// The motion from one crossing to the next.
#[derive(Debug, Clone)]
pub struct Leg {
    /// Whole periods and seconds at its start.
    pub start: (f64, f64),
    /// Drive angle at its start.
    pub angle: f64,
    pub duration: f64,
    pub position: f64,
    pub velocity: f64,
    pub kind: PhaseKind,
    /// Where the library joined stretches of one motion: elapsed time, position, velocity, kind.
    pub joints: Vec<(f64, f64, f64, PhaseKind)>,
    /// What ends it; nothing does at the end of the record.
    pub end: Option<Crossing>,
}

/// Keeps legs.
struct Recorder<'a> {
    scene: &'a Scene,
    legs: Vec<Leg>,
    open: Option<Leg>,
    /// Arcs since the last pause.
    arcs: u32,
    most: usize,
}

/// Arcs in a sixteenth of a period that are no motion any more. Bounces that damping alone makes
/// shrink are some millions at most.
const RUNAWAY: u32 = 30_000_000;

impl Observer for Recorder<'_> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.arcs += 1;
        let departure = &arc.course.departure;
        let (position, velocity) = (departure.position, departure.velocity);
        if let Some(leg) = &mut self.open {
            leg.joints
                .push((leg.duration, position, velocity, arc.kind));
            leg.duration += elapsed;
            return;
        }
        let drive = &self.scene.excitation;
        self.open = Some(Leg {
            start: (arc.start.cycles, arc.start.offset),
            angle: drive.frequency * arc.start.offset + drive.phase,
            duration: elapsed,
            position,
            velocity,
            kind: arc.kind,
            joints: Vec::new(),
            end: None,
        });
    }

    fn crossing(&mut self, crossing: &Crossing) {
        if let Some(leg) = self.open.take() {
            let end = Some(*crossing);
            if self.legs.len() < self.most || self.arcs + 8 > RUNAWAY {
                self.legs.push(Leg { end, ..leg });
            }
        }
    }

    fn progress(&mut self, _: u64) -> ControlFlow<()> {
        if self.arcs > RUNAWAY {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

/// Why there is no record.
pub enum Refusal {
    /// The library says that a drive period takes too much work.
    Endless,
    /// Anything else.
    Failure(String),
}

/// The legs of the motion over some periods, or up to `most` crossings.
///
/// # Errors
/// What the library refuses, or that it runs away, with the last legs.
pub fn record(scene: &Scene, start: Start, periods: f64, most: usize) -> Result<Vec<Leg>, Refusal> {
    let clock = scene.clock();
    let mut motion = scene.motion(start)?;
    let mut recorder = Recorder {
        scene,
        legs: Vec::new(),
        open: None,
        arcs: 0,
        most,
    };
    let slices = (16.0 * periods).ceil() as u32;
    for slice in 1..=slices {
        let until = clock.instant(scene.period() * f64::from(slice) / 16.0);
        recorder.arcs = 0;
        if motion.watch(until, &mut recorder)?.is_break() {
            let last = format!("runs away: {:?}", recorder.last());
            return Err(Refusal::Failure(last));
        }
        if recorder.legs.len() >= most {
            return Ok(recorder.legs);
        }
    }
    motion.tell_arc(&mut recorder);
    recorder.legs.extend(recorder.open.take());
    Ok(recorder.legs)
}

impl From<MotionError> for Refusal {
    fn from(error: MotionError) -> Self {
        match error {
            MotionError::Endless { .. } => Self::Endless,
            other => Self::Failure(other.to_string()),
        }
    }
}

impl Recorder<'_> {
    fn last(&self) -> &[Leg] {
        &self.legs[self.legs.len().saturating_sub(2)..]
    }
}
