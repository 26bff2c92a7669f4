//! Errors of the library: each names the parameter, its value and what is allowed.

use thiserror::Error;

use crate::error_message::{did_you_mean, key_hint, line_prefix, plain_number, rpm_value_hint};

/// Why a scene describes no machine.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// A parameter lies outside its range.
    #[error("{name} = {}: must be {allowed}", plain_number(*value))]
    OutOfRange {
        /// The parameter's name, as in TOML and in the FMU.
        name: &'static str,
        /// The value that was given.
        value: f64,
        /// The allowed range in words.
        allowed: &'static str,
    },
    /// Time scales so far apart that doubles do not resolve the shorter one.
    #[error(
        "{name} = {}: must be {bound} {} beside the other values of this machine; doubles do not resolve time scales \
         that lie farther apart",
        plain_number(*value), plain_number(*limit)
    )]
    TimeScales {
        /// The parameter's name, as in TOML and in the FMU.
        name: &'static str,
        /// The value that was given.
        value: f64,
        /// On which side of the limit it must lie: "at most", "at least".
        bound: &'static str,
        /// The last allowed value.
        limit: f64,
    },
    /// Something else of the stop below.
    #[error("of the stop below, {0}")]
    Below(Box<SceneError>),
    /// Stops on both sides that leave no way between them.
    #[error(
        "clearance = {} and stop.below.clearance = {}: their sum, the way between both stops, must be > 0",
        plain_number(*clearance), plain_number(*below)
    )]
    NoWay {
        /// Clearance of the stop above in m.
        clearance: f64,
        /// That of the stop below in m.
        below: f64,
    },
    /// A parameter that the machine does not have.
    #[error("{0}: this machine has no such parameter")]
    Lacks(&'static str),
    /// A strip without thickness and travel.
    #[error("piercing: thickness = {thickness} and travel = {travel} leave no room for a strip")]
    EmptyPiercing {
        /// Thickness of the strip in m.
        thickness: f64,
        /// Travel from the strip to the stop in m.
        travel: f64,
    },
    /// A piecewise linear stop without a slope.
    #[error("stop.loading: at least one slope is needed")]
    NoSlope,
    /// A slope that does not follow the one before it.
    #[error(
        "{list}[{index}]: from = {}, stiffness = {}: the first slope must begin at 0, each further \
         one beyond the one before it, and stiffness must be finite and >= 0, both at most 1e24",
        plain_number(*from), plain_number(*stiffness)
    )]
    Slope {
        /// Which of the two lists.
        list: &'static str,
        /// Which slope, counted from 0.
        index: usize,
        /// Deflection in m at which it begins.
        from: f64,
        /// Its stiffness in N/m.
        stiffness: f64,
    },
    /// An unloading curve above the loading curve.
    #[error(
        "stop.unloading: at a deflection of {deflection} m its force of {given} N must not exceed \
         that of stop.loading, {taken} N"
    )]
    GivesEnergy {
        /// The deflection in m.
        deflection: f64,
        /// Force of the unloading curve in N.
        given: f64,
        /// Force of the loading curve in N.
        taken: f64,
    },
}

