//! Intervals hold what they should, and little more.

use proptest::prelude::*;
use softstop_prove::Interval;
use softstop_prove::elementary::{even_series, full_turn};
use softstop_prove::number::{Decay, Dual, Number};
use softstop_testing::random::cases;

fn point(value: f64) -> Interval {
    Interval::point(value)
}

/// True if an interval is at most this wide, in units of its largest number.
fn is_narrow(it: Interval, share: f64) -> bool {
    it.width() <= share * it.magnitude()
}

fn holds(outer: Interval, (low, high): (f64, f64)) -> bool {
    outer.low() <= low && high <= outer.high()
}

proptest! {
    #![proptest_config(cases(20_000))]

    /// Fused multiply-adds know the sign of what was rounded off.
    #[test]
    fn bounds_of_operations_are_the_nearest_doubles(a in -1e6..1e6f64, b in -1e6..1e6f64) {
        prop_assume!(a.abs() > 1e-9 && b.abs() > 1e-9);
        let product = point(a) * point(b);
        prop_assert!(a.mul_add(b, -product.low()) >= 0.0 && a.mul_add(b, -product.high()) <= 0.0);
        let quotient = point(a) / point(b);
        let rest = |q: f64| q.mul_add(-b, a) * b.signum();
        prop_assert!(rest(quotient.low()) >= 0.0 && rest(quotient.high()) <= 0.0);
        let root = point(a.abs()).sqrt();
        let rest = |r: f64| r.mul_add(-r, a.abs());
        prop_assert!(rest(root.low()) >= 0.0 && rest(root.high()) <= 0.0);
        for it in [product, quotient, root] {
            prop_assert!(it.high() <= it.low().next_up());
        }
    }

    /// Integers show whether sums are held.
    #[test]
    fn sums_hold_the_exact_one(a in any::<i64>(), b in any::<i64>()) {
        let (a, b) = (a as f64, b as f64);
        let (sum, exact) = (point(a) + point(b), a as i128 + b as i128);
        prop_assert!(sum.low() as i128 <= exact && exact <= sum.high() as i128);
        prop_assert!(sum.high() <= sum.low().next_up());
    }

    /// Of any operands taken from two intervals.
    #[test]
    fn results_of_operands_within_are_held(
        (a, b) in (-5.0..5.0f64, -5.0..5.0f64), (wide, high) in (0.0..2.0f64, 0.0..2.0f64),
        (s, t) in (0.0..1.0f64, 0.0..1.0f64),
    ) {
        let (x, y) = (Interval::new(a, a + wide), Interval::new(b, b + high));
        let (u, v) = ((a + s * wide).min(x.high()), (b + t * high).min(y.high()));
        let held = [
            (x + y, point(u) + point(v)),
            (x - y, point(u) - point(v)),
            (x * y, point(u) * point(v)),
            (x.square(), point(u).square()),
            (x.exp(), point(u).exp()),
            (x.sin_cos().0, point(u).sin_cos().0),
            (x.sin_cos().1, point(u).sin_cos().1),
        ];
        for (outer, inner) in held {
            prop_assert!(outer.contains(inner.middle()), "{:?} {:?}", outer, inner);
        }
        if !y.contains(0.0) {
            prop_assert!((x / y).contains((point(u) / point(v)).middle()));
        }
    }
}

/// What is not finite is no number: nothing is known of it.
#[test]
fn what_is_not_finite_is_the_whole_line() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let cases = [
            point(value),
            Interval::from(value),
            Interval::new(value, value),
            Interval::around(value, 1.0),
        ];
        assert_eq!(cases, [Interval::WHOLE; 4]);
        assert!(!point(value).is_bounded());
    }
    assert_eq!(even_series(point(-2.0)), (Interval::WHOLE, Interval::WHOLE));
}

/// An argument with the doubles on both sides of its sine, cosine and exponential.
type Known = (f64, (f64, f64), (f64, f64), (f64, f64));

