//! The list of the motions (A) to (L): frequency, and which of the motions there.

use softstop::{Ratios, Scene, SceneError};

/// A motion that the figure shows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked {
    /// Its letter.
    pub(super) letter: char,
    /// Its frequency eta.
    pub(super) frequency: f64,
    /// Whether the paper's text gives that frequency.
    pub(super) is_given: bool,
    /// Which of the motions there.
    pub(super) motion: Wanted,
    /// What else there is to say.
    pub(super) remark: &'static str,
}

/// Which of the motions at a frequency.
#[derive(Debug, Clone, Copy)]
pub(super) enum Wanted {
    /// The one that does not repeat.
    Chaos,
    /// The one with this order of impacts.
    Impacts(&'static str),
}

use Wanted::{Chaos, Impacts};

/// Motions: letter, frequency, whether the paper gives it, which one, and what else there is to say.
macro_rules! motions {
    ($($letter:literal $frequency:literal $is_given:literal $motion:expr, $remark:literal;)*) => {
        [$(Asked {
            letter: $letter,
            frequency: $frequency,
            is_given: $is_given,
            motion: $motion,
            remark: $remark,
        }),*]
    };
}

/// The motions. Sections 4 and the legend of Fig. 9 name (A) and (B), (D) and (E), (G) to (I) with their
/// frequencies; (C), (F) and (J) without, and (K) and (L) not at all: those here lie in the subintervals of
/// Fig. 8 in which the paper has them.
pub(super) const MOTIONS: [Asked; 12] = motions! {
    'A' 0.952_647_5 true Impacts("0"), "coexists with (B)";
    'B' 0.952_647_5 true Chaos, "coexists with (A); shown while it lasts";
    'C' 0.952_66 false Impacts("1-0-0-0-0-0-0-0-0-0-1-0-0-0-0-0-0-0-0-0-0"), "";
    'D' 0.953_65 true Impacts("1-0-0-0-0-0-0-0-0-0"), "coexists with (E)";
    'E' 0.953_65 true Chaos, "coexists with (D)";
    'F' 0.955_8 false Impacts("1-0-0-0-0-0-0-0-0"), "";
    'G' 0.987_5 true Chaos, "coexists with (H) and (I)";
    'H' 0.987_5 true Impacts("1-1-0-0"), "the paper's (2/4)B; coexists with (G) and (I)";
    'I' 0.987_5 true Impacts("1-1-0"), "coexists with (G) and (H)";
    'J' 0.988_5 false Impacts("1-0"), "the paper's (2/4)A: one impact in 2 T";
    'K' 1.005_6 false Chaos, "beyond the doubling of z = 2/3 (bifurcation 17)";
    'L' 1.369 false Impacts("1"), "just below s_SN (bifurcation 19)";
};

/// The letters at each frequency, as "A, B".
pub(crate) fn letters() -> Vec<(String, f64)> {
    let same = |a: &Asked, b: &Asked| a.frequency == b.frequency;
    let names = |group: &[Asked]| {
        let letters: Vec<String> = group.iter().map(|it| it.letter.to_string()).collect();
        (letters.join(", "), group[0].frequency)
    };
    MOTIONS.chunk_by(same).map(names).collect()
}

impl Asked {
    /// The machine.
    pub(super) fn scene(&self) -> Result<Scene, SceneError> {
        let ratios = Ratios::unloaded().at_frequency(self.frequency);
        ratios.scene()
    }
}
