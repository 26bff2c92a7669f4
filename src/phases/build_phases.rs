//! Builds the phases of a scene from its data, layer by layer.

use std::borrow::Cow;
use std::sync::Arc;

use super::layer_plan::{LayerPlan, plan_layers};
use super::{
    Beyond, Exit, LawCoefficients, Layer, Phase, PhaseId, PhaseKind, Phases, Stack, StopEnergy,
    Surface, SurfaceId,
};
use crate::events::Guard;
use crate::flow::{LinearLaw, PowerLaw};
use crate::scene::Scene;

impl Phases {
    /// Lowers a valid scene to its phases.
    pub(crate) fn of_scene(scene: &Scene) -> Self {
        let free = LawCoefficients {
            damping: scene.damping,
            stiffness: scene.stiffness,
            force: 0.0,
        };
        let drive = scene.excitation;
        let mut builder = PhaseBuilder {
            scene: Cow::Borrowed(scene),
            side: 1.0,
            phases: Vec::with_capacity(8),
            surfaces: Vec::new(),
        };
        builder.add_phase(PhaseKind::Free, free, None, StopEnergy::default());
        let unfed = builder.add_stack(&plan_layers(scene, free, false));
        let fed = match scene.piercing {
            Some(_) => builder.add_stack(&plan_layers(scene, free, true)),
            None => unfed.clone(),
        };
        builder.join_to_free(&fed, &unfed);
        let below = match scene.mirrored() {
            Some(mirrored) => builder.add_stack_below(mirrored, free),
            None => Stack::default(),
        };
        Phases {
            phases: builder.phases,
            surfaces: builder.surfaces.into(),
            amplitude: drive.amplitude / scene.mass,
            frequency: drive.frequency,
            mass: scene.mass,
            held: LinearLaw::new(scene.mass, 0.0, 0.0, drive.amplitude, drive.frequency),
            fed,
            unfed,
            below,
        }
    }
}

/// The phases and surfaces of a scene, as they are added.
struct PhaseBuilder<'a> {
    scene: Cow<'a, Scene>,
    /// 1 as the scene is, -1 where it is a mirrored one: its plans then count positions downwards.
    side: f64,
    phases: Vec<Phase>,
    surfaces: Vec<Surface>,
}

