//! How the pictures look: [`pen`] (plain shapes), [`shapes`] (made of others), [`stroke`] (lines), [`panel`] (axes and what is between
//! them), [`scale`] (ranges and round values), [`shade`] (colours of numbers), [`style`] (colours and letters), [`index`] (indices
//! below the line), [`table`] (a table as a picture).
#![forbid(unsafe_code)]

mod axes;
pub mod index;
pub mod panel;
pub mod pen;
pub mod scale;
pub mod shade;
pub mod shapes;
pub mod stroke;
pub mod style;
pub mod table;
