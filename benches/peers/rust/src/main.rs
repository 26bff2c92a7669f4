//! The Rust peers of softstop as a worker: requests come in as lines of JSON, answers go out so. See
//! `benches/peers/run.py`, which asks, and `benches/peers/workers/serve.py`, its twin for Python.

mod exact;
mod peer_differential_equations;
mod peer_diffsol;
mod peer_ode_solvers;
mod request;

use std::io::{BufRead, Write};

use cpu_time::ProcessTime;

use request::{Answer, End, Request};

fn main() -> std::io::Result<()> {
    let mut output = std::io::stdout().lock();
    for line in std::io::stdin().lock().lines() {
        let answer = answer(&line?);
        serde_json::to_writer(&mut output, &answer)?;
        writeln!(output)?;
        output.flush()?;
    }
    Ok(())
}

fn answer(line: &str) -> Answer {
    let solved = serde_json::from_str(line)
        .map_err(|error| error.to_string())
        .and_then(|request| solve(&request));
    match solved {
        Ok((seconds, ends)) => Answer::Solved { seconds, ends },
        Err(error) => Answer::Failed { error },
    }
}

/// Solves for all frequencies in turn and takes the processor time.
fn solve(request: &Request) -> Result<(f64, Vec<End>), String> {
    let peer: fn(&Request, f64) -> Result<End, String> = match request.method.as_str() {
        "exact" => exact::solve,
        "diffsol-tsit45" => peer_diffsol::tsit45,
        "diffsol-bdf" => peer_diffsol::bdf,
        "ode_solvers-dop853" => peer_ode_solvers::dop853,
        "ode_solvers-dopri5" => peer_ode_solvers::dopri5,
        "differential-equations-dop853" => peer_differential_equations::dop853,
        "differential-equations-dop853-unlocated" => peer_differential_equations::dop853_unlocated,
        other => return Err(format!("no method {other}")),
    };
    let start = ProcessTime::now();
    let ends: Result<Vec<_>, _> = request
        .frequencies
        .iter()
        .map(|&frequency| peer(request, frequency))
        .collect();
    Ok((start.elapsed().as_secs_f64(), ends?))
}
