//! Figure 8: the diagram of rho = 10, its zooms, and the bifurcations of Table 1.

mod band;
mod chart;
mod isolated;
mod names;

use anyhow::{Error, Result, anyhow};
use softstop::Ratios;
use softstop_dynamics::continuation::Parameter;
use softstop_dynamics::sweep::{Chain, Direction, Plan, Step};

use crate::diagram::{self, Job};
use crate::figure::{self, Detail, Drawn, Figure, Studio};
use crate::figure8::band::Bifurcation;
use crate::figure8::chart::{Diagram, NumberedChart};
use crate::figure9;
use crate::table1::matching::{self, Match};
use crate::table1::{self, paper};

/// Fig. 8.
pub(crate) const FIGURE: Figure = Figure {
    title: "Bifurcation diagram of rho = 10 with zooms",
    files: &["figure-8.png", "figure-8.csv", "figure-8-bifurcations.csv"],
    draw,
};

/// A part of the diagram: its letter, range, number of frequencies and drive periods at each, for print and for
/// a first look.
struct Part {
    name: &'static str,
    range: (f64, f64),
    full: (usize, u64),
    draft: (usize, u64),
}

const WHOLE: Part = part("", table1::RANGE, (2200, 200), (200, 100));
/// The paper's sub-intervals; (d) without the stretch in which nothing happens.
const ZOOMS: [Part; 4] = [
    part("(a)", (0.952_624, 0.952_67), (700, 800), (40, 200)),
    part("(b)", (0.9533, 0.9563), (800, 500), (60, 150)),
    part("(c)", (0.9825, 0.9935), (900, 300), (60, 150)),
    part("(d)", (1.0, 1.05), (500, 150), (60, 100)),
];

const fn part(
    name: &'static str,
    range: (f64, f64),
    full: (usize, u64),
    draft: (usize, u64),
) -> Part {
    Part {
        name,
        range,
        full,
        draft,
    }
}

/// Chaos below g0 lasts some thousand drive periods: faster sweeps down, side by side, show it while it lasts.
const FLEETING: Part = part("", (0.952_624, 0.952_656), (600, 40), (30, 40));
const SIDE_BY_SIDE: usize = 8;

fn draw(studio: &Studio) -> Result<Drawn> {
    let detail = studio.detail;
    let mut whole = [(
        plan(&WHOLE, detail)?,
        diagram::ways(&Ratios::unloaded().scene()?).to_vec(),
    )];
    diagram::sweep(&mut whole, "steps of the sweeps")?;
    let [(_, chains)] = whole;
    let mut overview = diagram(&WHOLE, chains)?;
    let (mut zooms, fleeting) = zooms(&overview, detail)?;
    let known: Vec<&Diagram> = zooms.iter().chain([&overview]).collect();
    let isolated = isolated::find(&known, detail)?;
    zooms[0].fleeting = fleeting;
    for diagram in zooms.iter_mut().chain([&mut overview]) {
        diagram.names = names::of(diagram, &isolated);
    }
    let transitions = studio.transitions()?;
    let rows = paper::ROWS.iter();
    let matches = rows.filter_map(|row| Some((row.number, matching::find(row, transitions)?)));
    let bifurcations: Vec<Bifurcation> =
        matches.map(|(number, it)| numbered(number, &it)).collect();
    let chart = NumberedChart {
        overview: &overview,
        zooms: &zooms,
        isolated: &isolated,
        bifurcations: &bifurcations,
        letters: &figure9::letters(),
        explanation: explanation(detail),
    };
    Ok(Drawn {
        files: vec![
            chart.png().map_err(Error::msg)?,
            table(&overview, &zooms, &isolated)?,
            rows_table(&bifurcations)?,
        ],
        findings: findings(&bifurcations),
    })
}

fn plan(part: &Part, detail: Detail) -> Result<Plan> {
    let (steps, periods) = detail.pick(part.full, part.draft);
    Ok(Plan::new(Parameter::Frequency, part.range, steps, periods)?)
}

