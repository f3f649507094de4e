"""The pieces of Python in the pages of the book compile, and those of a beginner run."""

import os
import re
from pathlib import Path

import gyration
import pytest

ROOT = Path(__file__).parents[3]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


def pieces(page: Path, language: str) -> list[str]:
    """The blocks of a language of a page."""
    return re.findall(rf"^```{language}\n(.*?)^```", page.read_text(encoding="utf-8"), re.M | re.S)


def test_all_pieces_compile() -> None:
    found = [(page.name, piece) for page in PAGES for piece in pieces(page, "python")]
    assert len(found) > 15
    for name, piece in found:
        compile(piece, name, "exec")


@pytest.mark.parametrize("page", [ROOT / "README.md"], ids=["README"])
def test_first_piece_draws_a_picture(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    exec(pieces(page, "python")[0], {})
    assert Path("dice.png").read_bytes().startswith(b"\x89PNG")


def test_pieces_of_the_page_on_python_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"gyration": gyration}
    first, scenes, bands, runs, loop, *_ = pieces(ROOT / "docs/python.md", "python")
    exec(first, names)
    # Of the scenes named there, `my.toml` is the reader's.
    exec("\n".join(line for line in scenes.splitlines() if "my.toml" not in line), names)
    exec(runs, names)
    exec(loop, names)


def test_answers_that_any_simulator_can_be_checked_by_come_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    page = ROOT / "docs/check-any-simulator.md"
    Path("tumble.toml").write_text(pieces(page, "toml")[0], encoding="utf-8")
    exec(pieces(page, "python")[0], {})
    said = capsys.readouterr().out
    assert said in page.read_text(encoding="utf-8"), said
    assert os.listdir() == ["tumble.toml"]
