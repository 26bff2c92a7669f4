//! Gauss's rule over a stretch of time.

/// Nodes and weights of the eight-point Gauss rule on [-1, 1] (Abramowitz and Stegun, table 25.4),
/// positive half. Over one Taylor reach its error on the products of force and velocity is under 1e-17.
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_65, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
];

/// The same of the five-point rule, beside the middle: as exact over a quarter of a reach.
const SHORT: [(f64, f64); 2] = [
    (0.538_469_310_105_683, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];
const MIDDLE: f64 = 128.0 / 225.0;

/// The rule's nodes and weights on [0, `span`].
pub(super) fn gauss_nodes(span: f64) -> [(f64, f64); 8] {
    let half = 0.5 * span;
    std::array::from_fn(|index| {
        let (x, weight) = GAUSS[index / 2];
        let place = if index % 2 == 0 { 1.0 - x } else { 1.0 + x };
        (half * place, half * weight)
    })
}

/// Those of the five-point rule.
pub(super) fn few_gauss_nodes(span: f64) -> [(f64, f64); 5] {
    let half = 0.5 * span;
    let [(inner, wide), (outer, narrow)] = SHORT;
    [
        (1.0 - outer, narrow),
        (1.0 - inner, wide),
        (1.0, MIDDLE),
        (1.0 + inner, wide),
        (1.0 + outer, narrow),
    ]
    .map(|(place, weight)| (half * place, half * weight))
}
