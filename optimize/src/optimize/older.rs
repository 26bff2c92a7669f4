//! Older words of a task, rewritten into the one form: `machine`, `set`, `[vary]`, `[require]`, `[search]`.

use softstop_console::failure::Failure;
use softstop_console::older::say_once;

use super::OptimizeArguments;
use super::task_spec::TaskSpec;
use super::toml_leaves::{leaves, number};
use super::vary::Variable;

/// Rewrites a task; says once what to write instead.
///
/// # Errors
/// [`Failure::Usage`] if older words contradict others.
pub(super) fn rewrite(task: &mut TaskSpec) -> Result<(), Failure> {
    let mut old = Vec::new();
    let mut new = Vec::new();
    let mut say = |is_said: bool, older: &'static str, newer: &'static str| {
        if is_said {
            old.push(older);
            new.push(newer);
        }
        is_said
    };
    let only_one = |words: &str| {
        let message = format!("{words}: only one of the two can be given");
        Err(Failure::usage(message))
    };
    let (regime, scene) = (task.regime.take(), std::mem::take(&mut task.scene));
    let changes = scene.changes();
    let has_scene = say(
        !changes.is_empty() || scene.regime.is_some(),
        "[scene]",
        "set",
    );
    if say(regime.is_some(), "regime", "machine") && scene.regime.is_some() {
        return only_one("regime and scene.regime");
    }
    if task.machine.is_some() && (regime.is_some() || has_scene) {
        return only_one("machine and scene");
    }
    task.machine = task
        .machine
        .take()
        .or(regime.or(scene.regime).map(|it| it.name().into()));
    task.set.extend(changes);
    if let Some(margin) = task.margin.take() {
        say(true, "margin", "require.margin");
        if task
            .require
            .insert("margin".to_owned(), margin.into())
            .is_some()
        {
            return only_one("margin and require.margin");
        }
    }
    if let Some(seed) = task.seed.take() {
        say(true, "seed", "search.seed");
        task.search.seed = Some(seed);
    }
    if let Some(evaluations) = task.evaluations.take() {
        say(true, "evaluations", "search.evaluations");
        task.search.evaluations = Some(evaluations);
    }
    let tables = [(task.fix.clone(), true), (task.bounds.clone(), false)];
    task.with_usual = task.vary.is_empty();
    for (table, is_held) in &tables {
        let (name, instead) = if *is_held {
            ("[fix]", "[vary] (numbers)")
        } else {
            ("[bounds]", "[vary]")
        };
        say(!table.is_empty(), name, instead);
        for (name, value) in leaves(table) {
            if number(value).is_some() != *is_held || value.is_table() {
                return Err(Failure::usage(format!(
                    "{name} = {value}: fix holds a number, bounds a range [low, high]"
                )));
            }
            if task.vary.insert(name.clone(), value.clone()).is_some() {
                return only_one(&format!("{name}: a value to hold and a range"));
            }
        }
    }
    say_once(&old.join(", "), &new.join(", "));
    Ok(())
}

/// What the command line says of searched values: `--vary`, and its older forms `--bounds` and `--fix`.
pub(super) fn variables(arguments: &OptimizeArguments) -> Vec<Variable> {
    let OptimizeArguments {
        vary, bounds, fix, ..
    } = arguments;
    let older = [("--bounds", bounds), ("--fix", fix)];
    let old = older
        .iter()
        .flat_map(|(flag, all)| all.iter().map(move |it| format!("{flag} {it}")));
    let new = older
        .iter()
        .flat_map(|(_, all)| all.iter().map(|it| format!("--vary {it}")));
    say_once(
        &old.collect::<Vec<_>>().join(" "),
        &new.collect::<Vec<_>>().join(" "),
    );
    [&vary[..], bounds, fix].concat()
}
