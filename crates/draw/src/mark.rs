//! What marks, legends and texts look like.

use crate::stroke::Stroke;

/// A filled shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// Round.
    Circle,
    /// On its side.
    Square,
    /// On its base.
    Triangle,
    /// On a corner.
    Diamond,
    /// White with a rim of its colour.
    Hollow,
}

/// What an entry of a legend explains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sign {
    /// A colour.
    Patch(&'static str),
    /// A colour of a share of its opacity.
    Band(&'static str, f64),
    /// A line.
    Line(Stroke),
    /// A mark and its colour.
    Mark(Mark, &'static str),
    /// A ring.
    Ring,
}

/// How a text stands to its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// It begins there.
    Left,
    /// Its middle is there.
    Middle,
    /// It ends there.
    Right,
    /// Centred and turned to be read from below.
    Upwards,
}
