//! The library of softstop.fmu for FMI 2.0: the C functions of the standard, and no others.

use softstop_fmu::fmi2;

softstop_fmi::export_fmi2!(fmi2);
