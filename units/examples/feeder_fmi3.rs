//! The library of feeder.fmu for FMI 3.0.

softstop_fmi::export_fmi3!(softstop_units::Feeder);
