//! A scene as layers of positions, their laws and what rubs there, in many digits.
//!
//! Built from the user's data alone: sums of parameters are not rounded, and nothing of the core's lowering is used.

use softstop::{Release, Scene, Slope, Stop};

use super::ReferenceError;
use super::number::{Digits, Real};

/// x'' = push - `damping` x' - `stiffness` x + `force`, all per mass.
#[derive(Debug, Clone, PartialEq)]
pub struct Law {
    /// Damping in 1/s.
    pub damping: Real,
    /// Stiffness in 1/s^2.
    pub stiffness: Real,
    /// Constant force in m/s^2.
    pub force: Real,
}

/// A stop that presses only while `stiffness` (x - face) + `damping` v > 0; else the law is `free`.
#[derive(Debug, Clone)]
pub struct Grip {
    /// In N/m.
    pub stiffness: Real,
    /// What contact adds, in N s/m.
    pub damping: Real,
    /// The law without contact.
    pub free: Law,
}

/// A range of positions with one law for the way forward and one for the way back.
#[derive(Debug, Clone)]
pub struct Layer {
    /// Its lower end; none of the free layer.
    pub from: Option<Real>,
    /// Its upper end, if any.
    pub to: Option<Real>,
    /// Law of the way forward.
    pub forward: Law,
    /// Law of the way back.
    pub backward: Law,
    /// A stop that may let go.
    pub grip: Option<Grip>,
}

impl Layer {
    /// That of a way.
    pub fn law(&self, forward: bool) -> &Law {
        match forward {
            true => &self.forward,
            false => &self.backward,
        }
    }

    /// True if the force jumps where the velocity changes its sign.
    pub fn rubs(&self) -> bool {
        self.forward != self.backward
    }
}

/// The drive, per mass: `amplitude` cos(`frequency` t + `phase`).
#[derive(Debug, Clone)]
pub struct Drive {
    /// In m/s^2.
    pub amplitude: Real,
    /// In rad/s.
    pub frequency: Real,
    /// In rad.
    pub phase: Real,
}

/// A scene as layers.
#[derive(Debug, Clone)]
pub struct Machine {
    /// The layers in order of position; the first is the free one.
    pub layers: Vec<Layer>,
    /// Restitution of the rigid stop that ends the last layer, if one does.
    pub restitution: Option<Real>,
    /// The drive.
    pub drive: Drive,
}

impl Machine {
    /// The layers of a valid scene.
    ///
    /// # Errors
    /// [`ReferenceError::PowerLaw`] if a law is not linear.
    pub fn new(scene: &Scene, digits: Digits) -> Result<Self, ReferenceError> {
        let real = |value: f64| digits.real(value);
        let mass = real(scene.mass);
        let free = Law {
            damping: real(scene.damping) / &mass,
            stiffness: real(scene.stiffness) / &mass,
            force: real(0.0),
        };
        let touching = Law {
            damping: real(scene.contact_damping) / &mass,
            ..free.clone()
        };
        let mut builder = Builder {
            digits,
            mass,
            touching,
            layers: vec![Layer {
                from: None,
                to: None,
                forward: free.clone(),
                backward: free,
                grip: None,
            }],
        };
        let face = builder.strip(scene);
        let wall = builder.stop(scene, &face)?;
        let drive = Drive {
            amplitude: real(scene.excitation.amplitude) / &builder.mass,
            frequency: real(scene.excitation.frequency),
            phase: real(scene.excitation.phase),
        };
        let mut layers = builder.layers;
        if let Some((position, _)) = &wall {
            layers.retain(|layer| layer.from.as_ref().is_none_or(|from| from < position));
        }
        let ends = layers.iter().skip(1).map(|next| next.from.clone());
        let ends: Vec<_> = ends.collect();
        let last = wall.as_ref().map(|(position, _)| position.clone());
        for (layer, end) in layers.iter_mut().zip(ends.into_iter().chain([last])) {
            layer.to = end;
        }
        Ok(Self {
            layers,
            restitution: wall.map(|(_, restitution)| restitution),
            drive,
        })
    }
}

struct Builder {
    digits: Digits,
    mass: Real,
    /// Suspension and contact damping alone.
    touching: Law,
    layers: Vec<Layer>,
}

impl Builder {
    fn real(&self, value: f64) -> Real {
        self.digits.real(value)
    }

    fn add(&mut self, from: &Real, forward: Law, backward: Law, grip: Option<Grip>) {
        self.layers.push(Layer {
            from: Some(from.clone()),
            to: None,
            forward,
            backward,
            grip,
        });
    }

    /// Contact with a spring that gives `force` at `origin`.
    fn sprung(&self, stiffness: &Real, origin: &Real, force: &Real) -> Law {
        Law {
            damping: self.touching.damping.clone(),
            stiffness: &self.touching.stiffness + stiffness / &self.mass,
            force: (stiffness * origin - force) / &self.mass,
        }
    }

