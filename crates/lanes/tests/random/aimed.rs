//! Machines aimed at trouble: a face beside a turning point of a settled motion, or a frequency beside one at which the
//! settled motion changes.

use softstop::internals::turning_points;
use softstop::{Arc, Clock, Crossing, Observer, Scene, Start, Stop};
use softstop_testing::slope;

use super::machines::{Draw, Motion};

/// Motions of one aim.
const GROUP: usize = 16;
/// Drive periods that a motion is given to settle, and those that it is looked at.
const SETTLING: u64 = 240;
const LOOKED_AT: u64 = 64;
/// Bisections that a change of the motion is located by.
const BISECTIONS: usize = 28;

/// What a motion does once it has settled.
struct Settled {
    /// State at the beginning of a drive period.
    state: Start,
    /// Positions of its turning points, in m.
    turns: Vec<f64>,
    crossings: usize,
}

impl Observer for Settled {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let back = arc.course.start_node().velocity >= 0.0;
        let turns = turning_points(arc.course, elapsed, back);
        self.turns.extend(turns.map(|turn| turn.position));
    }

    fn crossing(&mut self, _: &Crossing) {
        self.crossings += 1;
    }
}

impl Settled {
    fn of(scene: &Scene, start: Start) -> Self {
        let mut motion = scene.motion(start).expect("valid");
        let mut settled = Self {
            state: start,
            turns: Vec::new(),
            crossings: 0,
        };
        let advanced = motion.advance(Clock::at_cycle(SETTLING), &mut ());
        advanced.expect("bounded");
        settled.state = motion.state();
        let advanced = motion.advance(Clock::at_cycle(SETTLING + LOOKED_AT), &mut settled);
        advanced.expect("bounded");
        motion.tell_arc(&mut settled);
        settled
    }

    fn peak(&self) -> f64 {
        self.turns.iter().copied().fold(f64::MIN, f64::max)
    }

    /// True if it is of another kind: other crossings, or another peak by far more than a small change of the frequency makes.
    fn differs(&self, other: &Self) -> bool {
        self.crossings != other.crossings || (self.peak() - other.peak()).abs() > 0.05
    }
}

impl Draw {
    /// Motions of machines that are aimed at trouble, [`GROUP`] of one aim; none if nothing was found to aim at.
    pub fn aimed(&mut self) -> Vec<Motion> {
        let (mut scene, start) = self.machine();
        if self.below(2) == 0 {
            scene.damping = 10f64.powf(self.between(-4.0, -0.5));
            scene.contact_damping = 10f64.powf(self.between(-4.0, 0.0));
        }
        if scene.validate().is_err() || matches!(scene.stop, Stop::Hertz { .. }) {
            return Vec::new();
        }
        match self.below(2) {
            0 => self.faces(&scene, start),
            _ => self.changes(&scene, start),
        }
    }

    /// Faces beside a turning point, by 1e-9 to 0.3.
    fn faces(&mut self, scene: &Scene, start: Start) -> Vec<Motion> {
        let settled = Settled::of(scene, start);
        if settled.turns.is_empty() {
            return Vec::new();
        }
        let target = match self.below(3) {
            0 => settled.turns[self.below(settled.turns.len())],
            _ => settled.peak(),
        };
        let motion = |draw: &mut Self| {
            let aside = draw.aside(-9.0, -0.5);
            let aimed = draw.face_at(scene, target + aside);
            draw.motion(aimed, &settled, start)
        };
        (0..GROUP).filter_map(|_| motion(self)).collect()
    }

    /// Frequencies beside that of a change, by 1e-8 to 1e-2.
    fn changes(&mut self, scene: &Scene, start: Start) -> Vec<Motion> {
        let mut from = scene.excitation.frequency;
        let mut to = from * (1.0 + self.aside(-3.0, -1.3));
        let mut settled = Settled::of(scene, start);
        if !settled.differs(&Settled::of(&scene.at_frequency(to), start)) {
            return Vec::new();
        }
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (from + to);
            let there = Settled::of(&scene.at_frequency(middle), start);
            if settled.differs(&there) {
                to = middle;
            } else {
                (from, settled) = (middle, there);
            }
        }
        let motion = |draw: &mut Self| {
            let aimed = scene.at_frequency(from * (1.0 + draw.aside(-8.0, -2.0)));
            draw.motion(aimed, &settled, start)
        };
        (0..GROUP).filter_map(|_| motion(self)).collect()
    }

    /// From the start that was settled from, from the settled state, or from anywhere; none if the machine cannot be.
    fn motion(&mut self, scene: Scene, settled: &Settled, start: Start) -> Option<Motion> {
        let start = match self.below(3) {
            0 => start,
            1 => settled.state,
            _ => self.start(&scene),
        };
        scene.motion(start).ok()?;
        Some((scene, start))
    }

    /// A machine with a face at a position: its clearance where the mass turns short of it, else a wall or a corner behind.
    fn face_at(&mut self, scene: &Scene, position: f64) -> Scene {
        let mut scene = scene.clone();
        let behind = position - scene.stop_position();
        if position < scene.clearance || behind <= 0.0 || matches!(scene.stop, Stop::Rigid { .. }) {
            scene.clearance = position;
            return scene;
        }
        let steeper = 10f64.powf(self.between(0.1, 4.0));
        match (&scene.stop, self.below(2)) {
            (Stop::KelvinVoigt { stiffness, .. }, 0) => {
                let corner = slope(behind, steeper * stiffness);
                scene.stop = Stop::PiecewiseLinear {
                    loading: vec![slope(0.0, *stiffness), corner],
                    unloading: Vec::new(),
                };
            }
            _ => scene.rigid = Some(self.wall(behind)),
        }
        scene
    }

    /// Plus or minus ten to a power between two.
    fn aside(&mut self, low: f64, high: f64) -> f64 {
        let size = 10f64.powf(self.between(low, high));
        if self.below(2) == 0 { size } else { -size }
    }
}
