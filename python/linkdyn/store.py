"""Directories that are URLs, for fsspec: object stores and the like.

There is nothing to append to and nothing to rename: files are written on this machine, and put there as whole objects.
"""

from __future__ import annotations

from os import PathLike, fspath
from pathlib import Path
from typing import Any

__all__ = ["Store", "is_url"]


def is_url(directory: str | PathLike[str]) -> bool:
    """Whether a directory is one of fsspec: ``s3://bucket/study``, and not a path."""
    return "://" in fspath(directory)


class Store:
    """A directory of fsspec."""

    def __init__(self, url: str) -> None:
        try:
            from fsspec.core import url_to_fs
        except ImportError as error:
            raise ImportError(f'{url} needs fsspec: pip install "linkdyn[store]"') from error
        found: tuple[Any, str] = url_to_fs(url)
        self._fs, root = found
        self._root = root.rstrip("/")

    def names(self, folder: str) -> set[str]:
        """Names of the files in a folder of it, as they are now."""
        self._fs.invalidate_cache()
        try:
            listed = self._fs.ls(f"{self._root}/{folder}".rstrip("/"), detail=False)
        except FileNotFoundError:
            return set()
        return {path.rstrip("/").rsplit("/", 1)[-1] for path in listed}

    def put(self, name: str, content: bytes) -> None:
        """Keeps a file; its name may have a folder before it."""
        path = f"{self._root}/{name}"
        self._fs.makedirs(path.rsplit("/", 1)[0], exist_ok=True)
        self._fs.pipe_file(path, content)

    def fetch(self, name: str, directory: Path) -> None:
        """Copies a file into a directory of this machine."""
        target = directory / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(self._fs.cat_file(f"{self._root}/{name}"))
