//! The tests of the unit, as one program.

mod abi;
mod c_driver;
mod calls;
mod common;
mod directional;
mod discard;
mod drive;
mod input_derivatives;
mod libraries;
mod package;
mod refusals;
mod start_values;
mod state_machine;
mod states;
mod stops;
mod table;
mod threads;
mod traces;
mod tuning;
mod v3;
