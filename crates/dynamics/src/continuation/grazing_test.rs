//! The grazing test: how near to grazing an orbit is, and the grazing orbits ahead of it.

use std::cell::OnceCell;
use std::f64::consts::TAU;

use super::crossing_counts::crossings_dying_with;
use super::equations::CurveNode;
use super::impact_section_orbit::ImpactSectionOrbit;
use super::impact_section_system::ImpactSectionSystem;
use super::newton_corrector::correct;
use super::period_map::PeriodMap;
use super::stroboscopic_shooting::Shooting;
use super::switching_surface::NearGrazing;
use super::{BranchPoint, Family, GrazingTouch, SpecialKind, SpecialPoint, SwitchingSurface};
use crate::orbit::OrbitError;
use softstop::internals::turning_points;
use softstop::{CrossingKind, Scene, Trajectory};

/// A grazing test of an orbit: its slowest crossing and its nearest turning point.
#[derive(Debug, Clone)]
pub(crate) struct GrazingTest {
    /// The slowest crossing, which may die.
    dying: Option<NearGrazing>,
    rising: Option<NearGrazing>,
    /// Crossings of the orbit, and those that a dying impact takes along.
    crossings: (usize, usize),
    /// Which surfaces an orbit can graze smoothly.
    continuous: [bool; SwitchingSurface::ALL.len()],
    parameter: f64,
    /// True if the orbit is its own mirror image half its period later: touches come in pairs.
    is_symmetric: bool,
    /// Drive angle at the section and frequency.
    drive: (f64, f64),
    /// Drive angle from phi to the section.
    turned: f64,
    speed: f64,
    /// What the distances of both touches to a smooth grazing have lost per unit of arclength on the step before.
    losses: [f64; 2],
    /// Grazing orbits near it, once they are asked for.
    grazes: OnceCell<Vec<SpecialPoint>>,
}

impl GrazingTest {
    /// The grazing test of the orbit at a node.
    pub fn of_node(shooting: &Shooting<'_, 1>, node: &CurveNode<PeriodMap>) -> Self {
        let round = &node.here.point;
        let total = round.counts.crossing_count();
        let motion = &round.trajectory;
        let scene = &motion.scene;
        let taken = round
            .slowest
            .map_or(0, |touch| crossings_dying_with(motion, touch.time));
        Self {
            dying: round.slowest,
            continuous: SwitchingSurface::ALL.map(|surface| surface.is_force_continuous(scene)),
            rising: nearest_turn(motion, scene),
            crossings: (total, taken),
            parameter: shooting.parameters(&node.at)[0],
            is_symmetric: shooting.symmetric_half_period(node).is_some(),
            drive: (scene.excitation.reduced_phase(), scene.excitation.frequency),
            turned: TAU * shooting.turn,
            speed: shooting.velocity_scale(),
            losses: [0.0; 2],
            grazes: OnceCell::new(),
        }
    }

    /// This grazing test with what its distances have lost per unit of arclength on the `step` from the test `before`.
    pub fn with_losses_on_step(self, before: &Self, step: f64) -> Self {
        let loss = |(then, now): (Option<NearGrazing>, Option<NearGrazing>)| match (then, now) {
            (Some(then), Some(now))
                if then.surface == now.surface && self.is_force_continuous(now.surface) =>
            {
                (then.amount - now.amount) / step
            }
            _ => 0.0,
        };
        let losses = [(before.dying, self.dying), (before.rising, self.rising)].map(loss);
        Self { losses, ..self }
    }

    /// True if the `step` to the test `ahead` may graze twice: a distance to a smooth grazing would vanish, no crossing changes.
    pub fn may_graze_twice(&self, ahead: &Self, step: f64) -> bool {
        let vanishes = |(touch, loss): (Option<NearGrazing>, f64)| {
            touch.is_some_and(|touch| touch.amount < loss * step)
        };
        self.crossings.0 == ahead.crossings.0
            && [self.dying, self.rising]
                .into_iter()
                .zip(self.losses)
                .any(vanishes)
    }

    /// True if the step from the test `before` leaves at least `share` of each distance to a grazing that is not smooth, or comes
    /// within `near` (scaled) of the grazing.
    pub fn keeps_share_of_distances(&self, before: &Self, share: f64, near: f64) -> bool {
        let leaves = |now: Option<NearGrazing>, then: Option<NearGrazing>| match (now, then) {
            (Some(now), Some(then)) if !self.is_force_continuous(now.surface) => {
                now.amount >= share * then.amount || now.amount < near * self.speed
            }
            _ => true,
        };
        leaves(self.dying, before.dying) && leaves(self.rising, before.rising)
    }

    /// True if a crossing with a jump of the force is slower than `near` (scaled): it is about to die.
    pub fn dies_closer_than(&self, near: f64) -> bool {
        let dies = |touch: NearGrazing| {
            touch.amount < near * self.speed && !self.is_force_continuous(touch.surface)
        };
        self.dying.is_some_and(dies)
    }

