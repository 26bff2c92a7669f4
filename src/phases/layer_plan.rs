//! The plan of the layers that a scene's stop and strip make, before their phases are numbered.

use super::{LawCoefficients, PhaseKind, SpringEnergy};
use crate::events::Guard;
use crate::flow::PowerLaw;
use crate::scene::{Release, Scene, Slope, Stop, Strip, force_of, stiffness_from};

/// The plan of one layer of positions.
pub(super) struct LayerPlan {
    pub kind: PhaseKind,
    pub from: f64,
    pub forward: LawCoefficients,
    /// The law of the way back, if it is another one.
    pub backward: Option<LawCoefficients>,
    /// The linear law that holds while the guard is above zero.
    pub released: Option<(LawCoefficients, Guard)>,
    pub hertz: Option<PowerLaw>,
    pub spring: SpringEnergy,
    pub is_far_side: bool,
}

impl LayerPlan {
    fn new(kind: PhaseKind, from: f64, forward: LawCoefficients) -> Self {
        Self {
            kind,
            from,
            forward,
            backward: None,
            released: None,
            hertz: None,
            spring: SpringEnergy {
                origin: from,
                ..SpringEnergy::default()
            },
            is_far_side: false,
        }
    }
}

/// The layers beyond the clearance, with or without a strip in them.
pub(super) fn plan_layers(scene: &Scene, free: LawCoefficients, fed: bool) -> Vec<LayerPlan> {
    let touching = LawCoefficients {
        damping: scene.contact_damping,
        ..free
    };
    let near = scene.clearance;
    let mut plans = match scene.piercing {
        Some(strip) if fed => strip_layers(strip, near, touching),
        Some(_) => vec![LayerPlan::new(PhaseKind::Gap, near, touching)],
        None => Vec::new(),
    };
    let count = plans.len();
    plans.extend(stop_layers(scene, free, touching, fed));
    if plans[..count]
        .last()
        .is_some_and(|below| below.kind == PhaseKind::Pierce)
        && let Some(stop) = plans.get_mut(count)
    {
        stop.is_far_side = true;
    }
    plans
}

/// Phases I and II (Peterka 2003, eqs. 1-4); a layer without thickness does not exist.
fn strip_layers(strip: Strip, near: f64, touching: LawCoefficients) -> Vec<LayerPlan> {
    let elastic = |stiffness: f64| LawCoefficients {
        stiffness: touching.stiffness + stiffness,
        force: stiffness * near,
        ..touching
    };
    let pierce = (strip.thickness > 0.0).then(|| LayerPlan {
        backward: Some(elastic(strip.stiffness - strip.friction)),
        ..LayerPlan::new(
            PhaseKind::Pierce,
            near,
            elastic(strip.stiffness + strip.friction),
        )
    });
    let rub = |force: f64| LawCoefficients {
        force: -force,
        ..touching
    };
    let cut = (strip.travel > 0.0).then(|| LayerPlan {
        backward: Some(rub(strip.cut_force_backward())),
        is_far_side: true,
        ..LayerPlan::new(
            PhaseKind::Cut,
            near + strip.thickness,
            rub(strip.cut_force_forward()),
        )
    });
    pierce.into_iter().chain(cut).collect()
}

/// The layers of the stop itself.
fn stop_layers(
    scene: &Scene,
    free: LawCoefficients,
    touching: LawCoefficients,
    fed: bool,
) -> Vec<LayerPlan> {
    let from = scene.stop_position();
    let bare_wall = scene.piercing.is_none() && scene.rigid.is_some();
    let spring = |stiffness: f64, preload: f64| {
        let origin = SpringEnergy {
            origin: from,
            energy: 0.0,
            force: preload,
            stiffness,
        };
        LayerPlan {
            spring: origin,
            ..LayerPlan::new(PhaseKind::Stop, from, spring_law(touching, &origin))
        }
    };
    match &scene.stop {
        // The end of the strip, or the way to a rigid stop, with nothing else there.
        Stop::None if (fed && scene.piercing.is_some()) || bare_wall => {
            vec![LayerPlan::new(PhaseKind::Gap, from, touching)]
        }
        // A rigid stop is the wall that ends the stack. Before it stands nothing but the far side of the strip.
        Stop::Rigid { .. } => vec![LayerPlan::new(PhaseKind::Gap, from, touching)],
        Stop::None => Vec::new(),
        Stop::Preloaded { stiffness, preload } => vec![spring(*stiffness, *preload)],
        Stop::KelvinVoigt { stiffness, release } => {
            let extra = scene.contact_damping - scene.damping;
            let pulls = Guard {
                position: -stiffness,
                velocity: -extra,
                forcing: 0.0,
                level: -stiffness * from,
            };
            let clips = *release == Release::ZeroForce && extra != 0.0;
            vec![LayerPlan {
                released: clips.then_some((free, pulls)),
                ..spring(*stiffness, 0.0)
            }]
        }
        Stop::PiecewiseLinear { loading, unloading } => {
            slope_plans(from, touching, loading, unloading)
        }
        // An exponent of 1 without dissipation is a linear spring.
        Stop::Hertz {
            stiffness,
            exponent: 1.0,
            dissipation: 0.0,
        } => vec![spring(*stiffness, 0.0)],
        Stop::Hertz {
            stiffness,
            exponent,
            dissipation,
        } => vec![LayerPlan {
            hertz: Some(PowerLaw {
                stiffness: *stiffness,
                exponent: *exponent,
                dissipation: *dissipation,
                origin: from,
                side: 1.0,
                mass: scene.mass,
            }),
            released: (*dissipation > 0.0).then(|| {
                let pulls = Guard {
                    velocity: -dissipation,
                    level: 1.0,
                    ..Guard::NONE
                };
                (touching, pulls)
            }),
            ..LayerPlan::new(PhaseKind::Stop, from, touching)
        }],
    }
}

/// The law of a layer under a stop's spring.
fn spring_law(touching: LawCoefficients, spring: &SpringEnergy) -> LawCoefficients {
    LawCoefficients {
        stiffness: touching.stiffness + spring.stiffness,
        force: spring.stiffness * spring.origin - spring.force,
        ..touching
    }
}

/// One layer from each deflection at which a slope of either way begins. What is stored is what the way back gives.
fn slope_plans(
    from: f64,
    touching: LawCoefficients,
    loading: &[Slope],
    unloading: &[Slope],
) -> Vec<LayerPlan> {
    let same = unloading.is_empty() || unloading == loading;
    let back = if same { loading } else { unloading };
    let mut starts: Vec<f64> = loading.iter().chain(back).map(|slope| slope.from).collect();
    starts.sort_by(f64::total_cmp);
    starts.dedup();
    let spring = |slopes: &[Slope], start: f64| SpringEnergy {
        origin: from + start,
        energy: 0.0,
        force: force_of(slopes, start),
        stiffness: stiffness_from(slopes, start),
    };
    let mut energy = 0.0;
    let mut plans: Vec<LayerPlan> = Vec::with_capacity(starts.len());
    for start in starts {
        let stored = spring(back, start);
        if let Some(below) = plans.last() {
            energy = below.spring.energy_at(stored.origin);
        }
        let forward = spring_law(touching, &spring(loading, start));
        plans.push(LayerPlan {
            backward: (!same).then(|| spring_law(touching, &stored)),
            spring: SpringEnergy { energy, ..stored },
            ..LayerPlan::new(PhaseKind::Stop, stored.origin, forward)
        });
    }
    plans
}
