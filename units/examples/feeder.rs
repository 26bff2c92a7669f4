//! The library of feeder.fmu.

softstop_fmi::export!(softstop_units::Feeder);
