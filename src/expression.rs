//! Arithmetic expressions of named values, with exact derivatives by the chain rule.

mod operations;
mod parser;

use operations::Instruction;
pub use operations::{Differentiated, chain_rule_product};
use parser::Parser;

/// Most characters of an expression.
const MAX_LENGTH: usize = 1000;

/// An expression of named values, as the instructions of a stack machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression {
    steps: Vec<Instruction>,
    names: Vec<String>,
}

impl Expression {
    /// The expression that a text states.
    ///
    /// # Errors
    /// What is wrong where, in words.
    pub fn parse(text: &str) -> Result<Self, String> {
        if text.chars().count() > MAX_LENGTH {
            return Err(format!("has more than {MAX_LENGTH} characters"));
        }
        let (steps, names) = Parser::parse(text)?;
        Ok(Self { steps, names })
    }

    /// The expression that is one number, without names.
    pub(crate) fn constant(value: f64) -> Self {
        Self {
            steps: vec![Instruction::Number(value)],
            names: Vec::new(),
        }
    }

    /// The names in the expression, each once, in the order of the values that [`Expression::eval`] takes.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The value of the expression where its names have these values, and its derivatives by them.
    pub fn eval(&self, values: &[f64]) -> Differentiated {
        let mut stack: Vec<Differentiated> = Vec::new();
        let constant = |value| Differentiated {
            value,
            by: vec![0.0; values.len()],
        };
        for step in &self.steps {
            let last = stack.pop();
            match (*step, last) {
                (Instruction::Unary(of), Some(last)) => stack.push(of.apply(&last)),
                (Instruction::Binary(of), Some(last)) => {
                    let first = stack.pop();
                    stack.extend(first.map(|first| of.apply(&first, &last)));
                }
                (step, last) => {
                    stack.extend(last);
                    stack.push(match step {
                        Instruction::Number(number) => constant(number),
                        Instruction::Name(index) => {
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
            let found = expression.eval(&values);
            assert!((found.value - value).abs() < 1e-12, "{text}");
            for (own, by) in indices.iter().map(|index| by[*index]).zip(found.by) {
                assert!((own - by).abs() < 1e-12, "{text}");
            }
        }
        Ok(())
    }

    #[test]
    fn what_has_no_value_has_none_of_its_maximum() -> Result<(), String> {
        for text in ["max(ln(-1), 3)", "max(3, ln(-1))", "min(3, x)", "min(x, 3)"] {
            assert!(
                Expression::parse(text)?.eval(&[f64::NAN]).value.is_nan(),
                "{text}"
            );
        }
        let power = Expression::parse("x^0")?.eval(&[0.0]);
        assert_eq!((power.value, power.by[0]), (1.0, 0.0));
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
        let nested = |depth| "(".repeat(depth) + "1" + &")".repeat(depth);
        assert!(Expression::parse(&nested(99)).is_ok());
        assert!(Expression::parse(&nested(450)).is_err());
        assert!(Expression::parse(&"x+".repeat(501)).is_err());
    }
}
