//! `softstop prove`: a periodic motion or its bifurcation, proven.

use std::path::PathBuf;

use anyhow::{Error, anyhow};
use clap::{Args, ValueEnum};
use nalgebra::Vector2;
use serde::Serialize;
use softstop::{Machine, Parameter, Scene, UnitSystem};
use softstop_dynamics::continuation::{SpecialKind, SpecialPoint, TestFunction};
use softstop_dynamics::{BranchLimits, Continuation, Orbit, ParameterFamily, Regime};
use softstop_prove::machine::Machine as Laws;
use softstop_prove::motion::Kind;
use softstop_prove::{Certificate, Claim, Interval, Touch};

use crate::continuation::seed;
use softstop_console::arguments::{CommandArguments, refuse_followers_of_frequency};
use softstop_console::column::Units;
use softstop_console::export::Export;
use softstop_console::failure::{Failure, check_interrupt};
use softstop_console::interrupt;
use softstop_console::output::{self, folder_and_file};
use softstop_console::record::Record;
use softstop_console::report::{self, stated_machine};
use softstop_console::table::{aligned, heading};

const EXAMPLES: &str = "\
Examples:
  softstop prove A
      the paper's point A exists, is the only motion near, is stable, and crosses nothing else
  softstop prove B --output b.json
      its point B, with six crossings
  softstop prove --at fold
      the fold s_SN at which the motion of point A ends
  softstop prove --set eta=0.9885 --orbit 1/2 --at flip
      the flip of z = 1/2, row 13 of the paper's Table 1
  softstop prove docs/scenes/kelvin-voigt.toml --set excitation.frequency=1.1
      any machine whose laws are linear, in SI units
  python examples/check_certificate.py proof.json
      proves it again, from the equations alone

Floating point finds the motion; interval arithmetic with outward rounding proves it. docs/proof.md says
what that means, and what is assumed. A motion that cannot be proven is an error: nothing is written.";

/// Arguments of `softstop prove`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ProveArguments {
    /// Motion to prove: p impacts in n drive periods, stable, found from scratch [default: 1/1]
    #[arg(long, value_name = "p/n", value_parser = seed::regime)]
    pub orbit: Option<Regime>,
    /// Prove the orbit nearest to this state at time 0, stable or not: that of --orbit p/n if given, else of one drive period
    #[arg(long, value_name = "X,V", value_parser = seed::state, allow_hyphen_values = true)]
    pub state: Option<Vector2<f64>>,
    /// Prove a bifurcation of the motion: the one at the nearest frequency of the drive on its branch
    #[arg(long, value_enum, value_name = "WHAT")]
    pub at: Option<Bifurcation>,
    /// The certificate to write
    #[arg(long, value_name = "FILE.json", default_value = "proof.json")]
    pub output: PathBuf,
    /// How it prints its result, the machine, and what it may cost.
    #[command(flatten)]
    pub common: CommandArguments,
}

/// Where a motion begins or ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Bifurcation {
    /// A saddle-node: a multiplier is 1
    Fold,
    /// A period doubling: a multiplier is -1
    Flip,
    /// A turning point of the motion touches a surface
    Grazing,
}

/// Frequencies, in units of the machine's own, between which a branch is followed, and its points in each direction.
const BRANCH: ((f64, f64), usize) = ((0.5, 2.0), 2000);

/// Proves the motion, writes the certificate and prints what it says.
pub fn run(arguments: &ProveArguments) -> Result<(), Failure> {
    let machine = arguments.common.machine_without_start()?;
    can_be_proven(&machine)?;
    if arguments.at.is_some() {
        refuse_followers_of_frequency(&machine)?;
    }
    let (folder, file) = folder_and_file(&arguments.output)?;
    let export = Export::of_file("json", folder, file)?;
    let limit = arguments.common.limit.budget;
    let certificate = limit.limit(|| prove(arguments, &machine.scene))?;
    let report = ProofReport::new(certificate, &machine);
    if !file.ends_with(".json") {
        export.file("json", output::json(&report)?.as_bytes())?;
    }
    export.finish(&report, report.text(), arguments.common.format)
}

