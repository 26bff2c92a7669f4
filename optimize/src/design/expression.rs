//! Arithmetic expressions of named values, with exact derivatives by the chain rule.
//!
//! ```text
//! sum     = product { ("+" | "-") product }
//! product = signed { ("*" | "/") signed }
//! signed  = { "+" | "-" } power
//! power   = atom [ "^" signed ]
//! atom    = number | name | "(" sum ")" | function "(" sum { "," sum } ")"
//! ```

use super::slope::Slope;

/// Characters of an expression at most.
const MAX_LENGTH: usize = 1000;

/// An expression as the steps of a stack machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression {
    steps: Vec<Step>,
    names: Vec<String>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Step {
    Number(f64),
    /// A named value, by its index.
    Name(usize),
    Unary(Unary),
    Binary(Binary),
}

/// What is computed of one value.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Unary {
    Minus,
    Abs,
    Exp,
    Ln,
    Sqrt,
}

/// What is computed of two values.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Binary {
    Plus,
    Minus,
    Times,
    Over,
    Power,
    Max,
    Min,
}

/// The functions that an expression may call.
const FUNCTIONS: [(&str, Step); 6] = [
    ("abs", Step::Unary(Unary::Abs)),
    ("exp", Step::Unary(Unary::Exp)),
    ("ln", Step::Unary(Unary::Ln)),
    ("max", Step::Binary(Binary::Max)),
    ("min", Step::Binary(Binary::Min)),
    ("sqrt", Step::Unary(Unary::Sqrt)),
];

impl Expression {
    /// Reads an expression.
    ///
    /// # Errors
    /// What is wrong where, in words.
    pub fn parse(text: &str) -> Result<Self, String> {
        if text.chars().count() > MAX_LENGTH {
            return Err(format!("has more than {MAX_LENGTH} characters"));
        }
        let mut parser = Parser {
            rest: text.trim_start(),
            found: Self {
                steps: Vec::new(),
                names: Vec::new(),
            },
        };
        parser.sum()?;
        match parser.rest {
            "" => Ok(parser.found),
            _ => Err(parser.unexpected("an operator")),
        }
    }

    /// The names in it, each once.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Its value, and its derivatives by the named values.
    pub fn at(&self, values: &[f64]) -> Slope {
        let mut stack: Vec<Slope> = Vec::new();
        let constant = |value| Slope {
            value,
            by: vec![0.0; values.len()],
        };
        for step in &self.steps {
            let last = stack.pop();
            match (*step, last) {
                (Step::Unary(of), Some(last)) => stack.push(of.at(&last)),
                (Step::Binary(of), Some(last)) => {
                    let first = stack.pop();
                    stack.extend(first.map(|first| of.at(&first, &last)));
                }
                (step, last) => {
                    stack.extend(last);
                    stack.push(match step {
                        Step::Number(number) => constant(number),
                        Step::Name(index) => {
                            let mut named = constant(values[index]);
                            named.by[index] = 1.0;
                            named
                        }
                        _ => constant(f64::NAN),
                    });
                }
            }
        }
        stack.pop().unwrap_or_else(|| constant(f64::NAN))
    }
}

impl Unary {
    fn at(self, of: &Slope) -> Slope {
        let x = of.value;
        let (value, by) = match self {
            Self::Minus => (-x, -1.0),
            Self::Abs => (x.abs(), x.signum()),
            Self::Exp => (x.exp(), x.exp()),
            Self::Ln => (x.ln(), x.recip()),
            Self::Sqrt => (x.sqrt(), 0.5 / x.sqrt()),
        };
        Slope {
            value,
            by: of.by.iter().map(|own| chained(by, *own)).collect(),
        }
    }
}

impl Binary {
    fn at(self, first: &Slope, second: &Slope) -> Slope {
        let (x, y) = (first.value, second.value);
        let pick = |is_first: bool| match is_first {
            true => (x, 1.0, 0.0),
            false => (y, 0.0, 1.0),
        };
        let (value, by_first, by_second) = match self {
            Self::Plus => (x + y, 1.0, 1.0),
            Self::Minus => (x - y, 1.0, -1.0),
            Self::Times => (x * y, y, x),
            Self::Over => (x / y, y.recip(), -x / (y * y)),
            Self::Power => (x.powf(y), y * x.powf(y - 1.0), x.powf(y) * x.ln()),
            Self::Max => pick(x >= y),
            Self::Min => pick(x <= y),
        };
        let pairs = first.by.iter().zip(&second.by);
        let by =
            pairs.map(|(first, second)| chained(by_first, *first) + chained(by_second, *second));
        Slope {
            value,
            by: by.collect(),
        }
    }
}

