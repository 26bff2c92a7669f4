//! Points of codimension two on curves of special points.

use super::GrazingTouch;

/// A bifurcation of codimension two.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum CodimensionTwo {
    /// Two curves of folds meet in a cusp (Kuznetsov 2004, section 9.2).
    Cusp,
    /// A flip whose normal form has no cubic term: between super- and subcritical (Kuznetsov 2004, section 9.4).
    GeneralisedFlip,
    /// Curves of folds and flips end on a curve of grazing: a weak impact has no bearing on the next (Simpson and Ghosh,
    /// arXiv 2602.22797).
    ResonantGrazing(GrazingTouch),
}

impl CodimensionTwo {
    /// The point of codimension two as a symbol: CP, GPD, RG.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Cusp => "CP",
            Self::GeneralisedFlip => "GPD",
            Self::ResonantGrazing(_) => "RG",
        }
    }

    /// The point of codimension two in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cusp => "cusp",
            Self::GeneralisedFlip => "generalised flip",
            Self::ResonantGrazing(_) => "resonant grazing",
        }
    }
}
