//! The library of drive.fmu for FMI 3.0.

mod functions {
    softstop_fmi::fmi3_functions!(softstop_units::Drive);
}

softstop_fmi::export_fmi3!(functions);
