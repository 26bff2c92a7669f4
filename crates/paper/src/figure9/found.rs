//! A motion of the figure as it was found.

use anyhow::Result;
use softstop::{Ratios, Scene};
use softstop_console::column::Column;
use softstop_console::columns;
use softstop_dynamics::attractors::Attractor;
use softstop_dynamics::motion_kind::MotionClass;
use softstop_dynamics::{Orbit, StroboscopicMap, Survey};

use super::WantedMotion;
use super::section::Section;
use crate::figure::{Findings, findings};
use crate::path::{Path, PathPoint};

/// Drive periods of the phase trajectory of what does not repeat.
const WANDERING: u64 = 60;
/// Drive periods over which its energy is taken, and points in each.
const ENERGY: (u64, (u32, u32)) = (2000, (400, 8));

/// A motion and what was asked for.
pub struct FoundMotion {
    pub asked: WantedMotion,
    pub scene: Scene,
    attractor: Attractor,
    /// Its states; of transient chaos those from a start on from which it lasts.
    pub section: Section,
}

/// A row for each motion; numbers that are findings are shown.
pub fn columns() -> [Column<FoundMotion>; 13] {
    columns! { FoundMotion, it;
        "motion" [None], "its letter" => it.asked.letter.to_string();
        "eta" [None] Plain, "eta" => it.asked.eta;
        "eta_is_the_papers" [None], "whether the paper gives it" => it.asked.is_given;
        "impacts" [None] Plain, "impacts p" => it.orbit().map(|orbit| orbit.impacts.len());
        "periods" [None] Plain, "periods n" => it.period();
        "impacts_per_period" [None], "mean per drive period" => it.section.impacts_per_period();
        "order_of_impacts" [None], "in each drive period" => it.orbit().map(|orbit| orbit.pattern().to_string());
        "largest_multiplier_modulus" [None] Plain, "largest multiplier, modulus" => it.modulus();
        "lyapunov_exponent_per_period" [None] Plain, "Lyapunov exponent per period" => it.exponent();
        "max_position" [None], "largest position" => it.orbit().map(|orbit| orbit.max_position);
        "before_impact_velocity" [None], "of the hardest impact" => it.velocity();
        "mean_life_periods" [None] Plain, "mean life, periods" => it.lifetime();
        "share_of_starts" [None] Plain, "share of starts" => it.attractor.share;
    }
}

impl FoundMotion {
    /// The motion that is asked for, if it is among those found, with so many states of what does not repeat.
    pub fn among(asked: &WantedMotion, survey: &Survey, most: u64) -> Result<Option<Self>> {
        let fits = |attractor: &&Attractor| match (&asked.impacts, attractor.motion.order()) {
            (Some(wanted), Some(order)) => order.to_string() == *wanted,
            (None, None) => attractor.motion.is_chaotic(),
            _ => false,
        };
        let Some(attractor) = survey.attractors.iter().find(fits).cloned() else {
            return Ok(None);
        };
        let scene = Ratios::unloaded().at_frequency(asked.eta).scene()?;
        let map = StroboscopicMap::new(&scene.check()?, 1);
        let section = match attractor.motion.periods() {
            Some(periods) => Section::of(&map, attractor.state, periods, usize::MAX)?,
            None => Section::lasting(&map, attractor.state, most)?,
        };
        Ok(Some(Self {
            asked: asked.clone(),
            scene,
            attractor,
            section,
        }))
    }

    fn orbit(&self) -> Option<&Orbit> {
        self.attractor.orbit.as_deref()
    }

    fn lifetime(&self) -> Option<f64> {
        self.attractor.chaos.as_ref()?.lifetime
    }

    /// What tells its colour.
    pub fn class(&self) -> MotionClass {
        self.attractor.motion.class()
    }

    pub fn is_chaotic(&self) -> bool {
        self.orbit().is_none()
    }

    /// Drive periods after which it repeats.
    pub fn period(&self) -> Option<u64> {
        self.orbit().map(|orbit| orbit.periods)
    }

    /// The motion over drive periods, as [`Path::new`] has it; unless said otherwise until it repeats.
    pub fn path(&self, periods: Option<u64>, fineness: (u32, u32)) -> Result<Path> {
        let periods = periods.or(self.period()).unwrap_or(WANDERING);
        Ok(Path::new(
            &self.scene,
            self.section.start,
            periods,
            fineness,
        )?)
    }

    fn exponent(&self) -> f64 {
        let exponents = self.attractor.exponents;
        exponents.map_or(f64::NAN, |exponents| exponents.per_period[0])
    }

    fn modulus(&self) -> Option<f64> {
        Some(self.orbit()?.monodromy.multipliers()[0].norm())
    }

    /// Frequency, regime and how stable it is.
    pub fn title(&self) -> String {
        let (eta, motion) = (self.asked.eta, &self.attractor.motion);
        let Some(orbit) = self.orbit() else {
            let (z, exponent) = (self.section.impacts_per_period(), self.exponent());
            return format!("η = {eta} · {motion}, z = {z:.3}, λ = {exponent:+.3}/T");
        };
        let modulus = self.modulus().unwrap_or(0.0);
        let order = match orbit.periods {
            2..=6 => format!(", impacts {}", orbit.pattern()),
            _ => String::new(),
        };
        let regime = match orbit.impacts.len() {
            0 => "0".to_owned(),
            _ => orbit.regime().to_string(),
        };
        format!("η = {eta} · z = {regime}{order}, |μ| = {modulus:.3}")
    }

    /// What else there is to say.
    pub fn remark(&self) -> String {
        let ours = (!self.asked.is_given).then(|| "η chosen here".to_owned());
        let life = self.lifetime().map(|periods| {
            let hundreds = 100.0 * (periods / 100.0).round();
            format!("mean life {hundreds} T")
        });
        let parts = [ours, Some(self.asked.remark.clone()), life];
        let mut said: Vec<String> = parts.into_iter().flatten().collect();
        said.retain(|part| !part.is_empty());
        said.join("; ")
    }

    fn velocity(&self) -> Option<f64> {
        let chaos = self.attractor.chaos.as_ref();
        let hardest = || chaos.and_then(|it| it.velocities).map(|ends| ends[1]);
        let orbit = self.orbit().map(Orbit::before_impact_velocity);
        orbit.or_else(hardest)
    }

    /// The kinetic energy in units of F0^2/k1: its mean over time, and the largest.
    fn kinetic(&self) -> Result<[f64; 2]> {
        let path = self.path(Some(self.period().unwrap_or(ENERGY.0)), ENERGY.1)?;
        let period = self.scene.period();
        let energy = |at: &PathPoint| 0.5 * at.velocity * at.velocity;
        let time = |at: &PathPoint| at.time / period;
        let pieces = path.points.windows(2);
        let pieces = pieces.map(|two| {
            f64::midpoint(energy(&two[0]), energy(&two[1])) * (time(&two[1]) - time(&two[0]))
        });
        let time = path.points.last().map_or(1.0, time);
        let largest = path.points.iter().map(energy).fold(0.0, f64::max);
        Ok([pieces.sum::<f64>() / time, largest])
    }

    /// What is told of it.
    pub fn tell(&self, findings: &mut Findings) -> Result<()> {
        let [energy, largest] = self.kinetic()?;
        let mean = self.section.impacts_per_period();
        let group = format!("({}) ", self.asked.letter);
        findings! { findings, |what| format!("{group}{what}");
            "impacts per period" => self.is_chaotic().then_some(mean);
            "mean kinetic energy" => energy;
            "largest kinetic energy" => largest;
        }
        findings.add_numbers(&group, &columns(), self);
        Ok(())
    }
}
