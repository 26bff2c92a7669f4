//! A machine as a few linear laws, each with what ends it, enclosed in intervals. Stops are lowered here anew, from their
//! equations, not by the engine.

use serde::Serialize;
use softstop::{Piercing, Release, Scene, Slope, Stop};

use crate::ProofError;
use crate::interval::Interval;
use crate::number::{Decay, Number};

/// m x'' + `damping` x' + `stiffness` x = `force` + F0 cos(drive angle).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Law {
    /// Damping in N s/m.
    pub damping: Interval,
    /// Net stiffness in N/m.
    pub stiffness: Interval,
    /// Constant force in N.
    pub force: Interval,
}

/// g = `position` x + `velocity` x' - `level`: what ends a phase as it rises through zero.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Guard {
    /// Weight of the position.
    pub position: Interval,
    /// Weight of the velocity.
    pub velocity: Interval,
    /// What is subtracted.
    pub level: Interval,
    /// By what the velocity is multiplied: -R at a rigid stop, else 1.
    pub factor: Interval,
    /// The phases that may follow.
    pub to: Vec<usize>,
    /// True if it is an impact.
    pub impact: bool,
}

/// A smooth law with what ends it.
#[derive(Debug, Clone, Serialize)]
pub struct Phase {
    /// Its name.
    pub name: String,
    /// Its law.
    pub law: Law,
    /// Its guards.
    pub guards: Vec<Guard>,
}

/// A range of positions.
#[derive(Debug, Clone)]
struct Layer {
    name: &'static str,
    from: Interval,
    forward: Law,
    /// The law of the way back, if it is another one.
    backward: Option<Law>,
    /// The law where the stop has let go, and the guard that lets it go.
    released: Option<(Law, Guard)>,
}

/// A machine whose laws are all linear.
#[derive(Debug, Clone, Serialize)]
pub struct Machine {
    /// The mass in kg.
    pub mass: Interval,
    /// The drive's amplitude F0 in N.
    pub amplitude: Interval,
    /// Its phases, the free flight first.
    pub phases: Vec<Phase>,
    #[serde(skip)]
    stack: Stack,
}

/// The layers, and position and restitution of the rigid stop.
#[derive(Debug, Clone)]
struct Stack {
    layers: Vec<Layer>,
    wall: Option<(Interval, Interval)>,
}

impl Guard {
    fn new(position: Interval, velocity: Interval, level: Interval) -> Self {
        Self {
            position,
            velocity,
            level,
            factor: Interval::ONE,
            to: Vec::new(),
            impact: false,
        }
    }

    fn rising_to(level: Interval) -> Self {
        Self::new(Interval::ONE, Interval::ZERO, level)
    }

    fn falling_to(level: Interval) -> Self {
        Self::rising_to(level).reversed()
    }

    fn of_velocity(weight: Interval) -> Self {
        Self::new(Interval::ZERO, weight, Interval::ZERO)
    }

    fn reversed(&self) -> Self {
        Self::new(-self.position, -self.velocity, -self.level)
    }

    fn leading_to(self, to: Vec<usize>) -> Self {
        Self { to, ..self }
    }

    /// Its value.
    pub fn value<T: Number>(&self, position: &T, velocity: &T) -> T {
        position.times(self.position) + velocity.times(self.velocity) - T::from(self.level)
    }

    /// True if both vanish at the same states.
    pub fn is_zero_with(&self, other: &Self) -> bool {
        let same = |a: &Self, b: &Self| {
            (a.position, a.velocity, a.level) == (b.position, b.velocity, b.level)
        };
        same(self, other) || same(self, &other.reversed())
    }
}

impl Machine {
    /// Encloses a scene.
    ///
    /// # Errors
    /// [`ProofError::Unsupported`] for a law without a closed form, and for surfaces that lie too near to each other.
    pub fn new(scene: &Scene) -> Result<Self, ProofError> {
        let stack = Stack::new(scene)?;
        Ok(Self {
            mass: Interval::point(scene.mass),
            amplitude: Interval::point(scene.excitation.amplitude),
            phases: stack.phases(),
            stack,
        })
    }

    /// The phase at a state that lies on no surface.
    pub fn phase_at(&self, position: f64, velocity: f64) -> usize {
        let below = |layer: &&Layer| layer.from.middle() < position;
        let index = self.stack.layers[1..].iter().filter(below).count();
        let layer = &self.stack.layers[index];
        let pulls = layer.released.as_ref().is_some_and(|(_, pulls)| {
            let [x, v] = [position, velocity].map(Interval::point);
            pulls.value(&x, &v).middle() > 0.0
        });
        let [forward, backward, released] = self.stack.numbers(index);
        match (pulls, velocity > 0.0) {
            (true, _) => released,
            (false, true) => forward,
            (false, false) => backward,
        }
    }

