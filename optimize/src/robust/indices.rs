//! Whose scatter it is: Sobol' indices, the shares of the inputs in the variance of an output.
//!
//! The first-order index is the share that an input has alone, by the estimator of Saltelli et al. (2010); the total one
//! the share of all in which it has a part, by Jansen (1999). Both take points A and B in as many dimensions as there are
//! inputs, and for each input the points of A with that input as in B.

use softstop_dynamics::monitor::Monitor;
use softstop_dynamics::parallel;
use softstop_dynamics::spread_points::{SEQUENCE_LENGTH, sobol_point};

/// An estimate and its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The mean over the sequences of points.
    pub value: f64,
    /// Its standard error, from their scatter.
    pub error: f64,
}

impl Estimate {
    /// The mean of values and its standard error.
    fn of(values: &[f64]) -> Self {
        let count = values.len() as f64;
        let value = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|one| (one - value).powi(2)).sum();
        Self {
            value,
            error: (squares / (count - 1.0) / count).sqrt(),
        }
    }
}

/// What an input has to do with an output.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SobolIndex {
    /// Its share alone.
    pub first: Estimate,
    /// Its share together with others.
    pub total: Estimate,
}

/// How many points are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SampleSize {
    /// Points of a sequence, a power of two of at most 65,536: each asks for the outputs once for each input, and twice more.
    pub points: usize,
    /// Sequences, at least 2.
    pub sequences: usize,
}

impl Default for SampleSize {
    fn default() -> Self {
        Self {
            points: 1 << 10,
            sequences: 8,
        }
    }
}

/// The indices of all inputs, spread evenly between -1 and 1, for each of the outputs; none if one of these is not there,
/// does not change at all, or if the watcher, told how many points are done, wants to stop.
pub fn indices<const N: usize>(
    dimensions: usize,
    effort: SampleSize,
    outputs: impl Fn(&[f64]) -> Option<[f64; N]> + Sync,
    watcher: Monitor<'_>,
) -> Option<[Vec<SobolIndex>; N]> {
    let SampleSize { points, sequences } = effort;
    let points = points.clamp(2, SEQUENCE_LENGTH);
    let sequences = sequences.max(2);
    let mut estimates: [Vec<Vec<[f64; 2]>>; N] = std::array::from_fn(|_| Vec::new());
    for sequence in 0..sequences {
        let first = sequence * SEQUENCE_LENGTH;
        let rows = parallel::try_map_indices(points, &|index| {
            let point = sobol_point(first + index, 2 * dimensions);
            SaltelliRow::new(&point, &outputs).ok_or(())
        });
        let rows: Vec<SaltelliRow<N>> = rows.ok()?;
        for (output, estimates) in estimates.iter_mut().enumerate() {
            estimates.push(shares(&rows, output, dimensions)?);
        }
        let done = ((sequence + 1) * points) as u64;
        if watcher(done, (sequences * points) as u64).is_break() {
            return None;
        }
    }
    Some(estimates.map(|all| {
        (0..dimensions)
            .map(|input| SobolIndex::of(&all, input))
            .collect()
    }))
}

/// The outputs at a point of A, of B, and at those between.
struct SaltelliRow<const N: usize> {
    a: [f64; N],
    b: [f64; N],
    between: Vec<[f64; N]>,
}

impl<const N: usize> SaltelliRow<N> {
    fn new(point: &[f64], outputs: &impl Fn(&[f64]) -> Option<[f64; N]>) -> Option<Self> {
        let (a, b) = point.split_at(point.len() / 2);
        let between = |input: usize| {
            let mut mixed = a.to_vec();
            mixed[input] = b[input];
            outputs(&mixed)
        };
        Some(Self {
            a: outputs(a)?,
            b: outputs(b)?,
            between: (0..a.len()).map(between).collect::<Option<_>>()?,
        })
    }
}

/// First-order and total shares of all inputs in an output's variance.
fn shares<const N: usize>(
    rows: &[SaltelliRow<N>],
    output: usize,
    dimensions: usize,
) -> Option<Vec<[f64; 2]>> {
    let count = rows.len() as f64;
    let both = || rows.iter().flat_map(|row| [row.a[output], row.b[output]]);
    let mean = both().sum::<f64>() / (2.0 * count);
    let variance = both().map(|value| (value - mean).powi(2)).sum::<f64>() / (2.0 * count);
    let of_input = |input: usize| {
        let mut sums = [0.0; 2];
        for row in rows {
            let change = row.between[input][output] - row.a[output];
            sums[0] += (row.b[output] - mean) * change;
            sums[1] += 0.5 * change * change;
        }
        sums.map(|sum| sum / count / variance)
    };
    (variance > 0.0).then(|| (0..dimensions).map(of_input).collect())
}

impl SobolIndex {
    /// From the estimates of all sequences.
    fn of(all: &[Vec<[f64; 2]>], input: usize) -> Self {
        let estimate = |which: usize| {
            let values: Vec<f64> = all.iter().map(|one| one[input][which]).collect();
            Estimate::of(&values)
        };
        Self {
            first: estimate(0),
            total: estimate(1),
        }
    }
}
