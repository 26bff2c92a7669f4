//! Many numbers at once: two registers of whatever width the processor has.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Sub};

use pulp::Simd;

/// Registers that go side by side, so that one waits less for the other.
const ABREAST: usize = 2;

/// One number per lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lanes<S: Simd> {
    simd: S,
    registers: [S::f64s; ABREAST],
}

/// One truth value per lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mask<S: Simd> {
    simd: S,
    registers: [S::m64s; ABREAST],
}

impl<S: Simd> Lanes<S> {
    /// How many there are.
    pub const COUNT: usize = ABREAST * S::F64_LANES;

    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        let registers = [simd.splat_f64s(value); ABREAST];
        Self { simd, registers }
    }

    #[inline(always)]
    pub fn get(&self, lane: usize) -> f64 {
        pulp::bytemuck::cast_slice::<S::f64s, f64>(&self.registers)[lane]
    }

    #[inline(always)]
    pub fn set(&mut self, lane: usize, value: f64) {
        pulp::bytemuck::cast_slice_mut::<S::f64s, f64>(&mut self.registers)[lane] = value;
    }

    #[inline(always)]
    fn map(self, f: impl Fn(S, S::f64s) -> S::f64s) -> Self {
        let [a, b] = self.registers;
        let registers = [f(self.simd, a), f(self.simd, b)];
        Self { registers, ..self }
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(S, S::f64s, S::f64s) -> S::f64s) -> Self {
        let ([a, b], [c, d]) = (self.registers, other.registers);
        let registers = [f(self.simd, a, c), f(self.simd, b, d)];
        Self { registers, ..self }
    }

    #[inline(always)]
    fn compare(self, other: Self, f: impl Fn(S, S::f64s, S::f64s) -> S::m64s) -> Mask<S> {
        let ([a, b], [c, d]) = (self.registers, other.registers);
        let registers = [f(self.simd, a, c), f(self.simd, b, d)];
        Mask {
            simd: self.simd,
            registers,
        }
    }

    /// The same number in every lane.
    #[inline(always)]
    pub fn like(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    /// self * b + c, rounded once where the processor can.
    #[inline(always)]
    pub fn mul_add(self, b: Self, c: Self) -> Self {
        let ([x0, x1], [y0, y1], [z0, z1]) = (self.registers, b.registers, c.registers);
        let simd = self.simd;
        let registers = [
            simd.mul_add_e_f64s(x0, y0, z0),
            simd.mul_add_e_f64s(x1, y1, z1),
        ];
        Self { registers, ..self }
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        self.map(|simd, a| simd.abs_f64s(a))
    }

    #[inline(always)]
    pub fn square_root(self) -> Self {
        self.map(|simd, a| simd.sqrt_f64s(a))
    }

    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        self.zip(other, |simd, a, b| simd.max_f64s(a, b))
    }

    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        self.zip(other, |simd, a, b| simd.min_f64s(a, b))
    }

    #[inline(always)]
    pub fn below(self, other: Self) -> Mask<S> {
        self.compare(other, |simd, a, b| simd.less_than_f64s(a, b))
    }

    #[inline(always)]
    pub fn at_most(self, other: Self) -> Mask<S> {
        self.compare(other, |simd, a, b| simd.less_than_or_equal_f64s(a, b))
    }

    #[inline(always)]
    pub fn equals(self, other: Self) -> Mask<S> {
        self.compare(other, |simd, a, b| simd.equal_f64s(a, b))
    }

    /// The largest whole number below, for numbers below 2^51.
    #[inline(always)]
    pub fn floor(self) -> Self {
        let shift = self.like(1.5 * (1u64 << 52) as f64);
        let near = (self + shift) - shift;
        self.below(near).choose(near - self.like(1.0), near)
    }
}

impl<S: Simd> Mask<S> {
    /// `yes` where true, `no` elsewhere.
    #[inline(always)]
    pub fn choose(self, yes: Lanes<S>, no: Lanes<S>) -> Lanes<S> {
        let ([m0, m1], [a0, a1], [b0, b1]) = (self.registers, yes.registers, no.registers);
        let simd = self.simd;
        let registers = [simd.select_f64s(m0, a0, b0), simd.select_f64s(m1, a1, b1)];
        Lanes { registers, simd }
    }

    /// True where this one is and the other is not.
    #[inline(always)]
    pub fn and_not(self, other: Self) -> Self {
        self & other.not()
    }

    #[inline(always)]
    pub fn not(self) -> Self {
        let [a, b] = self.registers;
        let registers = [self.simd.not_m64s(a), self.simd.not_m64s(b)];
        Self { registers, ..self }
    }

    #[inline(always)]
    pub fn any(self) -> bool {
        let [a, b] = self.registers;
        self.simd.first_true_m64s(self.simd.or_m64s(a, b)) < S::F64_LANES
    }

    #[inline(always)]
    pub fn set(&mut self, lane: usize, value: bool) {
        let (one, zero) = (Lanes::splat(self.simd, 1.0), Lanes::splat(self.simd, 0.0));
        let mut truths = self.choose(one, zero);
        truths.set(lane, f64::from(u8::from(value)));
        *self = truths.equals(one);
    }

    /// Truth of one lane.
    #[inline(always)]
    pub fn get(self, lane: usize) -> bool {
        let (one, zero) = (Lanes::splat(self.simd, 1.0), Lanes::splat(self.simd, 0.0));
        self.choose(one, zero).get(lane) != 0.0
    }
}

macro_rules! operator {
    ($trait:ident, $name:ident, $intrinsic:ident) => {
        impl<S: Simd> $trait for Lanes<S> {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                self.zip(other, |simd, a, b| simd.$intrinsic(a, b))
            }
        }
    };
}

operator!(Add, add, add_f64s);
operator!(Sub, sub, sub_f64s);
operator!(Mul, mul, mul_f64s);
operator!(Div, div, div_f64s);

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|simd, a| simd.neg_f64s(a))
    }
}

impl<S: Simd> BitAnd for Mask<S> {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        let ([a, b], [c, d]) = (self.registers, other.registers);
        let registers = [self.simd.and_m64s(a, c), self.simd.and_m64s(b, d)];
        Self { registers, ..self }
    }
}

impl<S: Simd> BitOr for Mask<S> {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        let ([a, b], [c, d]) = (self.registers, other.registers);
        let registers = [self.simd.or_m64s(a, c), self.simd.or_m64s(b, d)];
        Self { registers, ..self }
    }
}
