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


class Opened:
    """A page in a browser, and what it complains of; it needs nothing from elsewhere."""

    def __init__(self, page, file):
        self.page, self.errors, own = page, [], (file.as_uri(), "blob:")
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("console", lambda said: said.type in ("error", "warning") and self.errors.append(said.text))
        page.on("request", lambda it: it.url.startswith(own) or self.errors.append(it.url))
        page.goto(file.as_uri())


class Watched(Opened):
    """A page of `softstop watch`, and the motion that it holds."""

    def __init__(self, page, file):
        super().__init__(page, file)
        self.motion = json.loads(page.locator("#motion").text_content())
        self.impacts = [hit for hit in self.motion["hits"] if hit["impact"]]

    def press(self, *keys):
        for key in keys:
            self.page.keyboard.press(key)

    def text(self, name):
        return self.page.locator(f"#now-{name}").text_content()

    def number(self, name):
        return float(self.text(name).replace("−", "-").replace(" ", ""))


class Explored(Opened):
    """A page of `softstop explore`, once all that it shows is there."""

    def __init__(self, page, file):
        super().__init__(page, file)
        self.wait()

    def wait(self):
        self.until("byId('said').textContent && state.cells?.isLast && state.isPatient && state.branches")

    def until(self, condition):
        # The page's own policy refuses the eval of Playwright's function for this.
        for _ in range(600):
            if self.page.evaluate(f"Boolean({condition})"):
                return
            self.page.wait_for_timeout(50)
        pytest.fail(f"never: {condition}")

    def ask(self, questions):
        """What the engine of the page answers to questions: texts, each with numbers."""
        return self.page.evaluate(
            """questions => Promise.all(questions.map((question, k) => new Promise(resolve =>
                live.ask(`test ${k}`, () => question, ({ told, numbers }) => resolve([told, [...numbers]])))))""",
            questions,
        )


@pytest.fixture(scope="session")
def chromium():
    found = next(filter(None, map(shutil.which, NAMES)), None)
    if not found:
        pytest.skip(f"no Chromium is installed: none of {', '.join(NAMES)} is on the path")
    return found


@pytest.fixture(scope="session")
def browser(chromium):
    with sync_playwright() as playwright:
        # Without a sandbox it runs as root, too; the page is our own.
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def write(tmp_path_factory):
    """Writes the page of a command, each once."""
    files = {}

    def write(*words):
        if words not in files:
            folder = tmp_path_factory.mktemp("page")
            # A design has many files.
            is_design = words[0] == "optimize"
            file = folder / ("report.html" if is_design else "page.html")
            line = [PROGRAM, *words, "--output", folder if is_design else file]
            run = subprocess.run(line, capture_output=True, cwd=TOP, text=True)
            if "without the engine for pages" in run.stderr:
                pytest.skip("the page of the explorer: the program has no engine for it, see cargo xtask explorer")
            run.check_returncode()
            files[words] = file
        return files[words]

    return write


@pytest.fixture
def opening(browser, write):
    """Opens the page of a command; what the page complains of fails the test."""
    opened = []

    def opening(kind, *words, **screen):
        context = browser.new_context(**screen)
        opened.append((context, kind(context.new_page(), write(*words))))
        return opened[-1][1]

    yield opening
    for context, page in opened:
        context.close()
        assert page.errors == []


@pytest.fixture
def watch(opening):
    """Opens the page of a run."""
    return lambda *words, **screen: opening(Watched, "watch", *words, **screen)


@pytest.fixture
def explore(opening):
    """Opens the page of a machine."""
    return lambda *words, **screen: opening(Explored, "explore", *words, **screen)
