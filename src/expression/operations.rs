//! The operations of an expression, with the derivatives of each.

/// The value of an expression with its derivatives by the named values.
#[derive(Debug, Clone, PartialEq)]
pub struct Differentiated {
    /// The value.
    pub value: f64,
    /// Derivatives of the value by the named values.
    pub by: Vec<f64>,
}

/// An instruction of the stack machine that evaluates an expression.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Instruction {
    Number(f64),
    /// A named value, by its index.
    Name(usize),
    Unary(Unary),
    Binary(Binary),
}

/// An operation on one value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unary {
    Minus,
    Abs,
    Exp,
    Ln,
    Sqrt,
}

/// An operation on two values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Binary {
    Plus,
    Minus,
    Times,
    Over,
    Power,
    Max,
    Min,
}

impl Unary {
    /// The operation on a value, with derivatives by the chain rule.
    pub fn apply(self, of: &Differentiated) -> Differentiated {
        let x = of.value;
        let (value, by) = match self {
            Self::Minus => (-x, -1.0),
            Self::Abs => (x.abs(), x.signum()),
            Self::Exp => (x.exp(), x.exp()),
            Self::Ln => (x.ln(), x.recip()),
            Self::Sqrt => (x.sqrt(), 0.5 / x.sqrt()),
        };
        Differentiated {
            value,
            by: of
                .by
                .iter()
                .map(|own| chain_rule_product(by, *own))
                .collect(),
        }
    }
}

impl Binary {
    /// The operation on two values, with derivatives by the chain rule.
    pub fn apply(self, first: &Differentiated, second: &Differentiated) -> Differentiated {
        let (x, y) = (first.value, second.value);
        let pick = |is_first: bool| match is_first {
            _ if x.is_nan() || y.is_nan() => (f64::NAN, f64::NAN, f64::NAN),
            true => (x, 1.0, 0.0),
            false => (y, 0.0, 1.0),
        };
        let (value, by_first, by_second) = match self {
            Self::Plus => (x + y, 1.0, 1.0),
            Self::Minus => (x - y, 1.0, -1.0),
            Self::Times => (x * y, y, x),
            Self::Over => (x / y, y.recip(), -x / (y * y)),
            Self::Power => (
                x.powf(y),
                chain_rule_product(x.powf(y - 1.0), y),
                x.powf(y) * x.ln(),
            ),
            Self::Max => pick(x >= y),
            Self::Min => pick(x <= y),
        };
        let pairs = first.by.iter().zip(&second.by);
        let by = pairs.map(|(first, second)| {
            chain_rule_product(by_first, *first) + chain_rule_product(by_second, *second)
        });
        Differentiated {
            value,
            by: by.collect(),
        }
    }
}

/// The derivative of an operation times that of its operand; 0 if the latter is, whatever the former.
pub fn chain_rule_product(outer: f64, inner: f64) -> f64 {
    if inner == 0.0 { 0.0 } else { outer * inner }
}
