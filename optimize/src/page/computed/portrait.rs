//! One period of a design's motion in the phase plane, with and without its strip.

use softstop::{Arc, Clock, Dimension, Observer, Scene, Start};
use softstop_dynamics::{Orbit, zone};

use super::{label, unfed};
use crate::design::Design;
use crate::page::data::{Curve, Portrait, Role};

/// Points of a period, and the fewest of an arc.
const POINTS: f64 = 400.0;
const FEWEST: f64 = 12.0;

/// The motion, and beside it that of the machine to which no strip is fed.
pub fn portrait(design: &Design) -> Portrait {
    let machine = &design.machine;
    let scene = &machine.scene;
    let bare = unfed(scene).and_then(|scene| {
        let near = Orbit::near(&scene, design.orbit.state());
        near.or_else(|_| zone::find(&scene)).ok()
    });
    let mut curves = vec![Curve {
        name: if bare.is_some() {
            "with the strip"
        } else {
            "design"
        }
        .to_owned(),
        role: Role::Design,
        points: period(&design.orbit),
    }];
    curves.extend(bare.map(|orbit| Curve {
        name: "without a strip".to_owned(),
        role: Role::Beside,
        points: period(&orbit),
    }));
    Portrait {
        x: label(machine, "position", "X", Dimension::Length),
        y: label(machine, "velocity", "X′", Dimension::Velocity),
        curves,
        faces: faces(scene),
    }
}

/// What the mass meets on its way, and where.
fn faces(scene: &Scene) -> Vec<(String, f64)> {
    let stop = match scene.piercing {
        None => "stop",
        Some(_) => "stop behind it",
    };
    let strip = scene.piercing.map(|strip| {
        let through = scene.clearance + strip.thickness;
        [("strip", scene.clearance), ("strip cut through", through)]
    });
    let wall = scene.rigid.and(scene.wall());
    let wall = wall.map(|wall| ("rigid stop", wall.position));
    let all = strip
        .into_iter()
        .flatten()
        .chain([(stop, scene.stop_position())])
        .chain(wall);
    all.map(|(name, at)| (name.to_owned(), at)).collect()
}

/// Positions and velocities over one period; none if the motion cannot be computed.
fn period(orbit: &Orbit) -> Vec<[f64; 2]> {
    let mut recorder = Recorder {
        fineness: POINTS / orbit.scene.period(),
        points: Vec::new(),
    };
    let end = Clock::at_cycle(orbit.periods);
    let Ok(mut motion) = orbit.scene.motion(orbit.state().into()) else {
        return Vec::new();
    };
    if motion.advance(end, &mut recorder).is_err() {
        return Vec::new();
    }
    motion.tell_arc(&mut recorder);
    recorder.points
}

struct Recorder {
    /// Points in a second.
    fineness: f64,
    points: Vec<[f64; 2]>,
}

impl Observer for Recorder {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let steps = (self.fineness * elapsed).ceil().max(FEWEST) as u32;
        self.points.extend((0..=steps).map(|step| {
            let Start { position, velocity } = arc.at(elapsed * f64::from(step) / f64::from(steps));
            [position, velocity]
        }));
    }
}
