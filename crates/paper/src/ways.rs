//! Do slow changes of the clearance lead from z = 0 to z = (2/4)B or z = 2/3? The paper (section 4): they "cannot be
//! reached by successive, and quasistationary changes of parameters eta, rho from impact-less (z = 0) motion". Changes
//! of the frequency are in the maps of the regimes.

use anyhow::Result;
use softstop::{Parameter, Ratios};
use softstop_dynamics::{Chain, Direction, Plan, SweepStep};

use crate::diagram;
use crate::figure::{Drawn, Figure, Findings, Studio, evenly_spread};
use softstop_console::columns;
use softstop_console::export::csv;

/// Frequencies: both motions are stable on parts of this range at rho = 10.
const ETAS: (f64, f64, usize) = (0.984, 1.004, 11);
/// From beyond the highest resonance, where z = 0 is all there is, down to the paper's clearance.
const CLEARANCES: (f64, f64) = (10.0, 26.0);
/// Drive periods at each clearance.
const PERIODS: u64 = 100;
/// Steps of the sweeps, from fast to slow.
const STEPS: [usize; 3] = [321, 3201, 32_001];
/// Distance within which a state has returned, in units of the motion's size: more than a step changes.
const RETURN: f64 = 1e-2;
/// Steps in a row for which a motion is shown to count.
const LASTING: usize = 3;

/// The motions that are looked for: name, impacts in each drive period.
const SOUGHT: [(&str, &str); 2] = [("z = 2/3", "1-1-0"), ("z = (2/4)B", "1-1-0-0")];

pub(super) fn draw(studio: &Studio, _: &Figure) -> Result<Drawn> {
    let etas = evenly_spread(ETAS.0, ETAS.1, ETAS.2);
    let mut rows: Vec<WayRow> = Vec::new();
    let mut findings = Findings::default();
    let steps = studio.detail.pick(&STEPS[..], &STEPS[..1]);
    for steps in steps.iter().copied() {
        let plan = Plan {
            tolerance: RETURN,
            heights: false,
            ..Plan::new(Parameter::Clearance, CLEARANCES, steps, PERIODS)?
        };
        let chain = |eta: &f64| -> Result<Chain> {
            let scene = Ratios::unloaded().at_frequency(*eta).scene()?;
            Ok(Chain::new(scene, Direction::Down))
        };
        let chains = etas.iter().map(chain).collect::<Result<_>>()?;
        let chains = diagram::sweep(vec![(plan, chains)], "steps of the ways", studio.kept)?;
        for (name, order) in SOUGHT {
            let shows = |step: &SweepStep| {
                let own = step.motion.order();
                own.is_some_and(|it| it.to_string() == order)
            };
            let (mut met, mut there) = (0, 0);
            for (eta, chain) in etas.iter().zip(&chains) {
                let mut lasting = chain.steps.windows(LASTING);
                let first = lasting.find(|steps| steps.iter().all(shows));
                let first = first.map(|steps| steps[0].value);
                let stays = chain.steps.last().is_some_and(shows);
                met += u32::from(first.is_some());
                there += u32::from(stays);
                rows.push(WayRow {
                    rate: plan.sweep_rate(),
                    eta: *eta,
                    motion: name,
                    first,
                    stays,
                });
            }
            let (rate, ways) = (plan.sweep_rate(), etas.len());
            let told = format!("{name}, {rate:.0e} per period: ways of {ways}");
            findings.add(format!("{told} that meet it"), f64::from(met));
            findings.add(format!("{told} on it at rho = 10"), f64::from(there));
        }
    }
    let columns = columns! { WayRow, it;
        "change_of_rho_per_period" [None], "how fast" => it.rate;
        "eta" [None], "drive frequency" => it.eta;
        "motion" [None], "that is looked for" => it.motion;
        "first_rho" [None], "clearance at which it is met first" => it.first;
        "at_rho_10" [None], "whether the way ends on it" => it.stays;
    };
    Ok(Drawn::new([csv(&columns, rows)?], findings))
}

/// A motion that is looked for along one way.
struct WayRow {
    /// Change of the clearance rho in a drive period.
    rate: f64,
    /// Drive frequency.
    eta: f64,
    motion: &'static str,
    /// Clearance at which it is met first, if it is.
    first: Option<f64>,
    /// True if the way ends on it.
    stays: bool,
}
