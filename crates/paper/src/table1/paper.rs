//! What the paper prints in its Table 1: the figures and names with which ours are compared.

/// A motion as the paper names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Name {
    /// z = p/n, and the order of its impacts where that matters.
    Periodic(u64, u64, Option<&'static str>),
    /// Chaos.
    Chaos,
}

/// One row.
#[derive(Debug, Clone, Copy)]
pub struct PaperRow {
    /// Its number.
    pub number: usize,
    /// The frequency ratio as printed.
    pub eta: f64,
    /// What ends.
    pub from: Name,
    /// What follows in the end.
    pub to: Name,
    /// Its type.
    pub kind: &'static str,
    /// Whether there is hysteresis.
    pub hysteresis: bool,
}

const CHAOS: Name = Name::Chaos;
const REST: Name = Name::Periodic(0, 1, None);
const ONE: Name = Name::Periodic(1, 1, None);
const SLOW: Name = Name::Periodic(2, 21, None);
const TENTH: Name = Name::Periodic(1, 10, None);
const NINTH: Name = Name::Periodic(1, 9, None);
/// The paper's (2/4)A, impacts 1-0-1-0: z = 1/2 unless it is doubled.
const HALF: Name = Name::Periodic(1, 2, None);
/// The paper's (2/4)B.
const PAIR: Name = Name::Periodic(2, 4, Some("1-1-0-0"));
const TWO_THIRDS: Name = Name::Periodic(2, 3, None);

const fn row(
    number: usize,
    eta: f64,
    (from, to): (Name, Name),
    hysteresis: bool,
    kind: &'static str,
) -> PaperRow {
    PaperRow {
        number,
        eta,
        from,
        to,
        kind,
        hysteresis,
    }
}

/// The table (Peterka 2003, Table 1).
pub const ROWS: [PaperRow; 19] = [
    row(1, 0.952_641_75, (CHAOS, REST), true, "OCH"),
    row(2, 0.952_651_56, (REST, CHAOS), true, "G"),
    row(3, 0.952_654_75, (CHAOS, SLOW), false, "ISN"),
    row(4, 0.952_656_72, (TENTH, SLOW), true, "G"),
    row(5, 0.952_666_78, (SLOW, TENTH), true, "G"),
    row(6, 0.953_410_05, (CHAOS, TENTH), true, "OCH"),
    row(7, 0.953_803_62, (TENTH, CHAOS), true, "G"),
    row(8, 0.954_06, (CHAOS, NINTH), false, "IPD"),
    row(9, 0.955_42, (CHAOS, NINTH), true, "OCH"),
    row(10, 0.956_15, (NINTH, CHAOS), true, "G"),
    row(11, 0.983_05, (PAIR, CHAOS), true, "G"),
    row(12, 0.986_78, (TWO_THIRDS, CHAOS), true, "G"),
    row(13, 0.988_49, (CHAOS, HALF), false, "IPD"),
    row(14, 0.988_90, (ONE, HALF), true, "PD -> SN"),
    row(15, 0.988_99, (HALF, ONE), true, "G"),
    row(16, 0.992_73, (PAIR, TWO_THIRDS), true, "PD -> ISN -> OCH"),
    row(17, 1.005_44, (TWO_THIRDS, ONE), true, "PD -> ISN -> OCH"),
    row(18, 1.044_44, (REST, ONE), true, "G"),
    row(19, 1.370_83, (ONE, REST), true, "SN"),
];

/// Its sub-intervals (a) to (d) of eta, from the first of their rows to the last, and how many values are
/// surveyed evenly in each, its ends left out.
pub const INTERVALS: [(f64, f64, usize); 4] = [
    (ROWS[0].eta, ROWS[4].eta, 5),
    (ROWS[5].eta, ROWS[9].eta, 5),
    (ROWS[10].eta, ROWS[15].eta, 5),
    (ROWS[16].eta, ROWS[18].eta, 3),
];
