//! Quantities with their units, and enumerations: the named types of variables.

/// A physical quantity: the named type, its unit and how that unit is made of base units.
#[derive(Debug, PartialEq)]
pub struct Quantity {
    /// Name of the type in `TypeDefinitions`.
    pub type_name: &'static str,
    /// Physical quantity, as `quantity` of the type.
    pub quantity: &'static str,
    /// Name of the unit.
    pub unit: &'static str,
    /// Exponents of the base units: (name, exponent).
    pub base: &'static [(&'static str, i32)],
    /// Further units to show values in: (name, factor), shown value = factor * value.
    pub display: &'static [(&'static str, f64)],
}

/// An enumeration type.
#[derive(Debug, PartialEq)]
pub struct Enumeration {
    /// Name of the type in `TypeDefinitions`.
    pub type_name: &'static str,
    /// What the type is about.
    pub description: &'static str,
    /// Its items.
    pub items: &'static [Item],
}

/// One item of an enumeration.
#[derive(Debug, PartialEq)]
pub struct Item {
    /// Value by which importers set and read it.
    pub value: i32,
    /// Name.
    pub name: &'static str,
    /// What it means.
    pub description: &'static str,
}

/// An item, for tables of items.
pub const fn item(value: i32, name: &'static str, description: &'static str) -> Item {
    Item {
        value,
        name,
        description,
    }
}
