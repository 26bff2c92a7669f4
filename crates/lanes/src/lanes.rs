//! Many numbers at once: registers of whatever width the processor has.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Sub};

use pulp::Simd;
use pulp::bytemuck::Zeroable;

/// Applies an instruction to each register of one or two and puts the results in the place of a value's registers. Neither a loop
/// (thousands of them, though unrolled, take the compiler minutes) nor a closure, which has no instruction set of its own and is
/// slow wherever it is not inlined.
macro_rules! each {
    ($value:expr => $first:ident.$intrinsic:ident($($other:ident),*)) => {{
        const { assert!(N == 1 || N == 2) };
        let mut result = $value;
        result.registers[0] = $first.simd.$intrinsic($first.registers[0] $(, $other.registers[0])*);
        if N > 1 {
            result.registers[N - 1] =
                $first.simd.$intrinsic($first.registers[N - 1] $(, $other.registers[N - 1])*);
        }
        result
    }};
}

/// One number per lane, in N vector registers side by side, so that operations on one wait less for the other.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct Lanes<S: Simd, const N: usize> {
    simd: S,
    registers: [S::f64s; N],
}

/// Two numbers per lane: a value and its rate, or position and velocity, or cosine and sine.
pub(super) type Pair<S, const N: usize> = (Lanes<S, N>, Lanes<S, N>);

/// One truth value per lane, as wide as a number: narrower ones would be packed in one integer, and unpacked for each use.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(super) struct Mask<S: Simd, const N: usize> {
    simd: S,
    registers: [S::m64s; N],
}

impl<S: Simd, const N: usize> Lanes<S, N> {
    /// Number of lanes.
    pub const COUNT: usize = N * S::F64_LANES;

    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        let registers = [simd.splat_f64s(value); N];
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

    /// A vector that holds one number in every lane.
    #[inline(always)]
    pub fn like(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    /// self * b + c in every lane, rounded once where the processor can.
    #[inline(always)]
    pub fn mul_add(self, b: Self, c: Self) -> Self {
        each!(self => self.mul_add_e_f64s(b, c))
    }

    /// self - b * c in every lane, rounded once where the processor can.
    #[inline(always)]
    pub fn minus_product(self, b: Self, c: Self) -> Self {
        each!(self => b.negate_mul_add_e_f64s(c, self))
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        each!(self => self.abs_f64s())
    }

    #[inline(always)]
    pub fn square_root(self) -> Self {
        each!(self => self.sqrt_f64s())
    }

    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        each!(self => self.max_f64s(other))
    }

    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        each!(self => self.min_f64s(other))
    }

    #[inline(always)]
    pub fn below(self, other: Self) -> Mask<S, N> {
        each!(Mask::none(self.simd) => self.less_than_f64s(other))
    }

    #[inline(always)]
    pub fn at_most(self, other: Self) -> Mask<S, N> {
        each!(Mask::none(self.simd) => self.less_than_or_equal_f64s(other))
    }

    #[inline(always)]
    pub fn equals(self, other: Self) -> Mask<S, N> {
        each!(Mask::none(self.simd) => self.equal_f64s(other))
    }

    /// The largest whole number not above the number in each lane, for numbers below 2^51.
    #[inline(always)]
    pub fn floor(self) -> Self {
        let shift = self.like(1.5 * (1u64 << 52) as f64);
        let near = (self + shift) - shift;
        self.below(near).choose(near - self.like(1.0), near)
    }
}

impl<S: Simd, const N: usize> Mask<S, N> {
    #[inline(always)]
    fn none(simd: S) -> Self {
        let registers = [S::m64s::zeroed(); N];
        Self { simd, registers }
    }

    /// The numbers of `yes` in the lanes where the mask is true, those of `no` elsewhere.
    #[inline(always)]
    pub fn choose(self, yes: Lanes<S, N>, no: Lanes<S, N>) -> Lanes<S, N> {
        each!(yes => self.select_f64s(yes, no))
    }

    /// The truth values of `yes` in the lanes where the mask is true, those of `no` elsewhere.
    #[inline(always)]
    pub fn choose_mask(self, yes: Self, no: Self) -> Self {
        (self & yes) | no.and_not(self)
    }

    /// True in the lanes where this mask is true and `other` is not.
    #[inline(always)]
    pub fn and_not(self, other: Self) -> Self {
        self & other.not()
    }

    #[inline(always)]
    pub fn not(self) -> Self {
        each!(self => self.not_m64s())
    }

    #[inline(always)]
    pub fn any(self) -> bool {
        let any = self.simd.or_m64s(self.registers[0], self.registers[N - 1]);
        self.simd.first_true_m64s(any) < S::F64_LANES
    }

    /// Number of lanes in which the mask is true.
    pub fn count(&self) -> usize {
        (0..Lanes::<S, N>::COUNT)
            .filter(|lane| self.get(*lane))
            .count()
    }

    /// The truth value of one lane, read from memory, since it is asked for where the instruction set is not at hand.
    #[inline(always)]
    pub fn get(&self, lane: usize) -> bool {
        let (register, lane) = (lane / S::F64_LANES, lane % S::F64_LANES);
        let bytes = pulp::bytemuck::bytes_of(&self.registers[register]);
        if bytes.len() < S::F64_LANES {
            bytes[0] >> lane & 1 != 0
        } else {
            bytes[lane * (bytes.len() / S::F64_LANES)] != 0
        }
    }
}

macro_rules! operator {
    ($trait:ident, $name:ident, $type:ident, $intrinsic:ident) => {
        impl<S: Simd, const N: usize> $trait for $type<S, N> {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                each!(self => self.$intrinsic(other))
            }
        }
    };
}

operator!(Add, add, Lanes, add_f64s);
operator!(Sub, sub, Lanes, sub_f64s);
operator!(Mul, mul, Lanes, mul_f64s);
operator!(Div, div, Lanes, div_f64s);
operator!(BitAnd, bitand, Mask, and_m64s);
operator!(BitOr, bitor, Mask, or_m64s);

impl<S: Simd, const N: usize> Neg for Lanes<S, N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        each!(self => self.neg_f64s())
    }
}
