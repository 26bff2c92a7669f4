//! The palette: a colour means one thing in all pictures. Most are Okabe and Ito's, told apart by colour-blind readers too
//! (<https://jfly.uni-koeln.de/color/>).

/// Lines and letters.
pub const INK: &str = "#222222";
/// The ground, and what is blank on another one.
pub const PAPER: &str = "#ffffff";
/// Lines at round values.
pub const GRID: &str = "#e9e9e9";
/// What stands beside the matter.
pub const ASIDE: &str = "#777777";
/// What stands far behind it.
pub const FAINT: &str = "#b4b4b4";

/// A design and its motions: z = 1.
pub const DESIGN: &str = motion::ONE;
/// What a design or a motion is compared with.
pub const REFERENCE: &str = "#E69F00";
/// The best, and what counts most.
pub const OPTIMUM: &str = "#D55E00";
/// What is allowed.
pub const ALLOWED: &str = "#56B4E9";
/// A single point, and the line of a single motion.
pub const POINT: &str = "#000000";

/// Seen on rising values alone, on falling ones alone, and on both.
pub const RISING: &str = DESIGN;
/// Seen on falling values alone.
pub const FALLING: &str = OPTIMUM;
/// Seen on rising and on falling values.
pub const BOTH_WAYS: &str = "#555555";
/// Seen on neither.
pub const NEITHER_WAY: &str = "#009E73";

/// Curves or motions in a row.
pub const SERIES: [&str; 4] = [DESIGN, REFERENCE, "#009E73", "#882255"];

/// Plasma (van der Walt and Smith 2015) from dark to light, as far as thin lines are seen on white.
const ORDERED: [&str; 6] = [
    "#0D0887", "#8004A8", "#AB2494", "#CC4778", "#E76F5A", "#FBA238",
];

/// The colour of one of a few curves whose parameter rises from the first to the last.
pub fn ordered(index: usize, count: usize) -> &'static str {
    let last = ORDERED.len() - 1;
    ORDERED[(index * last / count.saturating_sub(1).max(1)).min(last)]
}

/// Kinds of motion.
#[expect(missing_docs, reason = "named after the kinds")]
pub mod motion {
    pub const ZERO: &str = "#E4E4E4";
    pub const ONE: &str = "#0072B2";
    pub const DOUBLED: &str = "#56B4E9";
    pub const TWO_THIRDS: &str = "#009E73";
    pub const BETWEEN: &str = "#7FC8A0";
    pub const HALF: &str = "#E69F00";
    pub const PAIRED: &str = "#D55E00";
    pub const FEW: &str = "#AA4499";
    pub const MANY: &str = "#F0E442";
    pub const REST: &str = "#8A6D3B";
    pub const CHAOS: &str = "#000000";
    pub const UNSETTLED: &str = "#5A5A5A";
    pub const LOST: &str = super::PAPER;
    /// Those of motions in one picture whose kind has its colour from another motion.
    pub const OTHERS: [&str; 6] = [FEW, MANY, DOUBLED, TWO_THIRDS, HALF, PAIRED];
}

/// Where a motion begins, ends or loses its stability.
#[expect(missing_docs, reason = "named after the kinds")]
pub mod bifurcation {
    pub const FOLD: &str = "#D55E00";
    pub const FLIP: &str = "#CC79A7";
    pub const NEIMARK_SACKER: &str = "#009E73";
    pub const GRAZING: &str = super::POINT;
    pub const CODIMENSION_TWO: &str = super::INK;
}

/// Phases of a motion: tints, behind its line; free flight is white.
#[expect(missing_docs, reason = "named after the phases")]
pub mod phase {
    pub const PIERCE: &str = "#F4D48C";
    pub const CUT: &str = "#F8F3AA";
    pub const GAP: &str = "#E0E0E0";
    pub const STOP: &str = "#B3DDF5";
    pub const RELEASED: &str = "#8CD3C0";
    pub const CHATTER: &str = "#E8C3D7";
    pub const STUCK: &str = "#E28E4D";
    pub const RESTING: &str = "#A9A9A9";
}

/// Outcomes of a run: blues where the motion is right at least in kind, all others apart from them and from each other in
/// lightness too.
#[expect(missing_docs, reason = "named after the outcomes")]
pub mod verdict {
    pub const CONVERGED: &str = "#0072B2";
    pub const INACCURATE: &str = "#9CCDEC";
    pub const WRONG_COUNT: &str = "#F0E442";
    pub const MISSED_CONTACT: &str = "#009E73";
    pub const ENERGY_GAIN: &str = "#CC6D00";
    pub const BLOWN_UP: &str = "#3A3A3A";
    pub const STUCK: &str = "#7F3B08";
    pub const UNSUITED: &str = "#EEEEEE";
}

/// Methods of integration, by their kind; what ignores events is grey.
#[expect(missing_docs, reason = "named after the kinds")]
pub mod method {
    pub const EXACT: &str = "#000000";
    pub const FIRST_ORDER: &str = "#56B4E9";
    pub const RUNGE_KUTTA: &str = "#0072B2";
    pub const IMPLICIT: &str = "#009E73";
    pub const TIME_STEPPING: &str = "#882255";
    pub const DIFFSOL: &str = "#D55E00";
    pub const DIFFERENTIAL_EQUATIONS: &str = "#E69F00";
    pub const BLIND: &str = "#AAAAAA";
}

/// What stands for a colour in a page, light or dark.
const THEME: [(&str, &str); 10] = [
    (INK, "var(--ink)"),
    (POINT, "var(--ink)"),
    (PAPER, "var(--card)"),
    (GRID, "var(--grid)"),
    (ASIDE, "var(--aside)"),
    (DESIGN, "var(--design)"),
    (OPTIMUM, "var(--mark)"),
    (REFERENCE, "var(--reference)"),
    (ALLOWED, "var(--allowed)"),
    (motion::ZERO, "var(--still)"),
];

/// Elements of SVG, or other texts, with variables of the page in place of colours, which are in small letters there.
pub fn themed(elements: &str) -> String {
    let elements = elements.to_owned();
    let replace = |elements: String, (color, variable): (&str, &str)| {
        elements.replace(&color.to_lowercase(), variable)
    };
    THEME.into_iter().fold(elements, replace)
}

/// In a document on a dark screen light and dark change places, and colours keep their hue.
pub(crate) const DARK: &str = "<style>@media screen and (prefers-color-scheme: dark) { svg { filter: invert(.88) hue-rotate(180deg) } }</style>";

/// The letters.
pub(crate) const FONTS: &str = "DejaVu Sans, Helvetica, Arial, sans-serif";

/// Colours and letters of pages, light and dark, as CSS.
pub const PAGE: &str = include_str!("../assets/page.css");