/// Refuses a machine with a law that has no closed form.
///
/// # Errors
/// [`Failure::Usage`] naming it.
pub fn can_be_proven(machine: &Machine) -> Result<(), Failure> {
    let laws = Laws::new(&machine.scene);
    laws.map(drop)
        .map_err(|error| Failure::usage(error.to_string()))
}

fn prove(arguments: &ProveArguments, scene: &Scene) -> Result<Certificate, Failure> {
    let orbit = match arguments.state {
        None => seed::find(scene, arguments.orbit.unwrap_or(Regime::ONE))?,
        Some(state) => near(state, scene, arguments.orbit)?,
    };
    let proven = match arguments.at {
        None => Certificate::new(scene, orbit.state(), orbit.periods, Claim::Orbit),
        Some(wanted) => {
            let special = nearest(wanted, scene, &orbit)?;
            let claim = claim(scene, &special)
                .ok_or_else(|| anyhow!("no proof: the surface that is touched is not known"))?;
            let scene = scene.at_frequency(special.point.parameter);
            Certificate::new(&scene, special.point.state(), orbit.periods, claim)
        }
    };
    Ok(proven.map_err(Error::from)?)
}

/// The orbit nearest to a state; an error if a regime is wanted and it is another one.
fn near(state: Vector2<f64>, scene: &Scene, wanted: Option<Regime>) -> Result<Orbit, Failure> {
    let periods = wanted.unwrap_or(Regime::ONE).periods;
    let orbit = Orbit::find_periodic(scene, state, periods)
        .map_err(|error| anyhow!(error).context("no orbit to prove"))?;
    let found = orbit.regime();
    match wanted {
        Some(wanted) if wanted != found => Err(Failure::Run(anyhow!(
            "no orbit to prove: the one nearest to the state is z = {found}, not z = {wanted}"
        ))),
        _ => Ok(orbit),
    }
}

/// The special point of a kind on the branch of an orbit at the frequency nearest to that of its scene.
fn nearest(wanted: Bifurcation, scene: &Scene, orbit: &Orbit) -> Result<SpecialPoint, Failure> {
    let family = ParameterFamily::new(scene.clone(), [Parameter::Frequency])
        .map_err(|error| anyhow!(error))?;
    let own = scene.excitation.frequency;
    let ((low, high), points) = BRANCH;
    let limits = BranchLimits {
        range: (low * own, high * own),
        points,
    };
    let follower = Continuation::new(&family, orbit.periods);
    let branch = follower.branch(own, orbit.state(), &limits, |_| interrupt::go_on());
    let branch = branch.map_err(|error| anyhow!(error).context("no branch to follow"))?;
    check_interrupt()?;
    let away = |it: &SpecialPoint| (it.point.parameter - own).abs();
    let specials = branch.specials.into_iter();
    let specials = specials.filter(|it| wanted.is(it.kind));
    let name = format!("{wanted:?}").to_lowercase();
    let none = || anyhow!("no {name} found on the branch of the motion");
    let nearest = specials.min_by(|a, b| away(a).total_cmp(&away(b)));
    Ok(nearest.ok_or_else(none)?)
}

impl Bifurcation {
    /// Whether a special point of a kind is one.
    fn is(self, kind: SpecialKind) -> bool {
        match self {
            Self::Fold => kind == SpecialKind::Critical(TestFunction::Fold),
            Self::Flip => kind == SpecialKind::Critical(TestFunction::Flip),
            Self::Grazing => matches!(kind, SpecialKind::Grazing(_)),
        }
    }
}

