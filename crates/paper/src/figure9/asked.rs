//! The list of the motions (A) to (L): frequency, and which of the motions there.

use softstop::{Ratios, Scene, SceneError};

/// A motion that the figure shows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked {
    pub(super) letter: char,
    /// Its frequency eta.
    pub(super) frequency: f64,
    /// Whether the paper's text gives that frequency.
    pub(super) is_given: bool,
    /// The order of its impacts; none of what does not repeat.
    pub(super) impacts: Option<&'static str>,
    /// What else there is to say.
    pub(super) remark: &'static str,
}

impl Asked {
    pub(super) fn scene(&self) -> Result<Scene, SceneError> {
        Ratios::unloaded().at_frequency(self.frequency).scene()
    }
}

macro_rules! motions {
    ($($letter:literal $frequency:literal $is_given:literal $impacts:expr, $remark:literal;)*) => {
        [$(Asked {
            letter: $letter,
            frequency: $frequency,
            is_given: $is_given,
            impacts: $impacts,
            remark: $remark,
        }),*]
    };
}

/// The motions. Sections 4 and the legend of Fig. 9 name (A) and (B), (D) and (E), (G) to (I) with their
/// frequencies; (C), (F) and (J) without, and (K) and (L) not at all: those here lie in the subintervals of
/// Fig. 8 in which the paper has them.
pub(super) const MOTIONS: [Asked; 12] = motions! {
    'A' 0.952_647_5 true Some("0"), "coexists with (B)";
    'B' 0.952_647_5 true None, "coexists with (A); shown while it lasts";
    'C' 0.952_66 false Some("1-0-0-0-0-0-0-0-0-0-1-0-0-0-0-0-0-0-0-0-0"), "";
    'D' 0.953_65 true Some("1-0-0-0-0-0-0-0-0-0"), "coexists with (E)";
    'E' 0.953_65 true None, "coexists with (D)";
    'F' 0.955_8 false Some("1-0-0-0-0-0-0-0-0"), "";
    'G' 0.987_5 true None, "coexists with (H) and (I)";
    'H' 0.987_5 true Some("1-1-0-0"), "the paper's (2/4)B; coexists with (G) and (I)";
    'I' 0.987_5 true Some("1-1-0"), "coexists with (G) and (H)";
    'J' 0.988_5 false Some("1-0"), "the paper's (2/4)A; here z = 1/2, one impact in 2 T";
    'K' 1.005_6 false None, "beyond the doubling of z = 2/3 (bifurcation 17)";
    'L' 1.369 false Some("1"), "just below s_SN (bifurcation 19)";
};

/// The letters at each frequency, as "A, B".
pub(crate) fn letters() -> Vec<(String, f64)> {
    let names = |group: &[Asked]| {
        let letters: Vec<String> = group.iter().map(|it| it.letter.to_string()).collect();
        (letters.join(", "), group[0].frequency)
    };
    let groups = MOTIONS.chunk_by(|a, b| a.frequency == b.frequency);
    groups.map(names).collect()
}
