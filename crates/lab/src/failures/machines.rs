//! The machines of the atlas, whose stop's stiffness is swept.

use crate::methods::Task;
use crate::scenes::{BuiltIn, Case, built_in};
use softstop::{MotionError, PhaseKind, Scene, Slope, Stop};

use softstop_console::failure::Failure;

const BUILT_IN: [BuiltIn; 5] = built_in! {
    "failures/":
    "pressed", "failures/pressed", 1.0, "Pressed onto the stop: pure stability";
    "bounce", "failures/bounce", 1.0, "A bounce without losses: energy";
    "graze", "failures/graze", 2.0, "A graze: short contacts";
    "chatter", "failures/chatter", 1.0, "Bounces to rest: endlessly many events";
    "driven", "failures/driven", 3.0, "The driven machine: everything at once";
};

/// The one whose start depends on the stiffness: a start at a fixed depth would throw the mass off a stiff stop.
const PRESSED: &str = "failures/pressed";

/// Its depth at the start over that at rest.
const SETTLED: f64 = 0.9;

/// Drive periods that a user's scene runs unless the user says otherwise.
const PERIODS: f64 = 3.0;

/// All machines that come with the program.
///
/// # Errors
/// [`Failure::Usage`] if one of their files does not describe a machine.
pub fn built_in() -> Result<Vec<Case>, Failure> {
    let names = BUILT_IN.iter().map(|known| known.name);
    names.map(find).collect()
}

/// The one of this name, or of the scene file at this path.
///
/// # Errors
/// [`Failure::Usage`] if there is neither, or nothing to sweep.
pub fn find(place: &str) -> Result<Case, Failure> {
    let mut case = Case::find(place, &BUILT_IN, PERIODS)?;
    if with_stiffness(&case.machine.scene.stop, 1.0).is_none() {
        return Err(Failure::usage(format!(
            "{place}: stop.model: must have a stiffness to sweep: kelvinVoigt, piecewiseLinear, hertz or preloaded"
        )));
    }
    if case.reference.is_none() {
        case.title.clone_from(&case.name);
    }
    Ok(case)
}

impl Case {
    /// The task with a stop of this stiffness in N/m.
    pub fn with_stiffness(&self, stiffness: f64) -> Task {
        let mut task = self.task();
        if let Some(stop) = with_stiffness(&task.scene.stop, stiffness) {
            task.scene.stop = stop;
        }
        if self.reference == Some(PRESSED) {
            let scene = &task.scene;
            let load = -scene.stiffness * scene.clearance;
            task.start.position += SETTLED * (load / (scene.stiffness + stiffness));
        }
        task
    }
}

/// The law with another stiffness: of several slopes the first gets it, the others keep their ratios to it.
fn with_stiffness(stop: &Stop, stiffness: f64) -> Option<Stop> {
    let mut stop = stop.clone();
    match &mut stop {
        Stop::KelvinVoigt { stiffness: old, .. }
        | Stop::Preloaded { stiffness: old, .. }
        | Stop::Hertz { stiffness: old, .. } => *old = stiffness,
        Stop::PiecewiseLinear { loading, unloading } => {
            let first = loading.first().map(|slope| slope.stiffness);
            let factor = stiffness / first.filter(|first| *first > 0.0)?;
            let scale = |slope: &mut Slope| slope.stiffness *= factor;
            loading.iter_mut().chain(unloading).for_each(scale);
        }
        Stop::None | Stop::Rigid { .. } => return None,
    }
    Some(stop)
}

/// Angular frequency in rad/s and damping ratio of the machine on its stop, if contact is linear: on the
/// steepest slope, if there are several.
pub fn contact_mode(scene: &Scene) -> Option<(f64, f64)> {
    let stiffness = match &scene.stop {
        Stop::KelvinVoigt { stiffness, .. } | Stop::Preloaded { stiffness, .. } => *stiffness,
        Stop::PiecewiseLinear { loading, unloading } => loading
            .iter()
            .chain(unloading)
            .map(|slope| slope.stiffness)
            .fold(0.0, f64::max),
        Stop::None | Stop::Hertz { .. } | Stop::Rigid { .. } => return None,
    };
    let frequency = ((scene.stiffness + stiffness) / scene.mass).sqrt();
    let ratio = 0.5 * scene.contact_damping / (scene.mass * frequency);
    (frequency > 0.0).then_some((frequency, ratio))
}

/// Duration in s of the shortest whole contact of the true motion, if there is one.
///
/// # Errors
/// [`MotionError`] if the motion cannot be carried on.
pub fn shortest_contact(task: &Task) -> Result<Option<f64>, MotionError> {
    let trajectory = task.scene.trajectory_until(task.start, task.end())?;
    let arcs = &trajectory.arcs;
    let contacts = arcs.split(|arc| arc.kind == PhaseKind::Free);
    // The first and the last group touch the ends of the run: they may be parts of contacts.
    let groups = contacts.map(|contact| contact.iter().map(|arc| arc.duration).sum());
    let groups: Vec<f64> = groups.collect();
    let inner = groups.get(1..groups.len().saturating_sub(1));
    let inner = inner.unwrap_or_default().iter().copied();
    Ok(inner.filter(|it| *it > 0.0).min_by(f64::total_cmp))
}