impl PhaseBuilder<'_> {
    fn add_phase(
        &mut self,
        kind: PhaseKind,
        law: LawCoefficients,
        hertz: Option<PowerLaw>,
        store: StopEnergy,
    ) -> PhaseId {
        let (scene, drive) = (&self.scene, self.scene.excitation);
        let id = PhaseId(self.phases.len() as u32);
        let law = LawCoefficients {
            force: self.side * law.force,
            ..law
        };
        self.phases.push(Phase {
            id,
            kind,
            law,
            contact: LawCoefficients {
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
            hertz: hertz.map(|hertz| hertz.on_side(self.side)),
            guards: Arc::default(),
            exits: Arc::default(),
            store: store.on_side(self.side),
            released: None,
            side: self.side,
        });
        id
    }

    /// A guard of the plan of a layer, mirrored where the layer belongs to the stop below.
    fn guard_on_side(&self, planned: Guard) -> Guard {
        if self.side < 0.0 {
            planned.mirrored()
        } else {
            planned
        }
    }

    fn add_exit(&mut self, phase: PhaseId, guard: Guard, exit: Exit) {
        let guard = self.guard_on_side(guard);
        let phase = &mut self.phases[phase.index()];
        Arc::make_mut(&mut phase.guards).push(guard);
        Arc::make_mut(&mut phase.exits).push(exit);
    }

    /// Adds the stack of a stop below, of the machine that is mirrored.
    fn add_stack_below(&mut self, mirrored: Scene, free: LawCoefficients) -> Stack {
        let plans = plan_layers(&mirrored, free, false);
        (self.scene, self.side) = (Cow::Owned(mirrored), -1.0);
        let stack = self.add_stack(&plans);
        self.join_to_free(&stack, &stack);
        stack
    }

    /// Adds the layers of one stack, from the clearance on, and the wall that ends it.
    fn add_stack(&mut self, plans: &[LayerPlan]) -> Stack {
        let wall = self.scene.wall();
        let within = |plan: &&LayerPlan| wall.is_none_or(|wall| plan.from < wall.position);
        let mut layers: Vec<Layer> = Vec::with_capacity(plans.len());
        for plan in plans.iter().filter(within) {
            let layer = self.add_layer(plan, layers.last().copied());
            layers.push(layer);
        }
        let wall = wall.map(|wall| {
            let (position, restitution) = (wall.position, wall.restitution);
            let beyond = Beyond::Wall { restitution };
            let layer_in_front = layers.last().copied();
            let is_far_side = plans
                .iter()
                .any(|plan| plan.is_far_side && plan.from == position);
            self.add_surface(position, layer_in_front, beyond, is_far_side)
        });
        Stack {
            layers: layers.into(),
            wall,
        }
    }

    /// Adds a layer as planned, its phases and the surface at which it begins, where the layer in front of it, if any, ends.
    fn add_layer(&mut self, plan: &LayerPlan, layer_in_front: Option<Layer>) -> Layer {
        let store = StopEnergy {
            spring: plan.spring,
            hertz: plan.hertz,
        };
        let add = |builder: &mut Self, law| builder.add_phase(plan.kind, law, plan.hertz, store);
        let inward = add(self, plan.forward);
        let outward = plan.backward.map_or(inward, |law| add(self, law));
        let beyond = Beyond::Phase(inward);
        let surface = self.add_surface(plan.from, layer_in_front, beyond, plan.is_far_side);
        let falling = Guard::falling_to(plan.from);
        self.add_exit(outward, falling, Exit::Backward(surface));
        let (forward, backward) = match self.side < 0.0 {
            true => (outward, inward),
            false => (inward, outward),
        };
        if inward != outward {
            let reversal = Exit::Reversal { forward, backward };
            let turning_forward = Guard::turning_forward();
            self.add_exit(inward, turning_forward.negated(), reversal);
            self.add_exit(outward, turning_forward, reversal);
        }
        if let Some((law, pulls)) = plan.released {
            let released = self.add_phase(PhaseKind::Released, law, None, store);
            self.add_exit(released, falling, Exit::Backward(surface));
            self.add_exit(released, pulls.negated(), Exit::Switch(inward));
            self.add_exit(inward, pulls, Exit::Switch(released));
            self.phases[inward.index()].released = Some((released, self.guard_on_side(pulls)));
        }
        Layer {
            from: self.side * plan.from,
            forward,
            backward,
            side: self.side,
            surface,
        }
    }

    /// Adds the surface at `position`, with what lies `beyond` it; the layer in front of it, if any, ends there.
    fn add_surface(
        &mut self,
        position: f64,
        layer_in_front: Option<Layer>,
        beyond: Beyond,
        is_far_side: bool,
    ) -> SurfaceId {
        let surface = SurfaceId(self.surfaces.len());
        self.surfaces.push(Surface {
            position: self.side * position,
            before: layer_in_front.map_or(PhaseId::FREE, Layer::outward_phase),
            beyond,
            beyond_unfed: None,
            side: self.side,
            is_clearance: layer_in_front.is_none(),
            is_far_side,
        });
        if let Some(layer) = layer_in_front {
            let released = self.phases[layer.inward_phase().index()].released;
            let guard = Guard::rising_to(position);
            self.add_exit(layer.inward_phase(), guard, Exit::Forward(surface));
            if let Some((released, _)) = released {
                self.add_exit(released, guard, Exit::Forward(surface));
            }
        }
        surface
    }

    /// Lets the free phase end at a clearance.
    fn join_to_free(&mut self, fed: &Stack, unfed: &Stack) {
        let (Some(first), Some(empty)) = (fed.first_surface(), unfed.first_surface()) else {
            return;
        };
        if first != empty {
            self.surfaces[first.0].beyond_unfed = Some(self.surfaces[empty.0].beyond);
        }
        let guard = Guard::rising_to(self.side * self.surfaces[first.0].position);
        self.add_exit(PhaseId::FREE, guard, Exit::Forward(first));
    }
}
