//! The tests of the laboratory and of its program, as one program.

mod atlas;
mod diagrams;
mod failures;
mod figure;
mod grazing;
mod guide;
mod interrupts;
mod methods;
mod methods_limits;
mod paper_maps;
mod paper_motions;
mod precision;
mod refusals;
mod solvers;
mod stored;
mod throughput;
