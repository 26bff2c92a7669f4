//! What became of a motion under a method: one of a few classes, told by a reference.

use super::{MethodError, Solution, Task};
use softstop::{Impact, Scene, Start};
use softstop_draw::style::verdict;

/// Beyond so many times the greatest speed that energy allows, a motion has blown up.
const BLOWN_UP: f64 = 1e3;

/// Each class of outcomes in one line: name, letter in maps, colour.
macro_rules! verdicts {
    ($($(#[$what:meta])* $verdict:ident $name:literal $letter:literal $color:expr;)*) => {
        /// The class of an outcome. Of several that apply the one named last here is taken.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Verdict {
            $($(#[$what])* $verdict),*
        }

        impl Verdict {
            /// All classes, from the best on.
            pub const ALL: [Self; 8] = [$(Self::$verdict),*];

            /// Its name in charts and tables.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$verdict => $name),* }
            }

            /// Its letter in maps.
            pub const fn letter(self) -> char {
                match self { $(Self::$verdict => $letter),* }
            }

            /// Its colour.
            pub const fn color(self) -> &'static str {
                match self { $(Self::$verdict => $color),* }
            }
        }
    };
}

verdicts! {
    /// Every impact has its counterpart, and the error at the end is within the tolerance.
    Converged "converged" 'C' verdict::CONVERGED;
    /// Every impact has its counterpart, but the error at the end is larger.
    Inaccurate "inaccurate" 'I' verdict::INACCURATE;
    /// The first impact that is out of order is one too many.
    WrongCount "wrong impact count" 'W' verdict::WRONG_COUNT;
    /// The first impact that is out of order is one that was not seen.
    MissedContact "missed contact" 'M' verdict::MISSED_CONTACT;
    /// More energy than start and drive could ever have supplied.
    EnergyGain "energy gain" 'E' verdict::ENERGY_GAIN;
    /// The numbers left all bounds.
    BlownUp "blow-up" 'B' verdict::BLOWN_UP;
    /// The method did not get to the end.
    Stuck "stuck" 'S' verdict::STUCK;
    /// The method is not made for the machine.
    Unsuited "unsuited" 'U' verdict::UNSUITED;
}

/// Tells the class of outcomes of one task by its true motion.
#[derive(Debug, Clone)]
pub struct Judge<'a> {
    task: &'a Task,
    reference: &'a Solution,
    tolerance: f64,
    /// Greatest speed of the true motion in m/s, positions times the drive frequency being speeds too.
    size: f64,
    /// Speed in m/s that all energy at the start is worth.
    first_speed: f64,
}

impl<'a> Judge<'a> {
    /// A judge with the true motion of a task, who lets errors pass up to `tolerance` times the motion's
    /// size, and speeds up to 1 + `tolerance` times the possible ones.
    pub fn new(task: &'a Task, reference: &'a Solution, tolerance: f64) -> Self {
        let scene = &task.scene;
        let Start { position, velocity } = task.start;
        let size = |position, velocity| norm(scene, (position, velocity));
        let struck = reference.impacts.iter();
        let struck = struck.map(|impact| size(scene.clearance, impact.velocity));
        let (end, end_velocity) = reference.end;
        Self {
            task,
            reference,
            tolerance,
            size: struck
                .chain([size(position, velocity), size(end, end_velocity)])
                .fold(0.0, f64::max),
            first_speed: worth(scene, task.start),
        }
    }

    /// Error of the state at the end: the length of (w dx, dv) over the greatest one of (w x, v) among start,
    /// impacts and end of the true motion, with w the drive frequency.
    pub fn error(&self, solution: &Solution) -> f64 {
        let (position, velocity) = self.reference.end;
        let gap = (solution.end.0 - position, solution.end.1 - velocity);
        ratio(norm(&self.task.scene, gap), self.size)
    }

    /// The class of an outcome.
    pub fn verdict(&self, outcome: &Result<Solution, MethodError>) -> Verdict {
        let solution = match outcome {
            Ok(solution) => solution,
            Err(MethodError::BlownUp { .. }) => return Verdict::BlownUp,
            Err(MethodError::Stuck { .. }) => return Verdict::Stuck,
            Err(MethodError::Unsuited { .. } | MethodError::Task(_)) => return Verdict::Unsuited,
        };
        let excess = self.excess(solution);
        // Numbers that are not finite make it infinite, too.
        if excess > BLOWN_UP {
            Verdict::BlownUp
        } else if excess > 1.0 + self.tolerance {
            Verdict::EnergyGain
        } else if let Some(verdict) = self.disorder(&solution.impacts) {
            verdict
        } else if self.error(solution) > self.tolerance {
            Verdict::Inaccurate
        } else {
            Verdict::Converged
        }
    }

    /// Greatest speed found over the possible one at that time, each speed with all energy in it.
    ///
    /// A force F0 cos does work at the rate F0 |x'| at most, and every stop and damper is passive; with
    /// E = m u^2/2 the speed u that the energy is worth obeys du/dt <= F0/m.
    fn excess(&self, solution: &Solution) -> f64 {
        let scene = &self.task.scene;
        let (position, velocity) = solution.end;
        let end = (self.task.duration(), Start::new(position, velocity));
        let struck = solution.impacts.iter();
        let struck = struck.map(|it| (it.time, Start::new(scene.clearance, it.velocity)));
        let rise = scene.excitation.amplitude / scene.mass;
        let excess = |(time, state)| ratio(worth(scene, state), self.first_speed + rise * time);
        struck.chain([end]).map(excess).fold(0.0, f64::max)
    }

