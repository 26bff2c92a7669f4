//! What a run of cases has seen.

use std::fmt;

use softstop::CrossingKind;

/// Counts, margins and failures.
#[derive(Debug, Clone)]
pub struct Tally {
    pub cases: u64,
    pub arcs: u64,
    /// Surfaces on and back, rebounds, reversals, switches, rests, releases.
    pub crossings: [u64; 7],
    /// Penetrations and gaps below 1e-6 of the positions' size.
    pub near_hits: u64,
    pub near_misses: u64,
    /// The smallest gap, in sizes of positions.
    pub closest: f64,
    /// Extrema within the grain of a condition.
    pub touches: u64,
    /// Crossings that cannot be told from a miss.
    pub undecidable: u64,
    /// Cases left where two outcomes cannot be told apart.
    pub left: u64,
    /// Cases cut short by their budget.
    pub cut: u64,
    /// Motions that the library refuses.
    pub refused: u64,
    /// Largest error of an end state, in grains.
    pub worst: f64,
    pub failures: Vec<String>,
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            cases: 0,
            arcs: 0,
            crossings: [0; 7],
            near_hits: 0,
            near_misses: 0,
            closest: f64::INFINITY,
            touches: 0,
            undecidable: 0,
            left: 0,
            cut: 0,
            refused: 0,
            worst: 0.0,
            failures: Vec::new(),
        }
    }
}

impl Tally {
    pub fn count(&mut self, kind: CrossingKind) {
        let index = match kind {
            CrossingKind::Surface { forward: true, .. } => 0,
            CrossingKind::Surface { forward: false, .. } => 1,
            CrossingKind::Rebound { .. } => 2,
            CrossingKind::Reversal => 3,
            CrossingKind::Switch => 4,
            CrossingKind::Rest => 5,
            CrossingKind::Release => 6,
        };
        self.crossings[index] += 1;
    }

    pub fn error(&mut self, grains: f64) {
        self.worst = self.worst.max(grains);
    }

    pub fn add(&mut self, other: Self) {
        self.cases += other.cases;
        self.arcs += other.arcs;
        for (sum, more) in self.crossings.iter_mut().zip(other.crossings) {
            *sum += more;
        }
        self.near_hits += other.near_hits;
        self.near_misses += other.near_misses;
        self.closest = self.closest.min(other.closest);
        self.touches += other.touches;
        self.undecidable += other.undecidable;
        self.left += other.left;
        self.cut += other.cut;
        self.refused += other.refused;
        self.worst = self.worst.max(other.worst);
        self.failures.extend(other.failures);
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [on, back, rebound, reversal, switch, rest, release] = self.crossings;
        write!(
            f,
            "{} cases, {} arcs; crossings: {on} on, {back} back, {rebound} rebounds, {reversal} \
             reversals, {switch} switches, {rest} rests, {release} releases; near-grazes: {} hits, \
             {} misses (closest {:.1e}); cannot be told: {} touches, {} crossings, {} cases left; \
             {} cut short, {} refused; worst end state {:.3} grains; {} failures",
            self.cases,
            self.arcs,
            self.near_hits,
            self.near_misses,
            self.closest,
            self.touches,
            self.undecidable,
            self.left,
            self.cut,
            self.refused,
            self.worst,
            self.failures.len()
        )
    }
}
