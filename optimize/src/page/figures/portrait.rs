//! One period of a design's motion in the phase plane, with and without its strip: the whole motion, and the part near the
//! stop.

use softstop::{Arc, Dimension, Scene, Start};
use softstop_draw::{Axis, Layer, Panel};
use softstop_dynamics::{Orbit, zone};
use softstop_explore::simulate::contact_force;

use crate::design::Design;
use crate::page::figure::{BESIDE, BOUND, Curve, DESIGN, Figure, Section, WIDE, bounds, lines};

/// Points of a period, and the fewest of an arc.
const POINTS: f64 = 400.0;
const FEWEST: f64 = 12.0;
/// How far before the first face the near part begins, in units of how far the mass goes beyond it, and how far it goes on
/// behind it.
const NEAR: (f64, f64) = (0.8, 0.15);

/// One period of a motion.
pub(super) struct SampledPeriod {
    /// Its length in s.
    pub(super) length: f64,
    /// Time in s, position in m, velocity in m/s and force of contact in N.
    pub(super) points: Vec<[f64; 4]>,
}

/// The design's motion, and then that of the machine to which no strip is fed, if it has a strip and such a motion.
pub(super) fn motions(design: &Design) -> Vec<SampledPeriod> {
    let bare = unfed(&design.machine.scene).and_then(|scene| {
        let near = Orbit::find_near(&scene, design.orbit.state());
        near.or_else(|_| zone::find(&scene)).ok()
    });
    let bare = bare.as_ref().map(SampledPeriod::of);
    [SampledPeriod::of(&design.orbit)]
        .into_iter()
        .chain(bare)
        .collect()
}

/// The machine's scene with nothing to pierce where its strip was.
fn unfed(scene: &Scene) -> Option<Scene> {
    let mut scene = scene.clone();
    let strip = scene.piercing.as_mut()?;
    (strip.stiffness, strip.friction) = (0.0, 0.0);
    Some(scene)
}

impl SampledPeriod {
    /// That of a motion; without points if it cannot be computed.
    fn of(orbit: &Orbit) -> Self {
        let scene = &orbit.scene;
        let motion = scene.trajectory(orbit.state().into(), orbit.periods).ok();
        let arcs = motion.iter().flat_map(|it| it.arc_views());
        Self {
            length: scene.period() * orbit.periods as f64,
            points: arcs
                .flat_map(|(arc, elapsed)| points(scene, &arc, elapsed))
                .collect(),
        }
    }

    fn curve(&self, name: &str, stroke: softstop_draw::Stroke) -> Curve {
        Curve {
            name: name.to_owned(),
            stroke,
            points: self.points.iter().map(|[_, x, v, _]| (*x, *v)).collect(),
        }
    }
}

/// The points of an arc of a motion, both ends among them.
fn points(scene: &Scene, arc: &Arc<'_>, elapsed: f64) -> Vec<[f64; 4]> {
    let steps = (POINTS * elapsed / scene.period()).ceil().max(FEWEST) as u32;
    let point = |step| {
        let after = elapsed * f64::from(step) / f64::from(steps);
        let state = arc.at(after);
        let Start { position, velocity } = state;
        let force = contact_force(scene, arc.phase, state, arc.drive(after));
        [arc.begin() + after, position, velocity, force]
    };
    (0..=steps).map(point).collect()
}

/// What the mass meets on its way, and where.
pub(super) fn faces(scene: &Scene) -> Vec<(&'static str, f64)> {
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
    let strip = strip.into_iter().flatten();
    strip
        .chain([(stop, scene.stop_position())])
        .chain(wall)
        .collect()
}

/// The picture.
pub(super) fn portrait(design: &Design, motions: &[SampledPeriod]) -> Figure {
    let machine = &design.machine;
    let names = match motions.len() {
        1 => ["design", ""],
        _ => ["with the strip", "without a strip"],
    };
    let curves = motions.iter().zip(names).zip([DESIGN, BESIDE]);
    let curves = curves.map(|((motion, name), stroke)| motion.curve(name, stroke));
    let curves: Vec<Curve> = curves.collect();
    let faces = faces(&machine.scene);
    let places = curves.iter().flat_map(|curve| &curve.points);
    let deepest = places.map(|it| it.0).fold(f64::NEG_INFINITY, f64::max);
    let first = faces.iter().map(|it| it.1).fold(f64::INFINITY, f64::min);
    let depth = deepest - first;
    let labels = [
        machine.label("position", "X", Dimension::Length),
        machine.label("velocity", "X′", Dimension::Velocity),
        machine.label("position, near the stop", "", Dimension::Length),
    ];
    let [x, y, near] = labels.each_ref();
    let unnamed = faces.iter().map(|it| Layer::vertical(it.1, BOUND, ""));
    let layers = unnamed.chain(curves.iter().map(Curve::layer));
    let whole = Panel::new(Axis::new(x), Axis::new(y), layers);
    let named = bounds(&faces, BOUND).chain(curves.iter().map(Curve::layer));
    let near = (depth.is_finite() && depth > 0.0).then(|| Panel {
        x: Axis::new(near).range((first - NEAR.0 * depth, deepest + NEAR.1 * depth)),
        layers: named.collect(),
        ..whole.clone()
    });
    let caption = "Left the whole motion, right the same near the stop. The mass runs round clockwise: up on its way to the \
                   stop, down on its way back.";
    let title = "One period of the motion in the phase plane";
    let sheet = lines("portrait", "motion", [x, y], &curves);
    let panels = [whole].into_iter().chain(near);
    Figure::new(Section::Motion, WIDE, title, panels, caption).with([sheet])
}
