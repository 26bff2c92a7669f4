//! The tests of the engine, as one program.

mod bad_input;
mod clock;
mod examples;
mod flow_reference;
mod force;
mod force_reference;
mod guarantee;
mod influences;
mod limits;
mod long_runs;
mod machine;
mod machine_files;
mod machine_refusals;
mod rates;
mod sensitivities;
mod snapshots;
mod stops_reference;
mod strip;
mod ties;
mod two_sided;
