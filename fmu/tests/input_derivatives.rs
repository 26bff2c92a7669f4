//! Inputs that are polynomials in time, through the C functions.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

use std::ffi::c_int;

use crate::common::{OK, Unit, reference};
use softstop_fmi2::*;

#[test]
fn input_derivatives_of_every_order_go_on_until_the_value_is_set() {
    let unit = Unit::new();
    unit.begin();
    let set = |orders: &[c_int], values: &[f64]| {
        let references = vec![reference("force"); orders.len()];
        unsafe {
            fmi2SetRealInputDerivatives(
                unit.component,
                references.as_ptr(),
                orders.len(),
                orders.as_ptr(),
                values.as_ptr(),
            )
        }
    };
    assert_eq!(unit.set("force", 0.5), OK);
    // In one call and in another one: t/4 - t^2/2 + 7! 2^-7 t^7/7!, with one order overwritten.
    assert_eq!(set(&[7, 2, 1], &[5040.0 / 128.0, -1.0, 9.0]), OK);
    assert_eq!(set(&[1], &[0.25]), OK);
    assert_eq!(unit.get("force"), 0.5);
    assert_eq!(unit.step(0.0, 2.0), OK);
    assert_eq!(unit.get("force"), 0.5 + 0.5 - 2.0 + 1.0);
    // Another order set later leaves the rest as it stands by now.
    assert_eq!(set(&[3], &[0.0]), OK);
    assert_eq!(unit.get("force"), 0.0);
    assert_eq!(set(&[8], &[0.0]), OK);
    // All or none.
    unit.refused(set(&[1, 8], &[1.0, 1.0]), &["order 8"]);
    assert_eq!(unit.get("force"), 0.0);
    assert_eq!(unit.set("force", 0.0), OK);
    assert_eq!(unit.step(2.0, 1.0), OK);
    assert_eq!(unit.get("force"), 0.0);
}
