"""No page has a serious fault that axe-core finds, on a wide and a narrow screen, light and dark."""

import pytest
from axe_playwright_python.sync_playwright import Axe
from conftest import Explored, Opened, Watched

PAGES = {
    "watch": (Watched, ["watch", "loaded", "--periods", "8"]),
    "explore": (Explored, ["explore", "loaded"]),
    "report": (Opened, ["optimize", "--samples", "1024"]),
}


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1366])
@pytest.mark.parametrize("name", PAGES)
def test_axe_finds_nothing_serious(opening, name, width, scheme):
    kind, words = PAGES[name]
    page = opening(kind, *words, viewport={"width": width, "height": 900}, color_scheme=scheme).page
    found = Axe().run(page).response["violations"]
    serious = [it for it in found if it["impact"] in ("serious", "critical")]
    assert not serious, [(it["id"], [node["html"] for node in it["nodes"]]) for it in serious]
