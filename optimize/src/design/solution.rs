//! The design of a task with what stands beside it: the task without tolerances, and trade-offs. Each of them may meet a better
//! design; the search goes on from that until none does. So none of them contradicts the design.

use softstop_console::interrupt;
use softstop_dynamics::monitor::OptionalMemory;
use softstop_dynamics::parallel;

use super::coordinates::{Candidate, best_by};
use super::figure::Figure;
use super::front::{Front, beats, front};
use super::pareto::Pareto;
use super::requirement::Scope;
use super::search::{
    SearchError, SearchMonitor, SearchResult, SearchSettings, Unmonitored, search_from,
};
use super::share::search_with_share;
use super::{Design, Problem};

/// What is traded for what is sought.
const TRADED: [Figure; 5] = [
    Figure::Share,
    Figure::Certainty,
    Figure::StopForce,
    Figure::DriveForce,
    Figure::DrivePower,
];

/// How often the search goes on from what was met beside it.
const ROUNDS: usize = 8;

/// What is looked at beside the search.
#[derive(Debug, Clone, Copy, Default)]
pub struct SideTasks {
    /// The task without tolerances.
    pub relaxed: bool,
    /// What more of one good costs of another.
    pub fronts: bool,
    /// Machines by which the share is judged that violates a requirement, if there are normal tolerances.
    pub machines: usize,
}

/// The design of a task and what stands beside it.
#[derive(Debug, Clone)]
pub struct Solution {
    /// The design.
    pub found: SearchResult,
    /// Standard deviations of normal tolerances that it keeps.
    pub deviations: f64,
    /// False if a search for a design that keeps fewer of them was interrupted.
    pub is_settled: bool,
    /// The best design if nothing has a tolerance and nothing is tried.
    pub relaxed: Option<Design>,
    /// What more of one good costs of another, where it costs something.
    pub fronts: Vec<Front>,
    /// Trade-offs of which there is none, each with the reason, in words.
    pub missing: Vec<String>,
    /// The designs among which one can choose, if more than one thing is sought; the first of them is the design.
    pub pareto: Option<Pareto>,
}

impl Problem {
    /// The problem without tolerances and trials: every design of the whole problem is one of this.
    #[must_use]
    pub fn relaxed(&self) -> Self {
        let mut relaxed = Self {
            tolerances: Vec::new(),
            ..self.clone()
        };
        relaxed.objective.scope = Scope::Drawing;
        relaxed.requirements.retain(|it| !it.figure.is_trial());
        relaxed
    }
}

impl Solution {
    /// The problem whose design it is: with the deviations that it keeps, on its range of the zone.
    pub fn problem(&self, stated: &Problem) -> Problem {
        stated
            .with_deviations(self.deviations)
            .on_range_of(&self.found.design)
    }

    /// Searches, looks beside, and goes on from what is better there.
    ///
    /// # Errors
    /// As [`search`](super::search::search).
    pub fn of(
        problem: &Problem,
        settings: SearchSettings,
        beside: SideTasks,
        (watch, kept): (&dyn SearchMonitor, OptionalMemory<'_>),
    ) -> Result<Self, SearchError> {
        let (mut found, deviations, is_settled) =
            search_with_share(problem, (settings, beside.machines), (watch, kept))?;
        let problem = &problem.with_deviations(deviations);
        let relaxed_problem = problem.relaxed();
        let mut relaxed = None;
        if beside.relaxed && !interrupt::requested() {
            let starts = [found.start()];
            relaxed = search_from(&relaxed_problem, settings, &starts, (&Unmonitored, None)).ok();
        }
        // Another design has another share of machines that violate a requirement, in a box of the same width.
        let is_rejected = |found: &SearchResult| {
            problem.has_normal_tolerances()
                && problem.as_built().rejected(&found.design, beside.machines) > problem.violating
        };
        let go_on = |found: &mut SearchResult, better: &Candidate| {
            let before = problem.has_normal_tolerances().then(|| found.clone());
            let is_better = found.go_on_from(problem, better);
            match before {
                Some(before) if is_better && is_rejected(found) => {
                    *found = before;
                    false
                }
                _ => is_better,
            }
        };
        if let Some(relaxed) = &relaxed {
            go_on(&mut found, &relaxed.candidate());
        }
        let pareto = match problem.traded.is_empty() {
            true => None,
            false => Some(Pareto::search(problem, &found, (settings, watch))?),
        };
        let best = pareto.as_ref().and_then(|it| it.points.first());
        if let Some(best) = best.filter(|it| !is_rejected(&it.found)) {
            found.take_design(problem, &best.found);
        }
        let (mut fronts, mut missing) = (Vec::new(), Vec::new());
        for _ in 0..ROUNDS {
            if !beside.fronts || interrupt::requested() {
                break;
            }
            let traded;
            (traded, missing) = self::traded(problem, &found);
            let (traded, better): (Vec<Front>, Vec<_>) = traded.into_iter().unzip();
            let better = best_by(better.into_iter().flatten(), |it| problem.score(&it.design));
            fronts = traded;
            if !better.is_some_and(|better| go_on(&mut found, &better)) {
                break;
            }
        }
        if let Some(relaxed) = &mut relaxed {
            relaxed.go_on_from(&relaxed_problem, &found.candidate());
        }
        for front in &mut fronts {
            let (figure, own) = (front.figure, front.design);
            front.points.retain(|it| !beats(problem, figure, *it, own));
        }
        fronts.retain(|it| it.points.len() > 1 || it.left_out > 0);
        let pareto = pareto.map(|it| it.with(problem, &found));
        Ok(Self {
            pareto,
            found,
            deviations,
            is_settled,
            relaxed: relaxed.map(|it| it.design),
            fronts,
            missing,
        })
    }
}

/// All trade-offs of a design, and those of which there is none, each with the reason.
fn traded(
    problem: &Problem,
    found: &SearchResult,
) -> (Vec<(Front, Option<Candidate>)>, Vec<String>) {
    let problem = &problem.on_range_of(&found.design);
    let figures = TRADED.iter().filter(|it| **it != problem.objective.figure);
    let figures: Vec<&Figure> = figures.collect();
    let traded = parallel::map(&figures, |figure| front(problem, found, **figure));
    let (mut fronts, mut missing) = (Vec::new(), Vec::new());
    for (traded, figure) in traded.into_iter().zip(figures) {
        match traded {
            Ok(front) => fronts.push(front),
            Err(why) => missing.extend(why.map(|why| {
                let name = figure.name();
                format!("the trade-off with {name}: {why}")
            })),
        }
    }
    (fronts, missing)
}
