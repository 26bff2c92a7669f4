//! The models of a scene with their errors and costs.

use anyhow::anyhow;
use softstop::{Scene, Start};
use softstop_dynamics::models::{
    Answers, FidelityError, Ladder, Likeness, Model, Observation, Quantity, Rung, cheapest,
    from_model, from_truth,
};

use super::cost::{Cost, costs};
use super::word;
use softstop_console::failure::Failure;
use softstop_console::progress::Progress;

/// What is to be compared.
#[derive(Debug, Clone)]
pub(super) struct Task {
    /// Where motions start that are not z = 1.
    pub(super) start: Start,
    pub(super) quantity: Quantity,
    pub(super) likenesses: Vec<Likeness>,
    pub(super) predictive: bool,
    /// Whether bounds of z = 1 are wanted.
    pub(super) bounded: bool,
    pub(super) periods: u64,
    pub(super) repeats: u64,
}

/// A model with what it gives.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub(super) rung: Rung,
    /// What it has in common with the contact; none where that makes no difference.
    pub(super) likeness: Option<Likeness>,
    pub(super) scene: Scene,
    pub(super) answers: Answers,
    /// Error of the quantity that is asked for.
    pub(super) error: Option<f64>,
    pub(super) cost: Cost,
    /// It is the scene itself.
    pub(super) is_truth: bool,
}

/// A rung without a model.
#[derive(Debug, Clone)]
pub(super) struct Missing {
    pub(super) rung: Rung,
    pub(super) likeness: Option<Likeness>,
    pub(super) reason: String,
}

/// All models of a scene.
#[derive(Debug, Clone)]
pub(super) struct Study {
    /// Before-impact velocity in m/s of the scene's motion, if it strikes.
    pub(super) velocity: Option<f64>,
    pub(super) truth: Answers,
    pub(super) entries: Vec<Entry>,
    pub(super) missing: Vec<Missing>,
}

impl Study {
    /// Matches, runs and measures all models.
    pub(super) fn new(truth: &Scene, task: &Task) -> Result<Self, Failure> {
        let observed = Observation::settled(truth, None, task.start).map_err(run)?;
        let answers = Answers::of(truth, observed, task.bounded).map_err(run)?;
        if task.quantity.value(&answers).is_none() {
            return Err(absent(task.quantity));
        }
        let velocity = from_truth(&observed).ok();
        let plan = plan(truth, &task.likenesses);
        let progress = Progress::new(plan.len() as u64, "models");
        let (mut found, mut missing) = (Vec::new(), Vec::new());
        for (rung, likeness) in plan {
            let ladder = Ladder {
                truth: truth.clone(),
                likeness: likeness.unwrap_or_default(),
            };
            match model(&ladder, rung, &observed, task) {
                Ok((model, seen)) => {
                    let answers = Answers::of(&model.scene, seen, task.bounded).map_err(run)?;
                    found.push((rung, likeness, model, answers));
                }
                Err(error) => missing.push(Missing {
                    rung,
                    likeness,
                    reason: error.to_string(),
                }),
            }
            progress.step()?;
        }
        drop(progress);
        let motions = found.iter();
        let motions = motions.map(|(_, _, it, seen)| (it.scene.clone(), seen.observed.start));
        let motions: Vec<(Scene, Start)> = motions.collect();
        let costs = costs(&motions, task.periods, task.repeats)?;
        let entry = |((rung, likeness, model, seen), cost): ((Rung, _, Model, _), Cost)| Entry {
            rung,
            likeness,
            is_truth: rung == Rung::of(truth),
            scene: model.scene,
            answers: seen,
            error: task.quantity.error(&answers, &seen),
            cost,
        };
        Ok(Self {
            velocity,
            truth: answers,
            entries: found.into_iter().zip(costs).map(entry).collect(),
            missing,
        })
    }

    /// The cheapest model within a tolerance; the scene itself always is.
    pub(super) fn cheapest(&self, tolerance: f64) -> Option<&Entry> {
        let models = self.entries.iter();
        let models = models.map(|entry| (entry.error, entry.cost.evaluations_per_period));
        cheapest(&models.collect::<Vec<_>>(), tolerance).map(|place| &self.entries[place])
    }
}

impl Entry {
    /// Its rung and what it has in common with the contact.
    pub(super) fn name(&self) -> String {
        name(self.rung, self.likeness)
    }

    /// The same, and whether it is the scene itself.
    pub(super) fn full_name(&self) -> String {
        let scene = if self.is_truth { " = the scene" } else { "" };
        self.name() + scene
    }
}

/// A model's name in tables and charts.
pub(super) fn name(rung: Rung, likeness: Option<Likeness>) -> String {
    match likeness {
        Some(likeness) => format!("{rung} ({})", word(likeness)),
        None => rung.to_string(),
    }
}

/// The rungs to be tried, soft ones once for each likeness.
fn plan(truth: &Scene, likenesses: &[Likeness]) -> Vec<(Rung, Option<Likeness>)> {
    let ladder = Ladder {
        truth: truth.clone(),
        likeness: Likeness::default(),
    };
    let own = Rung::of(truth);
    let variants = |rung: Rung| {
        let soft = matches!(rung, Rung::KelvinVoigt | Rung::Preloaded | Rung::Hertz);
        if soft && rung != own {
            likenesses.iter().map(|one| (rung, Some(*one))).collect()
        } else {
            vec![(rung, None)]
        }
    };
    ladder.rungs().into_iter().flat_map(variants).collect()
}

fn model(
    ladder: &Ladder,
    rung: Rung,
    observed: &Observation,
    task: &Task,
) -> Result<(Model, Observation), FidelityError> {
    if rung == Rung::of(&ladder.truth) {
        return Ok((ladder.model(rung, f64::NAN)?, *observed));
    }
    if task.predictive {
        return from_model(ladder, rung, task.start);
    }
    let velocity = match rung {
        Rung::Linear => f64::NAN,
        _ => from_truth(observed)?,
    };
    let model = ladder.model(rung, velocity)?;
    let seen = Observation::settled(&model.scene, Some(observed.start), task.start)?;
    Ok((model, seen))
}

fn run(error: impl std::error::Error + Send + Sync + 'static) -> Failure {
    Failure::Run(anyhow!(error))
}

fn absent(quantity: Quantity) -> Failure {
    let name = quantity.name();
    Failure::Run(anyhow!(
        "quantity = {name}: the scene itself has none, so no model can be measured by it"
    ))
}
