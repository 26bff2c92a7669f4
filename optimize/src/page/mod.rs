//! The report of a design: plain data ([`data`]) made into one page.

pub mod data;
