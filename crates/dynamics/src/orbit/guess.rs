//! Which impacts a periodic motion near a state may have.

use nalgebra::Vector2;

use super::StroboscopicMap;
use super::turn::turns;
use softstop::{Arc, Clock, Crossing, MotionError, Observer, PhaseKind, Scene};

/// Distance from the face, in units of the largest position, within which a mass nearly hits it.
const NEAR_MISS: f64 = 0.01;

/// Time in s and before-impact velocity in m/s of each impact.
pub(super) type Impacts = Vec<(f64, f64)>;

/// The impacts of the motion from a state over some drive periods; then with the nearest miss as one more, and
/// without the weakest one.
pub(super) fn guesses(
    scene: &Scene,
    state: Vector2<f64>,
    periods: u64,
) -> Result<Vec<Impacts>, MotionError> {
    let mut seen = NearMisses {
        clock: scene.clock(),
        face: scene.clearance,
        impacts: Impacts::new(),
        miss: None,
    };
    StroboscopicMap::new(scene, periods)?.observe(state, &mut seen)?;
    let NearMisses { impacts, miss, .. } = seen;
    let mut guesses = Vec::new();
    if !impacts.is_empty() {
        guesses.push(impacts.clone());
    }
    if let Some((depth, miss)) = miss
        && depth <= NEAR_MISS * (scene.clearance.abs() + depth)
    {
        let at = impacts.partition_point(|impact| impact.0 < miss.0);
        let mut more = impacts.clone();
        more.insert(at, miss);
        guesses.push(more);
    }
    if impacts.len() > 1 {
        let weakest = (0..impacts.len()).min_by(|a, b| impacts[*a].1.total_cmp(&impacts[*b].1));
        let mut fewer = impacts;
        fewer.remove(weakest.unwrap_or(0));
        guesses.push(fewer);
    }
    Ok(guesses)
}

/// Records impacts and the nearest miss.
struct NearMisses {
    clock: Clock,
    face: f64,
    impacts: Impacts,
    /// How near the nearest miss comes in m, when, and how fast an impact there would be if the face stood
    /// as much nearer.
    miss: Option<(f64, (f64, f64))>,
}

impl Observer for NearMisses {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        if arc.kind != PhaseKind::Free {
            return;
        }
        for turn in turns(arc.course, elapsed, true).filter(|turn| turn.back) {
            let at = self.clock.after(arc.start, turn.elapsed);
            let push = arc.course.flow.amplitude * self.clock.drive(at).cos;
            let acceleration = arc.course.flow.acceleration(turn.position, 0.0, push);
            let depth = self.face - turn.position;
            if self.miss.is_none_or(|(least, _)| depth < least) {
                let speed = (2.0 * acceleration.abs() * depth.max(0.0)).sqrt();
                self.miss = Some((depth, (self.clock.time(at), speed)));
            }
        }
    }

    fn crossing(&mut self, crossing: &Crossing) {
        if let Some(velocity) = crossing.impact_velocity() {
            self.impacts
                .push((self.clock.time(crossing.instant), velocity));
        }
    }
}