/// A product of derivatives; 0 if the inner one is, whatever the outer.
fn chained(outer: f64, inner: f64) -> f64 {
    if inner == 0.0 { 0.0 } else { outer * inner }
}

struct Parser<'a> {
    rest: &'a str,
    found: Expression,
}

impl<'a> Parser<'a> {
    /// Takes a sign, if it is one of these, and the space behind it.
    fn sign(&mut self, signs: &[char]) -> Option<char> {
        let sign = self.rest.chars().next().filter(|it| signs.contains(it))?;
        self.take(sign.len_utf8());
        Some(sign)
    }

    /// Takes so many bytes and the space behind them.
    fn take(&mut self, bytes: usize) -> &'a str {
        let (taken, rest) = self.rest.split_at(bytes);
        self.rest = rest.trim_start();
        taken
    }

    fn unexpected(&self, wanted: &str) -> String {
        match self.rest {
            "" => format!("ends where {wanted} must stand"),
            rest => format!("has {rest:?} where {wanted} must stand"),
        }
    }

    fn push(&mut self, step: Step) {
        self.found.steps.push(step);
    }

    fn sum(&mut self) -> Result<(), String> {
        self.product()?;
        while let Some(sign) = self.sign(&['+', '-']) {
            self.product()?;
            let is_sum = sign == '+';
            self.push(Step::Binary(if is_sum {
                Binary::Plus
            } else {
                Binary::Minus
            }));
        }
        Ok(())
    }

    fn product(&mut self) -> Result<(), String> {
        self.signed()?;
        while let Some(sign) = self.sign(&['*', '/']) {
            self.signed()?;
            let is_product = sign == '*';
            self.push(Step::Binary(if is_product {
                Binary::Times
            } else {
                Binary::Over
            }));
        }
        Ok(())
    }

    fn signed(&mut self) -> Result<(), String> {
        let mut is_negative = false;
        while let Some(sign) = self.sign(&['+', '-']) {
            is_negative ^= sign == '-';
        }
        self.atom()?;
        if self.sign(&['^']).is_some() {
            self.signed()?;
            self.push(Step::Binary(Binary::Power));
        }
        if is_negative {
            self.push(Step::Unary(Unary::Minus));
        }
        Ok(())
    }

    fn atom(&mut self) -> Result<(), String> {
        if self.sign(&['(']).is_some() {
            self.sum()?;
            return self.close();
        }
        if let Some(number) = self.number()? {
            self.push(Step::Number(number));
            return Ok(());
        }
        let is_of_name = |it: char| it.is_alphanumeric() || it == '_' || it == '.';
        let length = self.rest.find(|it| !is_of_name(it));
        let length = length.unwrap_or(self.rest.len());
        if length == 0 {
            return Err(self.unexpected("a number, a name or a bracket"));
        }
        let name = self.take(length);
        match self.rest.starts_with('(') {
            true => self.call(name),
            false => {
                self.name(name);
                Ok(())
            }
        }
    }

    fn name(&mut self, name: &str) {
        let names = &mut self.found.names;
        let known = names.iter().position(|it| it == name);
        let index = known.unwrap_or_else(|| {
            names.push(name.to_owned());
            names.len() - 1
        });
        self.push(Step::Name(index));
    }

    fn call(&mut self, name: &str) -> Result<(), String> {
        let known = FUNCTIONS.iter().find(|(own, _)| *own == name);
        let Some((_, step)) = known else {
            let known = FUNCTIONS.map(|(own, _)| own).join(", ");
            return Err(format!("has no function {name}; known are {known}"));
        };
        self.sign(&['(']);
        self.sum()?;
        if matches!(step, Step::Binary(_)) {
            if self.sign(&[',']).is_none() {
                return Err(self.unexpected("a comma"));
            }
            self.sum()?;
        }
        self.push(*step);
        self.close()
    }

    fn close(&mut self) -> Result<(), String> {
        match self.sign(&[')']) {
            Some(_) => Ok(()),
            None => Err(self.unexpected("a closing bracket")),
        }
    }

    /// Takes a number, if one stands here.
    fn number(&mut self) -> Result<Option<f64>, String> {
        let is_start = |it: char| it.is_ascii_digit() || it == '.';
        if !self.rest.starts_with(is_start) {
            return Ok(None);
        }
        let bytes = self.rest.as_bytes();
        let is_inside = |index: &usize| match bytes[*index] {
            b'+' | b'-' => matches!(bytes[index - 1], b'e' | b'E'),
            other => other.is_ascii_alphanumeric() || other == b'.',
        };
        let length = 1 + (1..bytes.len()).take_while(is_inside).count();
        let text = &self.rest[..length];
        let number = text.parse::<f64>().ok().filter(|it| it.is_finite());
        let number = number.ok_or_else(|| format!("has {text:?}, which is no number"))?;
        self.take(length);
        Ok(Some(number))
    }
}

