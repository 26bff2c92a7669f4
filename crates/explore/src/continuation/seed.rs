//! The orbit to start from.

use anyhow::{Error, anyhow};
use nalgebra::Vector2;
use softstop::Scene;
use softstop_dynamics::attractors::{SearchOptions, find_attractors_until};
use softstop_dynamics::{MotionKind, Orbit, Regime, orbit, zone};

use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::progress::Progress;

/// Reads a regime p/n.
///
/// # Errors
/// What is allowed.
pub fn regime(text: &str) -> Result<Regime, String> {
    let (impacts, periods) = text.split_once('/').unwrap_or((text, "1"));
    let number = |text: &str| text.trim().parse::<u64>().ok();
    match (number(impacts), number(periods)) {
        (Some(impacts), Some(periods)) if (1..=LONGEST).contains(&periods) => {
            Ok(Regime { impacts, periods })
        }
        _ => Err(format!(
            "must be p/n: p impacts in n drive periods, n from 1 to {LONGEST}"
        )),
    }
}

/// Most drive periods of an orbit.
pub const LONGEST: u64 = 64;

/// A state X,V.
///
/// # Errors
/// What is allowed.
pub fn state(text: &str) -> Result<Vector2<f64>, String> {
    let numbers = text.split_once(',').and_then(|(x, v)| {
        let number = |text: &str| text.trim().parse::<f64>().ok();
        Some(Vector2::new(number(x)?, number(v)?))
    });
    numbers
        .filter(|state| state.iter().all(|part| part.is_finite()))
        .ok_or_else(|| "must be X,V: two finite numbers".to_owned())
}

/// A stable orbit of this regime. Of 1/1 the one with the hardest impact that shows at the frequency of the drive, or else on
/// branches that lead there from other frequencies; of others the first that motions from starts far and wide settle on, or else
/// the one to which most starts about these motions lead.
pub fn find(scene: &Scene, wanted: Regime) -> Result<Orbit, Failure> {
    if wanted == Regime::ONE
        && let Ok(orbit) = orbit::find_with_monitor(scene, &interrupt::watch)
            .or_else(|_| zone::find_with_monitor(scene, &interrupt::watch))
    {
        return Ok(orbit);
    }
    let options = SearchOptions {
        longest: LONGEST as usize,
        ..SearchOptions::default()
    };
    let bar = Progress::new(1, "drive periods at most, in search of the orbit");
    let is_enough = |orbit: &Orbit| MotionKind::of(orbit).regime() == Some(wanted);
    let survey = find_attractors_until(scene, &options, is_enough, &|done, planned| {
        bar.at_of(done, planned);
        interrupt::go_on()
    });
    drop(bar);
    let survey = survey.map_err(Error::from)?;
    let mut others = Vec::new();
    for attractor in survey.attractors {
        match attractor.orbit {
            Some(orbit) if is_enough(&orbit) => return Ok(*orbit),
            _ => others.push(attractor.motion.to_string()),
        }
    }
    Err(Failure::Run(anyhow!(
        "no stable z = {}/{} motion found to start from; found: {}. Start from another machine, ask for one of \
         these with --orbit p/n, or give a state with --state",
        wanted.impacts,
        wanted.periods,
        others.join(", ")
    )))
}