/// What is to be proven of a special point.
fn claim(scene: &Scene, special: &SpecialPoint) -> Option<Claim> {
    match special.kind {
        SpecialKind::Critical(TestFunction::Fold) => Some(Claim::Fold),
        SpecialKind::Critical(TestFunction::Flip) => Some(Claim::Flip),
        SpecialKind::Critical(TestFunction::NeimarkSacker) | SpecialKind::Pitchfork => None,
        SpecialKind::Grazing(graze) => Some(Claim::Grazing(Touch {
            angle: graze.angle,
            position: graze.surface.surface_position(scene)?,
        })),
    }
}

/// What `softstop prove` reports: the certificate, and the machine as its user states it.
#[derive(Debug, Serialize)]
pub struct ProofReport<'a> {
    #[serde(flatten)]
    certificate: Certificate,
    #[serde(rename = "machine")]
    stated: Record,
    #[serde(skip)]
    machine: &'a Machine,
}

fn shown(interval: Interval) -> String {
    format!("[{:?}, {:?}]", interval.low(), interval.high())
}

/// A unit of the certificate, for people.
fn unit(machine: &Machine, name: &str) -> String {
    match machine.unit_system {
        UnitSystem::Ratios => String::new(),
        UnitSystem::Si | UnitSystem::Hertz => format!(" ({name})"),
    }
}

impl<'a> ProofReport<'a> {
    fn new(certificate: Certificate, machine: &'a Machine) -> Self {
        Self {
            certificate,
            stated: stated_machine(machine),
            machine,
        }
    }

    /// A proof of the motion of one drive period of a machine through a state at time 0.
    ///
    /// # Errors
    /// [`Failure::Run`] if there is none.
    pub fn of_single(machine: &'a Machine, state: Vector2<f64>) -> Result<Self, Failure> {
        let proof = Certificate::new(&machine.scene, state, 1, Claim::Orbit);
        Ok(Self::new(proof.map_err(Error::from)?, machine))
    }

    /// What is proven of the motion.
    pub fn figures(&self) -> Record {
        let proof = &self.certificate;
        let frequency = format!("drive frequency{}", unit(self.machine, "rad/s"));
        Record::default()
            .with("frequency", &frequency, shown(proof.frequency))
            .with("trace", "trace of the monodromy", shown(proof.trace))
            .with("determinant", "its determinant", shown(proof.determinant))
            .with("stability", "stability", proof.stability)
    }

    /// What people read.
    fn text(&self) -> String {
        let proof = &self.certificate;
        let regime = Regime {
            impacts: proof.impacts as u64,
            periods: proof.periods,
        };
        let figures = report::machine(self.machine, &[Parameter::Frequency]).and(self.figures());
        let unit = |name| unit(self.machine, name);
        let heads = [
            "from".to_owned(),
            "to".to_owned(),
            "drive angle (rad)".to_owned(),
            format!("position{}", unit("m")),
            format!("velocity{}", unit("m/s")),
            "parts of the arc after it".to_owned(),
        ];
        let count = proof.events.len();
        let rows = proof.events.iter().enumerate().map(|(index, it)| {
            let before = proof.events[(index + count - 1) % count].event.phase;
            let name = |phase: usize| proof.laws.phases[phase].name.clone();
            let boxes = proof.enclosure[3 * index..3 * index + 3]
                .iter()
                .map(|it| shown(*it));
            let parts = (it.division.len() - 1).to_string();
            let words = [name(before), name(it.event.phase)].into_iter();
            words.chain(boxes).chain([parts]).collect()
        });
        let rows: Vec<Vec<String>> = [heads.to_vec()].into_iter().chain(rows).collect();
        let title = match proof.claim {
            "orbit" => format!("Proven: a motion z = {regime}"),
            claim => format!("Proven: a {claim} of a motion z = {regime}"),
        };
        let events = match proof.events[0].event.event {
            Kind::Section => "No crossings; the motion at drive angle 0",
            Kind::Crossing | Kind::Touch => "Crossings and touches, the only ones",
        };
        heading(&title)
            + &figures.text(&Units::of(self.machine))
            + &format!("\n{events}\n")
            + &aligned(&rows, |index| index < 2)
    }
}
