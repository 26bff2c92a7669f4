//! A motion of the figure as it was found.

use serde::Serialize;
use softstop::{MotionError, Start};
use softstop_dynamics::attractors::{Attractor, Chaos, Survey};
use softstop_dynamics::orbit::{Orbit, StroboscopicMap};

use super::asked::{Asked, Wanted};
use super::path::Path;
use super::section::Section;

/// Drive periods of the phase trajectory of what does not repeat.
const WANDERING: u64 = 60;

/// A motion and what was asked for.
pub(super) struct Found {
    pub(super) asked: Asked,
    attractor: Attractor,
    /// A state of it at drive angle 0; of transient chaos one from which it lasts.
    start: Start,
    /// States at drive angle 0 from there on.
    pub(super) section: Vec<(f64, f64)>,
    impacts_per_period: f64,
}

/// Columns of the table.
pub(super) const COLUMNS: &str = "motion,eta,eta_is_the_papers,impacts,periods,impacts_per_period,\
    order_of_impacts,largest_multiplier_modulus,lyapunov_exponent_per_period,max_position,\
    before_impact_velocity,mean_life_periods,share_of_starts";

impl Found {
    /// The motion that is asked for, if it is among those found, with so many states of what does not repeat.
    pub(super) fn among(
        asked: Asked,
        survey: &Survey,
        most: u64,
    ) -> Result<Option<Self>, MotionError> {
        let fits = |attractor: &&Attractor| match (asked.motion, attractor.motion.order()) {
            (Wanted::Impacts(wanted), Some(order)) => order.to_string() == wanted,
            (Wanted::Chaos, None) => attractor.motion.is_chaotic(),
            _ => false,
        };
        let Some(attractor) = survey.attractors.iter().find(fits).cloned() else {
            return Ok(None);
        };
        let map = StroboscopicMap::new(&asked.scene()?, 1)?;
        let start = attractor.state;
        let (start, section) = match attractor.motion.periods() {
            Some(periods) => (start, Section::periodic(&map, start, periods)?),
            None => Section::lasting(&map, start, most)?,
        };
        Ok(Some(Self {
            asked,
            attractor,
            start,
            impacts_per_period: section.impacts_per_period(),
            section: section.states,
        }))
    }

    fn orbit(&self) -> Option<&Orbit> {
        self.attractor.orbit.as_deref()
    }

    fn chaos(&self) -> Option<&Chaos> {
        self.attractor.chaos.as_ref()
    }

    fn lifetime(&self) -> Option<f64> {
        self.chaos()?.lifetime
    }

    pub(super) fn is_chaotic(&self) -> bool {
        self.orbit().is_none()
    }

    /// Drive periods after which it repeats.
    pub(super) fn period(&self) -> Option<u64> {
        self.orbit().map(|orbit| orbit.periods)
    }

    /// Drive periods of its phase trajectory.
    pub(super) fn repeats(&self) -> u64 {
        self.period().unwrap_or(WANDERING)
    }

    /// The motion over drive periods, with so many points in each.
    pub(super) fn path(&self, periods: u64, fineness: u32) -> Result<Path, MotionError> {
        Path::of(&self.asked.scene()?, self.start, periods, fineness)
    }

    fn exponent(&self) -> f64 {
        let exponents = self.attractor.exponents;
        exponents.map_or(f64::NAN, |exponents| exponents.per_period[0])
    }

    fn modulus(&self) -> Option<f64> {
        self.orbit().map(|orbit| orbit.multipliers()[0].norm())
    }

    /// Frequency, regime and how stable it is.
    pub(super) fn title(&self) -> String {
        let eta = format!("η = {}", self.asked.frequency);
        let Some(orbit) = self.orbit() else {
            return format!(
                "{eta} · {}, z = {:.3}, λ = {:+.3}/T",
                self.attractor.motion,
                self.impacts_per_period,
                self.exponent()
            );
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
        format!("{eta} · z = {regime}{order}, |μ| = {modulus:.3}")
    }

    /// What else there is to say.
    pub(super) fn remark(&self) -> String {
        let ours = if self.asked.is_given {
            ""
        } else {
            "η chosen here"
        };
        let life = self.lifetime().map(|periods| {
            let hundreds = 100.0 * (periods / 100.0).round();
            format!("mean life {hundreds} T")
        });
        let parts = [ours, self.asked.remark].map(str::to_owned);
        let said: Vec<String> = parts
            .into_iter()
            .chain(life)
            .filter(|part| !part.is_empty())
            .collect();
        said.join("; ")
    }

    /// A row of the table.
    pub(super) fn line(&self) -> impl Serialize {
        let orbit = self.orbit();
        let chaos = self.chaos();
        let hardest = chaos.and_then(|chaos| chaos.velocities).map(|ends| ends[1]);
        let velocity = orbit.map(Orbit::before_impact_velocity);
        (
            self.asked.letter,
            self.asked.frequency,
            self.asked.is_given,
            orbit.map(|orbit| orbit.impacts.len()),
            self.period(),
            self.impacts_per_period,
            orbit.map_or_else(String::new, |orbit| orbit.pattern().to_string()),
            self.modulus(),
            self.exponent(),
            orbit.map(|orbit| orbit.max_position),
            velocity.or(hardest),
            self.lifetime(),
            self.attractor.share,
        )
    }

    pub(super) fn findings(&self) -> Vec<(String, f64)> {
        let name = |what: &str| format!("({}) {what}", self.asked.letter);
        let mut findings = vec![
            (name("eta"), self.asked.frequency),
            (name("Lyapunov exponent per period"), self.exponent()),
            (name("share of starts"), self.attractor.share),
        ];
        match self.orbit() {
            Some(orbit) => findings.extend([
                (name("impacts p"), orbit.impacts.len() as f64),
                (name("periods n"), orbit.periods as f64),
            ]),
            None => findings.push((name("impacts per period"), self.impacts_per_period)),
        }
        let modulus = self.modulus();
        findings.extend(modulus.map(|modulus| (name("largest multiplier, modulus"), modulus)));
        let lifetime = self.lifetime();
        findings.extend(lifetime.map(|periods| (name("mean life, periods"), periods)));
        findings
    }
}
