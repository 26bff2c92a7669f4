//! How long a step may be: theory for the linear oscillator.
//!
//! One step on x'' + 2 zeta w x' + w^2 x = 0 multiplies (x, v/w), with the alpha family (x, h v, h^2 a), by an
//! amplification matrix that depends on z = w h and zeta alone. The step is stable as long as its spectral
//! radius is at most 1 (Hughes, The Finite Element Method, 1987, ch. 9).

use nalgebra::{Complex, Matrix2};

use super::scheme::{Alpha, Scheme};

/// Lowest z that is looked at; a scheme that is unstable there has the limit 0.
const LEAST: f64 = 1e-5;
/// Highest z that is looked at; a scheme that is stable up to there has no limit.
const MOST: f64 = 1e5;
/// Ratio of one z and the next in the search.
const STRIDE: f64 = 1.02;
/// By how much rounding may lift a spectral radius above 1, and such a share of a sum below 0.
const ROUNDING: f64 = 1e-14;

impl Scheme {
    /// The largest w h at which the oscillator x'' + 2 zeta w x' + w^2 x = 0 does not grow, w its natural
    /// frequency in rad/s, h the step in s and zeta the damping ratio >= 0; none if it never does.
    /// It is 0 where any step makes it grow. (Limits below 1e-5 count as 0, such above 1e5 as none.)
    pub fn stability_limit(&self, damping_ratio: f64) -> Option<f64> {
        let stable = |z: f64| self.is_stable(z, damping_ratio);
        if !stable(LEAST) {
            return Some(0.0);
        }
        let mut low = LEAST;
        while stable(low * STRIDE) {
            low *= STRIDE;
            if low > MOST {
                return None;
            }
        }
        let mut high = low * STRIDE;
        while high - low > 4.0 * f64::EPSILON * high {
            let middle = 0.5 * (low + high);
            if stable(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(low)
    }

    fn is_stable(&self, z: f64, zeta: f64) -> bool {
        let drag = 2.0 * zeta * z;
        let radius = match self {
            Self::ExplicitEuler => radius(&Matrix2::new(1.0, z, -z, 1.0 - drag)),
            Self::SemiImplicitEuler => {
                let kick = Matrix2::new(1.0, 0.0, -z, 1.0 - drag);
                radius(&(Matrix2::new(1.0, z, 0.0, 1.0) * kick))
            }
            // One step multiplies a mode exp(lambda t) by a function of s = lambda h.
            Self::RungeKutta4 => over_modes(z, zeta, |s| {
                let one = Complex::from(1.0);
                one + s * (one + s * 0.5 * (one + s * (1.0 / 3.0) * (one + s * 0.25)))
            }),
            Self::ImplicitMidpoint => over_modes(z, zeta, |s| {
                let (one, half) = (Complex::from(1.0), s * 0.5);
                (one + half) / (one - half)
            }),
            Self::Newmark { .. } | Self::GeneralisedAlpha { .. } => {
                return self.alpha().is_some_and(|alpha| alpha.is_stable(z, zeta));
            }
        };
        radius <= 1.0 + ROUNDING
    }
}

/// The larger root of r^2 - tr r + det, without loss where both are nearly 1.
fn radius(matrix: &Matrix2<f64>) -> f64 {
    let (half, det) = (0.5 * matrix.trace(), matrix.determinant());
    let apart = half * half - det;
    if apart <= 0.0 {
        det.sqrt()
    } else {
        half.abs() + apart.sqrt()
    }
}

/// The largest |R(lambda h)| over both modes.
fn over_modes(z: f64, zeta: f64, factor: impl Fn(Complex<f64>) -> Complex<f64>) -> f64 {
    let root = Complex::from(zeta * zeta - 1.0).sqrt();
    let modes = [root, -root].map(|root| (root - zeta) * z);
    let sizes = modes.map(|s| factor(s).norm());
    sizes.into_iter().fold(0.0, f64::max)
}

impl Alpha {
    /// With r = (1 + w)/(1 - w) the eigenvalues |r| <= 1 of the matrix become Re w <= 0, and its characteristic
    /// equation c0 + c1 w + c2 w^2 + c3 w^3 = 0: Hurwitz's criterion decides, without the loss of digits that
    /// eigenvalues on the unit circle suffer where they meet.
    fn is_stable(&self, z: f64, zeta: f64) -> bool {
        let inertia = 1.0 - 2.0 * self.inertia;
        let forces = 1.0 - 2.0 * self.forces;
        let (first, second) = (2.0 * self.gamma - 1.0, 4.0 * self.beta - 2.0 * self.gamma);
        let (drag, spring) = (4.0 * zeta * z, z * z);
        let terms = [
            [0.0, 0.0, spring],
            [0.0, drag, spring * (first + forces)],
            [
                4.0,
                drag * (first + forces),
                spring * (second + forces * first),
            ],
            [
                4.0 * inertia,
                drag * forces * first,
                spring * forces * second,
            ],
        ];
        let [c0, c1, c2, c3] = terms.map(|terms| terms.iter().sum::<f64>());
        let size = |terms: &[f64; 3]| terms.iter().map(|term| term.abs()).sum::<f64>();
        let positive = terms
            .iter()
            .all(|terms| terms.iter().sum::<f64>() >= -ROUNDING * size(terms));
        positive && c1 * c2 - c0 * c3 >= -ROUNDING * (size(&terms[1]) * size(&terms[2]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    fn limit(scheme: Scheme, zeta: f64) -> f64 {
        scheme.stability_limit(zeta).expect("a limit")
    }

    fn assert_near(found: f64, expected: f64) {
        assert_abs_diff_eq!(found, expected, epsilon = 1e-9 * expected.max(1e-3));
    }

    #[test]
    fn limits_are_those_of_closed_forms() {
        use Scheme::{ExplicitEuler, RungeKutta4, SemiImplicitEuler};
        assert_eq!(limit(ExplicitEuler, 0.0), 0.0);
        assert_near(limit(RungeKutta4, 0.0), 8f64.sqrt());
        // |1 + u + u^2/2 + u^3/6 + u^4/24| = 1 with u = z (-zeta + i sqrt(1 - zeta^2)), solved to 25 digits.
        assert_near(limit(RungeKutta4, 0.05), 2.909_799_685_490_394);
        assert_near(limit(RungeKutta4, 0.3), 2.835_300_102_593_945);
        // The end of the stability interval on the negative real axis.
        assert_near(limit(RungeKutta4, 1.0), 2.785_293_563_405_289);
        for zeta in [0.01, 0.1, 0.5, 0.9] {
            assert_near(limit(ExplicitEuler, zeta), 2.0 * zeta);
        }
        for zeta in [0.0f64, 0.05, 0.3, 0.6] {
            assert_near(
                limit(SemiImplicitEuler, zeta),
                2.0 * (zeta.hypot(1.0) - zeta),
            );
        }
    }

    /// Hughes 1987, eq. 9.1.19.
    #[test]
    fn newmark_has_the_limits_of_its_parameters() {
        for (beta, gamma) in [(0.0, 0.5), (1.0 / 6.0, 0.5), (1.0 / 12.0, 0.5), (0.1, 0.6)] {
            for zeta in [0.0, 0.05, 0.4] {
                let (shift, room): (f64, f64) = (zeta * (gamma - 0.5), 0.5 * gamma - beta);
                let expected = (shift + (room + shift * shift).sqrt()) / room;
                assert_near(limit(Scheme::Newmark { beta, gamma }, zeta), expected);
            }
        }
        let growing = Scheme::Newmark {
            beta: 0.25,
            gamma: 0.45,
        };
        assert_eq!(limit(growing, 0.0), 0.0);
    }

    #[test]
    fn implicit_schemes_have_no_limit() {
        let alphas = [0.0, 0.3, 0.8, 1.0].map(|rho_inf| Scheme::GeneralisedAlpha { rho_inf });
        let others = [Scheme::ImplicitMidpoint, Scheme::NEWMARK];
        for scheme in alphas.into_iter().chain(others) {
            for zeta in [0.0, 0.01, 1.0, 3.0] {
                assert_eq!(scheme.stability_limit(zeta), None, "{scheme:?} {zeta}");
            }
        }
    }
}
