//! The table of variables.

use crate::variable::{Access, Variable};

/// Value references lie below this number.
const REFERENCES: usize = 256;
/// The value reference of time, which is a variable in FMI 3.0.
pub(crate) const TIME_REFERENCE: u32 = REFERENCES as u32;

/// All variables of a unit.
#[derive(Debug)]
pub struct Table<U: 'static, T: 'static> {
    groups: &'static [&'static [Variable<U, T>]],
    by_reference: [Option<&'static Variable<U, T>>; REFERENCES],
}

impl<U, T> Table<U, T> {
    /// The rows group by group, in the order of the XML: depth first, as structured naming demands, so
    /// that all of a branch and all elements of an array come in one piece.
    pub const fn new(groups: &'static [&'static [Variable<U, T>]]) -> Self {
        let mut by_reference = [None; REFERENCES];
        let mut group = 0;
        while group < groups.len() {
            let mut row = 0;
            while row < groups[group].len() {
                let variable = &groups[group][row];
                by_reference[variable.reference as usize] = Some(variable);
                row += 1;
            }
            group += 1;
        }
        Self {
            groups,
            by_reference,
        }
    }

    /// All rows, in the order of the XML.
    pub fn rows(&self) -> impl Iterator<Item = &'static Variable<U, T>> + use<U, T> {
        self.groups.iter().copied().flatten()
    }

    /// The variable with this value reference.
    pub fn by_reference(&self, reference: u32) -> Option<&'static Variable<U, T>> {
        *self.by_reference.get(usize::try_from(reference).ok()?)?
    }

    /// The value of a real variable that follows from the motion; of another one it is not a number.
    pub(crate) fn number(&self, unit: &U, reference: u32) -> f64 {
        match self
            .by_reference(reference)
            .map(|variable| &variable.access)
        {
            Some(Access::Continuous { value, .. } | Access::Local(value)) => value(unit),
            _ => f64::NAN,
        }
    }

    /// The variable of this name.
    pub fn by_name(&self, name: &str) -> Option<&'static Variable<U, T>> {
        self.rows().find(|variable| variable.name == name)
    }

    /// The variable of this name or the elements of the array of this name, each with its row counted
    /// from 0.
    pub fn rows_of(&self, name: &str) -> impl Iterator<Item = (usize, &'static Variable<U, T>)> {
        self.rows().enumerate().filter(move |(_, variable)| {
            let rest = variable.name.strip_prefix(name);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('['))
        })
    }

    /// How many continuous inputs there are.
    pub fn signals(&self) -> usize {
        let signal = |variable: &&Variable<U, T>| matches!(variable.access, Access::Signal(_));
        self.rows().filter(signal).count()
    }

    /// The highest order of a time derivative that an output has.
    pub fn highest_output_order(&self) -> usize {
        let orders = self.rows().map(|variable| match variable.access {
            Access::Continuous { derivatives, .. } => derivatives.len(),
            _ => 0,
        });
        orders.max().unwrap_or(0)
    }
}
