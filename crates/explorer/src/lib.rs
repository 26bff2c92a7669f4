//! The engine for a page: it answers questions about one machine, each a text of JSON, with a text of JSON and numbers.
//!
//! A browser has it as WebAssembly, through the few functions of `browser`; programs and tests call [`answer`]. Both
//! compute the same motions.
//!
//! ```
//! use softstop::Machine;
//!
//! let machine = Machine::named("loaded").expect("the paper's").to_toml();
//! let question = serde_json::json!({ "machine": machine, "set": [["clearance", "10"]], "task": "machine" });
//! let answer = softstop_explorer::answer(&question.to_string());
//! assert!(answer.text.contains("before-impact velocity"));
//! ```

mod answer;
mod basin;
mod branches;
#[cfg(target_arch = "wasm32")]
mod browser;
mod diagram;
mod machine;
mod motion;

use serde::Deserialize;
use softstop::Machine;

pub use answer::Answer;
use answer::Answered;

/// A machine, what is changed in it, and what is asked about it.
#[derive(Debug, Deserialize)]
struct Question {
    /// The text of a machine file.
    machine: String,
    /// Keys of the file with their values.
    #[serde(default)]
    set: Vec<(String, String)>,
    #[serde(flatten)]
    task: Task,
}

/// What is asked.
#[derive(Debug, Deserialize)]
#[serde(tag = "task", rename_all = "snake_case")]
enum Task {
    /// What the machine is.
    Machine,
    /// The motions along a parameter.
    Diagram(diagram::Diagram),
    /// One motion.
    Motion(motion::Shown),
    /// Periodic motions along a parameter, stable or not.
    Branches(branches::Branches),
    /// What starts lead to.
    Basin(basin::Basin),
}

/// Answers a question; a text that is no question, and a machine that cannot be, with what is wrong as `error`.
pub fn answer(question: &str) -> Answer {
    serde_json::from_str(question)
        .map_err(|error| error.to_string())
        .and_then(|question: Question| question.answer())
        .unwrap_or_else(|error| Answer::new(&serde_json::json!({ "error": error }), Vec::new()))
}

impl Question {
    fn answer(&self) -> Answered {
        let machine = Machine::from_toml(&self.machine);
        let mut machine = machine.map_err(|error| error.to_string())?;
        let set = self.set.iter();
        let set = set.map(|(key, value)| (key.as_str(), value.as_str()));
        machine.apply(set).map_err(|error| error.to_string())?;
        match &self.task {
            Task::Machine => Ok(machine::describe(&machine)),
            Task::Diagram(diagram) => diagram.answer(&machine),
            Task::Motion(shown) => shown.answer(&machine),
            Task::Branches(branches) => branches.answer(&machine),
            Task::Basin(basin) => basin.answer(&machine),
        }
    }
}
