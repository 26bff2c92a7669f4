//! Findings on the regimes: shares of the maps, hardest impact on s_SN.

use super::boundaries::Boundaries;
use super::{MAPS, Named};
use crate::figure::Findings;
use softstop_dynamics::motion::{MotionClass, MotionKind};
use softstop_explore::basin::cells::RegimeMap;

/// Shares of the maps, and what the boundaries say.
pub(super) fn of(maps: &[RegimeMap; 6], boundaries: &[Boundaries; 2]) -> Findings {
    let [up, down, _, _, loaded_up, loaded_down] = maps;
    let mut findings = Findings::default();
    for (
        Named {
            machine, finding, ..
        },
        map,
    ) in MAPS.iter().zip(maps)
    {
        for &class in MotionClass::ALL {
            let (name, share) = (class.name(), map.share(class));
            let name = format!("{machine}, {finding}: share of {name}");
            findings.add(name, (share > 0.0).then_some(share));
        }
    }
    let ways = [("unloaded", up, down), ("loaded", loaded_up, loaded_down)];
    for ((name, up, down), own) in ways.into_iter().zip(boundaries) {
        let share = hysteresis(up, down);
        findings.add(format!("{name}: share of z = 1 or z = 0 by the way"), share);
        let point = own.hardest();
        let velocity = point.map(super::boundaries::hardest);
        findings.add(format!("{name}: largest velocity on s_SN"), velocity);
        let [eta, rho] = [0, 1].map(|index: usize| point.map(|at| at.parameters[index]));
        findings.add(format!("{name}: its clearance rho"), rho);
        findings.add(format!("{name}: its frequency eta"), eta);
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
