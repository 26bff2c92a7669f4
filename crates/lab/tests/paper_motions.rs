//! Figures 7 and 9 of the paper: their numbers against those known, and the files beside them.

use softstop_testing::tolerance::{DIFFERENCED, MOTION, printed};

use crate::figure::Figure;
use softstop_testing::report::Row;
use softstop_testing::{assert_near, number_in};

fn numbers(lines: &[Row], name: &str) -> Vec<f64> {
    lines.iter().map(|row| number_in(row, name)).collect()
}

#[test]
fn points_a_and_b_hit_as_hard_as_is_known() {
    let known = [
        ("7a", 10.260_591_34, 6.494_627_429_36),
        ("7b", 11.155_994_68, 8.398_675_591_86),
    ];
    for (name, max_position, velocity) in known {
        let figure = Figure::of(name);
        figure.near("X_m", max_position, printed(8));
        figure.near("X'_-", velocity, printed(11));
        let lines = figure.table(&format!("figure-{name}.csv"));
        let highest = numbers(&lines, "position").into_iter().fold(0.0, f64::max);
        assert!(highest <= max_position + 1e-8 && highest > max_position - 1e-3);
    }
}

#[test]
fn the_strip_is_pierced_on_the_way_forward_and_the_stop_pressed_between_d_and_e() {
    let figure = Figure::of("7b");
    let lines = figure.table("figure-7b.csv");
    let mut phases: Vec<&str> = lines.iter().map(|line| line["phase"].as_str()).collect();
    phases.dedup();
    assert_eq!(
        phases,
        ["free", "pierce", "cut", "stop", "cut", "pierce", "free"]
    );
    // Each passage costs speed; the preloaded stop gives back almost all.
    let velocity = |name: &str| figure.get(name);
    assert!(velocity("X'_-") > velocity("X'_C") && velocity("X'_C") > velocity("X'_D"));
    let restitution = -velocity("X'_E") / velocity("X'_D");
    assert!((0.98..1.0).contains(&restitution), "{restitution}");
    // The preload is a force of 70 F0: its jump at X_III is the largest of all.
    let highest = numbers(&lines, "contact_force")
        .into_iter()
        .fold(0.0, f64::max);
    assert!((70.0..73.0).contains(&highest), "{highest}");
}

#[test]
fn an_interrupted_supply_misses_no_stroke_at_b() {
    let figure = Figure::of("supply");
    for stop in ["stop fixed at rho + 0.9", "stop at rho without a strip"] {
        for runs in [2, 5, 25] {
            let told = format!("{stop}, runs of {runs}: motions with a missed stroke at B");
            assert_eq!(figure.get(&told), 0.0, "{told}");
        }
    }
}

#[test]
fn a_slow_change_of_the_clearance_seldom_leads_to_two_thirds() {
    let figure = Figure::of("ways");
    let told = "z = 2/3, 5e-4 per period: ways of 11";
    let (met, there) = (
        figure.get(&format!("{told} that meet it")),
        figure.get(&format!("{told} on it at rho = 10")),
    );
    assert!(there <= met && met < 11.0, "{there} of {met}");
}

#[test]
fn b_goes_farther_than_a_and_hits_harder() {
    let figure = Figure::of("7");
    figure.near(
        "X_m of B less that of A",
        11.155_994_68 - 10.260_591_34,
        printed(7),
    );
    figure.near(
        "X'_- of B over that of A",
        8.398_675_59 / 6.494_627_43,
        printed(7),
    );
}

