//! Figure 8: the diagram of rho = 10, its zooms, and the bifurcations of Table 1.

mod chart;
mod isolated;

use anyhow::{Error, Result};
use softstop::{Parameter, Ratios};
use softstop_dynamics::{Chain, Direction, Plan, Step};

use crate::diagram::{self, Job};
use crate::figure::{self, Detail, Drawn, Figure, Findings, Studio};
use crate::table1::matching::{self, Match};
use crate::table1::{self, paper};

/// Fig. 8.
pub(crate) const FIGURE: Figure = Figure {
    title: "Bifurcation diagram of rho = 10 with zooms",
    files: &["figure-8.png", "figure-8.csv", "figure-8-bifurcations.csv"],
    draw,
};

/// A part of the diagram.
struct Part {
    /// Its letter, if it has one.
    name: &'static str,
    /// Range of eta.
    range: (f64, f64),
    /// Number of frequencies, and drive periods at each, for print and for a first look.
    size: [(usize, u64); 2],
}

const fn part(name: &'static str, range: (f64, f64), size: [(usize, u64); 2]) -> Part {
    Part { name, range, size }
}

static WHOLE: Part = part("", table1::RANGE, [(2200, 200), (200, 100)]);
/// The paper's sub-intervals; (d) without the stretch in which nothing happens.
static ZOOMS: [Part; 4] = [
    part("(a)", (0.952_624, 0.952_67), [(700, 800), (40, 200)]),
    part("(b)", (0.9533, 0.9563), [(800, 500), (60, 150)]),
    part("(c)", (0.9825, 0.9935), [(900, 300), (60, 150)]),
    part("(d)", (1.0, 1.05), [(500, 150), (60, 100)]),
];
/// Chaos below g0 lasts some thousand drive periods: faster sweeps down, side by side, show it while it lasts.
static FLEETING: Part = part("", (0.952_624, 0.952_656), [(600, 40), (30, 40)]);
const SIDE_BY_SIDE: usize = 8;

impl Part {
    fn size(&self, detail: Detail) -> (usize, u64) {
        detail.pick(self.size[0], self.size[1])
    }

    fn plan(&self, detail: Detail) -> Result<Plan> {
        let (steps, periods) = self.size(detail);
        Ok(Plan::new(Parameter::Frequency, self.range, steps, periods)?)
    }
}

/// A part as it was swept.
struct Diagram {
    part: &'static Part,
    /// The sweep up and the sweep down, over the same values.
    ways: Vec<Chain>,
    /// Faster sweeps down that show chaos which does not last.
    fleeting: Vec<Chain>,
}

/// A numbered bifurcation.
struct Bifurcation {
    number: usize,
    /// Where it was found.
    eta: f64,
    /// By the paper's symbols.
    symbols: String,
    /// True if it cannot be reversed.
    hysteresis: bool,
    /// The direction of eta in which it is met.
    direction: &'static str,
}

fn draw(studio: &Studio) -> Result<Drawn> {
    let detail = studio.detail;
    let ways = diagram::ways(&Ratios::unloaded().scene()?).to_vec();
    let jobs = vec![(WHOLE.plan(detail)?, ways)];
    let whole = diagram::sweep(jobs, "steps of the sweeps", studio.kept)?;
    let mut diagrams = vec![Diagram {
        part: &WHOLE,
        ways: whole,
        fleeting: Vec::new(),
    }];
    zooms(&mut diagrams, studio)?;
    let isolated = isolated::find(&diagrams, studio)?;
    let transitions = studio.transitions()?;
    let rows = paper::ROWS.iter();
    let matches = rows.filter_map(|row| Some((row.number, matching::find(row, transitions)?)));
    let bifurcations = matches.map(|(number, found)| numbered(number, &found));
    let bifurcations: Vec<Bifurcation> = bifurcations.collect();
    let chart = chart::chart(&diagrams, &isolated, &bifurcations, explanation(detail));
    let mut findings = Findings::default();
    findings.add("bifurcations found", bifurcations.len() as f64);
    for it in &bifurcations {
        findings.add(format!("eta of bifurcation {:02}", it.number), it.eta);
    }
    Ok(Drawn {
        files: vec![
            chart.png().map_err(Error::msg)?,
            table(&diagrams, &isolated)?,
            rows_table(&bifurcations)?,
        ],
        findings,
    })
}

