//! The search of a front: the best design by each objective alone, then the best by one of them with bounds of the others (the
//! epsilon-constraint method, Haimes, Lasdon and Wismer 1971). Of two objectives one is bounded in the middle of the widest gap
//! between designs, of more all but the first on a lattice, then one in the middle of the widest gaps. A problem whose solution
//! follows from a looser one is not searched (Mavrotas 2009).

use softstop_dynamics::parallel;

use super::pareto::{Alternative, FrontTally, Pareto, undominated};
use super::posed::{FrontProblem, Ranges, levels};
use super::problem::{Objective, Problem};
use super::search::{
    LEAST_EVALUATIONS, QuietMonitor, SearchError, SearchMonitor, SearchResult, SearchSettings,
    search_from,
};
use crate::order::sort_rising;

/// Problems in gaps between designs of two objectives and, beside a lattice, of more; those of them that are solved at once.
const PROBLEMS: usize = 14;
const PROBLEMS_BESIDE_LATTICE: usize = 12;
const AT_ONCE: usize = 2;
/// Share of the evaluations of a search that each problem with bounds may take: its neighbours are solved.
const SHARE: u64 = 4;
/// Neighbours from which a problem starts.
const NEIGHBOURS: usize = 3;
/// Relative difference of a value that is none.
const ROUNDING: f64 = 1e-9;

/// A problem of a front with its solution.
#[derive(Debug, Clone)]
struct SolvedProblem {
    posed: FrontProblem,
    alternative: Alternative,
}

impl Pareto {
    /// Searches the designs of a front from the best one by the first objective on; an interrupted one has those that are
    /// found by then.
    ///
    /// # Errors
    /// [`SearchError`] if no design has one of the objectives.
    pub fn search(
        problem: &Problem,
        first: &SearchResult,
        (settings, watch): (SearchSettings, &dyn SearchMonitor),
    ) -> Result<Self, SearchError> {
        let objectives = problem.objectives();
        let mut search = ParetoSearch {
            problem,
            objectives: &objectives,
            settings,
            watch,
            ranges: Ranges::default(),
            solved: Vec::new(),
            failed: Vec::new(),
            tally: FrontTally::default(),
        };
        search.find_anchors(first)?;
        search.refine_anchors();
        match objectives.len() {
            2 => search.fill_gaps(PROBLEMS, |ranges, points, all| {
                ranges.widest_gaps(points, all)
            }),
            _ => {
                search.solve_lattice();
                search.fill_gaps(PROBLEMS_BESIDE_LATTICE, |ranges, points, all| {
                    ranges.widest_marginal_gaps(&points, all)
                });
            }
        }
        search.exchange();
        let (solved, tally) = (search.solved.into_iter(), search.tally);
        let points: Vec<Alternative> = solved.map(|it| it.alternative).collect();
        let solved = points.len();
        Ok(Self::new(
            objectives,
            points,
            FrontTally { solved, ..tally },
        ))
    }
}

/// The search of a front.
struct ParetoSearch<'a> {
    problem: &'a Problem,
    objectives: &'a [Objective],
    settings: SearchSettings,
    watch: &'a dyn SearchMonitor,
    ranges: Ranges,
    solved: Vec<SolvedProblem>,
    /// Problems without a design.
    failed: Vec<FrontProblem>,
    tally: FrontTally,
}

