"""The page of `softstop explore` in a headless Chromium: it computes what the program computes, and at once."""

import json
import random
import re
import shutil
import subprocess

import pytest
from conftest import PROGRAM, TOP, Explored
from playwright.sync_api import expect

SCENES = sorted(path.read_text() for path in (TOP / "docs" / "scenes").glob("*.toml"))
ONE_SIDED = [scene for scene in SCENES if "[stop.below]" not in scene]
ANSWERS = PROGRAM.parent / "examples" / "answers"


def native(questions):
    """What the engine of this computer answers."""
    lines = "\n".join(map(json.dumps, questions))
    run = subprocess.run([ANSWERS], input=lines, capture_output=True, text=True, check=True)
    return [json.loads(line) for line in run.stdout.splitlines()]


def random_machines(count):
    """Machines of all the scenes with other numbers, each with its description."""
    draw = random.Random(2003)
    machines = []
    while len(machines) < count:
        scene = draw.choice(ONE_SIDED)
        [[about, _]] = native([{"task": "machine", "machine": scene}])
        changes = [(it["key"], it["value"] * draw.uniform(0.6, 1.4)) for it in about["parameters"] if it["allowed"] != "share"]
        question = {"task": "machine", "machine": scene, "set": [(key, str(value)) for key, value in changes]}
        [[about, _]] = native([question])
        if "error" not in about:
            machines.append(about)
    return machines


def kinds(numbers):
    """Class, p and n of each motion of a diagram."""
    found, at = [], 0
    while at < len(numbers):
        found.append(numbers[at : at + 3])
        at += int(5 + numbers[at + 3] + 2 * numbers[at + 4])
    return found


def frequency(about):
    return next(it for it in about["parameters"] if it["key"].startswith("excitation.frequency"))


def test_the_regimes_of_200_random_machines_are_those_of_the_program(explore):
    page = explore()
    questions = []
    for about in random_machines(200):
        along = frequency(about)
        ends = {"from": 0.8 * along["value"], "to": 1.3 * along["value"], "columns": 8}
        asked = {"starts": about["starts"], "periods": 300, "longest": 2400}
        questions.append({"task": "diagram", "machine": about["toml"], "along": along["key"], **ends, **asked})
    count = 0
    for question, here, there in zip(questions, native(questions), page.ask(questions)):
        assert kinds(there[1]) == kinds(here[1]), question
        count += len(kinds(here[1]))
    assert count == 200 * 8 * 2


def test_zone_and_basins_are_those_of_the_program(explore):
    page = explore("loaded")
    zone = page.page.evaluate("state.branches.told.zone")
    program = json.loads(subprocess.run([PROGRAM, "zone", "loaded", "--format", "json"], capture_output=True, check=True).stdout)
    assert zone["g0"] == pytest.approx(program["frequency_g0"], rel=1e-9)
    assert zone["s_sn"] == pytest.approx(program["frequency_sn"], rel=1e-9)
    flips = [it["from"] for it in program["stretches"] if it["from_by"] == "flip"]
    assert zone["s_pd"] == pytest.approx(flips[-1], rel=1e-9)
    basin = {"task": "basin", "machine": page.page.evaluate("state.machine"), "reach": [20, 20], "cells": [16, 16]}
    basin |= {"rows": [0, 16], "periods": 200}
    assert page.ask([basin]) == native([basin])


