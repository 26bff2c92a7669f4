//! The library of drive.fmu.

softstop_fmi::export!(softstop_units::Drive);