    /// Acceleration under a law at a state; `cosine` is that of the drive angle.
    pub fn acceleration<T: Number>(&self, law: &Law, position: &T, velocity: &T, cosine: &T) -> T {
        let force = T::from(law.force) + cosine.times(self.amplitude)
            - velocity.times(law.damping)
            - position.times(law.stiffness);
        force.times(Interval::ONE / self.mass)
    }

    /// The free motion of a law.
    pub fn decay(&self, law: &Law) -> Decay {
        Decay {
            rate: law.damping / (self.mass + self.mass),
            stiffness: law.stiffness / self.mass,
        }
    }
}

impl Stack {
    fn new(scene: &Scene) -> Result<Self, ProofError> {
        let point = Interval::point;
        let free = Law {
            damping: point(scene.damping),
            stiffness: point(scene.stiffness),
            force: Interval::ZERO,
        };
        let touching = Law {
            damping: point(scene.contact_damping),
            ..free
        };
        let mut face = point(scene.clearance);
        let mut layers = vec![Layer::new("free", Interval::WHOLE, free)];
        if let Some(strip) = scene.piercing {
            layers.extend(strip_layers(strip, face, touching));
            face = face + point(strip.thickness) + point(strip.travel);
        }
        let wall = match (&scene.stop, scene.rigid) {
            (Stop::Rigid { restitution }, _) => Some((face, point(*restitution))),
            (_, Some(rigid)) => Some((face + point(rigid.travel), point(rigid.restitution))),
            _ => None,
        };
        let before = |layer: &Layer| wall.is_none_or(|wall| layer.from.middle() < wall.0.middle());
        let stops = stop_layers(scene, free, touching, face)?;
        layers.extend(stops.into_iter().filter(before));
        let surfaces = layers[1..]
            .iter()
            .map(|layer| layer.from)
            .chain(wall.map(|it| it.0));
        let surfaces: Vec<Interval> = surfaces.collect();
        if surfaces
            .windows(2)
            .all(|pair| pair[0].high() < pair[1].low())
        {
            Ok(Self { layers, wall })
        } else {
            Err(ProofError::Unsupported(
                "surfaces of the machine lie too near to each other",
            ))
        }
    }

    /// The numbers of the phases of a layer, those that it lacks being the one of its way forward.
    fn numbers(&self, layer: usize) -> [usize; 3] {
        let count = |it: &Layer| {
            1 + usize::from(it.backward.is_some()) + usize::from(it.released.is_some())
        };
        let first = self.layers[..layer].iter().map(count).sum();
        let here = &self.layers[layer];
        let other = |has: bool| if has { first + 1 } else { first };
        [
            first,
            other(here.backward.is_some()),
            other(here.released.is_some()),
        ]
    }

    /// The phases that may follow where a layer is entered.
    fn entered(&self, layer: usize, forward: bool) -> Vec<usize> {
        let [onward, back, released] = self.numbers(layer);
        let mut to = vec![if forward { onward } else { back }];
        if self.layers[layer].released.is_some() {
            to.push(released);
        }
        to
    }

    fn phases(&self) -> Vec<Phase> {
        let layers = self.layers.iter().enumerate();
        layers
            .flat_map(|(index, layer)| self.phases_of(index, layer))
            .collect()
    }

    fn phases_of(&self, index: usize, layer: &Layer) -> Vec<Phase> {
        let [onward, back, released] = self.numbers(index);
        let falling = (index > 0)
            .then(|| Guard::falling_to(layer.from).leading_to(self.entered(index - 1, false)));
        let rising = match (self.layers.get(index + 1), self.wall) {
            (Some(next), _) => Some(Guard {
                impact: index == 0,
                ..Guard::rising_to(next.from).leading_to(self.entered(index + 1, true))
            }),
            (None, Some((wall, restitution))) => Some(Guard {
                impact: index == 0,
                factor: -restitution,
                ..Guard::rising_to(wall).leading_to(self.entered(index, false))
            }),
            (None, None) => None,
        };
        let phase = |name: &str, law: Law, guards: [Option<Guard>; 3]| Phase {
            name: name.to_owned(),
            law,
            guards: guards.into_iter().flatten().collect(),
        };
        if let Some(law) = layer.backward {
            let turns = Guard::of_velocity(Interval::ONE);
            let turns_back = turns.reversed().leading_to(vec![back]);
            let turns_on = turns.leading_to(vec![onward]);
            return vec![
                phase(layer.name, layer.forward, [rising, Some(turns_back), None]),
                phase(
                    &format!("{} back", layer.name),
                    law,
                    [falling, Some(turns_on), None],
                ),
            ];
        }
        let Some((law, pulls)) = &layer.released else {
            return vec![phase(layer.name, layer.forward, [falling, rising, None])];
        };
        let presses = pulls.reversed().leading_to(vec![onward]);
        let pulls = pulls.clone().leading_to(vec![released]);
        vec![
            phase(
                layer.name,
                layer.forward,
                [falling.clone(), rising.clone(), Some(pulls)],
            ),
            phase("released", *law, [falling, rising, Some(presses)]),
        ]
    }
}

