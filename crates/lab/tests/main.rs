//! The tests of the laboratory and of its program, as one program.

mod atlas;
mod diagrams;
mod failures;
mod figure;
mod grazing;
mod guide;
mod interrupts;
mod many_digits;
mod methods;
mod methods_limits;
mod paper_maps;
mod paper_motions;
mod precision;
mod reference;
mod refusals;
mod solvers;
mod stored;
mod throughput;