/// Adds the zooms, each way going on from where the sweep over all frequencies is at their ends, and to the first the
/// chaos that does not last.
fn zooms(diagrams: &mut Vec<Diagram>, studio: &Studio) -> Result<()> {
    let detail = studio.detail;
    let mut jobs = Vec::new();
    for zoom in &ZOOMS {
        let plan = zoom.plan(detail)?;
        let ways = diagrams[0].ways.iter();
        jobs.extend(ways.map(|sweep| diagram::part_of(sweep, &plan)));
    }
    jobs.push(fleeting(detail)?);
    let mut chains = diagram::sweep(jobs, "steps of the zooms", studio.kept)?.into_iter();
    for zoom in &ZOOMS {
        diagrams.push(Diagram {
            part: zoom,
            ways: chains.by_ref().take(2).collect(),
            fleeting: Vec::new(),
        });
    }
    diagrams[1].fleeting = chains.collect();
    Ok(())
}

/// Sweeps down from chaos. Their machines differ by rounding only, so that the motions part.
fn fleeting(detail: Detail) -> Result<Job> {
    let chain = |index: usize| -> Result<Chain> {
        let mut machine = Ratios::unloaded();
        machine.clearance *= 1.0 + 1e-14 * index as f64;
        Ok(Chain::new(machine.scene()?, Direction::Down))
    };
    let chains = (0..SIDE_BY_SIDE).map(chain).collect::<Result<_>>()?;
    Ok((FLEETING.plan(detail)?, chains))
}

fn numbered(number: usize, found: &Match<'_>) -> Bifurcation {
    let transition = found.transition;
    let is_rising = transition.rising != found.is_reversed;
    Bifurcation {
        number,
        eta: found.eta,
        symbols: transition.symbols(),
        hysteresis: transition.hysteresis,
        direction: match (transition.hysteresis, is_rising) {
            (false, _) => "both",
            (true, true) => "up",
            (true, false) => "down",
        },
    }
}

fn explanation(detail: Detail) -> String {
    let (steps, periods) = WHOLE.size(detail);
    let zooms = ZOOMS.iter().map(|zoom| {
        let (steps, periods) = zoom.size(detail);
        format!("{} {steps} × {periods}", zoom.name)
    });
    let (fast, short) = FLEETING.size(detail);
    format!(
        "Peterka 2003, Fig. 8. Frequencies × drive periods, up and down: {steps} × {periods}; {}; \
         in (a) also {SIDE_BY_SIDE} fast ways down {fast} × {short}",
        zooms.collect::<Vec<String>>().join(", ")
    )
}

fn table(diagrams: &[Diagram], isolated: &[Step]) -> Result<Vec<u8>> {
    let mut sweeps = Vec::new();
    for diagram in diagrams {
        let name = match diagram.part.name {
            "" => "overview",
            name => name,
        };
        let ways = diagram.ways.iter().map(|it| (it.direction.name(), it));
        let fast = diagram.fleeting.iter().map(|it| ("down fast", it));
        sweeps.extend(
            ways.chain(fast)
                .map(|(way, it)| (name.to_owned(), way, &it.steps[..])),
        );
    }
    sweeps.push(("isolated".to_owned(), "either", isolated));
    diagram::table("part", sweeps)
}

fn rows_table(bifurcations: &[Bifurcation]) -> Result<Vec<u8>> {
    let rows = bifurcations.iter().map(|it| {
        let eta = format!("{:.10}", it.eta);
        (it.number, eta, &it.symbols, it.hysteresis, it.direction)
    });
    figure::table("number,eta,type,hysteresis,direction", rows)
}
