//! The work that an answer may cost.

use std::fmt;
use std::str::FromStr;

use anyhow::anyhow;
use clap::Args;
use serde::Serialize;
use softstop::internals::budget;

use crate::failure::Failure;
use crate::interrupt;

/// The option that limits the work.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Args)]
pub struct BudgetArguments {
    /// Work that the answer may cost, or each thousand steps of a sweep, cells of a basin or motions of models, in
    /// millions of scan windows; what would cost more is refused, the same on every computer
    #[arg(long, value_name = "MILLIONS", default_value_t = Budget::MACHINE)]
    pub budget: Budget,
}

/// Work that an answer may cost, in millions of scan windows. A window is the reciprocal of the fastest of drive and
/// free motion; a crossing costs as much as 64 of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Budget(u32);

impl Budget {
    /// For one machine: some ten seconds of a core.
    pub const MACHINE: Self = Self(2000);
    /// For a point of a study, of which there are many: some fifty times as much as one usually costs.
    pub const POINT: Self = Self(10);
    /// For each zone of a search, of which few cost that much.
    pub const ZONE: Self = Self(20);

    /// It in scan windows.
    pub fn windows(self) -> u64 {
        1_000_000 * u64::from(self.0)
    }

    /// What is said of an answer that would cost more.
    pub fn refusal(self) -> String {
        format!("not settled within --budget {self} (millions of scan windows)")
    }

    /// Does work within it. What came of that is discarded if it is spent.
    ///
    /// # Errors
    /// Those of the work; [`Failure::Run`] if it is over the budget.
    pub fn limit<T>(self, work: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
        self.limit_many(1, work)
    }

    /// Does work on many steps or cells within it for each thousand of them.
    ///
    /// # Errors
    /// As [`Budget::limit`].
    pub fn limit_many<T>(
        self,
        count: usize,
        work: impl FnOnce() -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let windows = self.windows().saturating_mul(count.div_ceil(1000) as u64);
        let (done, spent) = budget::run_within(windows, work);
        match done {
            _ if interrupt::requested() => Err(Failure::Interrupted),
            done if spent < windows => done,
            Err(Failure::Run(error)) => Err(anyhow!("{}: {error:#}", self.refusal()).into()),
            _ => Err(anyhow!(self.refusal()).into()),
        }
    }
}

impl fmt::Display for Budget {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(formatter)
    }
}

impl FromStr for Budget {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let millions = text.parse().ok().filter(|millions| *millions > 0);
        let most = u32::MAX;
        millions
            .map(Self)
            .ok_or(format!("must be a whole number, 1 to {most}"))
    }
}

#[cfg(test)]
mod tests {
    use super::Budget;
    use softstop::internals::budget::charge;

    #[test]
    fn what_is_over_budget_is_refused_whatever_came_of_it() {
        assert_eq!(Budget(1).limit(|| Ok(charge(999_999))).ok(), Some(true));
        let refused = Budget(1).limit(|| Ok(charge(1_000_000)));
        assert_eq!(
            refused.map_err(|failure| failure.to_string()),
            Err("error: not settled within --budget 1 (millions of scan windows)".to_owned())
        );
    }

    #[test]
    fn nothing_is_no_budget() {
        assert_eq!("7".parse(), Ok(Budget(7)));
        assert!("0".parse::<Budget>().is_err() && "-1".parse::<Budget>().is_err());
    }
}
