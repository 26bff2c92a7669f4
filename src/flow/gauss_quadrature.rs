//! Gauss's quadrature rule.

/// Nodes and weights of the eight-point Gauss rule on [-1, 1] (Abramowitz and Stegun, table 25.4). Over the reach of a
/// Taylor polynomial its error on the products of force and velocity is under 1e-17.
const EIGHT_POINT_RULE: [(f64, f64); 8] = [
    (-0.183_434_642_495_65, 0.362_683_783_378_362),
    (0.183_434_642_495_65, 0.362_683_783_378_362),
    (-0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (-0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (-0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
];

/// Nodes and weights of the eight-point Gauss rule on [0, `span`].
pub(crate) fn gauss_nodes(span: f64) -> [(f64, f64); 8] {
    EIGHT_POINT_RULE.map(|(place, weight)| (0.5 * span * (1.0 + place), 0.5 * span * weight))
}

/// The integral of a function between two times by Gauss's rule, in panels for oscillations no faster than `rate` in rad/s.
pub(crate) fn integrate((from, to): (f64, f64), rate: f64, value: impl Fn(f64) -> f64) -> f64 {
    let panels = (rate * (to - from)).ceil().max(1.0);
    let width = (to - from) / panels;
    let mut sum = 0.0;
    for panel in 0..panels as u64 {
        let start = from + width * panel as f64;
        for (time, weight) in gauss_nodes(width) {
            sum += weight * value(start + time);
        }
    }
    sum
}
