//! An independent method: steps of the extrapolated midpoint rule (Gragg 1965; Bulirsch and Stoer 1966), ended by
//! bisection wherever a sign changes that the law of force depends on. The sign of the velocity is one of them, so
//! that between two ends no face is passed twice.

use softstop::{Crossing, Observer, Release, Scene, Slope, Start, Stop, Tangent};

/// Midpoint steps that are extrapolated.
const STEPS: [usize; 5] = [2, 4, 6, 8, 10];
/// Length of a step, relative to the fastest rate.
const LENGTH: f64 = 0.04;
/// Impacts slower than that are grazes: whether they are any is left open.
const GRAZE: f64 = 1e-3;
/// Magnification of a difference beyond which motions are not compared.
const CHAOS: f64 = 1e4;

/// Impacts of one motion that are compared: in longer rows of bounces on a preloaded face this method loses its digits.
const MOST: usize = 200;

/// How a motion of the engine and one of this method agree.
#[derive(Debug, Default)]
pub struct Compared {
    pub impacts: usize,
    pub below: usize,
    /// Largest difference, in units of what one at the start is magnified to by then.
    pub error: f64,
}

#[derive(Debug, Clone, Copy)]
struct Impact {
    time: f64,
    velocity: f64,
    magnified: f64,
}

/// One of the two stops: positions and velocities are multiplied by `side`.
struct Face<'a> {
    side: f64,
    clearance: f64,
    stop: &'a Stop,
}

impl Face<'_> {
    /// What the law of force depends on by its sign.
    fn signs(&self, scene: &Scene, x: f64, v: f64) -> Vec<f64> {
        let (d, v) = (self.side * x - self.clearance, self.side * v);
        let mut signs = vec![d];
        match self.stop {
            Stop::KelvinVoigt {
                stiffness,
                release: Release::ZeroForce,
            } => signs.push(stiffness * d + (scene.contact_damping - scene.damping) * v),
            Stop::Hertz { dissipation, .. } => signs.push(1.0 + dissipation * v),
            Stop::PiecewiseLinear { loading, unloading } => {
                let slopes = loading.iter().chain(unloading).skip(1);
                signs.extend(slopes.map(|slope| d - slope.from));
            }
            _ => {}
        }
        signs
    }

    /// Force against the direction of x where these signs hold, the damping of free flight left out.
    fn force(&self, scene: &Scene, (x, v): (f64, f64), signs: &[bool], forward: bool) -> f64 {
        let (d, v) = (self.side * x - self.clearance, self.side * v);
        if !signs[0] {
            return 0.0;
        }
        let damper = (scene.contact_damping - scene.damping) * v;
        let inward = forward == (self.side > 0.0);
        let force = match self.stop {
            Stop::None => 0.0,
            Stop::Rigid { .. } => 0.0,
            Stop::KelvinVoigt { stiffness, release } => {
                if *release == Release::ZeroForce && !signs[1] {
                    0.0
                } else {
                    stiffness * d + damper
                }
            }
            Stop::Preloaded { stiffness, preload } => preload + stiffness * d + damper,
            Stop::Hertz {
                stiffness,
                exponent,
                dissipation,
            } => {
                let grip = if signs[1] { 1.0 + dissipation * v } else { 0.0 };
                stiffness * d.max(0.0).powf(*exponent) * grip + damper
            }
            Stop::PiecewiseLinear { loading, unloading } => {
                let first = &signs[1..loading.len()];
                let second = signs.get(loading.len()..).unwrap_or_default();
                let chain = match inward || unloading.is_empty() {
                    true => chain(loading, first.iter().copied(), d),
                    false => {
                        // Of the second list, the first slope holds from zero on as well.
                        chain(unloading, second.iter().copied().skip(1), d)
                    }
                };
                chain + damper
            }
        };
        self.side * force
    }
}

/// Force of a chain of slopes where it is known which of them are passed, the first one aside.
fn chain(slopes: &[Slope], passed: impl Iterator<Item = bool>, d: f64) -> f64 {
    let (mut force, mut steep) = (slopes[0].stiffness * d, slopes[0].stiffness);
    for (slope, passed) in slopes[1..].iter().zip(passed) {
        if passed {
            force += (slope.stiffness - steep) * (d - slope.from);
            steep = slope.stiffness;
        }
    }
    force
}

struct Oracle<'a> {
    scene: &'a Scene,
    faces: Vec<Face<'a>>,
    time: f64,
    state: (f64, f64),
    signs: Vec<Vec<bool>>,
    forward: bool,
}

