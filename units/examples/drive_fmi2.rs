//! The library of drive.fmu for FMI 2.0.

mod functions {
    softstop_fmi::fmi2_functions!(softstop_units::Drive);
}

softstop_fmi::export_fmi2!(functions);
