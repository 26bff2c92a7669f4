//! Lowering: from the scene's data to phases, layer by layer.

use super::plan::{Plan, layers};
use super::{
    Beyond, Exit, Law, Layer, Phase, PhaseId, PhaseKind, Phases, Stack, Store, Surface, SurfaceId,
};
use crate::events::Guard;
use crate::flow::{Hertz, LinearLaw};
use crate::scene::Scene;

pub(super) fn lower(scene: &Scene) -> Phases {
    let free = Law {
        damping: scene.damping,
        stiffness: scene.stiffness,
        force: 0.0,
    };
    let drive = scene.excitation;
    let mut builder = Builder {
        scene,
        phases: Vec::with_capacity(8),
        surfaces: Vec::new(),
    };
    builder.add_phase(PhaseKind::Free, free, None, Store::default());
    let unfed = builder.stack(&layers(scene, free, false));
    let fed = match scene.piercing {
        Some(_) => builder.stack(&layers(scene, free, true)),
        None => unfed.clone(),
    };
    builder.join_to_free(&fed, &unfed);
    Phases {
        phases: builder.phases,
        surfaces: builder.surfaces,
        amplitude: drive.amplitude / scene.mass,
        frequency: drive.frequency,
        mass: scene.mass,
        fed,
        unfed,
    }
}

struct Builder<'a> {
    scene: &'a Scene,
    phases: Vec<Phase>,
    surfaces: Vec<Surface>,
}

impl Builder<'_> {
    fn add_phase(
        &mut self,
        kind: PhaseKind,
        law: Law,
        hertz: Option<Hertz>,
        store: Store,
    ) -> PhaseId {
        let (scene, drive) = (self.scene, self.scene.excitation);
        let id = PhaseId(self.phases.len());
        self.phases.push(Phase {
            id,
            kind,
            law,
            contact: Law {
                damping: law.damping - scene.damping,
                stiffness: law.stiffness - scene.stiffness,
                force: law.force,
            },
            flow: LinearLaw::new(
                scene.mass,
                law.damping,
                law.stiffness,
                drive.amplitude,
                drive.frequency,
            ),
            hertz,
            guards: Vec::with_capacity(3),
            exits: Vec::with_capacity(3),
            store,
            released: None,
        });
        id
    }

    fn add_exit(&mut self, phase: PhaseId, guard: Guard, exit: Exit) {
        let phase = &mut self.phases[phase.0];
        phase.guards.push(guard);
        phase.exits.push(exit);
    }

    /// Adds the layers of one stack, from the clearance on, and the wall that ends it.
    fn stack(&mut self, plans: &[Plan]) -> Stack {
        let wall = self.scene.wall();
        let within = |plan: &&Plan| wall.is_none_or(|wall| plan.from < wall.position);
        let mut layers: Vec<Layer> = Vec::with_capacity(plans.len());
        for plan in plans.iter().filter(within) {
            let layer = self.add_layer(plan, layers.last().copied());
            layers.push(layer);
        }
        let wall = wall.map(|wall| {
            let (position, restitution) = (wall.position, wall.restitution);
            let beyond = Beyond::Wall { restitution };
            let below = layers.last().copied();
            let is_far_side = plans
                .iter()
                .any(|plan| plan.is_far_side && plan.from == position);
            self.add_surface(position, below, beyond, is_far_side)
        });
        Stack { layers, wall }
    }

    fn add_layer(&mut self, plan: &Plan, below: Option<Layer>) -> Layer {
        let store = Store {
            spring: plan.spring,
            hertz: plan.hertz,
        };
        let add = |builder: &mut Self, law| builder.add_phase(plan.kind, law, plan.hertz, store);
        let forward = add(self, plan.forward);
        let backward = plan.backward.map_or(forward, |law| add(self, law));
        let beyond = Beyond::Phase(forward);
        let surface = self.add_surface(plan.from, below, beyond, plan.is_far_side);
        self.add_exit(
            backward,
            Guard::falling_to(plan.from),
            Exit::Backward(surface),
        );
        if forward != backward {
            let reversal = Exit::Reversal { forward, backward };
            self.add_exit(forward, Guard::turning_back(), reversal);
            self.add_exit(backward, Guard::turning_forward(), reversal);
        }
        if let Some((law, pulls)) = plan.released {
            let released = self.add_phase(PhaseKind::Released, law, None, store);
            let falling = Guard::falling_to(plan.from);
            self.add_exit(released, falling, Exit::Backward(surface));
            self.add_exit(released, pulls.reversed(), Exit::Switch(forward));
            self.add_exit(forward, pulls, Exit::Switch(released));
            self.phases[forward.0].released = Some((released, pulls));
        }
        Layer {
            from: plan.from,
            forward,
            backward,
            surface,
        }
    }

    /// Adds a surface and lets the phases below it end there.
    fn add_surface(
        &mut self,
        position: f64,
        below: Option<Layer>,
        above: Beyond,
        is_far_side: bool,
    ) -> SurfaceId {
        let surface = SurfaceId(self.surfaces.len());
        self.surfaces.push(Surface {
            position,
            below: below.map_or(PhaseId::FREE, |layer| layer.backward),
            above,
            above_unfed: None,
            is_clearance: below.is_none(),
            is_far_side,
        });
        if let Some(below) = below {
            let released = self.phases[below.forward.0].released;
            let guard = Guard::rising_to(position);
            self.add_exit(below.forward, guard, Exit::Forward(surface));
            if let Some((released, _)) = released {
                self.add_exit(released, guard, Exit::Forward(surface));
            }
        }
        surface
    }

    /// Lets the free phase end at the clearance.
    fn join_to_free(&mut self, fed: &Stack, unfed: &Stack) {
        let (Some(first), Some(empty)) = (fed.first(), unfed.first()) else {
            return;
        };
        if first != empty {
            self.surfaces[first.0].above_unfed = Some(self.surfaces[empty.0].above);
        }
        let guard = Guard::rising_to(self.surfaces[first.0].position);
        self.add_exit(PhaseId::FREE, guard, Exit::Forward(first));
    }
}

impl Stack {
    /// The surface at which it begins.
    fn first(&self) -> Option<SurfaceId> {
        self.layers.first().map(|layer| layer.surface).or(self.wall)
    }
}
