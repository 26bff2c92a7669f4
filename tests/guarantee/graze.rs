//! Grazing on purpose: a surface is put a hair's breadth from a highest point that the oracle finds.

use softstop::Stop;

use super::cases::{Case, Dice};
use super::law::Machine;
use super::motion::{Departure, Motion};

/// Moves a surface of the case next to a highest point of the motion: the clearance, or what lies
/// behind the first layer of contact.
pub fn aim(case: &mut Case, dice: &mut Dice) {
    let second = dice.once_in(3);
    let offset = 10f64.powf(-dice.range(1.0, 11.0)) * if dice.once_in(2) { -1.0 } else { 1.0 };
    if second {
        aim_behind(case, offset);
    } else {
        aim_first(case, offset, dice);
    }
}

fn aim_first(case: &mut Case, offset: f64, dice: &mut Dice) {
    let machine = Machine::new(&case.scene);
    let (start, angle) = (case.start, case.scene.excitation.phase);
    let span = case.periods * machine.period();
    let Some(motion) = depart(&machine, 0, start.position, start.velocity, angle, span) else {
        return;
    };
    let mut tops = tops(&motion, span, machine.frequency);
    tops.iter_mut().for_each(|top| *top += start.position);
    // Only a top that is higher than all before it is reached without a touch.
    let mut highest = start.position;
    tops.retain(|top| {
        let higher = *top > highest;
        highest = highest.max(*top);
        higher
    });
    if let Some(count) = u64::try_from(tops.len()).ok().filter(|count| *count > 0) {
        let top = tops[dice.below(count) as usize];
        case.scene.clearance = top + offset * (1.0 + top.abs());
    }
}

fn aim_behind(case: &mut Case, offset: f64) {
    let machine = Machine::new(&case.scene);
    let Some(depth) = first_depth(&machine, case) else {
        return;
    };
    let depth = depth + offset * (depth + 1e-3);
    if depth <= 0.0 {
        return;
    }
    let scene = &mut case.scene;
    if let Some(strip) = scene
        .piercing
        .as_mut()
        .filter(|strip| strip.thickness > 0.0)
    {
        strip.thickness = depth;
        return;
    }
    match (&mut scene.stop, &mut scene.rigid) {
        (Stop::PiecewiseLinear { loading, .. }, _) if loading.len() > 1 => {
            let shift = depth - loading[1].from;
            loading
                .iter_mut()
                .skip(1)
                .for_each(|slope| slope.from += shift);
        }
        (_, Some(rigid)) => rigid.travel = depth,
        _ => {}
    }
}

/// How deep the mass would go into the first layer of contact if that never ended.
fn first_depth(machine: &Machine, case: &Case) -> Option<f64> {
    let (start, angle) = (case.start, case.scene.excitation.phase);
    let face = machine.layers.get(1)?.from;
    if start.position >= face {
        return None;
    }
    let span = case.periods * machine.period();
    let free = depart(machine, 0, start.position, start.velocity, angle, span)?;
    let h = span / 1000.0;
    let above = |t: f64| start.position + free.at(t).u >= face;
    let hit = (1..=1000).map(|k| f64::from(k) * h).find(|t| above(*t))?;
    let touch = bisect(hit - h, hit, above);
    let speed = free.at(touch).v;
    let later = angle + machine.frequency * touch;
    let inside = depart(machine, 1, face, speed, later, span)?;
    let mut h = 1e-9 * span;
    let turned = |t: f64| inside.at(t).v <= 0.0;
    while !turned(h) {
        h *= 1.1;
        if h > span {
            return None;
        }
    }
    Some(inside.at(bisect(0.0, h, turned)).u)
}

fn depart(
    machine: &Machine,
    layer: usize,
    position: f64,
    velocity: f64,
    angle: f64,
    span: f64,
) -> Option<Motion> {
    let (forward, released) = (true, false);
    let at = Departure {
        layer,
        forward,
        released,
        position,
        velocity,
        angle,
    };
    Motion::new(machine, &at, span, &mut 5000)
}

fn tops(motion: &Motion, span: f64, frequency: f64) -> Vec<f64> {
    let count = (20.0 * span * frequency.max(3.0))
        .ceil()
        .clamp(50.0, 20_000.0);
    let h = span / count;
    let mut tops = Vec::new();
    let mut before = motion.at(0.0).v;
    for k in 1..=count as u32 {
        let t = f64::from(k) * h;
        let now = motion.at(t).v;
        if before > 0.0 && now <= 0.0 {
            let top = bisect(t - h, t, |t| motion.at(t).v <= 0.0);
            tops.push(motion.at(top).u);
        }
        before = now;
    }
    tops
}

/// Where a condition begins to hold.
fn bisect(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}
