"""What the guide shows in Python runs as printed, block after block, and prints what it says."""

import ast
import re

import pytest
from conftest import TOP

BLOCK = re.compile(r"```python\n(.*?)```(?:\n\n```text\n(.*?)```)?", re.DOTALL)
TUTORIAL = TOP / "docs/tutorials/python.md"
NOTEBOOKS = sorted((TOP / "docs/notebooks").glob("*.md"))


def run(code, names):
    """Runs a cell and shows its last value as a notebook does."""
    body = ast.parse(code).body
    last = body.pop() if isinstance(body[-1], ast.Expr) else None
    exec(compile(ast.Module(body, []), "cell", "exec"), names)
    value = last and eval(compile(ast.Expression(last.value), "cell", "eval"), names)
    if hasattr(value, "_repr_mimebundle_"):
        assert any(kind.startswith("image/") for kind in value._repr_mimebundle_())


@pytest.mark.parametrize("page", [TUTORIAL, *NOTEBOOKS], ids=lambda page: page.stem)
def test_page(monkeypatch, tmp_path, capsys, page):
    (tmp_path / "docs/notebooks").mkdir(parents=True)
    for path in (TOP / "docs").iterdir():
        if path.name != "notebooks":
            (tmp_path / "docs" / path.name).symlink_to(path)
    monkeypatch.chdir(tmp_path if page == TUTORIAL else tmp_path / "docs/notebooks")
    monkeypatch.setenv("MPLBACKEND", "agg")
    names = {}
    for code, said in BLOCK.findall(page.read_text(encoding="utf-8")):
        run(code, names)
        assert capsys.readouterr().out == said
