//! Lowering: from the scene's data to phases, layer by layer.

use super::{Exit, Law, Layer, Phase, PhaseKind, Phases, Surface};
use crate::events::Guard;
use crate::flow::Flow;
use crate::scene::{Piercing, Scene, Stop};

/// One layer before its phases are numbered.
struct Plan {
    kind: PhaseKind,
    from: f64,
    forward: Law,
    backward: Option<Law>,
    stored: (f64, f64, f64),
    is_far_side: bool,
}

pub(super) fn lower(scene: &Scene) -> Phases {
    let free = Law {
        damping: scene.damping,
        stiffness: scene.stiffness,
        force: 0.0,
    };
    let amplitude = scene.excitation.amplitude;
    let frequency = scene.excitation.frequency;
    let mut builder = Builder {
        scene,
        phases: Vec::with_capacity(8),
        surfaces: Vec::new(),
    };
    builder.add_phase(PhaseKind::Free, free, (0.0, 0.0, 0.0));
    let unfed = builder.stack(&layers(scene, free, None));
    let fed = match scene.piercing {
        Some(strip) => builder.stack(&layers(scene, free, Some(strip))),
        None => unfed.clone(),
    };
    builder.join_to_free(&fed, &unfed);
    Phases {
        phases: builder.phases,
        surfaces: builder.surfaces,
        held: Flow::new(scene.mass, 0.0, 0.0, amplitude, frequency),
        mass: scene.mass,
        free,
        fed,
        unfed,
    }
}

/// The layers beyond the clearance, with or without a strip in them.
fn layers(scene: &Scene, free: Law, strip: Option<Piercing>) -> Vec<Plan> {
    let mut plans = Vec::with_capacity(3);
    let touching = Law {
        damping: scene.contact_damping,
        ..free
    };
    let near = scene.clearance;
    match strip {
        Some(strip) => plans.extend(strip_layers(strip, near, touching)),
        None if scene.piercing.is_some() => plans.push(Plan {
            kind: PhaseKind::Gap,
            from: near,
            forward: touching,
            backward: None,
            stored: (0.0, 0.0, 0.0),
            is_far_side: false,
        }),
        None => {}
    }
    let from = scene.stop_position();
    let is_far_side = plans
        .last()
        .is_some_and(|below| below.kind == PhaseKind::Pierce);
    match scene.stop {
        Stop::Preloaded { stiffness, preload } => plans.push(Plan {
            kind: PhaseKind::Stop,
            from,
            forward: Law {
                stiffness: free.stiffness + stiffness,
                force: stiffness * from - preload,
                ..touching
            },
            backward: None,
            stored: (preload, stiffness, from),
            is_far_side,
        }),
        Stop::None if strip.is_some() => plans.push(Plan {
            kind: PhaseKind::Gap,
            from,
            forward: touching,
            backward: None,
            stored: (0.0, 0.0, 0.0),
            is_far_side,
        }),
        Stop::None => {}
    }
    plans
}

/// Phases I and II (Peterka 2003, eqs. 1-4); a layer without thickness does not exist.
fn strip_layers(strip: Piercing, near: f64, touching: Law) -> impl Iterator<Item = Plan> {
    let elastic = |stiffness: f64| Law {
        stiffness: touching.stiffness + stiffness,
        force: stiffness * near,
        ..touching
    };
    let pierce = (strip.thickness > 0.0).then(|| Plan {
        kind: PhaseKind::Pierce,
        from: near,
        forward: elastic(strip.stiffness + strip.friction),
        backward: Some(elastic(strip.stiffness - strip.friction)),
        stored: (0.0, 0.0, 0.0),
        is_far_side: false,
    });
    let rub = |force: f64| Law {
        force: -force,
        ..touching
    };
    let cut = (strip.travel > 0.0).then(|| Plan {
        kind: PhaseKind::Cut,
        from: near + strip.thickness,
        forward: rub(strip.cut_force_forward()),
        backward: Some(rub(strip.cut_force_backward())),
        stored: (0.0, 0.0, 0.0),
        is_far_side: true,
    });
    pierce.into_iter().chain(cut)
}

struct Builder<'a> {
    scene: &'a Scene,
    phases: Vec<Phase>,
    surfaces: Vec<Surface>,
}

impl Builder<'_> {
    fn add_phase(&mut self, kind: PhaseKind, law: Law, stored: (f64, f64, f64)) -> usize {
        let drive = self.scene.excitation;
        self.phases.push(Phase {
            kind,
            law,
            flow: Flow::new(
                self.scene.mass,
                law.damping,
                law.stiffness,
                drive.amplitude,
                drive.frequency,
            ),
            guards: Vec::with_capacity(3),
            exits: Vec::with_capacity(3),
            stored,
        });
        self.phases.len() - 1
    }

    fn add_exit(&mut self, phase: usize, guard: Guard, exit: Exit) {
        self.phases[phase].guards.push(guard);
        self.phases[phase].exits.push(exit);
    }

    /// Adds the layers of one stack, from the clearance on.
    fn stack(&mut self, plans: &[Plan]) -> Vec<Layer> {
        let mut layers: Vec<Layer> = Vec::with_capacity(plans.len());
        for plan in plans {
            let forward = self.add_phase(plan.kind, plan.forward, plan.stored);
            let backward = match plan.backward {
                Some(law) => self.add_phase(plan.kind, law, plan.stored),
                None => forward,
            };
            let surface = self.surfaces.len();
            self.surfaces.push(Surface {
                position: plan.from,
                below: layers.last().map_or(0, |layer| layer.backward),
                above: forward,
                above_unfed: None,
                is_clearance: layers.is_empty(),
                is_far_side: plan.is_far_side,
            });
            if let Some(below) = layers.last() {
                let guard = Guard::rising_to(plan.from);
                self.add_exit(below.forward, guard, Exit::Forward(surface));
            }
            let guard = Guard::falling_to(plan.from);
            self.add_exit(backward, guard, Exit::Backward(surface));
            if forward != backward {
                let reversal = Exit::Reversal { forward, backward };
                self.add_exit(forward, Guard::turning_back(), reversal);
                self.add_exit(backward, Guard::turning_forward(), reversal);
            }
            layers.push(Layer {
                from: plan.from,
                forward,
                backward,
                surface,
            });
        }
        layers
    }

    /// Lets the free phase end at the clearance.
    fn join_to_free(&mut self, fed: &[Layer], unfed: &[Layer]) {
        let Some(first) = fed.first().or(unfed.first()) else {
            return;
        };
        if let (Some(_), Some(empty)) = (fed.first(), unfed.first()) {
            self.surfaces[first.surface].above_unfed = Some(empty.forward);
        }
        self.add_exit(
            0,
            Guard::rising_to(first.from),
            Exit::Forward(first.surface),
        );
    }
}
