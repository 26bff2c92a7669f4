//! Numbers of many digits, and polynomials of them.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

/// A number of many digits. An operation keeps the precision of the more precise operand.
pub type Real = FBig<HalfEven, 2>;

/// How many binary digits are carried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Digits(pub usize);

impl Digits {
    /// A double, taken as an exact number.
    pub fn real(self, value: f64) -> Real {
        let exact = Real::try_from(value).expect("a finite number");
        exact.with_precision(self.0).value()
    }

    /// 2^exponent.
    pub fn power_of_two(self, exponent: isize) -> Real {
        self.real(1.0) << exponent
    }

    /// 2 pi.
    pub fn turn(self) -> Real {
        Real::pi(self.0) << 1
    }
}

/// The nearest double.
pub fn float(number: &Real) -> f64 {
    number.to_f64().value()
}

/// |number|.
pub fn size(number: &Real) -> Real {
    if is_negative(number) {
        -number
    } else {
        number.clone()
    }
}

/// True below zero.
pub fn is_negative(number: &Real) -> bool {
    *number < Real::ZERO
}

/// True at zero.
pub fn is_zero(number: &Real) -> bool {
    *number == Real::ZERO
}

/// The value of a polynomial, lowest coefficient first.
pub fn value(coefficients: &[Real], at: &Real) -> Real {
    let mut sum = Real::ZERO;
    for coefficient in coefficients.iter().rev() {
        sum = sum * at + coefficient;
    }
    sum
}

/// The derivative of a polynomial.
pub fn derivative(coefficients: &[Real]) -> Vec<Real> {
    let terms = coefficients.iter().enumerate().skip(1);
    terms.map(|(n, term)| term * Real::from(n)).collect()
}
