//! The library of feeder.fmu for FMI 3.0.

mod functions {
    softstop_fmi::fmi3_functions!(softstop_units::Feeder);
}

softstop_fmi::export_fmi3!(functions);