impl<'a> Oracle<'a> {
    fn new(scene: &'a Scene, start: Start) -> Self {
        let below = scene.below.as_ref().expect("a stop below");
        let faces = [
            (1.0, scene.clearance, &scene.stop),
            (-1.0, below.clearance, &below.stop),
        ];
        let faces = faces.into_iter().filter(|face| *face.2 != Stop::None);
        let mut oracle = Self {
            scene,
            faces: faces
                .map(|(side, clearance, stop)| Face {
                    side,
                    clearance,
                    stop,
                })
                .collect(),
            time: 0.0,
            state: (start.position, start.velocity),
            signs: Vec::new(),
            forward: start.velocity > 0.0,
        };
        oracle.signs = oracle.signs_at(oracle.state);
        oracle
    }

    fn signs_at(&self, (x, v): (f64, f64)) -> Vec<Vec<bool>> {
        let of = |face: &Face<'_>| face.signs(self.scene, x, v);
        let all = self.faces.iter().map(of);
        all.map(|signs| signs.into_iter().map(|sign| sign > 0.0).collect())
            .collect()
    }

    fn acceleration(&self, time: f64, (x, v): (f64, f64), forward: bool) -> f64 {
        let (scene, drive) = (self.scene, self.scene.excitation);
        let faces = self.faces.iter().zip(&self.signs);
        let force =
            |(face, signs): (&Face<'_>, &Vec<bool>)| face.force(scene, (x, v), signs, forward);
        let contact: f64 = faces.map(force).sum();
        let forcing = drive.amplitude * (drive.frequency * time + drive.phase).cos();
        (forcing - contact - scene.damping * v - scene.stiffness * x) / scene.mass
    }

    /// The state a step later under the law that holds now.
    fn step(&self, length: f64) -> (f64, f64) {
        let mut table: Vec<Vec<[f64; 2]>> = Vec::new();
        for (row, &count) in STEPS.iter().enumerate() {
            let h = length / count as f64;
            let rate =
                |time: f64, [x, v]: [f64; 2]| [v, self.acceleration(time, (x, v), self.forward)];
            let plus = |a: [f64; 2], h: f64, b: [f64; 2]| [a[0] + h * b[0], a[1] + h * b[1]];
            let mut last = [self.state.0, self.state.1];
            let mut now = plus(last, h, rate(self.time, last));
            for index in 1..count {
                let next = plus(last, 2.0 * h, rate(self.time + index as f64 * h, now));
                (last, now) = (now, next);
            }
            let end = rate(self.time + length, now);
            let mut columns = vec![[0, 1].map(|i| 0.5 * (last[i] + now[i] + h * end[i]))];
            for column in 0..row {
                let ratio = count as f64 / STEPS[row - 1 - column] as f64;
                let (finer, coarser) = (columns[column], table[row - 1][column]);
                let step = |i: usize| (finer[i] - coarser[i]) / (ratio * ratio - 1.0);
                columns.push([0, 1].map(|i| finer[i] + step(i)));
            }
            table.push(columns);
        }
        let best = table[STEPS.len() - 1][STEPS.len() - 1];
        (best[0], best[1])
    }

    fn changes(&self, state: (f64, f64)) -> bool {
        (state.1 > 0.0) != self.forward || self.signs_at(state) != self.signs
    }

    /// Length of the next step: short beside the face of a power law, where it has a branch point.
    fn length(&self) -> f64 {
        let scene = self.scene;
        let stiff = |face: &Face<'_>| match face.stop {
            Stop::KelvinVoigt { stiffness, .. }
            | Stop::Hertz { stiffness, .. }
            | Stop::Preloaded { stiffness, .. } => *stiffness,
            Stop::PiecewiseLinear { loading, .. } => loading
                .iter()
                .map(|slope| slope.stiffness)
                .fold(0.0, f64::max),
            _ => 0.0,
        };
        let stiffness: f64 = scene.stiffness + self.faces.iter().map(stiff).sum::<f64>();
        let rate = (stiffness / scene.mass).sqrt() + scene.contact_damping / scene.mass;
        let longest = LENGTH / (rate + scene.excitation.frequency);
        let (x, v) = self.state;
        let near = self.faces.iter().zip(&self.signs).map(|(face, signs)| {
            let depth = face.side * x - face.clearance;
            match face.stop {
                Stop::Hertz { .. } if signs[0] => (0.15 * (depth / v).abs()).max(1e-7 * longest),
                _ => longest,
            }
        });
        near.fold(longest, f64::min)
    }

    /// Goes on to the next impact; none if there is none up to `until`.
    fn next_impact(&mut self, until: f64) -> Option<Impact> {
        while self.time < until {
            let length = self.length().min(until - self.time);
            if !self.changes(self.step(length)) {
                self.state = self.step(length);
                self.time += length;
                continue;
            }
            let (mut low, mut high) = (0.0, length);
            loop {
                let middle = 0.5 * (low + high);
                if middle <= low || middle >= high {
                    break;
                }
                match self.changes(self.step(middle)) {
                    true => high = middle,
                    false => low = middle,
                }
            }
            self.state = self.step(high);
            self.time += high;
            if let Some(impact) = self.cross(until) {
                return Some(impact);
            }
        }
        None
    }