/// What is wrong with a machine as its user states it, in a file or by changes.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MachineError {
    /// The text is no TOML, or a value is of another type.
    #[error("{0}")]
    Syntax(String),
    /// A key that no machine has.
    #[error(
        "{}{key}: unknown key{}{}; known are {known}",
        line_prefix(*line),
        did_you_mean(*meant),
        key_hint(key, *meant)
    )]
    UnknownKey {
        /// Its line in the file.
        line: Option<usize>,
        /// The key.
        key: String,
        /// What it may mean.
        meant: Option<&'static str>,
        /// The keys that there are.
        known: String,
    },
    /// A table that no file has.
    #[error("{}[{table}]: unknown table (did you mean [{meant}]?)", line_prefix(Some(*line)))]
    UnknownTable {
        /// The line of a key in it.
        line: usize,
        /// Its name.
        table: String,
        /// What it may mean.
        meant: &'static str,
    },
    /// A key that this machine does not have.
    #[error("{key}: this machine has no such parameter; it has {has}")]
    Lacks {
        /// The key.
        key: String,
        /// What it has.
        has: String,
    },
    /// A value out of its range.
    #[error("{}{source}", line_prefix(*line))]
    Value {
        /// Its line in the file.
        line: Option<usize>,
        /// What is wrong with it.
        source: SceneError,
    },
    /// A value that is no number.
    #[error("{}{key} = {value}: must be a number{}", line_prefix(*line), rpm_value_hint(value))]
    NotANumber {
        /// Its line in the file.
        line: Option<usize>,
        /// The key.
        key: String,
        /// The value.
        value: String,
    },
    /// An expression that gives no value of a parameter.
    #[error("{}{key} = {text:?}: {what}{}", line_prefix(*line), rpm_value_hint(text))]
    Expression {
        /// Its line in the file.
        line: Option<usize>,
        /// The key.
        key: String,
        /// The expression.
        text: String,
        /// What is wrong with it.
        what: String,
    },
    /// A parameter that cannot be changed by itself.
    #[error("{key}: follows others, as {text:?}; change those, or state it as a number")]
    Follows {
        /// The key.
        key: &'static str,
        /// Its expression.
        text: String,
    },
    /// A text that would act on a terminal, or break a file that it stands in.
    #[error("{key} = {value:?}: must have no control characters")]
    ControlCharacters {
        /// The key.
        key: &'static str,
        /// The text.
        value: String,
    },
    /// Two keys for one thing.
    #[error("{0} and {1}: only one of the two can be given")]
    Both(&'static str, &'static str),
    /// The letter of a ratio, and the key of a machine in SI units that is to be used instead.
    #[error("{0}: is a ratio, but this machine is in SI units; say {1}")]
    Ratio(String, &'static str),
    /// A key that is set twice.
    #[error("{0}: is set twice")]
    Twice(String),
    /// A key that every machine must state, and what it is for.
    #[error("missing key `{0}`: {1}")]
    Missing(&'static str, &'static str),
    /// A key in SI units in a file of ratios.
    #[error("{0}: must stand in [ratios]; only name, description and [initial] stand beside it")]
    BesideRatios(String),
    /// A value in the place of a table.
    #[error("{0}: must be a table")]
    NoTable(&'static str),
}

impl From<SceneError> for MachineError {
    fn from(source: SceneError) -> Self {
        Self::Value { line: None, source }
    }
}

/// Why a motion cannot begin or be carried on.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MotionError {
    /// The target time is not finite or lies before the present one.
    #[error("until = {until} s: must be finite and not before the present time {present} s")]
    TimeBackwards {
        /// The requested time in s.
        until: f64,
        /// The present time in s.
        present: f64,
    },
    /// An input is not finite.
    #[error("{name} = {value}: must be finite")]
    NotFinite {
        /// The input's name.
        name: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// A derivative of the external force is not finite.
    #[error("force: derivative of order {order} = {value}: must be finite")]
    ForceNotFinite {
        /// Its order; 0 is the force itself.
        order: usize,
        /// The value that was given.
        value: f64,
    },
    /// A derivative of the external force beyond the highest order.
    #[error("force: derivative of order {order} = {value}: must be 0 beyond order {highest}")]
    ForceOrder {
        /// Its order.
        order: usize,
        /// The value that was given.
        value: f64,
        /// The highest order that is honoured.
        highest: usize,
    },
    /// The motion left the range of floating-point numbers.
    #[error("the motion grew beyond all bounds near t = {time} s (position {position} m)")]
    Unbounded {
        /// The time in s up to which it is known.
        time: f64,
        /// The last position in m.
        position: f64,
    },
    /// The target time lies where the drive angle is no longer resolved.
    #[error("time = {until:?} s: must lie within {farthest:?} s of time 0")]
    TooFar {
        /// The requested time in s.
        until: f64,
        /// The farthest time in s.
        farthest: f64,
    },
    /// A state beyond a rigid stop.
    #[error("position = {position} m: must be {} {wall} m, where the rigid stop stands", if position < wall { ">=" } else { "<=" })]
    BeyondStop {
        /// The position in m.
        position: f64,
        /// Where the rigid stop stands, in m.
        wall: f64,
    },
    /// Crossings or steps pile up at one instant.
    #[error("the motion does not get on from t = {time} s, position {position} m")]
    Stalled {
        /// The time in s.
        time: f64,
        /// The position in m.
        position: f64,
    },
    /// A drive period of more work than any machine's within the limits of a scene.
    #[error(
        "one drive period takes too much work (some seconds), at t = {time} s, position {position} m"
    )]
    Endless {
        /// The time in s.
        time: f64,
        /// The position in m.
        position: f64,
    },
    /// The work that was allowed is done, and the motion has not come to its end.
    #[error("all work that the budget allows is done at t = {time} s")]
    OverBudget {
        /// The time in s that was reached.
        time: f64,
    },
    /// A snapshot that no machine left behind.
    #[error("the snapshot cannot be taken up: {what}")]
    Snapshot {
        /// What is wrong with it.
        what: &'static str,
    },
    /// A motion on a border, or at the end of what is summed: its neighbours do not change smoothly.
    #[error("the motion has no derivative by {name}")]
    NoDerivative {
        /// The parameter's name.
        name: &'static str,
    },
    /// The parameters are not those of a machine.
    #[error(transparent)]
    Scene(#[from] SceneError),
}
