//! The library of drive.fmu for FMI 2.0.

softstop_fmi::export_fmi2!(softstop_units::Drive);
