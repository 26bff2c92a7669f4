//! The unit through the C functions of FMI 3.0.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

mod arrays;
mod clock;
mod derivatives;
mod events;
mod exchange;
mod integrator;
mod intermediate;
mod linearization;
mod state_machine;
mod unit;