#[cfg(test)]
mod tests {
    use super::Expression;

    #[test]
    fn values_and_derivatives_are_those_of_the_formula() -> Result<(), String> {
        let (x, y): (f64, f64) = (1.3, 2.1);
        let cases = [
            ("2", 2.0, [0.0, 0.0]),
            ("x.a - y / 2 - 1", x - y / 2.0 - 1.0, [1.0, -0.5]),
            ("-x.a^2", -x * x, [-2.0 * x, 0.0]),
            (
                "2^-x.a",
                2.0_f64.powf(-x),
                [-2.0_f64.powf(-x) * 2.0_f64.ln(), 0.0],
            ),
            ("x.a^2^y", x.powf(2.0_f64.powf(y)), {
                let power = 2.0_f64.powf(y);
                let value = x.powf(power);
                [power * value / x, value * x.ln() * power * 2.0_f64.ln()]
            }),
            (
                "3e-5*x.a*y + .5E+1",
                3e-5 * x * y + 5.0,
                [3e-5 * y, 3e-5 * x],
            ),
            ("max(x.a, y) * min(x.a, y)", x * y, [y, x]),
            (
                "sqrt(x.a) / y",
                x.sqrt() / y,
                [0.5 / x.sqrt() / y, -x.sqrt() / (y * y)],
            ),
            ("exp(ln(abs(-x.a))) - -y", x + y, [1.0, 1.0]),
            ("(-1)^2 * ( x.a )", x, [1.0, 0.0]),
        ];
        for (text, value, by) in cases {
            let expression = Expression::parse(text)?;
            let given = [("x.a", x), ("y", y)];
            let named = |name: &String| given.iter().position(|(own, _)| own == name);
            let indices: Option<Vec<usize>> = expression.names().iter().map(named).collect();
            let indices = indices.ok_or(text)?;
            let values: Vec<f64> = indices.iter().map(|index| given[*index].1).collect();
            let found = expression.at(&values);
            assert!((found.value - value).abs() < 1e-12, "{text}");
            for (own, by) in indices.iter().map(|index| by[*index]).zip(found.by) {
                assert!((own - by).abs() < 1e-12, "{text}");
            }
        }
        Ok(())
    }

    #[test]
    fn what_is_no_expression_is_refused() {
        for (text, says) in [
            ("", "ends where a number, a name or a bracket"),
            ("2 *", "ends where"),
            ("2 x", "has \"x\" where an operator"),
            ("(x", "ends where a closing bracket"),
            ("x)", "has \")\" where an operator"),
            ("1.2.3", "\"1.2.3\", which is no number"),
            ("1e400", "no number"),
            ("sin(x)", "no function sin; known are abs, exp"),
            ("max(x)", "has \")\" where a comma"),
            ("x ** 2", "has \"* 2\" where"),
            ("2 €", "has \"€\" where an operator"),
        ] {
            let error = Expression::parse(text).expect_err(text);
            assert!(error.contains(says), "{error}");
        }
        assert!(Expression::parse(&"(".repeat(1000)).is_err());
        assert!(Expression::parse(&"x+".repeat(501)).is_err());
    }
}
