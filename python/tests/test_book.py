"""The book's page about Python shows what is so."""

from __future__ import annotations

import doctest
from pathlib import Path

import pytest

BOOK = next((at / "docs" for at in Path(__file__).resolve().parents if (at / "docs" / "python.md").exists()), None)


@pytest.mark.skipif(BOOK is None, reason="the tests stand alone, without the book")
@pytest.mark.parametrize(("name", "count"), [("python", 15), ("cluster", 3)])
def test_a_page_of_the_book(name: str, count: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert BOOK is not None
    if name == "cluster":
        pytest.importorskip("fsspec")
    monkeypatch.chdir(tmp_path)
    page = BOOK / f"{name}.md"
    text = page.read_text("utf-8").replace("```", "")
    examples = doctest.DocTestParser().get_doctest(text, {}, page.name, str(page), 0)
    assert len(examples.examples) > count
    told: list[str] = []
    failed = doctest.DocTestRunner().run(examples, out=told.append)
    assert failed.failed == 0, "".join(told)
