//! Random machines with every kind of stop.

use proptest::prelude::*;
use softstop::{Below, Release, RigidStop, Scene, Slope, Start, Stop, Strip};

fn release() -> impl Strategy<Value = Release> {
    prop_oneof![Just(Release::Clearance), Just(Release::ZeroForce)]
}

/// Up to four slopes; on the way back, if at all, all of them half as steep.
fn slopes() -> impl Strategy<Value = Stop> {
    let gaps = prop::collection::vec((0.02..1.0f64, 0.0..100.0f64), 1..5);
    (gaps, any::<bool>()).prop_map(|(gaps, returns)| {
        let mut from = 0.0;
        let mut loading = Vec::new();
        for (gap, stiffness) in gaps {
            loading.push(Slope { from, stiffness });
            from += gap;
        }
        let half = |slope: &Slope| Slope {
            stiffness: 0.5 * slope.stiffness,
            ..*slope
        };
        let unloading = if returns {
            loading.iter().map(half).collect()
        } else {
            Vec::new()
        };
        Stop::PiecewiseLinear { loading, unloading }
    })
}

/// Every law of a stop, not too stiff for differences to be taken.
pub fn stops() -> impl Strategy<Value = Stop> {
    prop_oneof![
        Just(Stop::None),
        (1.0..300.0f64, release())
            .prop_map(|(stiffness, release)| Stop::KelvinVoigt { stiffness, release }),
        slopes(),
        (1.0..300.0f64, 1.0..3.0f64, 0.0..0.5f64).prop_map(|(stiffness, exponent, dissipation)| {
            Stop::Hertz {
                stiffness,
                exponent,
                dissipation,
            }
        }),
        (1.0..200.0f64, 0.0..100.0f64)
            .prop_map(|(stiffness, preload)| Stop::Preloaded { stiffness, preload }),
        prop_oneof![Just(0.0), 0.0..1.0f64].prop_map(|restitution| Stop::Rigid { restitution }),
    ]
}

fn strips() -> impl Strategy<Value = Option<Strip>> {
    let strip = (0.0..30.0f64, 0.0..30.0f64, 0.05..0.5f64, 0.0..0.6f64).prop_map(
        |(stiffness, friction, thickness, travel)| Strip {
            stiffness,
            friction,
            thickness,
            travel,
        },
    );
    prop::option::weighted(0.25, strip)
}

fn walls() -> impl Strategy<Value = Option<RigidStop>> {
    let wall = (0.0..1.0f64, 0.0..1.0f64).prop_map(|(travel, restitution)| RigidStop {
        travel,
        restitution,
    });
    prop::option::weighted(0.25, wall)
}

/// Machines with m = k1 = F0 = 1 around the paper's, with any stop.
pub fn machines() -> impl Strategy<Value = Scene> {
    (
        (0.3..2.5f64, -3.0..3.0f64),
        -1.0..8.0f64,
        (0.01..0.4f64, 0.02..2.0f64),
        stops(),
        strips(),
        walls(),
    )
        .prop_map(
            |((frequency, phase), clearance, (damping, contact_damping), stop, piercing, rigid)| {
                let mut scene = Scene {
                    damping,
                    clearance,
                    contact_damping,
                    piercing,
                    rigid,
                    ..Scene::of_stop(stop)
                };
                (scene.excitation.frequency, scene.excitation.phase) = (frequency, phase);
                scene
            },
        )
}

/// Machines with m = F0 = 1 and any stop on each side.
pub fn two_sided() -> impl Strategy<Value = Scene> {
    (
        (0.3..2.5f64, -3.0..3.0f64),
        (-0.6..2.0f64, 0.3..3.0f64),
        (0.01..0.4f64, 0.02..2.0f64),
        prop_oneof![Just(0.0), Just(1.0), 0.1..4.0f64],
        (stops(), stops()),
    )
        .prop_map(
            |(
                (frequency, phase),
                (clearance, way),
                (damping, contact_damping),
                stiffness,
                stops,
            )| {
                let mut scene = Scene {
                    stiffness,
                    damping,
                    clearance,
                    contact_damping,
                    below: Some(Box::new(Below {
                        clearance: way - clearance,
                        stop: stops.1,
                    })),
                    ..Scene::of_stop(stops.0)
                };
                (scene.excitation.frequency, scene.excitation.phase) = (frequency, phase);
                scene
            },
        )
}

/// A start between the clearances of a machine with a stop on each side, at this share of the way.
pub fn start_between(scene: &Scene, share: f64, velocity: f64) -> Start {
    let below = scene.below.as_ref().map_or(0.0, |below| -below.clearance);
    Start::new(below + share * (scene.clearance - below), velocity)
}

/// A start below the clearance of a machine.
pub fn start_below(scene: &Scene, depth: f64, velocity: f64) -> Start {
    Start::new(scene.clearance - depth, velocity)
}