    /// True if an orbit can graze a surface smoothly.
    pub fn is_force_continuous(&self, surface: SwitchingSurface) -> bool {
        self.continuous[surface as usize]
    }

    /// The grazing orbits that Newton's method reaches from the tested one, computed once.
    pub fn grazing_orbits(&self, shooting: &Shooting<'_, 1>) -> &[SpecialPoint] {
        self.grazes.get_or_init(|| self.find_grazings(shooting))
    }

    /// Finds the grazing orbits that Newton's method reaches from both touches.
    fn find_grazings(&self, shooting: &Shooting<'_, 1>) -> Vec<SpecialPoint> {
        let touches = if self.is_symmetric { 2 } else { 1 };
        let (total, taken) = self.crossings;
        let dying = self.dying.zip(total.checked_sub(touches * taken));
        // Where the force jumps down, the mass goes on from rest at the surface.
        let passing = self
            .dying
            .filter(|_| taken > 1)
            .zip(total.checked_sub(touches));
        let rising = self.rising.and_then(|touch| {
            let taken = touches * usize::from(touch.reverses);
            Some((touch, total.checked_sub(taken)?))
        });
        [(dying, true), (passing, true), (rising, false)]
            .into_iter()
            .filter_map(|(touch, dies)| {
                let (touch, crossings) = touch?;
                self.solve_grazing(shooting, &touch, crossings, dies).ok()
            })
            .collect()
    }

    /// The grazing orbit that Newton's method reaches from a near touch.
    fn solve_grazing(
        &self,
        shooting: &Shooting<'_, 1>,
        touch: &NearGrazing,
        crossings: usize,
        dies: bool,
    ) -> Result<SpecialPoint, OrbitError> {
        let (phase, frequency) = self.drive;
        let near = GrazingTouch {
            angle: phase + frequency * touch.time,
            impacts: 0,
            dies,
            surface: touch.surface,
            is_symmetric: self.is_symmetric,
            crossings,
        };
        let orbits = (shooting.family, shooting.periods);
        find_grazing(orbits, &near, phase - self.turned, self.parameter)
    }
}

/// The grazing orbit of a family, over a number of drive periods, that Newton's method reaches from the drive angle of
/// another one's touch and from a parameter; its own angle is counted on from `phase`.
pub(crate) fn find_grazing(
    (family, periods): (&dyn Family, u64),
    near: &GrazingTouch,
    phase: f64,
    parameter: f64,
) -> Result<SpecialPoint, OrbitError> {
    let touching = ImpactSectionSystem::of_graze(near, (family, periods));
    let guess = touching.scaled_unknowns(&[near.angle], [parameter]);
    let node = correct(&touching, &guess, None)?;
    let [parameter] = touching.parameters(&node.at);
    let state = touching.state(&node.at)?;
    let ImpactSectionOrbit {
        monodromy,
        impacts,
        is_cut,
        ..
    } = node.here.point;
    if is_cut {
        return Err(OrbitError::LOST);
    }
    let graze = GrazingTouch {
        angle: phase + (node.at[0] - phase).rem_euclid(TAU * periods as f64),
        impacts: impacts.len(),
        ..*near
    };
    Ok(SpecialPoint {
        kind: SpecialKind::Grazing(graze),
        point: BranchPoint {
            parameter,
            position: state.x,
            velocity: state.y,
            impacts,
            monodromy,
        },
    })
}

/// The turning point of a motion that comes nearest to a surface of the scene ahead of it, if any turns before one.
fn nearest_turn(motion: &Trajectory, scene: &Scene) -> Option<NearGrazing> {
    let surfaces = SwitchingSurface::ALL.into_iter();
    let surfaces = surfaces.filter_map(|surface| Some((surface, surface.surface_position(scene)?)));
    let surfaces: Vec<(SwitchingSurface, f64)> = surfaces.collect();
    let on_arcs = motion.arc_views().flat_map(|(arc, elapsed)| {
        let back = arc.course.departure.velocity > 0.0;
        let turns = turning_points(arc.course, elapsed, back);
        turns.map(move |turn| (turn.back, arc.begin() + turn.elapsed, turn.position, false))
    });
    let crossings = motion.crossings();
    let reversals = crossings.filter(|it| it.kind == CrossingKind::Reversal);
    let reversals = reversals.map(|it| {
        let back = it.acceleration_before < 0.0;
        (back, motion.clock.time(it.instant), it.position, true)
    });
    let touches = on_arcs.chain(reversals);
    let touches = touches.flat_map(|(back, time, position, reverses)| {
        let side = if back { 1.0 } else { -1.0 };
        surfaces.iter().map(move |&(surface, level)| NearGrazing {
            time,
            amount: side * (level - position),
            surface,
            reverses,
        })
    });
    let ahead = touches.filter(|touch| touch.amount > 0.0);
    ahead.reduce(|known, touch| {
        let is_equal = touch.reverses && touch.amount == known.amount;
        match touch.amount < known.amount || is_equal {
            true => touch,
            false => known,
        }
    })
}
