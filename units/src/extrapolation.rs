//! Smooth equations of motion: the modified midpoint rule, extrapolated (Gragg 1965; Bulirsch and Stoer 1966).

/// Columns of the extrapolation at most: order 16.
const COLUMNS: usize = 8;
/// Error of a step, as a share of what it has come to.
const TOLERANCE: f64 = 1e-12;
/// Steps that one stretch may take.
const MOST: usize = 1 << 16;

/// A state of so many numbers.
pub(crate) type State<const N: usize> = [f64; N];

/// The state at `until` of y' = rates(t, y), from `state` at `time`; nothing if it takes too many steps.
pub(crate) fn integrate<const N: usize>(
    (mut time, until): (f64, f64),
    mut state: State<N>,
    rates: impl Fn(f64, &State<N>) -> State<N>,
) -> Option<State<N>> {
    let mut size = until - time;
    for _ in 0..MOST {
        if time >= until {
            return Some(state);
        }
        let ends = size >= until - time;
        size = size.min(until - time);
        if let Some((next, columns)) = step(time, size, &state, &rates) {
            (time, state) = (if ends { until } else { time + size }, next);
            size *= if columns < COLUMNS - 1 { 2.0 } else { 1.0 };
        } else {
            size *= 0.5;
        }
    }
    None
}

/// One step, and how many columns it took; nothing if all of them do not converge.
fn step<const N: usize>(
    time: f64,
    size: f64,
    state: &State<N>,
    rates: &impl Fn(f64, &State<N>) -> State<N>,
) -> Option<(State<N>, usize)> {
    let mut row: Vec<State<N>> = Vec::with_capacity(COLUMNS);
    for column in 0..COLUMNS {
        let mut best = midpoint(time, size, state, 2 * (column + 1), rates);
        let mut last = best;
        for (back, kept) in row.iter_mut().enumerate() {
            let ratio = (column + 1) as f64 / (column - back) as f64;
            let share = 1.0 / (ratio * ratio - 1.0);
            let before = std::mem::replace(kept, best);
            last = best;
            best = std::array::from_fn(|k| best[k] + share * (best[k] - before[k]));
        }
        row.push(best);
        let close = |k: usize| {
            let scale = state[k].abs().max(best[k].abs());
            (best[k] - last[k]).abs() <= TOLERANCE * scale
        };
        if column > 0 && (0..N).all(close) {
            return Some((best, column));
        }
    }
    None
}

fn midpoint<const N: usize>(
    time: f64,
    size: f64,
    state: &State<N>,
    steps: usize,
    rates: &impl Fn(f64, &State<N>) -> State<N>,
) -> State<N> {
    let width = size / steps as f64;
    let moved = |from: &State<N>, by: f64, rate: &State<N>| -> State<N> {
        std::array::from_fn(|k| by.mul_add(rate[k], from[k]))
    };
    let mut before = *state;
    let mut now = moved(state, width, &rates(time, state));
    for k in 1..steps {
        let next = moved(&before, 2.0 * width, &rates(time + k as f64 * width, &now));
        (before, now) = (now, next);
    }
    let end = moved(&before, width, &rates(time + size, &now));
    std::array::from_fn(|k| 0.5 * (now[k] + end[k]))
}

#[cfg(test)]
mod tests {
    use super::integrate;

    #[test]
    fn an_oscillator_over_many_periods() {
        let rates = |_: f64, y: &[f64; 2]| [y[1], -y[0]];
        let end = integrate((0.0, 100.0), [1.0, 0.0], rates).expect("it converges");
        assert!((end[0] - 100_f64.cos()).abs() < 1e-10, "{}", end[0]);
    }
}
