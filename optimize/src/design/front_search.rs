//! The search of a front: the best design by each objective alone, then the best by one of them with bounds of the others (the
//! epsilon-constraint method, Haimes, Lasdon and Wismer 1971). Of two objectives one is bounded in the middle of the widest gap
//! between designs, of more all but the first on a lattice. A problem whose solution follows from a looser one is not searched
//! (Mavrotas 2009).

use rayon::prelude::*;
use serde::Serialize;

use super::bounded::{Point, Posed};
use super::non_dominated::{Front, front};
use super::problem::{Objective, Problem};
use super::search::{Found, LEAST_EVALUATIONS, SearchError, Settings, Watch, search_from};

/// Bounds of each objective but the first between its ends, by how many objectives there are from three on: 35, 26 and 15
/// problems.
const LEVELS: [usize; 3] = [5, 2, 1];
/// Problems of two objectives, those that are solved at once, and the gap between designs, in units of the front, that needs
/// none.
const PROBLEMS: usize = 14;
const AT_ONCE: usize = 2;
const SMALL_GAP: f64 = 0.04;
/// Share of the evaluations of a search that each problem with bounds may take: its neighbours are solved.
const SHARE: u64 = 4;
/// Neighbours from which a problem starts.
const NEIGHBOURS: usize = 3;
/// Relative difference of a value that is none.
const ROUNDING: f64 = 1e-9;

/// The problems of a front, and what became of them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// All problems.
    pub problems: usize,
    /// Those that led to a design.
    pub solved: usize,
    /// Those that a looser one solves, or that have no design because it has none.
    pub implied: usize,
    /// Those without a design that is as asked.
    pub failed: usize,
    /// Designs that another one dominates, or that are the same.
    pub dominated: usize,
}

/// A problem of a front with its solution.
#[derive(Debug, Clone)]
struct Solved {
    problem: Problem,
    posed: Posed,
    point: Point,
}

/// A watch of one of many searches: it can be stopped, and tells nothing.
struct Quiet<'a>(&'a dyn Watch);

impl Watch for Quiet<'_> {
    fn evaluated(&self, _: Option<f64>) {}
    fn stop(&self) -> bool {
        self.0.stop()
    }
}

/// Bounds of each objective but the first, of so many.
fn levels(objectives: usize) -> usize {
    LEVELS[(objectives - 3).min(LEVELS.len() - 1)]
}

/// The designs of a front from the best one by the first objective on, some of which others may dominate, and what became of
/// the problems; an interrupted search has those that are found by then.
///
/// # Errors
/// [`SearchError`] if no design has one of the objectives.
pub(super) fn search_front(
    problem: &Problem,
    objectives: &[Objective],
    first: &Found,
    (settings, watch): (Settings, &dyn Watch),
) -> Result<(Vec<Point>, Tally), SearchError> {
    let mut search = FrontSearch {
        problem,
        objectives,
        settings,
        watch,
        ranges: Vec::new(),
        solved: Vec::new(),
        failed: Vec::new(),
        tally: Tally::default(),
    };
    search.find_anchors(first)?;
    search.refine_anchors();
    match objectives.len() {
        2 => search.fill_gaps(),
        _ => search.solve_lattice(),
    }
    search.exchange();
    let points: Vec<Point> = search.solved.into_iter().map(|it| it.point).collect();
    let solved = points.len();
    Ok((
        points,
        Tally {
            solved,
            ..search.tally
        },
    ))
}

/// The search of a front.
struct FrontSearch<'a> {
    problem: &'a Problem,
    objectives: &'a [Objective],
    settings: Settings,
    watch: &'a dyn Watch,
    /// For each objective the worst value of the best designs by each, and the best.
    ranges: Vec<[f64; 2]>,
    solved: Vec<Solved>,
    /// Problems without a design.
    failed: Vec<Posed>,
    tally: Tally,
}

