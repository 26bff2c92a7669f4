//! Branches of twice the period, and orbits asked for at a multiple of theirs.

use super::*;
use softstop::Machine;
use softstop_dynamics::monitor::stop_if;
use softstop_dynamics::orbit;
use softstop_testing::tolerance::MOTION;
use softstop_testing::{assert_near, with_changes};

/// A rigid stop of restitution 1/2.
fn rigid() -> Frequencies {
    let scene = with_changes("unloaded", "eta=2.2 rho=0.2 stop.model=rigid R=0.5");
    ParameterFamily::new(scene, [Parameter::Frequency]).expect("a family")
}

/// Doublings accumulate at Feigenbaum's rate, 4.669.
#[test]
fn doublings_of_a_rigid_stop_are_feigenbaums() {
    let family = rigid();
    let limits = BranchLimits {
        range: (1.5, 3.0),
        points: 500,
    };
    let state = Vector2::new(-0.630_529, 0.062_449);
    let branch = follow(&family, 1, (2.2, state), limits.range);
    let flip = of_kind(&branch, "PD").remove(0).point;
    let next = |flip: &BranchPoint| {
        let continuation = Continuation::new(&family, flip.impacts.len() as u64);
        let mut first = None;
        let branch = continuation.double_period(flip, &limits, |point| {
            let is_positive = TestFunction::Flip.scaled_value(&point.monodromy) > 0.0;
            stop_if(*first.get_or_insert(is_positive) != is_positive)
        });
        let branch = branch.expect("doubled orbits");
        branch.critical_points(TestFunction::Flip).next().cloned()
    };
    let flips: Vec<BranchPoint> = std::iter::successors(Some(flip), next).take(5).collect();
    assert_eq!(flips.len(), 5);
    for (index, flip) in flips.iter().enumerate() {
        assert_eq!(flip.impacts.len(), 1 << index);
    }
    let gaps: Vec<_> = flips
        .windows(2)
        .map(|pair| pair[1].parameter - pair[0].parameter)
        .collect();
    assert_near(gaps[2] / gaps[3], 4.669, 0.05);
}

/// The paper's machine doubles once and then grazes: no cascade (PD -> ISN in its Table 1). The doubled
/// branch of z = 1 meets that of z = 1/2 where its second impact dies.
#[test]
fn the_doubled_branch_of_z1_grazes() {
    let z1 = all_of_z1();
    let flip = of_kind(&z1, "PD").remove(0).point;
    let doubled = double(&frequencies(1.15), 1, &flip);
    assert_eq!(doubled.periods, 2);
    assert!(matches!(doubled.ends.1, BranchEnd::Grazing));
    let dies = of_kind(&doubled, "G").remove(0).point;
    let half = branch(0.9886, 2, HALF, (0.9, 1.1));
    let born = of_kind(&half, "G").remove(1).point;
    assert_near(dies.parameter, born.parameter, 10.0 * MOTION);
}

/// An orbit of one period that is asked for as one of four is followed as one of one.
#[test]
fn the_shortest_period_is_found() {
    let branch = branch(1.15, 4, A, (1.1, 1.2));
    assert_eq!(branch.periods, 1);
    assert!(matches!(branch.ends, (BranchEnd::Range, BranchEnd::Range)));
    let (low, high) = (&branch.points[0], &branch.points[branch.points.len() - 1]);
    assert_near(low.parameter, 1.1, MOTION);
    assert_near(high.parameter, 1.2, MOTION);
}

/// A doubled branch that comes back to the orbit of half its period ends there.
#[test]
fn a_doubled_branch_merges_into_the_one_it_came_from() {
    let branch = branch(0.9886, 2, HALF, (0.9, 1.1));
    let flip = of_kind(&branch, "PD").remove(0).point;
    let family = frequencies(0.9886);
    let middle = &double(&family, 2, &flip).points[1];
    let from = (middle.parameter, middle.state());
    let back = follow(&family, 4, from, (0.9, 1.1));
    let ends = [
        (&back.ends.0, &back.points[0]),
        (&back.ends.1, &back.points[back.points.len() - 1]),
    ];
    let merged = ends
        .iter()
        .find(|(end, _)| matches!(end, BranchEnd::Merged));
    let (_, point) = merged.expect("one end is the flip");
    assert_near(point.parameter, flip.parameter, 10.0 * MOTION);
}

/// The doubled orbits between two flips of one branch end in the other one, wherever their section lies by then, as orbits of twice
/// the period: with a multiplier 1, and each impact twice.
#[test]
fn doubled_branches_end_in_the_next_flip_of_their_branch() {
    let kelvin_voigt = r#"
        mass = 0.344336
        stiffness = 2.83648
        damping = 0.119851
        clearance = 1.15113
        contact.damping = 0.0105357
        excitation = { amplitude = 0.586976, frequency = 3.21157, phase = 0.546143 }
        stop = { model = "kelvinVoigt", stiffness = 597.64349952, release = "clearance" }
        initial = { position = 0, velocity = 0 }
    "#;
    let piecewise_linear = r#"
        mass = 1.59043
        stiffness = 0.360398
        damping = 0.02
        clearance = 2.26294
        contact.damping = 0.0508691
        excitation = { amplitude = 0.600713, frequency = 0.482023, phase = -1.20584 }
        initial = { position = 0, velocity = 0 }
        [stop]
        model = "piecewiseLinear"
        loading = [{ from = 0.0, stiffness = 0.84597664132 }, { from = 0.32585, stiffness = 7.2816974308 }]
    "#;
    for machine in [kelvin_voigt, piecewise_linear] {
        let scene = Machine::from_toml(machine).expect("a machine").scene;
        let own = scene.excitation.frequency;
        let state = orbit::find(&scene).expect("an orbit").state();
        let family = ParameterFamily::new(scene, [Parameter::Frequency]).expect("a family");
        let range = (0.6 * own, 1.6 * own);
        let flips = of_kind(&follow(&family, 1, (own, state), range), "PD");
        let flip = &flips[0].point;
        let doubled = double_within(&family, 1, flip, range);
        assert!(
            matches!(doubled.ends.1, BranchEnd::Merged),
            "{:?}",
            doubled.ends
        );
        let last = doubled.points.last().expect("points");
        assert_eq!(last.impacts.len(), 2 * flip.impacts.len());
        assert_near(last.fold_test(), 0.0, SOLVED);
        let other = flips[1..]
            .iter()
            .find(|it| is_near(it.point.parameter, last.parameter, SOLVED));
        assert!(other.is_some(), "{last:?}");
    }
}