    /// What is wrong with the impacts, if their times do not pair off with the true ones. Each true impact
    /// has the time up to halfway to its neighbours to itself.
    fn disorder(&self, impacts: &[Impact]) -> Option<Verdict> {
        let mut left = impacts;
        for (index, _) in self.reference.impacts.iter().enumerate() {
            let end = self.turn_ends(index);
            let (own, later) = left.split_at(left.partition_point(|impact| impact.time <= end));
            match own.len() {
                0 => return Some(Verdict::MissedContact),
                1 => left = later,
                _ => return Some(Verdict::WrongCount),
            }
        }
        (!left.is_empty()).then_some(Verdict::WrongCount)
    }

    /// Up to which time in s an impact is taken for this true one.
    fn turn_ends(&self, index: usize) -> f64 {
        let truth = &self.reference.impacts;
        truth.get(index + 1).map_or(f64::INFINITY, |next| {
            f64::midpoint(truth[index].time, next.time)
        })
    }
}

/// Length of a state as a speed in m/s, a position counting as what it is worth at the drive frequency.
fn norm(scene: &Scene, (position, velocity): (f64, f64)) -> f64 {
    (scene.excitation.frequency * position).hypot(velocity)
}

/// Speed in m/s of a mass that has all energy of this state: its own, the suspension's and the stop's. Infinite
/// if the numbers are not finite.
fn worth(scene: &Scene, state: Start) -> f64 {
    let wall = scene.wall().map_or(f64::INFINITY, |wall| wall.position);
    let position = match state.position > wall {
        true => wall,
        false => state.position,
    };
    match scene.motion(Start { position, ..state }) {
        Ok(motion) => (2.0 * motion.mechanical_energy(scene).max(0.0) / scene.mass).sqrt(),
        Err(_) => f64::INFINITY,
    }
}

/// A share of what may be nothing: nothing of nothing is zero.
fn ratio(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::{Exact, Integrator};
    use softstop::Ratios;

    fn task() -> Task {
        let scene = Ratios::unloaded().scene().expect("the paper's machine");
        Task::new(scene, Start::new(0.0, 14.0), 3.0, 1_000_000)
    }

    /// The verdict on the true motion after a change.
    fn after(change: impl FnOnce(&mut Solution)) -> Verdict {
        let task = task();
        let truth = Exact.integrate(&task).expect("a motion");
        assert!(truth.impacts.len() >= 3);
        let mut altered = truth.clone();
        change(&mut altered);
        Judge::new(&task, &truth, 0.01).verdict(&Ok(altered))
    }

    #[test]
    fn the_true_motion_has_converged() {
        assert_eq!(after(|_| ()), Verdict::Converged);
        assert_eq!(after(|altered| altered.end.1 += 0.1), Verdict::Converged);
    }

    #[test]
    fn each_fault_has_its_class() {
        assert_eq!(after(|altered| altered.end.1 += 0.3), Verdict::Inaccurate);
        let twice = |altered: &mut Solution| {
            let first = altered.impacts[0];
            let time = first.time + 0.01;
            altered.impacts.insert(1, Impact { time, ..first });
        };
        assert_eq!(after(twice), Verdict::WrongCount);
        let unseen = |altered: &mut Solution| {
            altered.impacts.remove(1);
        };
        assert_eq!(after(unseen), Verdict::MissedContact);
        assert_eq!(after(|altered| altered.end.1 = 40.0), Verdict::EnergyGain);
        let struck = |altered: &mut Solution| altered.impacts[1].velocity = -40.0;
        assert_eq!(after(struck), Verdict::EnergyGain);
        assert_eq!(after(|altered| altered.end.0 = 1e6), Verdict::BlownUp);
        assert_eq!(after(|altered| altered.end.0 = f64::NAN), Verdict::BlownUp);
    }

    #[test]
    fn a_late_impact_is_not_a_missed_one() {
        let late = |altered: &mut Solution| altered.impacts[0].time += 0.5;
        assert_eq!(after(late), Verdict::Converged);
    }

    #[test]
    fn methods_that_fail_say_how() {
        let task = task();
        let truth = Solution::default();
        let judge = Judge::new(&task, &truth, 0.01);
        let (method, reason) = ("a".to_owned(), "b".to_owned());
        for (error, verdict) in [
            (MethodError::Unsuited { method, reason }, Verdict::Unsuited),
            (MethodError::stuck(0.0, 3, "c"), Verdict::Stuck),
            (MethodError::BlownUp { time: 1.0 }, Verdict::BlownUp),
        ] {
            assert_eq!(judge.verdict(&Err(error)), verdict);
        }
    }

    #[test]
    fn a_mass_at_rest_has_no_size_and_no_energy() {
        let mut task = task();
        task.scene.excitation.amplitude = 0.0;
        task.start.velocity = 0.0;
        let mut found = Solution::default();
        let truth = found.clone();
        let judge = Judge::new(&task, &truth, 0.01);
        assert_eq!(judge.verdict(&Ok(found.clone())), Verdict::Converged);
        found.end.1 = 1e-3;
        assert_eq!(judge.verdict(&Ok(found)), Verdict::BlownUp);
    }
}
