//! How the values of machines that are built lie within a tolerance.

/// How the values of a parameter lie about its design value.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Distribution {
    /// Anywhere between the ends of the tolerance; where machines are drawn, evenly.
    #[default]
    Box,
    /// Normally; the half-width of the tolerance is so many standard deviations.
    Normal(f64),
}

impl Distribution {
    /// The distribution over so many standard deviations to either side, and how many times as wide that is.
    #[must_use]
    pub fn over(self, deviations: f64) -> (Self, f64) {
        match self {
            Self::Box => (self, 1.0),
            Self::Normal(own) => (Self::Normal(deviations), deviations / own),
        }
    }

    /// The coordinate of a value that is drawn, 1 at the upper end, from a number that is spread evenly between -1 and 1.
    pub(super) fn draw(self, even: f64) -> f64 {
        match self {
            Self::Box => even,
            Self::Normal(deviations) => normal_quantile(0.5 * (1.0 + even)) / deviations,
        }
    }
}

/// Standard deviations of normal tolerances up to which polynomials are fitted where machines are drawn: one value of 16,000
/// lies beyond.
pub const FITTED: f64 = 4.0;
/// Standard deviations that an even distribution with the same standard deviation reaches to either side: the root of 3.
pub const EVEN: f64 = 1.732_050_807_568_877_2;

/// Distance from 0.5 up to which the first approximation holds; constants of both.
const SPLIT: f64 = 0.425;
const MIDDLE: f64 = 0.180_625;
const TAIL: f64 = 1.6;
/// Numerator and denominator about the middle, and of the tails, by rising powers.
const CENTRAL: [[f64; 8]; 2] = [
    [
        3.387_132_872_796_366_5,
        1.331_416_678_917_843_8e2,
        1.971_590_950_306_551_3e3,
        1.373_169_376_550_946e4,
        4.592_195_393_154_987e4,
        6.726_577_092_700_87e4,
        3.343_057_558_358_813e4,
        2.509_080_928_730_122_7e3,
    ],
    [
        1.0,
        4.231_333_070_160_091e1,
        6.871_870_074_920_579e2,
        5.394_196_021_424_751e3,
        2.121_379_430_158_659_7e4,
        3.930_789_580_009_271e4,
        2.872_908_573_572_194_3e4,
        5.226_495_278_852_854e3,
    ],
];
const OUTER: [[f64; 8]; 2] = [
    [
        1.423_437_110_749_683_5,
        4.630_337_846_156_546,
        5.769_497_221_460_691,
        3.647_848_324_763_204_5,
        1.270_458_252_452_368_4,
        2.417_807_251_774_506e-1,
        2.272_384_498_926_918_4e-2,
        7.745_450_142_783_414e-4,
    ],
    [
        1.0,
        2.053_191_626_637_759,
        1.676_384_830_183_803_8,
        6.897_673_349_851e-1,
        1.481_039_764_274_800_8e-1,
        1.519_866_656_361_645_7e-2,
        5.475_938_084_995_345e-4,
        1.050_750_071_644_416_9e-9,
    ],
];

/// The value that a share of a standard normal distribution lies below, to 16 digits for shares from 1e-10 to 1 - 1e-10
/// (Wichura 1988, AS 241).
pub fn normal_quantile(share: f64) -> f64 {
    let aside = share - 0.5;
    let ratio = |[above, below]: [[f64; 8]; 2], at: f64| {
        let sum = |factors: [f64; 8]| factors.iter().rev().fold(0.0, |sum, it| sum * at + it);
        sum(above) / sum(below)
    };
    if aside.abs() <= SPLIT {
        return aside * ratio(CENTRAL, MIDDLE - aside * aside);
    }
    let tail = share.min(1.0 - share);
    let value = ratio(OUTER, (-tail.ln()).sqrt() - TAIL);
    value.copysign(aside)
}

#[cfg(test)]
mod tests {
    use super::normal_quantile;

    /// Values of Wichura's paper.
    #[test]
    fn quantiles_are_those_of_the_paper() {
        for (share, value) in [
            (0.25, -0.674_489_750_196_081_7),
            (0.001, -3.090_232_306_167_813_5),
            (0.5, 0.0),
            (0.975, 1.959_963_984_540_054),
            (0.998_650_101_968_369_9, 3.0),
        ] {
            assert!((normal_quantile(share) - value).abs() < 1e-13, "{share}");
        }
    }
}
