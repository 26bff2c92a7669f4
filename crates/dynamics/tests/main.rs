//! The tests of orbits, branches, attractors, basins, sweeps and models, as one program.

mod attractors;
mod basin;
mod branch_ends;
mod continuation;
mod corners;
mod examples;
mod exponents;
mod fidelity;
mod grazing;
mod in_service;
mod invariants;
mod limits;
mod machine_reference;
mod slopes;
mod slopes_of_borders;
mod slopes_of_designs;
mod spread;
mod stop_invariants;
mod stroke;
mod sweep;
mod zone_denied;
mod zone_judge;
mod zone_light;
mod zone_reference;
mod zone_sample;
mod zone_units;