/// The doubles on both sides of sine, cosine and exponential, from 300 bits of mpmath.
const KNOWN: [Known; 10] = [
    (0.0, (0.0, 0.0), (1.0, 1.0), (1.0, 1.0)),
    (
        -0.1,
        (-0.09983341664682817, -0.09983341664682815),
        (0.9950041652780257, 0.9950041652780258),
        (0.9048374180359595, 0.9048374180359596),
    ),
    (
        0.79,
        (0.7103532724176078, 0.7103532724176079),
        (0.7038453156522361, 0.7038453156522362),
        (2.2033964262559365, 2.203396426255937),
    ),
    (
        1.15,
        (0.912763940260521, 0.9127639402605211),
        (0.40848744088415734, 0.4084874408841574),
        (3.158192909689767, 3.1581929096897676),
    ),
    (
        -3.5,
        (0.35078322768961984, 0.3507832276896199),
        (-0.9364566872907963, -0.9364566872907962),
        (0.030197383422318497, 0.0301973834223185),
    ),
    (
        22.0,
        (-0.008851309290403876, -0.008851309290403874),
        (-0.9999608263946372, -0.9999608263946371),
        (3584912846.1315913, 3584912846.131592),
    ),
    (
        131.9,
        (-0.04687426844305525, -0.04687426844305524),
        (0.9989007973557376, 0.9989007973557377),
        (1.920623166642909e57, 1.9206231666429093e57),
    ),
    (
        1e4,
        (-0.30561438888825215, -0.3056143888882521),
        (-0.9521553682590149, -0.9521553682590148),
        (f64::MAX, f64::INFINITY),
    ),
    (
        -700.0,
        (-0.5439705233633757, -0.5439705233633756),
        (-0.8391043258807425, -0.8391043258807424),
        (9.85967654375977e-305, 9.859676543759773e-305),
    ),
    (
        600.5,
        (-0.4401836232200362, -0.4401836232200361),
        (-0.8979077780311747, -0.8979077780311746),
        (6.22065882492659e260, 6.220658824926591e260),
    ),
];

#[test]
fn functions_hold_known_values_and_are_narrow() {
    for (x, sine, cosine, exponential) in KNOWN {
        let (sin, cos) = point(x).sin_cos();
        assert!(
            holds(sin, sine) && holds(cos, cosine),
            "{x}: {sin:?} {cos:?}"
        );
        assert!(sin.width() < 1e-15 && cos.width() < 1e-15, "{x}");
        let exp = point(x).exp();
        assert!(holds(exp, exponential), "{x}: {exp:?}");
        assert!(
            is_narrow(exp, 4e-15) || !(-600.0..=700.0).contains(&x),
            "{x}: {exp:?}"
        );
    }
    assert!(holds(
        full_turn(),
        (std::f64::consts::TAU, std::f64::consts::TAU.next_up())
    ));
    assert!(is_narrow(full_turn(), 3e-16));
}

/// Of x'' + 2 a x' + b x = 0 in all its cases: the Wronskian is exp(-2 a t), two halves make a whole, and the
/// derivatives are those of the equation.
#[test]
fn free_motions_obey_their_equation() {
    for (rate, stiffness) in [
        (0.1, 9.0),
        (0.5, 0.25),
        (3.0, 0.1),
        (0.0, 0.0),
        (0.09, -1.0),
        (40.0, 2.0),
    ] {
        let [rate, stiffness] = [rate, stiffness].map(point);
        let decay = Decay { rate, stiffness };
        for time in [1e-3, 0.4, 2.0, 7.5] {
            let matrix = |time: Interval| {
                let (u, s) = time.decay(&decay);
                [[u + rate * s, s], [-(stiffness * s), u - rate * s]]
            };
            let (whole, half) = (matrix(point(time)), matrix(point(0.5 * time)));
            let wronskian = whole[0][0] * whole[1][1] - whole[0][1] * whole[1][0];
            let exact = (point(-2.0 * time) * rate).exp();
            assert!(wronskian.intersection(exact).is_some(), "{decay:?} {time}");
            for row in 0..2 {
                for column in 0..2 {
                    let twice = half[row][0] * half[0][column] + half[row][1] * half[1][column];
                    let once = whole[row][column];
                    assert!(
                        twice.intersection(once).is_some(),
                        "{decay:?} {time}: {twice:?} {once:?}"
                    );
                    assert!(
                        once.width() < 1e-13 * (1.0 + once.magnitude()),
                        "{decay:?} {time}"
                    );
                }
            }
            let (u, s) = Dual::unknown(point(time), 0, 1).decay(&decay);
            let square = stiffness - rate.square();
            let by_time = [
                -(rate * u.value) - square * s.value,
                u.value - rate * s.value,
            ];
            let found = [u.slope(0), s.slope(0)];
            for (found, exact) in found.into_iter().zip(by_time) {
                assert!(found.intersection(exact).is_some(), "{decay:?} {time}");
            }
        }
    }
}