impl ParetoSearch<'_> {
    /// The best design by each objective alone.
    fn find_anchors(&mut self, first: &SearchResult) -> Result<(), SearchError> {
        let count = self.objectives.len();
        self.tally.problems = 2 * count
            + match count {
                2 => PROBLEMS,
                _ => (levels(count) + 1).pow(count as u32 - 1) - 1 + PROBLEMS_BESIDE_LATTICE,
            };
        let alone = |objective| FrontProblem {
            objective,
            bounds: vec![None; count],
        };
        self.keep(alone(0), first);
        for index in 1..count {
            let problem = self.problem_of(&alone(index));
            let starts = [first.start()];
            let quiet = QuietMonitor(self.watch);
            let found = match search_from(&problem, self.settings, &starts, (&quiet, None)) {
                Ok(found) => found,
                Err(SearchError::Stopped(_)) => break,
                Err(SearchError::NoDesign { .. }) => {
                    self.fail(alone(index));
                    continue;
                }
                Err(error) => return Err(error),
            };
            self.keep(alone(index), &found);
            self.tell();
        }
        self.ranges = Ranges((0..count).map(|index| self.range(index)).collect());
        Ok(())
    }

    /// The best designs by another objective among those that are best by each, of which there may be many.
    fn refine_anchors(&mut self) {
        let count = self.objectives.len();
        let at_best = |index: usize| FrontProblem {
            objective: usize::from(index == 0),
            ..FrontProblem::of_bound(count, index, self.ranges.0[index][1])
        };
        self.solve_all((0..count).map(at_best).collect());
    }

    fn range(&self, index: usize) -> [f64; 2] {
        let objective = &self.objectives[index];
        let values = self.solved.iter().map(|it| it.alternative.values[index]);
        let by_grade = |a: &f64, b: &f64| objective.graded(*a).total_cmp(&objective.graded(*b));
        let worst = values.clone().min_by(by_grade).unwrap_or(f64::NAN);
        [worst, values.max_by(by_grade).unwrap_or(f64::NAN)]
    }

    fn tell(&self) {
        let done = self.solved.len() + self.failed.len() + self.tally.implied;
        self.watch.posed(done as u64, self.tally.problems as u64);
    }

    /// Takes note of a solution.
    fn keep(&mut self, posed: FrontProblem, found: &SearchResult) {
        match Alternative::new(self.problem, self.objectives, found) {
            Some(alternative) => self.solved.push(SolvedProblem { posed, alternative }),
            None => self.fail(posed),
        }
    }

    fn fail(&mut self, posed: FrontProblem) {
        self.tally.failed += 1;
        self.failed.push(posed);
    }

    /// The best designs by one objective with a bound of another one in the middle of the widest gaps between designs, so many at
    /// most.
    fn fill_gaps(
        &mut self,
        most: usize,
        widest_gaps: impl Fn(&Ranges, Vec<Vec<f64>>, &[FrontProblem]) -> Vec<FrontProblem>,
    ) {
        let mut all: Vec<FrontProblem> = Vec::new();
        while all.len() < most && !self.watch.stop() {
            let mut next = widest_gaps(&self.ranges, self.undominated(), &all);
            next.truncate(AT_ONCE.min(most - all.len()));
            if next.is_empty() {
                break;
            }
            all.extend(next.iter().cloned());
            self.solve_all(next);
        }
        if !self.watch.stop() {
            self.tally.problems -= most - all.len();
        }
    }

    /// The values of the designs that no other one dominates.
    fn undominated(&self) -> Vec<Vec<f64>> {
        let all = self.solved.iter().map(|it| &it.alternative);
        let members = undominated(all, self.objectives).members.into_iter();
        let values = members.map(|index| self.solved[index].alternative.values.clone());
        values.collect()
    }

    /// The best designs by the first objective with so many bounds of each other one, the loosest first: those of one sum of
    /// levels do not depend on each other.
    fn solve_lattice(&mut self) {
        let sums = self.ranges.lattice();
        for posed in sums {
            if !self.watch.stop() {
                self.solve_all(posed);
            }
        }
    }

    /// Solves problems that do not depend on each other.
    fn solve_all(&mut self, all: Vec<FrontProblem>) {
        let (implied, posed): (Vec<_>, Vec<_>) =
            all.into_iter().partition(|it| self.is_implied(it));
        self.tally.implied += implied.len();
        let found = parallel::map(&posed, |it| self.solve(it));
        for (posed, found) in posed.into_iter().zip(found) {
            match found {
                Ok(found) => self.keep(posed, &found),
                Err(SearchError::Stopped(_)) => return,
                Err(_)
                    if self
                        .solved
                        .iter()
                        .any(|it| self.keeps(&it.alternative, &posed)) =>
                {
                    self.tally.failed += 1;
                }
                Err(_) => self.fail(posed),
            }
        }
        self.tell();
    }

    /// Whether the solution of a looser problem keeps these bounds, or that has none.
    fn is_implied(&self, posed: &FrontProblem) -> bool {
        let is_looser = |other: &FrontProblem| {
            let pairs = other.bounds.iter().zip(&posed.bounds);
            let mut pairs = pairs.zip(self.objectives);
            let is_tighter = |own: Option<f64>, bound: f64, it: &Objective| {
                own.is_some_and(|own| it.graded(own) >= it.graded(bound))
            };
            other.objective == posed.objective
                && pairs
                    .all(|((other, own), it)| other.is_none_or(|other| is_tighter(*own, other, it)))
        };
        let mut solved = self.solved.iter();
        self.failed.iter().any(is_looser)
            || solved.any(|it| is_looser(&it.posed) && self.keeps(&it.alternative, posed))
    }

    /// Whether a design keeps the bounds of a problem.
    fn keeps(&self, design: &Alternative, posed: &FrontProblem) -> bool {
        let pairs = self
            .objectives
            .iter()
            .zip(&design.values)
            .zip(&posed.bounds);
        let mut bounded = pairs.filter_map(|((objective, value), bound)| {
            let bound = (*bound)?;
            let margin = objective.graded(*value) - objective.graded(bound);
            Some(margin >= -ROUNDING * bound.abs())
        });
        bounded.all(|is_kept| is_kept)
    }

    /// The problem of one objective with bounds of the others.
    fn problem_of(&self, posed: &FrontProblem) -> Problem {
        let alone = Problem {
            objective: self.objectives[posed.objective],
            ..self.problem.clone()
        };
        let bounds = self.objectives.iter().zip(&posed.bounds);
        bounds.fold(alone, |problem, (objective, bound)| match bound {
            Some(bound) => problem.bounded(objective, *bound),
            None => problem,
        })
    }

    /// Solves a problem with bounds, from the designs that are nearest to these on.
    fn solve(&self, posed: &FrontProblem) -> Result<SearchResult, SearchError> {
        let distance = |it: &SolvedProblem| {
            let bounds = posed.bounds.iter().zip(&it.alternative.values).enumerate();
            let parts = bounds.filter_map(|(index, (bound, value))| {
                Some(self.ranges.scaled(index, *value) - self.ranges.scaled(index, (*bound)?))
            });
            parts.map(|part| part * part).sum::<f64>()
        };
        let mut near: Vec<&SolvedProblem> = self.solved.iter().collect();
        sort_rising(&mut near, |it| distance(it));
        let starts = near.iter().take(NEIGHBOURS);
        let starts: Vec<(Vec<f64>, f64)> = starts.map(|it| it.alternative.found.start()).collect();
        let settings = SearchSettings {
            evaluations: (self.settings.evaluations / SHARE).max(LEAST_EVALUATIONS),
        };
        let watch = (&QuietMonitor(self.watch) as &dyn SearchMonitor, None);
        search_from(&self.problem_of(posed), settings, &starts, watch)
    }

    /// Goes on with each problem from the design of another one, where that solves it better.
    fn exchange(&mut self) {
        for index in (0..self.solved.len()).rev() {
            if self.watch.stop() {
                return;
            }
            let own = &self.solved[index];
            let objective = own.posed.objective;
            let graded = |it: &SolvedProblem| {
                self.objectives[objective].graded(it.alternative.values[objective])
            };
            let is_better = |it: &&SolvedProblem| {
                let gain = graded(it) - graded(own);
                gain > ROUNDING * graded(own).abs() && self.keeps(&it.alternative, &own.posed)
            };
            let better = self.solved.iter().filter(is_better);
            let Some(best) = better.max_by(|a, b| graded(a).total_cmp(&graded(b))) else {
                continue;
            };
            let from = best.alternative.found.candidate();
            let mut found = own.alternative.found.clone();
            found.design.value = own.alternative.values[objective];
            if found.go_on_from(&self.problem_of(&own.posed), &from)
                && let Some(alternative) = Alternative::new(self.problem, self.objectives, &found)
            {
                self.solved[index].alternative = alternative;
            }
        }
    }
}
