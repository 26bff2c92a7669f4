//! Where a cycle is at one instant, and the faces of the phase that it is in.

use nalgebra::{Complex, Matrix2, Vector2};

use super::law::Constants;

/// A crossing that a lane has met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Passage {
    pub position: f64,
    /// Velocities before and after it.
    pub velocity: f64,
    pub velocity_after: f64,
    /// The phase after it.
    pub phase: usize,
    /// Drive periods left, and seconds into the present one.
    pub left: f64,
    pub offset: f64,
}

/// The drive of a machine.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drive {
    pub frequency: f64,
    pub period: f64,
    /// cos + i sin of its angle at the beginning of a period.
    pub begin: Complex<f64>,
}

/// Position, velocity, acceleration and jerk.
pub(super) type Jet = [f64; 4];

/// A motion in one phase at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct CyclePlace {
    pub jet: Jet,
    /// The free part, position and velocity, and the rate of the steady part.
    pub free: Vector2<f64>,
    pub steady_rate: Vector2<f64>,
}

/// A linear function of position and velocity that is negative inside a phase.
#[derive(Debug, Clone, Copy)]
pub(super) struct Face {
    pub position: f64,
    pub velocity: f64,
    pub level: f64,
}

/// Derivatives of a state by the state at the start of its arc, by the delay there, and by the return that the cycle
/// begins with.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Derivatives {
    pub transition: Matrix2<f64>,
    pub response: Vector2<f64>,
    pub tangent: Matrix2<f64>,
}

impl Drive {
    /// cos + i sin of the angle so many seconds into a period.
    pub fn angle(&self, offset: f64) -> Complex<f64> {
        self.begin * Complex::cis(self.frequency * offset)
    }
}

impl Constants {
    /// Position and velocity of the steady motion.
    pub fn steady_at(&self, Complex { re: cos, im: sin }: Complex<f64>) -> Vector2<f64> {
        let p = self.cosine * cos + self.sine * sin;
        let q = self.cosine_rate * cos + self.sine_rate * sin;
        Vector2::new(p, q) * self.side
    }

    pub fn place(&self, drive: &Drive, (x, v): (f64, f64), angle: Complex<f64>) -> CyclePlace {
        let steady = self.steady_at(angle);
        self.place_of(drive, Vector2::new(x - self.offset, v) - steady, steady)
    }

    pub fn place_of(&self, drive: &Drive, free: Vector2<f64>, steady: Vector2<f64>) -> CyclePlace {
        let square = drive.frequency * drive.frequency;
        let second = self.stiffness * free.x + self.damping * free.y;
        let third = self.stiffness * free.y + self.damping * second;
        let state = free + steady;
        CyclePlace {
            jet: [
                state.x + self.offset,
                state.y,
                second - square * steady.x,
                third - square * steady.y,
            ],
            free,
            steady_rate: Vector2::new(steady.y, -square * steady.x),
        }
    }

    /// The face of the phase that a passage crosses.
    pub fn face_at(&self, passage: &Passage) -> Face {
        let [high, low, further] = self.faces();
        match passage.position {
            x if x == high.level => high,
            x if x == -low.level => low,
            _ => further,
        }
    }

    /// The faces that end the phase: above, below, and the further guard; at infinity where there is none.
    pub fn faces(&self) -> [Face; 3] {
        let face = |position, velocity, level| Face {
            position,
            velocity,
            level,
        };
        [
            face(1.0, 0.0, self.high),
            face(-1.0, 0.0, -self.low),
            face(self.by_position, self.by_velocity, self.level),
        ]
    }

    /// Amplitude of the drive's force per mass.
    pub fn force(&self, w: f64) -> f64 {
        let (elastic, damped) = (self.stiffness + w * w, self.damping * w);
        self.swing * elastic.hypot(damped)
    }
}
