//! The library of softstop.fmu for FMI 3.0: the C functions of the standard, and no others.

use softstop_fmu::fmi3;

softstop_fmi::export_fmi3!(fmi3);
