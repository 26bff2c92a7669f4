//! Findings on the regimes: shares of the maps, hardest impact on s_SN.

use super::boundaries::Boundaries;
use softstop_dynamics::motion::{MotionClass, MotionKind};
use softstop_explore::basin::cells::RegimeMap;

/// Shares of the maps, and what the boundaries say.
pub(super) fn of(maps: &[RegimeMap; 6], boundaries: &[Boundaries; 2]) -> Vec<(String, f64)> {
    let [up, down, zoom, hardest, loaded_up, loaded_down] = maps;
    let mut findings = Vec::new();
    let named = [
        ("unloaded, rising", up),
        ("unloaded, falling", down),
        ("unloaded, zoom, rising", zoom),
        ("unloaded, zoom, hardest of several starts", hardest),
        ("loaded, rising", loaded_up),
        ("loaded, falling", loaded_down),
    ];
    for (name, map) in named {
        for &class in MotionClass::ALL {
            let share = map.share(class);
            if share > 0.0 {
                findings.push((format!("{name}: share of {}", class.name()), share));
            }
        }
    }
    for (name, up, down) in [("unloaded", up, down), ("loaded", loaded_up, loaded_down)] {
        let name = format!("{name}: share of z = 1 or z = 0 by the way");
        findings.push((name, hysteresis(up, down)));
    }
    for (name, own) in ["unloaded", "loaded"].into_iter().zip(boundaries) {
        if let Some(point) = own.hardest() {
            let [eta, rho] = point.parameters;
            let velocity = super::boundaries::hardest(point);
            findings.push((format!("{name}: largest velocity on s_SN"), velocity));
            findings.push((format!("{name}: its clearance rho"), rho));
            findings.push((format!("{name}: its frequency eta"), eta));
        }
    }
    findings
}

/// Share of the cells in which one way leads to z = 0 and the other to z = 1.
fn hysteresis(up: &RegimeMap, down: &RegimeMap) -> f64 {
    let is = |cell: &MotionKind, class| cell.class() == class;
    let differ = |(a, b): &(&MotionKind, &MotionKind)| {
        let (zero, one) = (MotionClass::Zero, MotionClass::One);
        (is(a, zero) && is(b, one)) || (is(a, one) && is(b, zero))
    };
    let count = up.cells.iter().zip(&down.cells).filter(differ).count();
    count as f64 / up.cells.len() as f64
}
