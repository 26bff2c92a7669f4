"""The page of `softstop watch` in a headless Chromium: what it shows is what its motion says."""

import re

import pytest
from conftest import TOP
from playwright.sync_api import expect

SCENES = sorted(path.name for path in (TOP / "docs" / "scenes").glob("*.toml"))
LOADED = ("loaded", "--periods", "8", "--missing-strips", "4:5")


def near(value):
    """Six digits are shown."""
    return pytest.approx(value, rel=6e-6, abs=1e-12)


def test_every_impact_is_shown_at_its_time(watch):
    page = watch(*LOADED)
    assert len(page.impacts) > 4
    for number, impact in enumerate(page.impacts, 1):
        page.press("Shift+ArrowRight")
        assert page.number("time") == near(impact["time"])
        assert page.number("x") == near(impact["position"])
        assert page.number("v") == near(impact["velocity_after"])
        assert page.number("before") == near(impact["velocity_before"])
        assert page.text("impact") == f"{number} of {len(page.impacts)}"
    assert page.page.locator("#on-impact").is_disabled()
    page.press("Shift+ArrowLeft")
    assert page.number("time") == near(page.impacts[-2]["time"])


def test_the_state_anywhere_is_that_of_the_samples(watch):
    page = watch("docs/scenes/rigid.toml", "--periods", "6")
    samples = page.motion["samples"]
    for index in range(7, len(samples["time"]) - 1, 97):
        time = samples["time"][index]
        page.page.locator("#at").evaluate("(it, t) => { it.value = t; it.oninput(); }", time)
        if time == samples["time"][index + 1]:
            continue
        assert page.number("time") == near(time)
        assert page.number("x") == pytest.approx(samples["position"][index], rel=1e-5, abs=1e-5)
        assert page.number("v") == pytest.approx(samples["velocity"][index], rel=1e-4, abs=1e-4)


def test_it_plays_pauses_and_ends(watch):
    page = watch(*LOADED)
    play = page.page.locator("#play")
    assert (play.text_content(), page.number("time")) == ("Play", 0)
    page.press("Space")
    expect(play).to_have_text("Pause")
    expect(page.page.locator("#at")).not_to_have_value(re.compile(r"^0(\.[01].*)?$"))
    page.press("Space")
    time = page.number("time")
    assert play.text_content() == "Play" and time > 0.2
    page.press("ArrowRight")
    assert page.number("time") == pytest.approx(time + page.motion["drive"]["period"] / 200, rel=1e-4)
    page.press("End", "Shift+ArrowLeft", "s", "+", "+", "+", "Space")
    expect(play).to_have_text("Play")
    assert page.number("time") == near(page.motion["span"][1])
    assert page.page.locator("#sound").get_attribute("aria-pressed") == "true"


def test_no_impact_passes_unheard(watch):
    page = watch("docs/scenes/chatter.toml", "--periods", "2")
    page.page.evaluate("() => { window.heard = []; strike = hit => heard.push(hit.time); }")
    page.press("s")
    page.page.evaluate("byId('speed').value = 0.5; play(true)")
    expect(page.page.locator("#play")).to_have_text("Play", timeout=60000)
    heard = page.page.evaluate("heard")
    assert heard == [hit["time"] for hit in page.motion["hits"]]


def test_strips_are_whole_pierced_and_missing(watch):
    page = watch(*LOADED)
    seen = []
    for time, _ in page.motion["strips"]:
        page.page.evaluate("to => go(to)", time)
        seen.append(page.text("strip"))
    assert seen == [state for _, state in page.motion["strips"]]
    assert {"whole", "pierced", "missing"} == set(seen)


@pytest.mark.parametrize("scene", SCENES)
def test_every_stop_is_drawn_without_a_fault(watch, scene):
    page = watch(f"docs/scenes/{scene}", "--periods", "4", viewport={"width": 375, "height": 800})
    for key in ["Home", "Shift+ArrowRight", "ArrowRight", "PageDown", "End"]:
        page.press(key)
        drawn = page.page.locator("main").inner_html()
        assert "NaN" not in drawn and "undefined" not in drawn and "Infinity" not in drawn
    assert page.page.evaluate("document.documentElement.scrollWidth") == 375


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_it_is_readable_in_light_and_dark(watch, scheme):
    page = watch(*LOADED, color_scheme=scheme)
    color = "getComputedStyle(document.{}).{}".format
    ink, ground = (page.page.evaluate(color("body", it)) for it in ("color", "backgroundColor"))
    bright = [sum(map(int, it.strip("rgb()").split(","))) for it in (ink, ground)]
    assert (bright[0] < bright[1]) == (scheme == "light") and abs(bright[0] - bright[1]) > 450
    page.page.emulate_media(media="print")
    assert not page.page.locator(".player").is_visible()
    assert page.page.locator("#portrait svg").is_visible()


def test_less_motion_where_it_is_asked_for(watch):
    page = watch(*LOADED, reduced_motion="reduce")
    axis = "document.querySelector('#position svg').textContent"
    before = page.page.evaluate(axis)
    page.press("Shift+ArrowRight", "ArrowRight")
    assert page.page.evaluate(axis) == before, "the series turn over like pages"
    assert page.page.locator("#machine .flash").count() == 0


def test_all_controls_have_names(watch):
    page = watch(*LOADED).page
    for control in page.locator("button, input, select").all():
        name = control.evaluate("it => it.ariaLabel || it.labels?.[0]?.textContent || it.textContent")
        assert name.strip()
    for picture in page.locator("svg:not([aria-hidden])").all():
        assert picture.get_attribute("aria-label")


@pytest.mark.parametrize("chart", ["position", "force", "portrait"])
def test_a_click_on_a_chart_seeks(watch, chart):
    page = watch(*LOADED)
    svg = page.page.locator(f"#{chart} svg")
    box = svg.bounding_box()
    times = []
    for share in (0.3, 0.6):
        svg.click(position={"x": share * box["width"], "y": box["height"] / 2})
        times.append(page.number("time"))
    samples = page.motion["samples"]
    assert samples["time"][0] < times[0] != times[1] < samples["time"][-1]
    if chart != "portrait":
        assert times[0] < times[1] < 4 * page.motion["drive"]["period"]


def test_the_phase_plane_is_seen_at_once_and_targets_are_large(watch):
    page = watch(*LOADED, viewport={"width": 1366, "height": 900}).page
    box = page.locator("#portrait svg").bounding_box()
    assert box["y"] + box["height"] < 900
    for control in page.locator("button, select, input").all():
        assert control.bounding_box()["height"] >= 44
