//! How the pictures look: [`pen`] (plain shapes), [`panel`] and [`plane`] (axes), [`style`] (colours and
//! letters), [`table`] (a table as a picture).
#![forbid(unsafe_code)]
#![allow(missing_docs)]

pub mod panel;
pub mod pen;
pub mod plane;
pub mod style;
pub mod table;