/// A stop so stiff that all of the doubled orbits from the flip beside grazing on lie within 1e-9 of its frequency: rounding tells
/// on no step where the halves change sides.
#[test]
fn doubled_branches_of_stiff_stops_end_in_a_flip() {
    for stiffness in [1e5, 1e6] {
        let contact = 0.18 * f64::sqrt(stiffness);
        let scene = with_changes(
            "unloaded",
            &format!(
                "damping=0.04 contact.damping={contact} stop.stiffness={stiffness} stop.preload=0"
            ),
        );
        let family = ParameterFamily::new(scene, [Parameter::Frequency]).expect("a family");
        let range = (0.9, 1.5);
        let branch = follow(&family, 1, (1.15, Vector2::new(6.9, 9.5)), range);
        let flips = of_kind(&branch, "PD");
        let doubled = double_within(&family, 1, &flips[1].point, range);
        assert!(
            matches!(doubled.ends.1, BranchEnd::Merged),
            "{:?}",
            doubled.ends
        );
        let last = doubled.points.last().expect("points");
        assert_near(last.parameter, flips[0].point.parameter, SOLVED);
        assert_eq!(last.impacts.len(), 2, "{stiffness}");
    }
}

/// Orbits of four periods end at a flip of those of two at which the weaker impact all but grazes.
#[test]
fn doubled_branches_end_beside_grazing() {
    let machine = include_str!("beside_grazing.toml");
    let scene = Machine::from_toml(machine).expect("a machine").scene;
    let own = scene.excitation.frequency;
    let state = orbit::find(&scene).expect("an orbit").state();
    let family = ParameterFamily::new(scene, [Parameter::Frequency]).expect("a family");
    let range = (0.6 * own, 1.6 * own);
    let flip = of_kind(&follow(&family, 1, (own, state), range), "PD").remove(0);
    let twice = of_kind(&double_within(&family, 1, &flip.point, range), "PD");
    let four = double_within(&family, 2, &twice[1].point, range);
    assert!(matches!(four.ends.1, BranchEnd::Merged), "{:?}", four.ends);
    let last = four.points.last().expect("points").parameter;
    assert_near(last, twice[0].point.parameter, SOLVED);
}

/// On the orbits of twice the period that begin at a flip, half the distance u of their two states grows as the coefficient c of
/// the normal form says: their multiplier is 1 - 4 c u^2. At a fold the multiplier changes by 2 a along the branch.
#[test]
fn coefficients_are_those_of_the_orbits_beside() {
    let family = rigid();
    let scene = |parameter: f64| family.scene([parameter]).expect("a scene");
    let state = Vector2::new(-0.630_529, 0.062_449);
    let branch = follow(&family, 1, (2.2, state), (1.5, 3.0));
    let flip = of_kind(&branch, "PD").remove(0).point;
    let at_flip = scene(flip.parameter);
    let found = normal_form_coefficient(&at_flip, 1, TestFunction::Flip, flip.state());
    let coefficient = found.expect("a motion").expect("a coefficient");
    assert!(coefficient > 0.0, "the cascade begins with a stable orbit");
    let doubled = double_within(&family, 1, &flip, (1.5, 3.0));
    let scales = at_flip.scales();
    let length = |way: Vector2<f64>| (way.x / scales.length).hypot(way.y / scales.speed());
    let measured = |point: &BranchPoint| {
        let map = StroboscopicMap::new(&scene(point.parameter).check().expect("a map"), 1);
        let half = 0.5 * length(map.image(point.state()).expect("a motion") - point.state());
        let multipliers = point.monodromy.multipliers();
        (half, (1.0 - multipliers[0].re) / (4.0 * half * half))
    };
    let nearest = doubled.points.iter().map(measured);
    let nearest = nearest.min_by(|a, b| a.0.total_cmp(&b.0)).expect("points");
    assert!(nearest.0 < 0.02, "{nearest:?}");
    assert_near(nearest.1 / coefficient, 1.0, 0.02);

    let z1 = all_of_z1();
    let fold = of_kind(&z1, "SN").remove(0).point;
    let at_fold = frequencies(1.15).scene([fold.parameter]).expect("a scene");
    let found = normal_form_coefficient(&at_fold, 1, TestFunction::Fold, fold.state());
    let coefficient = found.expect("a motion").expect("a coefficient");
    let scales = at_fold.scales();
    let place = z1.points.iter().position(|it| it.state() == fold.state());
    let place = place.expect("the fold is a point of the branch");
    let beside = |index: usize| {
        let point = &z1.points[index];
        let way = point.state() - fold.state();
        let way = (way.x / scales.length).hypot(way.y / scales.speed());
        (way, point.monodromy.multipliers()[0].re - 1.0)
    };
    let ((back, before), (on, after)) = (beside(place - 1), beside(place + 1));
    let change = (after / on * back - before / back * on) / (back + on);
    assert_near((change / (2.0 * coefficient)).abs(), 1.0, 0.02);
}
