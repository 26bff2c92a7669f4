//! Figure 8: the diagram of rho = 10, its zooms, and the bifurcations of Table 1.

mod chart;
mod isolated;

use anyhow::{Error, Result};
use serde::Deserialize;
use softstop::Ratios;
use softstop_dynamics::{Chain, Direction, SweepStep};

use crate::diagram::{self, Job, Part};
use crate::figure::{Detail, Drawn, Figure, Findings, Studio};
use crate::table1::matching::{self, Match};
use crate::table1::paper;
use softstop_console::columns;
use softstop_console::export::csv;

/// The whole diagram, its zooms, and sweeps side by side that show chaos while it lasts.
#[derive(Deserialize)]
struct Parts {
    whole: Part,
    zooms: Vec<Part>,
    fleeting: Part,
    side_by_side: usize,
}

/// A part as it was swept.
struct Diagram<'a> {
    part: &'a Part,
    /// The sweep up and the sweep down, over the same values.
    ways: &'a [Chain],
    /// Faster sweeps down that show chaos which does not last.
    fleeting: &'a [Chain],
}

/// A bifurcation with its number in Table 1.
type Bifurcation<'a> = (usize, Match<'a>);

pub(super) fn draw(studio: &Studio, figure: &Figure) -> Result<Drawn> {
    let detail = studio.detail;
    let parts: Parts = figure.get("parts")?;
    let ways = diagram::ways(&Ratios::unloaded().scene()?).to_vec();
    let jobs = vec![(parts.whole.plan(detail)?, ways)];
    let whole = diagram::sweep(jobs, "steps of the sweeps", studio.kept)?;
    let mut jobs = Vec::new();
    for zoom in &parts.zooms {
        // Each way goes on from where the sweep over all frequencies is at its end.
        let plan = zoom.plan(detail)?;
        jobs.extend(whole.iter().map(|sweep| diagram::part_of(sweep, &plan)));
    }
    jobs.push(fleeting(&parts, detail)?);
    let chains = diagram::sweep(jobs, "steps of the zooms", studio.kept)?;
    let (zooms, fleeting) = chains.split_at(2 * parts.zooms.len());
    let ways = [&whole[..]].into_iter().chain(zooms.chunks_exact(2));
    let all = [&parts.whole].into_iter().chain(&parts.zooms).zip(ways);
    let diagrams = all.enumerate().map(|(index, (part, ways))| Diagram {
        part,
        ways,
        fleeting: if index == 1 { fleeting } else { &[] },
    });
    let diagrams: Vec<Diagram<'_>> = diagrams.collect();
    let isolated = isolated::find(&diagrams, studio)?;
    let transitions = studio.transitions()?;
    let rows = paper::ROWS.iter();
    let matches = rows.filter_map(|row| Some((row.number, matching::find(row, transitions)?)));
    let bifurcations: Vec<Bifurcation<'_>> = matches.collect();
    let mut chart = chart::chart(figure, &diagrams, &isolated, &bifurcations)?;
    chart.subtitle = explanation(&parts, detail);
    let mut findings = Findings::default();
    findings.add("bifurcations found", bifurcations.len() as f64);
    for (number, it) in &bifurcations {
        findings.add(format!("eta of bifurcation {number:02}"), it.eta);
    }
    let columns = columns! { Bifurcation<'_>, it;
        "number" [None], "in Table 1" => it.0;
        "eta" [None], "drive frequency" => format!("{:.10}", it.1.eta);
        "type" [None], "in the paper's symbols" => it.1.transition.symbols();
        "hysteresis" [None], "whether it cannot be reversed" => it.1.transition.hysteresis;
        "direction" [None], "of eta in which it is met" => it.1.direction();
    };
    let files = [
        chart.png().map_err(Error::msg)?,
        table(&diagrams, &isolated)?,
        csv(&columns, &bifurcations)?,
    ];
    Ok(Drawn::new(files, findings))
}

/// Sweeps down from chaos. Their machines differ by rounding only, so that the motions part.
fn fleeting(parts: &Parts, detail: Detail) -> Result<Job> {
    let chain = |index: usize| -> Result<Chain> {
        let mut machine = Ratios::unloaded();
        machine.clearance *= 1.0 + 1e-14 * index as f64;
        Ok(Chain::new(machine.scene()?, Direction::Down))
    };
    let chains = (0..parts.side_by_side).map(chain).collect::<Result<_>>()?;
    Ok((parts.fleeting.plan(detail)?, chains))
}

fn explanation(parts: &Parts, detail: Detail) -> String {
    let (steps, periods) = parts.whole.size(detail);
    let zooms = parts.zooms.iter().map(|zoom| {
        let (steps, periods) = zoom.size(detail);
        format!("{} {steps} × {periods}", zoom.name)
    });
    let (fast, short) = parts.fleeting.size(detail);
    format!(
        "Peterka 2003, Fig. 8. Frequencies × drive periods, up and down: {steps} × {periods}; {}; \
         in (a) also {} fast ways down {fast} × {short}",
        zooms.collect::<Vec<String>>().join(", "),
        parts.side_by_side
    )
}

fn table(diagrams: &[Diagram], isolated: &[SweepStep]) -> Result<Vec<u8>> {
    let mut sweeps = Vec::new();
    for diagram in diagrams {
        let name = match &*diagram.part.name {
            "" => "overview",
            name => name,
        };
        let ways = diagram.ways.iter().map(|it| (it.direction.name(), it));
        let fast = diagram.fleeting.iter().map(|it| ("down fast", it));
        let ways = ways.chain(fast);
        sweeps.extend(ways.map(|(way, it)| (name.to_owned(), way, &it.steps[..])));
    }
    sweeps.push(("isolated".to_owned(), "either", isolated));
    diagram::table("part", sweeps)
}