    fn cross(&mut self, until: f64) -> Option<Impact> {
        let signs = self.signs_at(self.state);
        let touched = |(face, now): &(usize, &Vec<bool>)| now[0] && !self.signs[*face][0];
        let touched = signs.iter().enumerate().find(touched).map(|(face, _)| face);
        let (time, velocity) = (self.time, self.state.1);
        let impact = Impact {
            time,
            velocity,
            magnified: 1.0,
        };
        if let Some(face) = touched
            && let Stop::Rigid { restitution } = self.faces[face].stop
        {
            let Face {
                side, clearance, ..
            } = self.faces[face];
            self.state = (side * clearance, -restitution * velocity);
            self.forward = self.state.1 > 0.0;
            if self.state.1 == 0.0 {
                let leaves =
                    |it: &Self| side * it.acceleration(it.time, it.state, it.forward) < 0.0;
                self.wait(until, leaves);
                self.forward = side < 0.0;
            }
            return Some(impact);
        }
        self.signs = signs;
        let turned = (velocity > 0.0) != self.forward;
        self.forward = velocity > 0.0;
        if turned {
            let [up, down] =
                [true, false].map(|forward| self.acceleration(self.time, self.state, forward));
            if up <= 0.0 && down >= 0.0 {
                self.state.1 = 0.0;
                let rises = |it: &Self| it.acceleration(it.time, it.state, true) > 0.0;
                let falls = |it: &Self| it.acceleration(it.time, it.state, false) < 0.0;
                self.wait(until, |it| rises(it) || falls(it));
                self.forward = rises(self);
            }
        }
        touched.map(|_| impact)
    }

    /// Holds the mass until something is so.
    fn wait(&mut self, until: f64, ends: impl Fn(&Self) -> bool) {
        let length = 1e-3 / self.scene.excitation.frequency;
        if ends(self) {
            return;
        }
        while self.time < until && !ends(self) {
            self.time += length;
        }
        let (mut low, mut high) = (self.time - length, self.time);
        for _ in 0..60 {
            self.time = 0.5 * (low + high);
            match ends(self) {
                true => high = self.time,
                false => low = self.time,
            }
        }
        self.time = high;
    }
}

/// Keeps the impacts of a motion, each with the magnification of a difference at the start.
#[derive(Default)]
struct Impacts {
    tangent: Tangent,
    period: f64,
    found: Vec<Impact>,
}

impl Observer for Impacts {
    fn arc(&mut self, arc: &softstop::Arc<'_>, elapsed: f64) {
        self.tangent.arc(arc, elapsed);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        if crossing.kind.is_impact() {
            self.found.push(Impact {
                time: crossing.instant.cycles * self.period + crossing.instant.offset,
                velocity: crossing.velocity,
                magnified: self.tangent.matrix.norm(),
            });
        }
        self.tangent.crossing(crossing);
    }
}

/// Compares both methods impact by impact, and at the end, up to a graze, chaos or a long row of bounces.
pub fn compare(scene: &Scene, start: Start, periods: u64) -> Compared {
    let mut impacts = Impacts {
        period: scene.period(),
        ..Impacts::default()
    };
    let end = softstop::Clock::at_cycle(periods);
    let motion = scene.trajectory_with_forces(start, end, &[], &mut impacts);
    let motion = motion.expect("a motion");
    let until = periods as f64 * scene.period();
    let mut oracle = Oracle::new(scene, start);
    let mut compared = Compared::default();
    let mut own = impacts.found.into_iter();
    loop {
        let (exact, found) = (own.next(), oracle.next_impact(until));
        let is_open = |impact: Option<Impact>| {
            impact.is_some_and(|it| it.velocity.abs() < GRAZE || it.magnified > CHAOS)
        };
        if is_open(exact) || is_open(found) || compared.impacts == MOST {
            return compared;
        }
        let (Some(exact), Some(found)) = (exact, found) else {
            assert!(
                exact.is_none() && found.is_none(),
                "{exact:?} {found:?} {scene:?} {start:?}"
            );
            break;
        };
        let apart = (exact.time - found.time).abs() + (exact.velocity - found.velocity).abs();
        let size = (1.0 + exact.velocity.abs()) * (1.0 + exact.magnified);
        compared.error = compared.error.max(apart / size);
        compared.impacts += 1;
        compared.below += usize::from(exact.velocity < 0.0);
    }
    let magnified = impacts.tangent.matrix.norm();
    if magnified < CHAOS {
        let (x, v) = oracle.state;
        let apart = (motion.end.position - x).abs() + (motion.end.velocity - v).abs();
        let size = (1.0 + v.abs()) * (1.0 + magnified);
        compared.error = compared.error.max(apart / size);
    }
    compared
}