#[test]
fn the_twelve_motions_are_found_and_are_what_the_paper_says() {
    let figure = Figure::of("9");
    let regimes = [
        ('A', 0.0, 1.0),
        ('C', 2.0, 21.0),
        ('D', 1.0, 10.0),
        ('F', 1.0, 9.0),
        ('H', 2.0, 4.0),
        ('I', 2.0, 3.0),
        ('J', 1.0, 2.0),
        ('L', 1.0, 1.0),
    ];
    for (letter, impacts, periods) in regimes {
        figure.near(&format!("({letter}) impacts p"), impacts, 0.0);
        figure.near(&format!("({letter}) periods n"), periods, 0.0);
        let modulus = figure.get(&format!("({letter}) largest multiplier, modulus"));
        let exponent = figure.get(&format!("({letter}) Lyapunov exponent per period"));
        assert!(modulus < 1.0, "({letter}) {modulus}");
        assert_near(exponent * periods, modulus.ln(), MOTION);
    }
    for letter in ['B', 'E', 'G', 'K'] {
        let exponent = figure.get(&format!("({letter}) Lyapunov exponent per period"));
        assert!(exponent > 0.0, "({letter}) {exponent}");
        assert!(figure.find(&format!("({letter}) periods n")).is_none());
    }
    figure.near("(B) mean life, periods", 15e3, 8e3);
    figure.near("(G) Lyapunov exponent per period", 0.137, 0.02);
    let lines = figure.table("figure-9.csv");
    let order = |letter: &str| {
        let line = lines.iter().find(|line| line["motion"] == letter);
        line.map(|line| line["order_of_impacts"].clone())
    };
    assert_eq!(order("H").as_deref(), Some("1-1-0-0"));
    assert_eq!(order("J").as_deref(), Some("1-0"));
    assert_eq!(lines.len(), 12);
}

#[test]
fn sections_return_and_chaos_is_shown_while_it_lasts() {
    let figure = Figure::of("9");
    let lines = figure.table("figure-9-section.csv");
    let count = |letter: &str| lines.iter().filter(|line| line["motion"] == letter).count();
    assert_eq!(["A", "C", "D", "H", "L"].map(count), [1, 21, 10, 4, 1]);
    // The chaos below grazing ends after some 15,000 periods; all 600 that are drawn have impacts.
    assert_eq!(["B", "E", "G", "K"].map(count), [600; 4]);
}

#[test]
fn from_soft_to_rigid_the_papers_five_points_in_numbers() {
    let figure = Figure::of("hardening");
    let of = |name: &str| figure.get(name);
    // (1) Without a stop worth the name all is reversible; z = 1 has folds only from some stiffness on.
    figure.near("(1) k2/k1 = 1: share of eta that is reversible", 1.0, 0.0);
    figure.near("(1) k2/k1 from which on z = 1 has folds", 1.92, 0.04);
    figure.near("(1) k2/k1 from which on s_SN lies beyond g0", 2.31, 0.05);
    // (2) Subharmonic and chaotic motions become more.
    let complex = [1.0, 3.0, 10.0, 100.0].map(|k| {
        of(&format!(
            "(2) k2/k1 = {k}: share of eta beyond z = 0 and z = 1"
        ))
    });
    assert!(
        complex.is_sorted() && complex[0] == 0.0 && complex[3] > 0.1,
        "{complex:?}"
    );
    // (3) The region of weak impacts is narrow, as 1/k2^2, and the hysteresis is not.
    figure.near("(3) k2/k1 = 10: width of weak z = 1", 2.379_027e-4, 1e-9);
    figure.near(
        "(3) k2/k1 = 10: width of hysteresis",
        0.111_243,
        DIFFERENCED,
    );
    let power = "(3) width of weak z = 1 goes with k2 to the power";
    figure.near(power, -2.0, 0.03);
    // (4) Other laws, the same fundamental motions; the others less so.
    for law in ["two slopes", "Hertz"] {
        let name = format!("(4) {law}, like k2/k1 = 10: share of eta with the same motion");
        assert!(of(&name) > 0.85, "{law}: {}", of(&name));
        let others = of(&format!("{name}, where either is neither z = 0 nor z = 1"));
        assert!(others < of(&name), "{law}: {others}");
    }
    // (5) z = 1/n of high order only where the impact-less motion exists too.
    for motion in figure.table("hardening-subharmonics.csv") {
        let high = motion["impacts"] == "1" && motion["periods"] != "2";
        assert!(
            !high || motion["beside_impactless_motion"] == "true",
            "{motion:?}"
        );
    }
}
