//! The models of a scene with their errors and costs.

use std::fmt;
use std::time::Instant;

use super::models::{
    ContactLaw, FidelityError, MatchedProperty, ModelHierarchy, ObservedFigures, cheapest,
    from_model, from_truth,
};
use anyhow::{Context, anyhow};
use softstop::internals::Evaluations;
use softstop::{Clock, Machine, MotionError, Scene, Start};

use super::FidelityArguments;
use softstop_console::failure::Failure;
use softstop_console::median::median;
use softstop_console::progress::Progress;

/// A model by its law and by what it has in common with the contact, nothing where that makes no difference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ModelName {
    pub(super) rung: ContactLaw,
    pub(super) matched: Option<MatchedProperty>,
}

impl ModelName {
    /// What it has in common with the contact, in a word.
    pub(super) fn word(self) -> Option<&'static str> {
        self.matched.map(|likeness| match likeness {
            MatchedProperty::Penetration => "penetration",
            MatchedProperty::Duration => "duration",
        })
    }
}

impl fmt::Display for ModelName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.word() {
            Some(word) => write!(formatter, "{} ({word})", self.rung),
            None => self.rung.fmt(formatter),
        }
    }
}

/// A model with what it gives.
#[derive(Debug, Clone)]
pub(super) struct ModelEntry {
    pub(super) name: ModelName,
    pub(super) scene: Scene,
    pub(super) answers: ObservedFigures,
    /// Error of the quantity that is asked for.
    pub(super) error: Option<f64>,
    /// Evaluations of the law of force in a drive period of its settled motion: the same on every machine.
    pub(super) evaluations_per_period: f64,
    /// Median time of such a period.
    pub(super) microseconds_per_period: f64,
    /// It is the scene itself.
    pub(super) is_truth: bool,
}

/// All models of a scene.
#[derive(Debug, Clone)]
pub(super) struct ModelComparison {
    /// Before-impact velocity in m/s of the scene's motion, if it strikes.
    pub(super) velocity: Option<f64>,
    pub(super) truth: ObservedFigures,
    pub(super) entries: Vec<ModelEntry>,
    /// Those without a model, and why.
    pub(super) unmatched: Vec<(ModelName, String)>,
}

impl ModelComparison {
    /// Matches, runs and measures all models.
    pub(super) fn new(machine: &Machine, arguments: &FidelityArguments) -> Result<Self, Failure> {
        let (truth, quantity) = (&machine.scene, arguments.quantity);
        let is_bounded = arguments.structure || quantity.is_bound();
        let bounded = |scene: &Scene, seen: ObservedFigures| match is_bounded {
            true => seen.with_bounds(scene).map_err(run),
            false => Ok(seen),
        };
        let observed = ObservedFigures::settled(truth, None, machine.start).map_err(run)?;
        let answers = bounded(truth, observed)?;
        if answers.value(quantity).is_none() {
            return Err(Failure::Run(anyhow!(
                "quantity = {}: the scene itself has none, so no model can be measured by it",
                quantity.name()
            )));
        }
        let plan = plan(truth, arguments.matched.likenesses());
        let progress = Progress::new(plan.len() as u64, "models");
        let mut study = Self {
            velocity: from_truth(&observed).ok(),
            truth: answers,
            entries: Vec::new(),
            unmatched: Vec::new(),
        };
        for name in plan {
            match model(truth, name, &observed, machine.start, arguments.predictive) {
                Ok((scene, seen)) => {
                    let answers = bounded(&scene, seen)?;
                    study.entries.push(ModelEntry {
                        name,
                        is_truth: name.rung == ContactLaw::of(truth),
                        scene,
                        error: study.truth.error(&answers, quantity),
                        answers,
                        evaluations_per_period: f64::NAN,
                        microseconds_per_period: f64::NAN,
                    });
                }
                Err(error) => study.unmatched.push((name, error.to_string())),
            }
            progress.step()?;
        }
        drop(progress);
        study.measure_costs(arguments)?;
        Ok(study)
    }

