//! Lyapunov exponents of a motion, from its exact tangent.

use nalgebra::{Matrix2, Vector2};

use super::{Orbit, StroboscopicMap};
use softstop::{MotionError, Scene};

/// Drive periods in each batch of Lyapunov exponents at first and at most.
pub(crate) const LYAPUNOV_BATCH_PERIODS: (u64, u64) = (100, 1600);
/// Exponent of a growth, or decay, of differences that is for good: rounding to the size of the motion is 36.
const LASTING_GROWTH: f64 = 100.0;
/// Student's t of 31 degrees of freedom for a two-sided 95 % interval.
const STUDENT_T: f64 = 2.039_5;
/// Errors (half-widths of the 95 % interval) by which an exponent has to lie away from zero for its sign to be told.
const SIGN_ERRORS: f64 = 3.0;

/// Both Lyapunov exponents of a motion of the state (x, x'): mean rates at which small differences grow.
///
/// Saltation matrices at the crossings are part of the tangent (Mueller 1995); differences are made
/// orthogonal anew after each drive period (Benettin et al. 1980). Along the motion itself nothing grows:
/// time adds a third exponent, 0.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LyapunovExponents {
    /// Exponents of the map, per drive period, the larger first; minus infinity where sticking wipes out differences.
    pub per_period: [f64; 2],
    /// Half-width of the 95 % interval of the larger exponent, by batch means; 0 on a periodic motion.
    pub error: f64,
    /// Drive periods that they are the mean over.
    pub periods: u64,
    /// The drive period in s.
    pub period: f64,
}

impl LyapunovExponents {
    /// The Lyapunov exponents of the motion from a state over 32 batches of `batch` drive periods, and its end.
    ///
    /// # Errors
    /// [`MotionError`] if the motion cannot be computed.
    pub fn along_motion(
        scene: &Scene,
        state: Vector2<f64>,
        batch: u64,
    ) -> Result<(Self, Vector2<f64>), MotionError> {
        Self::along_motion_with_monitor(scene, state, batch, || Ok(()))
    }

    /// The Lyapunov exponents as by [`LyapunovExponents::along_motion`], unless `ask`, asked each period, fails.
    ///
    /// # Errors
    /// That of `ask`, or [`MotionError`] if the motion cannot be computed.
    pub fn along_motion_with_monitor<E: From<MotionError>>(
        scene: &Scene,
        state: Vector2<f64>,
        batch: u64,
        ask: impl Fn() -> Result<(), E>,
    ) -> Result<(Self, Vector2<f64>), E> {
        let mut walk = TangentMotion::new(scene, state)?;
        let batch = batch.max(1);
        let mut sums = Vec::with_capacity(BATCHES);
        walk.add_growth_batches(&mut sums, batch, ask)?;
        Ok((Self::of_batches(&sums, batch, scene.period()), walk.state))
    }

    /// True if small differences grow for good along the motion from a state: the Lyapunov exponent is positive beyond
    /// doubt, and differences grow by far more than from rounding to the size of the motion; false if they die out as
    /// clearly, or neither is clear after 51,200 drive periods.
    ///
    /// # Errors
    /// [`MotionError`] if the motion cannot be computed.
    pub fn differences_grow(scene: &Scene, state: Vector2<f64>) -> Result<bool, MotionError> {
        let mut walk = TangentMotion::new(scene, state)?;
        let (mut sums, mut batch) = (Vec::with_capacity(BATCHES), LYAPUNOV_BATCH_PERIODS.0);
        loop {
            walk.add_growth_batches(&mut sums, batch, || Ok::<(), MotionError>(()))?;
            let found = Self::of_batches(&sums, batch, scene.period());
            let largest = found.per_period[0];
            let is_clear = largest.abs() > SIGN_ERRORS * found.error;
            let is_much = largest.abs() * found.periods as f64 > LASTING_GROWTH;
            if (is_clear && is_much) || batch >= LYAPUNOV_BATCH_PERIODS.1 {
                return Ok(found.is_positive());
            }
            let pairs = sums.chunks(2);
            let pairs =
                pairs.map(|pair| [0, 1].map(|which| pair.iter().map(|sum| sum[which]).sum()));
            sums = pairs.collect();
            batch *= 2;
        }
    }

    /// The Lyapunov exponents from the sums of growth over batches of so many drive periods, each `period` s long.
    fn of_batches(batches: &[[f64; 2]], periods: u64, period: f64) -> Self {
        let count = BATCHES as f64;
        let means = batches.iter();
        let means: Vec<[f64; 2]> = means
            .map(|sums| sums.map(|sum| sum / periods as f64))
            .collect();
        let mean = |which: usize| means.iter().map(|batch| batch[which]).sum::<f64>() / count;
        // The frame turns where multipliers are complex: either may come out as the larger one by the ends of the batches.
        let mut exponents = [mean(0), mean(1)];
        let larger = usize::from(exponents[1] > exponents[0]);
        exponents.rotate_left(larger);
        let squares = means
            .iter()
            .map(|batch| (batch[larger] - exponents[0]).powi(2));
        let variance = squares.sum::<f64>() / (count - 1.0);
        let error = STUDENT_T * (variance / count).sqrt();
        Self {
            per_period: exponents,
            error: if error.is_nan() { 0.0 } else { error },
            periods: BATCHES as u64 * periods,
            period,
        }
    }

    /// The Lyapunov exponents of a periodic orbit: ln |mu| / n of its multipliers.
    pub fn of(orbit: &Orbit) -> Self {
        let rate = |multiplier: nalgebra::Complex<f64>| {
            multiplier.re.hypot(multiplier.im).ln() / orbit.periods as f64
        };
        Self {
            per_period: orbit.monodromy.multipliers().map(rate),
            error: 0.0,
            periods: orbit.periods,
            period: orbit.scene.period(),
        }
    }

    /// The Lyapunov exponents of the flow, in 1/s: those of the map over the drive period.
    pub fn per_second(&self) -> [f64; 2] {
        self.per_period.map(|exponent| exponent / self.period)
    }

    /// The Kaplan-Yorke dimension of the states at one drive angle, 1 + lambda1/|lambda2| between 0 and 2 (Kaplan and Yorke
    /// 1979); that of the motion in phase space and time is greater by one.
    pub fn kaplan_yorke_dimension(&self) -> f64 {
        let [first, second] = self.per_period;
        match (first > 0.0, first + second < 0.0) {
            (false, _) => 0.0,
            (true, true) => 1.0 - first / second,
            (true, false) => 2.0,
        }
    }

    /// True if both Lyapunov exponents are negative beyond doubt.
    pub fn is_negative(&self) -> bool {
        -self.per_period[0] > SIGN_ERRORS * self.error
    }

    /// True if the larger Lyapunov exponent is positive beyond doubt.
    pub fn is_positive(&self) -> bool {
        self.per_period[0] > SIGN_ERRORS * self.error
    }
}

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
    pub fn add_growth_batches<E: From<MotionError>>(
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
                let [first, second] = carry_frame_through(&mut self.frame, &passage.monodromy);
                sums[0] += first;
                sums[1] += second;
            }
            batches.push(sums);
        }
        Ok(())
    }
}

/// Carries an orthonormal frame through a Jacobian: M Q = Q' R. Returns ln |R| on the diagonal.
fn carry_frame_through(frame: &mut Matrix2<f64>, jacobian: &Matrix2<f64>) -> [f64; 2] {
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
