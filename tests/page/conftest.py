"""Fixtures: the program, and the pages that it writes, in a headless Chromium."""

import json
import os
import pathlib
import shutil
import subprocess

import pytest
from playwright.sync_api import sync_playwright

TOP = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", TOP / "target")) / "release" / "softstop"
NAMES = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"]


class Watched:
    """A page of `softstop watch` in a browser, and the motion that it holds."""

    def __init__(self, page, file):
        self.page, self.errors = page, []
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("console", lambda said: said.type in ("error", "warning") and self.errors.append(said.text))
        page.on("request", lambda it: it.url != file.as_uri() and self.errors.append(it.url))
        page.goto(file.as_uri())
        self.motion = json.loads(page.locator("#motion").text_content())
        self.impacts = [hit for hit in self.motion["hits"] if hit["impact"]]

    def press(self, *keys):
        for key in keys:
            self.page.keyboard.press(key)

    def text(self, name):
        return self.page.locator(f"#now-{name}").text_content()

    def number(self, name):
        return float(self.text(name).replace("−", "-").replace(" ", ""))


@pytest.fixture(scope="session")
def browser():
    found = next(filter(None, map(shutil.which, NAMES)), None)
    if not found:
        pytest.skip(f"no Chromium is installed: none of {', '.join(NAMES)} is on the path")
    with sync_playwright() as playwright:
        # Without a sandbox it runs as root, too; the page is our own.
        browser = playwright.chromium.launch(executable_path=found, args=["--no-sandbox"])
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def write(tmp_path_factory):
    """Writes the page of a run, each run once."""
    files = {}

    def write(*arguments):
        if arguments not in files:
            file = tmp_path_factory.mktemp("page") / "watch.html"
            line = [PROGRAM, "watch", *arguments, "--output", file]
            subprocess.run(line, check=True, capture_output=True, cwd=TOP)
            files[arguments] = file
        return files[arguments]

    return write


@pytest.fixture
def watch(browser, write):
    """Opens the page of a run; what the page complains of fails the test."""
    opened = []

    def watch(*arguments, **screen):
        context = browser.new_context(**screen)
        watched = Watched(context.new_page(), write(*arguments))
        opened.append((context, watched))
        return watched

    yield watch
    for context, watched in opened:
        context.close()
        assert watched.errors == []
