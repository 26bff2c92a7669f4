//! The library of softstop.fmu for FMI 2.0: the C functions of the standard, and no others.

softstop_fmi::export_fmi2!(softstop_fmu::Machine);
