//! The grammar of an expression:
//!
//! ```text
//! sum     = product { ("+" | "-") product }
//! product = signed { ("*" | "/") signed }
//! signed  = { "+" | "-" } power
//! power   = atom [ "^" signed ]
//! atom    = number | name | "(" sum ")" | function "(" sum { "," sum } ")"
//! ```

use super::operations::{Binary, Instruction, Unary};

/// The names of the functions that an expression may call, each with its instruction.
const FUNCTIONS: [(&str, Instruction); 6] = [
    ("abs", Instruction::Unary(Unary::Abs)),
    ("exp", Instruction::Unary(Unary::Exp)),
    ("ln", Instruction::Unary(Unary::Ln)),
    ("max", Instruction::Binary(Binary::Max)),
    ("min", Instruction::Binary(Binary::Min)),
    ("sqrt", Instruction::Unary(Unary::Sqrt)),
];

/// The parser of an expression, from left to right by recursive descent.
pub struct Parser<'a> {
    rest: &'a str,
    steps: Vec<Instruction>,
    names: Vec<String>,
    /// Brackets that are open.
    depth: usize,
}

/// Most levels of brackets within brackets.
const MAX_BRACKET_DEPTH: usize = 100;

impl<'a> Parser<'a> {
    /// The steps of an expression and the names in it.
    ///
    /// # Errors
    /// What is wrong where, in words.
    pub fn parse(text: &'a str) -> Result<(Vec<Instruction>, Vec<String>), String> {
        let mut parser = Self {
            rest: text.trim_start(),
            steps: Vec::new(),
            names: Vec::new(),
            depth: 0,
        };
        parser.parse_sum()?;
        match parser.rest {
            "" => Ok((parser.steps, parser.names)),
            _ => Err(parser.unexpected("an operator")),
        }
    }

    /// Takes one of these signs of an expression, if it stands next, and the space behind it.
    fn take_sign(&mut self, signs: &[char]) -> Option<char> {
        let sign = self.rest.chars().next().filter(|it| signs.contains(it))?;
        self.take_bytes(sign.len_utf8());
        Some(sign)
    }

    /// Takes so many bytes of the text of an expression and the space behind them.
    fn take_bytes(&mut self, bytes: usize) -> &'a str {
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

    fn parse_sum(&mut self) -> Result<(), String> {
        self.depth += 1;
        if self.depth > MAX_BRACKET_DEPTH {
            return Err(format!(
                "has more than {MAX_BRACKET_DEPTH} brackets within each other"
            ));
        }
        let signs = [('+', Binary::Plus), ('-', Binary::Minus)];
        self.parse_operands(Self::parse_product, signs)?;
        self.depth -= 1;
        Ok(())
    }

    fn parse_product(&mut self) -> Result<(), String> {
        let signs = [('*', Binary::Times), ('/', Binary::Over)];
        self.parse_operands(Self::parse_signed, signs)
    }

    /// Takes operands of the expression, each by `parse`, and the operators between them, which bind from left to right.
    fn parse_operands(
        &mut self,
        parse: fn(&mut Self) -> Result<(), String>,
        operators: [(char, Binary); 2],
    ) -> Result<(), String> {
        parse(self)?;
        while let Some((_, operator)) = operators
            .iter()
            .find(|(sign, _)| self.take_sign(&[*sign]).is_some())
        {
            parse(self)?;
            self.steps.push(Instruction::Binary(*operator));
        }
        Ok(())
    }

    fn parse_signed(&mut self) -> Result<(), String> {
        let mut is_negative = false;
        while let Some(sign) = self.take_sign(&['+', '-']) {
            is_negative ^= sign == '-';
        }
        self.parse_atom()?;
        if self.take_sign(&['^']).is_some() {
            self.parse_signed()?;
            self.steps.push(Instruction::Binary(Binary::Power));
        }
        if is_negative {
            self.steps.push(Instruction::Unary(Unary::Minus));
        }
        Ok(())
    }

    fn parse_atom(&mut self) -> Result<(), String> {
        if self.take_sign(&['(']).is_some() {
            self.parse_sum()?;
            return self.take_closing();
        }
        if let Some(number) = self.parse_number()? {
            self.steps.push(Instruction::Number(number));
            return Ok(());
        }
        let is_of_name = |it: char| it.is_alphanumeric() || it == '_' || it == '.';
        let length = self.rest.find(|it| !is_of_name(it));
        let length = length.unwrap_or(self.rest.len());
        if length == 0 {
            return Err(self.unexpected("a number, a name or a bracket"));
        }
        let name = self.take_bytes(length);
        match self.rest.starts_with('(') {
            true => self.parse_call(name),
            false => {
                self.push_name(name);
                Ok(())
            }
        }
    }

    fn push_name(&mut self, name: &str) {
        let names = &mut self.names;
        let known = names.iter().position(|it| it == name);
        let index = known.unwrap_or_else(|| {
            names.push(name.to_owned());
            names.len() - 1
        });
        self.steps.push(Instruction::Name(index));
    }

    fn parse_call(&mut self, name: &str) -> Result<(), String> {
        let known = FUNCTIONS.iter().find(|(own, _)| *own == name);
        let Some((_, step)) = known else {
            let known = FUNCTIONS.map(|(own, _)| own).join(", ");
            return Err(format!("has no function {name}; known are {known}"));
        };
        self.take_sign(&['(']);
        self.parse_sum()?;
        if matches!(step, Instruction::Binary(_)) {
            if self.take_sign(&[',']).is_none() {
                return Err(self.unexpected("a comma"));
            }
            self.parse_sum()?;
        }
        self.steps.push(*step);
        self.take_closing()
    }

    fn take_closing(&mut self) -> Result<(), String> {
        match self.take_sign(&[')']) {
            Some(_) => Ok(()),
            None => Err(self.unexpected("a closing bracket")),
        }
    }

    /// Takes a number, if one stands next in the text of the expression.
    fn parse_number(&mut self) -> Result<Option<f64>, String> {
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
        self.take_bytes(length);
        Ok(Some(number))
    }
}