impl FrontSearch<'_> {
    /// The best design by each objective alone.
    fn find_anchors(&mut self, first: &Found) -> Result<(), SearchError> {
        let count = self.objectives.len();
        self.tally.problems = 2 * count
            + match count {
                2 => PROBLEMS,
                _ => (levels(count) + 1).pow(count as u32 - 1) - 1,
            };
        let alone = |objective| Posed {
            objective,
            bounds: vec![None; count],
        };
        self.keep(self.problem.clone(), alone(0), first);
        for (index, objective) in self.objectives.iter().enumerate().skip(1) {
            let problem = Problem {
                objective: *objective,
                ..self.problem.clone()
            };
            let starts = [first.start()];
            let quiet = Quiet(self.watch);
            let found = match search_from(&problem, self.settings, &starts, (&quiet, None)) {
                Ok(found) => found,
                Err(SearchError::Stopped(_)) => break,
                Err(error) => return Err(error),
            };
            self.keep(problem, alone(index), &found);
            self.tell();
        }
        self.ranges = (0..count).map(|index| self.range(index)).collect();
        Ok(())
    }

    /// The best designs by another objective among those that are best by each, of which there may be many.
    fn refine_anchors(&mut self) {
        let count = self.objectives.len();
        let at_best = |index: usize| {
            let mut bounds = vec![None; count];
            bounds[index] = Some(self.ranges[index][1]);
            Posed {
                objective: usize::from(index == 0),
                bounds,
            }
        };
        self.solve_all((0..count).map(at_best).collect());
    }

    fn range(&self, index: usize) -> [f64; 2] {
        let objective = &self.objectives[index];
        let values = self.solved.iter().map(|it| it.point.values[index]);
        let by_grade = |a: &f64, b: &f64| objective.graded(*a).total_cmp(&objective.graded(*b));
        let worst = values.clone().min_by(by_grade).unwrap_or(f64::NAN);
        [worst, values.max_by(by_grade).unwrap_or(f64::NAN)]
    }

    /// A value of an objective in units of its range: 0 at its worst, 1 at its best.
    fn scaled(&self, index: usize, value: f64) -> f64 {
        let [worst, best] = self.ranges[index];
        (value - worst) / (best - worst)
    }

    fn tell(&self) {
        let done = self.solved.len() + self.failed.len() + self.tally.implied;
        self.watch.posed(done as u64, self.tally.problems as u64);
    }

    /// Takes note of a solution.
    fn keep(&mut self, problem: Problem, posed: Posed, found: &Found) {
        match Point::new(self.problem, self.objectives, found) {
            Some(point) => self.solved.push(Solved {
                problem,
                posed,
                point,
            }),
            None => self.fail(posed),
        }
    }

    fn fail(&mut self, posed: Posed) {
        self.tally.failed += 1;
        self.failed.push(posed);
    }

    /// The best designs by one of two objectives with a bound of the other, in the middle of the widest gaps.
    fn fill_gaps(&mut self) {
        let mut all: Vec<Posed> = Vec::new();
        while all.len() < PROBLEMS && !self.watch.stop() {
            let mut next = self.widest_gaps(&all);
            next.truncate(AT_ONCE.min(PROBLEMS - all.len()));
            if next.is_empty() {
                break;
            }
            all.extend(next.iter().cloned());
            self.solve_all(next);
        }
        if !self.watch.stop() {
            self.tally.problems -= PROBLEMS - all.len();
        }
    }

    /// Problems in the middle of the gaps between designs, the widest first, but for those that were posed.
    fn widest_gaps(&self, posed: &[Posed]) -> Vec<Posed> {
        let mut points: Vec<[f64; 2]> = self.undominated();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut gaps: Vec<(f64, Posed)> = Vec::new();
        for pair in points.windows(2) {
            let widths = [0, 1].map(|index| {
                (self.scaled(index, pair[0][index]) - self.scaled(index, pair[1][index])).abs()
            });
            let wider = usize::from(widths[1] > widths[0]);
            let of = |bounded: usize| {
                let mut bounds = vec![None; 2];
                bounds[bounded] = Some(0.5 * (pair[0][bounded] + pair[1][bounded]));
                Posed {
                    objective: 1 - bounded,
                    bounds,
                }
            };
            let new = [wider, 1 - wider].map(of).into_iter();
            let mut new = new.filter(|it| !posed.contains(it));
            let width = widths[0].hypot(widths[1]);
            gaps.extend(
                new.next()
                    .filter(|_| width > SMALL_GAP)
                    .map(|it| (width, it)),
            );
        }
        gaps.sort_by(|a, b| b.0.total_cmp(&a.0));
        gaps.into_iter().map(|(_, it)| it).collect()
    }

    /// The values of the designs of two objectives that no other one dominates.
    fn undominated(&self) -> Vec<[f64; 2]> {
        let points: Vec<&Point> = self.solved.iter().map(|it| &it.point).collect();
        let grades = points.iter().map(|it| it.graded(self.objectives));
        let Front { members, .. } = front(&grades.collect::<Vec<_>>());
        let values = members.iter().map(|index| &points[*index].values);
        values.map(|it| [it[0], it[1]]).collect()
    }

    /// The best designs by the first objective with so many bounds of each other one, the loosest first: those of one sum of
    /// levels do not depend on each other.
    fn solve_lattice(&mut self) {
        let (others, levels) = (self.objectives.len() - 1, levels(self.objectives.len()));
        let count = (levels + 1).pow(others as u32);
        let digit =
            |number: usize, place: usize| number / (levels + 1).pow(place as u32) % (levels + 1);
        let bound = |index: usize, level: usize| {
            let [worst, best] = self.ranges[index];
            worst + (best - worst) * level as f64 / (levels + 1) as f64
        };
        let mut sums: Vec<Vec<Posed>> = vec![Vec::new(); others * levels + 1];
        for number in 1..count {
            let own: Vec<usize> = (0..others).map(|place| digit(number, place)).collect();
            let bounds = own.iter().enumerate();
            let bounds =
                bounds.map(|(place, level)| (*level > 0).then(|| bound(place + 1, *level)));
            sums[own.iter().sum::<usize>()].push(Posed {
                objective: 0,
                bounds: [None].into_iter().chain(bounds).collect(),
            });
        }
        for posed in sums {
            if !self.watch.stop() {
                self.solve_all(posed);
            }
        }
    }

    /// Solves problems that do not depend on each other.
    fn solve_all(&mut self, all: Vec<Posed>) {
        let (implied, posed): (Vec<_>, Vec<_>) =
            all.into_iter().partition(|it| self.is_implied(it));
        self.tally.implied += implied.len();
        let found = posed.par_iter().map(|it| self.solve(it));
        let found: Vec<_> = found.collect();
        for (posed, (problem, found)) in posed.into_iter().zip(found) {
            match found {
                Ok(found) => self.keep(problem, posed, &found),
                Err(SearchError::Stopped(_)) => return,
                Err(_) if self.solved.iter().any(|it| self.keeps(&it.point, &posed)) => {
                    self.tally.implied += 1;
                }
                Err(_) => self.fail(posed),
            }
        }
        self.tell();
    }

    /// Whether the solution of a looser problem keeps these bounds, or that has none.
    fn is_implied(&self, posed: &Posed) -> bool {
        let is_looser = |other: &Posed| {
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
            || solved.any(|it| is_looser(&it.posed) && self.keeps(&it.point, posed))
    }

    /// Whether a design keeps the bounds of a problem.
    fn keeps(&self, point: &Point, posed: &Posed) -> bool {
        let pairs = self.objectives.iter().zip(&point.values).zip(&posed.bounds);
        let mut bounded = pairs.filter_map(|((objective, value), bound)| {
            let bound = (*bound)?;
            let margin = objective.graded(*value) - objective.graded(bound);
            Some(margin >= -ROUNDING * bound.abs())
        });
        bounded.all(|is_kept| is_kept)
    }

    /// A problem with bounds, from the designs that are nearest to these on.
    fn solve(&self, posed: &Posed) -> (Problem, Result<Found, SearchError>) {
        let mut problem = Problem {
            objective: self.objectives[posed.objective],
            ..self.problem.clone()
        };
        for (objective, bound) in self.objectives.iter().zip(&posed.bounds) {
            if let Some(bound) = bound {
                problem = problem.bounded(objective, *bound);
            }
        }
        let distance = |it: &Solved| {
            let bounds = posed.bounds.iter().zip(&it.point.values).enumerate();
            let parts = bounds.filter_map(|(index, (bound, value))| {
                Some(self.scaled(index, *value) - self.scaled(index, (*bound)?))
            });
            parts.map(|part| part * part).sum::<f64>()
        };
        let mut near: Vec<&Solved> = self.solved.iter().collect();
        near.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        let starts = near.iter().take(NEIGHBOURS);
        let starts: Vec<(Vec<f64>, f64)> = starts.map(|it| it.point.found.start()).collect();
        let settings = Settings {
            evaluations: (self.settings.evaluations / SHARE).max(LEAST_EVALUATIONS),
        };
        let found = search_from(&problem, settings, &starts, (&Quiet(self.watch), None));
        (problem, found)
    }

    /// Goes on with each problem from the design of another one, where that solves it better.
    fn exchange(&mut self) {
        for index in (0..self.solved.len()).rev() {
            if self.watch.stop() {
                return;
            }
            let own = &self.solved[index];
            let objective = own.posed.objective;
            let graded =
                |it: &Solved| self.objectives[objective].graded(it.point.values[objective]);
            let is_better = |it: &&Solved| {
                let gain = graded(it) - graded(own);
                gain > ROUNDING * graded(own).abs() && self.keeps(&it.point, &own.posed)
            };
            let better = self.solved.iter().filter(is_better);
            let Some(best) = better.max_by(|a, b| graded(a).total_cmp(&graded(b))) else {
                continue;
            };
            let (from, mut found) = (best.point.found.candidate(), own.point.found.clone());
            found.design.value = own.point.values[objective];
            if found.go_on_from(&own.problem, &from)
                && let Some(point) = Point::new(self.problem, self.objectives, &found)
            {
                self.solved[index].point = point;
            }
        }
    }
}
