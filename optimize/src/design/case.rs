//! Cases: operating points beside that of the drawing, in which parameters have other values.

use softstop::Parameter;

/// What the drawing's operating point is called.
pub const DRAWING: &str = "drawing";

/// An operating point beside that of the drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// What it is called.
    pub name: String,
    /// Weight of what it has of what is sought, in units of that of the drawing; 0 if it only has to hold.
    pub weight: f64,
    /// The parameters that differ from the drawing's, in the machine's own units.
    pub changes: Vec<(Parameter, f64)>,
}

impl Case {
    /// The value that it gives to a parameter, if it changes that.
    pub fn value(&self, parameter: Parameter) -> Option<f64> {
        let mut all = self.changes.iter();
        all.find(|(own, _)| *own == parameter)
            .map(|(_, value)| *value)
    }
}
