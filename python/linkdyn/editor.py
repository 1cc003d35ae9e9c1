"""The editor in a notebook."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from typing import Any

import anywidget
import traitlets

from .errors import LinkdynError
from .model import Model, load

__all__ = ["Editor"]

_HERE = Path(__file__).parent
_PAGE = "editor.html"


class Editor(anywidget.AnyWidget):
    """A model that is drawn, dragged and typed in a notebook; :meth:`linkdyn.Model.edit` makes one.

    ``text`` is the text of the model file, ``parameters`` the numbers of its parameters in the file's units, ``height``
    that of the widget [pixels]. All are traits: they may be set, observed and linked. A text with faults leaves the
    parameters as they are.
    """

    _esm = _HERE / "editor.js"
    _page = traitlets.Unicode().tag(sync=True)
    text = traitlets.Unicode().tag(sync=True)
    parameters: traitlets.Dict[str, float] = traitlets.Dict(
        key_trait=traitlets.Unicode(), value_trait=traitlets.Float()
    ).tag(sync=True)
    height = traitlets.Int(720).tag(sync=True)

    def __init__(self, text: str, page: str | os.PathLike[str] | None = None, height: int = 720) -> None:
        super().__init__(_page=_page(page), text=text, height=height)

    @property
    def model(self) -> Model:
        """The model as it is now.

        :raises ModelError: with all faults of the text.
        """
        return load(self.text.encode())

    @traitlets.observe("text")
    def _read(self, _: Any) -> None:
        with suppress(LinkdynError):
            self.parameters = self.model._knobs()

    @traitlets.validate("parameters")
    def _numbers(self, proposal: Any) -> dict[str, float]:
        """Numbers of parameters that are left out stay.

        :raises TraitError: for names that the model has not.
        """
        wanted: dict[str, float] = proposal["value"]
        try:
            model = self.model
        except LinkdynError as fault:
            raise traitlets.TraitError(f"the text has faults, and no parameters: {fault}") from fault
        known = model._knobs()
        if unknown := wanted.keys() - known.keys():
            raise traitlets.TraitError(f"no parameter {min(unknown)!r}; there are {', '.join(known) or 'none'}")
        changed = {name: value for name, value in wanted.items() if value != known[name]}
        if changed:
            self.text = model._rewritten(changed)
        return {**known, **wanted}


def _page(path: str | os.PathLike[str] | None) -> str:
    """The page: one that is given, that of LINKDYN_EDITOR, or that of the package."""
    place = Path(path or os.environ.get("LINKDYN_EDITOR") or _HERE / _PAGE)
    if not place.is_file():
        raise FileNotFoundError(
            f"{place}: the page of the editor is not there; it comes with released wheels, and `node web/build.mjs` makes it"
            " as web/dist/editor.html: give it as edit(page=...) or in the environment as LINKDYN_EDITOR"
        )
    return place.read_text("utf-8")
