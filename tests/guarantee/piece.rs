//! The search that proves a condition not met: bounds and monotony, no sampling.

/// Displacement since the start of the arc, velocity and acceleration.
#[derive(Debug, Clone, Copy)]
pub struct State {
    pub u: f64,
    pub v: f64,
    pub a: f64,
}

/// What holds from some time t to t + h.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    /// Largest |acceleration| and |jerk|.
    pub a: f64,
    pub j: f64,
    /// Steady motion: displacement and velocity in the middle, largest change of the displacement
    /// to either side, and its frequency.
    pub drift: Option<(f64, f64, f64, f64)>,
    /// Largest |displacement| and |velocity| of what comes on top of it.
    pub free: (f64, f64),
}

/// A stretch of smooth motion.
pub trait Piece {
    fn at(&self, t: f64) -> State;
    fn bounds(&self, t: f64, h: f64) -> Bounds;
}

/// `constant` + `u` u + `v` v, which ends an arc when it rises through zero.
#[derive(Debug, Clone, Copy)]
pub struct Guard {
    pub constant: f64,
    pub u: f64,
    pub v: f64,
    /// Values up to this one cannot be told from zero.
    pub grain: f64,
    /// Natural size of a value.
    pub size: f64,
}

impl Guard {
    pub fn value(&self, s: &State) -> f64 {
        self.constant + self.u * s.u + self.v * s.v
    }

    pub fn slope(&self, s: &State) -> f64 {
        self.u * s.v + self.v * s.a
    }
}

/// What a search has seen.
#[derive(Debug, Clone, Copy)]
pub struct Watch {
    /// Evaluations left.
    pub budget: u64,
    /// Smallest distance, in natural sizes, by which a local extremum failed to meet a condition.
    pub margin: f64,
    /// Extrema that cannot be told from a touch.
    pub touches: u64,
    /// The condition has been told from met on this leg, and doubtful since.
    pub away: bool,
    pub doubt: bool,
}

impl Watch {
    /// For a new guard or leg.
    pub fn renew(&mut self) {
        (self.away, self.doubt) = (false, false);
    }

    /// The condition is told from met. What was doubtful between such times was a touch.
    fn clear(&mut self) {
        self.touches += u64::from(self.away && self.doubt);
        (self.away, self.doubt) = (true, false);
    }
}

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Seen {
    Clear,
    Met { time: f64, value: f64 },
    Exhausted,
}

/// Conditions nearer than this share of their natural size are looked at closely.
const NEAR: f64 = 1e-6;

/// Looks for the guard above zero anywhere between two times.
pub fn search(piece: &impl Piece, guard: &Guard, from: f64, to: f64, watch: &mut Watch) -> Seen {
    let mut todo = vec![(from, to)];
    while let Some((begin, end)) = todo.pop() {
        if watch.budget == 0 {
            return Seen::Exhausted;
        }
        watch.budget -= 1;
        let (h, middle) = (end - begin, 0.5 * (begin + end));
        let (state, bounds) = (piece.at(middle), piece.bounds(begin, h));
        let (value, slope) = (guard.value(&state), guard.slope(&state));
        let bend = guard.u.abs() * bounds.a + guard.v.abs() * bounds.j;
        let wave = bend * h * h / 8.0;
        let near = -NEAR * guard.size;
        if value + 0.5 * slope.abs() * h + wave < near || steady(guard, &bounds) < near {
            watch.clear();
            continue;
        }
        if slope.abs() > 0.5 * bend * h {
            let time = if slope > 0.0 { end } else { begin };
            let value = guard.value(&piece.at(time));
            if value > guard.grain {
                return Seen::Met { time, value };
            }
            if value < -guard.grain {
                watch.clear();
            }
            continue;
        }
        if wave <= (0.05 * -value).max(0.02 * guard.grain) || middle <= begin || middle >= end {
            if value > guard.grain {
                return Seen::Met {
                    time: middle,
                    value,
                };
            }
            if value > -guard.grain {
                watch.doubt = true;
            } else {
                watch.clear();
                let inside = begin > from && end < to;
                let margin = if inside {
                    -value / guard.size
                } else {
                    f64::INFINITY
                };
                watch.margin = watch.margin.min(margin);
            }
            continue;
        }
        todo.push((middle, end));
        todo.push((begin, middle));
    }
    Seen::Clear
}

/// The guard's largest value by the steady motion and the size of what comes on top.
fn steady(guard: &Guard, bounds: &Bounds) -> f64 {
    let Some((u, v, change, frequency)) = bounds.drift else {
        return f64::INFINITY;
    };
    let middle = guard.constant + guard.u * u + guard.v * v;
    middle
        + guard.u.abs() * (change + bounds.free.0)
        + guard.v.abs() * (change * frequency + bounds.free.1)
}