@pytest.mark.skipif(not shutil.which("taskset"), reason="no taskset to keep the browser on one core")
def test_a_thousand_frequencies_of_200_periods_follow_the_hand(browser, chromium, write, tmp_path):
    """With -s it prints how long a redraw takes on one core."""
    on_one_core = tmp_path / "chromium"
    on_one_core.write_text(f'#!/bin/sh\nexec taskset -c 0 {chromium} "$@"\n')
    on_one_core.chmod(0o755)
    with browser.browser_type.launch(executable_path=on_one_core, args=["--no-sandbox"]) as own:
        page = Explored(own.new_page(), write("explore")).page
        times = page.evaluate(
            """async () => {
                const times = [], slider = byId('clearance');
                for (let k = 0; k < 100; k++) {
                    performance.clearMeasures();
                    // A machine so fast that the page asks for a thousand, however long the last ones took.
                    state.each = 0.01;
                    slider.value = 7 + k / 20;
                    slider.dispatchEvent(new Event('input'));
                    let drawn;
                    while (!([drawn] = performance.getEntriesByName('redrawn'))[0]) await new Promise(then => setTimeout(then, 1));
                    if (drawn.detail === 1000) times.push(drawn.duration);
                }
                return times;
            }"""
        )
    assert len(times) == 100
    times.sort()
    print(f"redrawn in {times[len(times) // 2]:.0f} ms (median), {times[int(0.95 * len(times))]:.0f} ms (95th percentile)")


def test_a_slider_a_click_and_a_link_lead_to_motions(explore):
    page = explore("unloaded")
    readout = page.page.locator("#readout")
    expect(readout).to_contain_text("z = 1")
    page.page.locator("#rest").click()
    expect(readout).to_contain_text("z = 0")
    # Beyond the fold the motion with impacts ends, and it does not come back by itself.
    page.page.locator("#thrown").click()
    expect(readout).to_contain_text("z = 1")
    slider = page.page.locator("#excitation-frequency")
    for value, motion in [(1.3, "z = 1"), (1.4, "z = 0"), (1.15, "z = 0")]:
        slider.evaluate("(it, value) => { it.value = value; it.dispatchEvent(new Event('input')); }", value)
        expect(readout).to_contain_text(motion)
    page.page.evaluate("pick(1.2, 8.2)")
    expect(readout).to_contain_text("z = 1")
    assert page.page.evaluate("[value(), state.motion.told.hardest]") == pytest.approx([1.2, 8.2], rel=0.02)
    link = page.page.locator("#permalink")
    link.evaluate("it => { it.removeAttribute('href'); settle(); }")
    expect(link).to_have_attribute("href", re.compile("^#.{50,}$"))
    numbers = page.page.evaluate("[state.about.parameters, state.about.start]")
    page.page.goto(page.page.url.split("#")[0] + link.get_attribute("href"))
    page.page.reload()
    page.wait()
    assert page.page.evaluate("[state.about.parameters, state.about.start]") == numbers


def test_the_keyboard_moves_the_machine_and_the_file_holds_it(explore):
    explored = explore("unloaded")
    page = explored.page
    page.locator("#clearance").focus()
    page.keyboard.press("ArrowRight")
    explored.until("number('clearance').value > 10")
    with page.expect_download() as download:
        page.wait_for_timeout(500)
        page.locator("#download").click()
    [[about, _]] = native([{"task": "machine", "machine": download.value.path().read_text()}])
    here = page.evaluate("state.about.parameters")
    assert about["parameters"] == here
    page.locator("#sound").click()
    assert page.locator("#sound").get_attribute("aria-pressed") == "true"
    assert "z = 1" in page.locator("#said").text_content()


def test_what_a_machine_cannot_be_is_said(explore):
    page = explore("unloaded").page
    box = page.locator("#main input[type=number]").first
    box.fill("1e30")
    box.press("Enter")
    expect(page.locator("#warning")).to_contain_text("clearance")


@pytest.mark.parametrize("scene", ["hertz", "piercing", "chaotic", "none", "chatter"])
@pytest.mark.parametrize("width", [390, 768, 1366])
def test_every_stop_fits_every_screen(explore, scene, width):
    page = explore(f"docs/scenes/{scene}.toml", viewport={"width": width, "height": 900}).page
    assert page.evaluate("document.documentElement.scrollWidth") == width
    text = page.locator("main").inner_text()
    assert not re.search("NaN|undefined|Infinity", text)


def test_the_page_is_small(write):
    assert write("explore").stat().st_size < 1_500_000
