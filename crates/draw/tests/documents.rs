//! Documents: dark on dark screens, titles in lines, names of points on plates.

use softstop_draw::{Chart, Layer, Panel};

#[test]
fn a_document_is_dark_on_dark_screens_and_a_page_has_its_own_colours() {
    let chart = Chart::new("chart", [Panel::default()]);
    let dark = "@media screen and (prefers-color-scheme: dark)";
    assert_eq!(chart.svg().matches(dark).count(), 1);
    assert!(!chart.inline(str::to_owned).contains("<style>"));
}

/// A title takes one line where the page is as wide as it must be, and as many as it needs where it is not.
#[test]
fn a_title_is_not_cut() {
    let title = "Before-impact velocity over drive frequency and stiffness of the stop";
    let chart = Chart::new(title, [Panel::default()]);
    let lines = |chart: &Chart| chart.svg().matches("font-weight=\"bold\"").count();
    assert_eq!(lines(&chart), 1);
    let page = Some((480.0, 400.0));
    assert_eq!(lines(&Chart { page, ..chart }), 2);
}

#[test]
fn names_of_points_are_read_among_lines() {
    let layers = vec![Layer::label((0.5, 0.5), "point")];
    let panel = Panel {
        layers,
        ..Panel::default()
    };
    let svg = Chart::new("", [panel]).svg();
    let (before, _) = svg.split_once(">point</text>").unwrap_or_default();
    let plate = before.lines().rev().nth(1).unwrap_or_default();
    assert!(
        plate.contains("<rect") && plate.contains("fill=\"#ffffff\""),
        "{plate}"
    );
}