/// The zooms, each way going on from where the sweep over all frequencies is at their ends, and the chaos
/// that does not last.
fn zooms(overview: &Diagram, detail: Detail) -> Result<(Vec<Diagram>, Vec<Chain>)> {
    let mut jobs = Vec::new();
    for zoom in &ZOOMS {
        let plan = plan(zoom, detail)?;
        let ways = overview.ways.iter();
        jobs.extend(ways.map(|sweep| diagram::part_of(sweep, &plan)));
    }
    jobs.push(fleeting(detail)?);
    diagram::sweep(&mut jobs, "steps of the zooms")?;
    let fleeting = jobs.pop().map_or_else(Vec::new, |job| job.1);
    let mut chains = jobs.into_iter().flat_map(|job| job.1);
    let zooms = ZOOMS
        .iter()
        .map(|zoom| diagram(zoom, chains.by_ref().take(2).collect()));
    Ok((zooms.collect::<Result<_>>()?, fleeting))
}

/// Sweeps down from chaos. Their machines differ by rounding only, so that the motions part.
fn fleeting(detail: Detail) -> Result<Job> {
    let chain = |index: usize| -> Result<Chain> {
        let mut machine = Ratios::unloaded();
        machine.clearance *= 1.0 + 1e-14 * index as f64;
        Ok(Chain::new(machine.scene()?, Direction::Down))
    };
    let chains = (0..SIDE_BY_SIDE).map(chain).collect::<Result<_>>()?;
    Ok((plan(&FLEETING, detail)?, chains))
}

fn diagram(part: &Part, chains: Vec<Chain>) -> Result<Diagram> {
    let ways = chains.try_into();
    Ok(Diagram {
        name: part.name,
        range: part.range,
        ways: ways.map_err(|_| anyhow!("{}: not swept up and down", part.name))?,
        fleeting: Vec::new(),
        names: Vec::new(),
    })
}

fn numbered(number: usize, found: &Match<'_>) -> Bifurcation {
    let transition = found.transition;
    Bifurcation {
        number,
        eta: found.eta,
        symbols: transition.symbols(),
        hysteresis: transition.hysteresis,
        rising: transition.rising != found.is_reversed,
    }
}

fn explanation(detail: Detail) -> String {
    let (steps, periods) = detail.pick(WHOLE.full, WHOLE.draft);
    let zooms: Vec<String> = ZOOMS
        .iter()
        .map(|zoom| {
            let (steps, periods) = detail.pick(zoom.full, zoom.draft);
            format!("{} {steps} × {periods}", zoom.name)
        })
        .collect();
    format!(
        "Peterka 2003, Fig. 8 and Table 1. Sweeps up and down: {steps} frequencies × {periods} drive periods; \
         zooms {}",
        zooms.join(", ")
    )
}

fn table(overview: &Diagram, zooms: &[Diagram], isolated: &[Step]) -> Result<Vec<u8>> {
    let columns = "part,direction,eta,z,max_position,before_impact_velocities";
    let row = |part: &str, way: &str, step: &Step| {
        (
            part.to_owned(),
            way.to_owned(),
            format!("{:.12}", step.value),
            diagram::name(&step.motion),
            format!("{:.6}", step.max_position),
            diagram::velocities(step),
        )
    };
    let of_diagram = |diagram: &Diagram| {
        let part = if diagram.name.is_empty() {
            "overview"
        } else {
            diagram.name
        };
        let ways = diagram
            .ways
            .iter()
            .map(|chain| (chain.direction.name(), chain));
        let fleeting = diagram.fleeting.iter().map(|chain| ("down fast", chain));
        let all = ways.chain(fleeting);
        let rows = all.flat_map(|(way, chain)| chain.steps.iter().map(move |step| (way, step)));
        rows.map(|(way, step)| row(part, way, step))
            .collect::<Vec<_>>()
    };
    let diagrams = std::iter::once(overview).chain(zooms).flat_map(of_diagram);
    let apart = isolated.iter().map(|step| row("isolated", "either", step));
    figure::table(columns, diagrams.chain(apart))
}

fn rows_table(bifurcations: &[Bifurcation]) -> Result<Vec<u8>> {
    let columns = "number,eta,type,hysteresis,direction";
    let rows = bifurcations.iter().map(|it| {
        let direction = match (it.hysteresis, it.rising) {
            (false, _) => "both",
            (true, true) => "up",
            (true, false) => "down",
        };
        (
            it.number,
            format!("{:.10}", it.eta),
            it.symbols.clone(),
            it.hysteresis,
            direction,
        )
    });
    figure::table(columns, rows)
}

fn findings(bifurcations: &[Bifurcation]) -> Vec<(String, f64)> {
    let found = ("bifurcations found".to_owned(), bifurcations.len() as f64);
    let each = bifurcations
        .iter()
        .map(|it| (format!("eta of bifurcation {:02}", it.number), it.eta));
    std::iter::once(found).chain(each).collect()
}