    /// Phases I and II (Peterka 2003, eqs. 1-4); where the stop stands behind them.
    fn strip(&mut self, scene: &Scene) -> Real {
        let near = self.real(scene.clearance);
        let Some(strip) = scene.piercing else {
            return near;
        };
        let (zero, thickness) = (self.real(0.0), self.real(strip.thickness));
        let (forming, friction) = (self.real(strip.stiffness), self.real(strip.friction));
        if strip.thickness > 0.0 {
            let forward = self.sprung(&(&forming + &friction), &near, &zero);
            let backward = self.sprung(&(&forming - &friction), &near, &zero);
            self.add(&near, forward, backward, None);
        }
        let cut = near + &thickness;
        if strip.travel > 0.0 {
            let unit = thickness * (forming + friction) / self.real(40.0);
            let forward = self.sprung(&zero, &zero, &(&unit * self.real(4.0)));
            let backward = self.sprung(&zero, &zero, &(unit * self.real(-2.0)));
            self.add(&cut, forward, backward, None);
        }
        cut + self.real(strip.travel)
    }

    /// The stop's own layers, and the rigid stop at the end of all.
    fn stop(&mut self, scene: &Scene, face: &Real) -> Result<Option<(Real, Real)>, ReferenceError> {
        let zero = self.real(0.0);
        let wall = scene.rigid.map(|rigid| {
            let position = face + self.real(rigid.travel);
            (position, self.real(rigid.restitution))
        });
        match &scene.stop {
            Stop::Rigid { restitution } => {
                return Ok(Some((face.clone(), self.real(*restitution))));
            }
            Stop::None if scene.piercing.is_none() && wall.is_none() => {}
            Stop::None => self.spring(face, &zero, &zero, None),
            Stop::Preloaded { stiffness, preload } => {
                let (stiffness, preload) = (self.real(*stiffness), self.real(*preload));
                self.spring(face, &stiffness, &preload, None);
            }
            Stop::KelvinVoigt { stiffness, release } => {
                let stiffness = self.real(*stiffness);
                let grip = self.release(scene, *release, &stiffness);
                self.spring(face, &stiffness, &zero, grip);
            }
            Stop::PiecewiseLinear { loading, unloading } => {
                let ways = [unloading, loading];
                self.slopes(face, loading, ways[usize::from(unloading.is_empty())]);
            }
            // A linear spring.
            Stop::Hertz {
                stiffness,
                exponent: 1.0,
                dissipation: 0.0,
            } => self.spring(face, &self.real(*stiffness), &zero, None),
            &Stop::Hertz {
                exponent,
                dissipation,
                ..
            } => {
                return Err(ReferenceError::PowerLaw {
                    exponent,
                    dissipation,
                });
            }
        }
        Ok(wall)
    }

    fn spring(&mut self, face: &Real, stiffness: &Real, force: &Real, grip: Option<Grip>) {
        let law = self.sprung(stiffness, face, force);
        self.add(face, law.clone(), law, grip);
    }

    /// A Kelvin-Voigt stop that is let go at zero force never pulls.
    fn release(&self, scene: &Scene, release: Release, stiffness: &Real) -> Option<Grip> {
        let lets_go = release != Release::Clearance && scene.contact_damping != scene.damping;
        lets_go.then(|| Grip {
            stiffness: stiffness.clone(),
            damping: self.real(scene.contact_damping) - self.real(scene.damping),
            free: self.layers[0].forward.clone(),
        })
    }

    /// One layer from each deflection on at which a slope of either way begins.
    fn slopes(&mut self, face: &Real, loading: &[Slope], back: &[Slope]) {
        let mut starts: Vec<f64> = loading.iter().chain(back).map(|slope| slope.from).collect();
        starts.sort_by(f64::total_cmp);
        starts.dedup();
        for start in starts {
            let from = face + self.real(start);
            let law = |builder: &Self, slopes: &[Slope]| {
                let (stiffness, force) = builder.chain(slopes, start);
                builder.sprung(&stiffness, &from, &force)
            };
            let (forward, backward) = (law(self, loading), law(self, back));
            self.add(&from, forward, backward, None);
        }
    }

    /// Stiffness from a deflection on and force there, of a continuous chain.
    fn chain(&self, slopes: &[Slope], deflection: f64) -> (Real, Real) {
        let (mut force, mut stiffness, mut from) = (self.real(0.0), self.real(0.0), 0.0);
        for slope in slopes.iter().take_while(|slope| slope.from <= deflection) {
            force += &stiffness * (self.real(slope.from) - self.real(from));
            (stiffness, from) = (self.real(slope.stiffness), slope.from);
        }
        force += &stiffness * (self.real(deflection) - self.real(from));
        (stiffness, force)
    }
}