    /// Measures the costs of the motions, timed turn and turn about, so that what else the machine does meanwhile falls on
    /// all of them.
    fn measure_costs(&mut self, arguments: &FidelityArguments) -> Result<(), Failure> {
        let (periods, repeats) = (arguments.periods, arguments.repeats);
        let progress = Progress::new(self.entries.len() as u64 * repeats, "runs");
        let mut times = vec![Vec::new(); self.entries.len()];
        for _ in 0..repeats {
            for (entry, times) in self.entries.iter_mut().zip(&mut times) {
                let begin = Instant::now();
                let start = entry.answers.start;
                let taken =
                    evaluated(&entry.scene, start, periods).context("cannot time a motion")?;
                times.push(1e6 * begin.elapsed().as_secs_f64() / periods as f64);
                entry.evaluations_per_period = taken.evaluations as f64 / periods as f64;
                progress.step()?;
            }
        }
        for (entry, times) in self.entries.iter_mut().zip(times) {
            entry.microseconds_per_period = median(times);
        }
        Ok(())
    }

    /// The cheapest model within a tolerance; the scene itself always is.
    pub(super) fn cheapest(&self, tolerance: f64) -> Option<&ModelEntry> {
        let models = self.entries.iter();
        let models = models.map(|entry| (entry.error, entry.evaluations_per_period));
        cheapest(&models.collect::<Vec<_>>(), tolerance).map(|place| &self.entries[place])
    }
}

impl ModelEntry {
    /// Its name, and whether it is the scene itself.
    pub(super) fn full_name(&self) -> String {
        let scene = if self.is_truth { " = the scene" } else { "" };
        format!("{}{scene}", self.name)
    }
}

/// The rungs to be tried, soft ones once for each likeness.
fn plan(truth: &Scene, likenesses: &[MatchedProperty]) -> Vec<ModelName> {
    let ladder = ModelHierarchy {
        truth: truth.clone(),
        likeness: MatchedProperty::default(),
    };
    let own = ContactLaw::of(truth);
    let variants = |rung: ContactLaw| {
        let soft = matches!(
            rung,
            ContactLaw::KelvinVoigt | ContactLaw::Preloaded | ContactLaw::Hertz
        );
        let matched: Vec<Option<MatchedProperty>> = match soft && rung != own {
            true => likenesses.iter().copied().map(Some).collect(),
            false => vec![None],
        };
        matched
            .into_iter()
            .map(move |matched| ModelName { rung, matched })
    };
    ladder.rungs().into_iter().flat_map(variants).collect()
}

fn model(
    truth: &Scene,
    ModelName { rung, matched }: ModelName,
    observed: &ObservedFigures,
    start: Start,
    is_predictive: bool,
) -> Result<(Scene, ObservedFigures), FidelityError> {
    let ladder = ModelHierarchy {
        truth: truth.clone(),
        likeness: matched.unwrap_or_default(),
    };
    if rung == ContactLaw::of(truth) {
        return Ok((ladder.model(rung, f64::NAN)?, *observed));
    }
    if is_predictive {
        return from_model(&ladder, rung, start);
    }
    let velocity = match rung {
        ContactLaw::Linear => f64::NAN,
        _ => from_truth(observed)?,
    };
    let model = ladder.model(rung, velocity)?;
    let seen = ObservedFigures::settled(&model, Some(observed.start), start)?;
    Ok((model, seen))
}

fn run(error: impl std::error::Error + Send + Sync + 'static) -> Failure {
    Failure::Run(anyhow!(error))
}

fn evaluated(scene: &Scene, start: Start, periods: u64) -> Result<Evaluations, MotionError> {
    let mut motion = scene.motion(start)?;
    let mut taken = Evaluations::default();
    motion.advance(Clock::at_cycle(periods), &mut taken)?;
    motion.tell_arc(&mut taken);
    Ok(taken)
}
