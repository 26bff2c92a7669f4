//! A motion with the growth of small differences along it.

use nalgebra::{Matrix2, Vector2};

use super::StroboscopicMap;
use softstop::{MotionError, Scene};

/// Batches of drive periods whose means tell how uncertain Lyapunov exponents are.
pub(super) const BATCHES: usize = 32;

/// A motion along which an orthonormal frame of small differences is carried, for its Lyapunov exponents.
pub(super) struct TangentMotion {
    pub map: StroboscopicMap,
    /// The state at drive angle phi that it has come to.
    pub state: Vector2<f64>,
    frame: Matrix2<f64>,
}

impl TangentMotion {
    /// A motion of a scene from a state, with a fresh frame of differences.
    pub fn new(scene: &Scene, state: Vector2<f64>) -> Result<Self, MotionError> {
        Ok(Self {
            map: StroboscopicMap::new(&scene.check()?, 1),
            state,
            frame: Matrix2::identity(),
        })
    }

    /// Adds sums of growth over batches of drive periods until there are enough; an error where `ask` gives one.
    pub fn add_batches<E: From<MotionError>>(
        &mut self,
        batches: &mut Vec<[f64; 2]>,
        periods: u64,
        ask: impl Fn() -> Result<(), E>,
    ) -> Result<(), E> {
        while batches.len() < BATCHES {
            let mut sums = [0.0; 2];
            for _ in 0..periods {
                ask()?;
                let passage = self.map.apply(self.state)?;
                self.state = passage.end;
                let [first, second] = carry_frame(&mut self.frame, &passage.monodromy);
                sums[0] += first;
                sums[1] += second;
            }
            batches.push(sums);
        }
        Ok(())
    }
}

/// Carries an orthonormal frame through a Jacobian: M Q = Q' R. Returns ln |R| on the diagonal.
fn carry_frame(frame: &mut Matrix2<f64>, jacobian: &Matrix2<f64>) -> [f64; 2] {
    let image = jacobian * *frame;
    let first = image.column(0).into_owned();
    let length = first.norm();
    if length == 0.0 {
        return [f64::NEG_INFINITY; 2];
    }
    let along = first / length;
    let across = Vector2::new(-along.y, along.x);
    // |R22| from the determinant: free of the cancellation of a projection.
    let other = jacobian.determinant().abs() / length;
    *frame = Matrix2::from_columns(&[along, across]);
    [length.ln(), other.ln()]
}