/// Phases I and II (Peterka 2003, eqs. 1-4).
fn strip_layers(strip: Piercing, face: Interval, touching: Law) -> Vec<Layer> {
    let [stiffness, friction, thickness] =
        [strip.stiffness, strip.friction, strip.thickness].map(Interval::point);
    let elastic = |stiffness| touching.with_spring(stiffness, face, Interval::ZERO);
    let share = thickness * (stiffness + friction);
    let rub = |part: f64| Law {
        force: -(share / Interval::point(part)),
        ..touching
    };
    let layer = |name, from, forward, backward| Layer {
        backward: Some(backward),
        ..Layer::new(name, from, forward)
    };
    let pierce = (strip.thickness > 0.0).then(|| {
        layer(
            "pierce",
            face,
            elastic(stiffness + friction),
            elastic(stiffness - friction),
        )
    });
    let cut = (strip.travel > 0.0).then(|| layer("cut", face + thickness, rub(10.0), rub(-20.0)));
    pierce.into_iter().chain(cut).collect()
}

impl Law {
    /// This law and a spring that presses with `preload` at `origin`.
    fn with_spring(self, stiffness: Interval, origin: Interval, preload: Interval) -> Self {
        Self {
            stiffness: self.stiffness + stiffness,
            force: stiffness * origin - preload,
            ..self
        }
    }
}

impl Layer {
    fn new(name: &'static str, from: Interval, forward: Law) -> Self {
        Self {
            name,
            from,
            forward,
            backward: None,
            released: None,
        }
    }
}

/// The layers of the stop, from its face on.
fn stop_layers(
    scene: &Scene,
    free: Law,
    touching: Law,
    face: Interval,
) -> Result<Vec<Layer>, ProofError> {
    let point = Interval::point;
    let spring = |stiffness: f64, preload: f64| {
        let law = touching.with_spring(point(stiffness), face, point(preload));
        Layer::new("stop", face, law)
    };
    Ok(match &scene.stop {
        Stop::None if scene.piercing.is_none() && scene.rigid.is_none() => Vec::new(),
        Stop::None | Stop::Rigid { .. } => vec![Layer::new("gap", face, touching)],
        Stop::Preloaded { stiffness, preload } => vec![spring(*stiffness, *preload)],
        Stop::KelvinVoigt { stiffness, release } => {
            let extra = point(scene.contact_damping) - point(scene.damping);
            let clips = *release == Release::ZeroForce && extra != Interval::ZERO;
            let stiffness_of = point(*stiffness);
            let pulls = Guard::new(-stiffness_of, -extra, -(stiffness_of * face));
            vec![Layer {
                released: clips.then_some((free, pulls)),
                ..spring(*stiffness, 0.0)
            }]
        }
        Stop::PiecewiseLinear { loading, unloading } => slopes(face, touching, loading, unloading),
        Stop::Hertz {
            stiffness,
            exponent: 1.0,
            dissipation: 0.0,
        } => vec![spring(*stiffness, 0.0)],
        Stop::Hertz { .. } => {
            return Err(ProofError::Unsupported(
                "stop.model = \"hertz\": a power law has no closed form to enclose",
            ));
        }
    })
}

/// One layer from each deflection at which a slope of either way begins.
fn slopes(face: Interval, touching: Law, loading: &[Slope], unloading: &[Slope]) -> Vec<Layer> {
    let same = unloading.is_empty() || unloading == loading;
    let back = if same { loading } else { unloading };
    let mut starts: Vec<f64> = loading.iter().chain(back).map(|slope| slope.from).collect();
    starts.sort_by(f64::total_cmp);
    starts.dedup();
    let law = |chain: &[Slope], start: f64| {
        let mut force = Interval::ZERO;
        let mut stiffness = Interval::ZERO;
        for (index, slope) in chain.iter().enumerate() {
            if slope.from > start {
                break;
            }
            let end = chain
                .get(index + 1)
                .map_or(start, |next| next.from.min(start));
            let passed = Interval::point(end) - Interval::point(slope.from);
            force = force + Interval::point(slope.stiffness) * passed;
            stiffness = Interval::point(slope.stiffness);
        }
        touching.with_spring(stiffness, face + Interval::point(start), force)
    };
    let layer = |start: f64| Layer {
        backward: (!same).then(|| law(back, start)),
        ..Layer::new("stop", face + Interval::point(start), law(loading, start))
    };
    starts.into_iter().map(layer).collect()
}
