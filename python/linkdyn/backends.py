"""Who computes the shares of a study: thin adapters, each a generator that yields as shares come back.

All of them compute a share in one thread of a worker process. A worker that dies loses the share it was at; it is computed
again. Where the directory is not shared, workers hand back the chunks, and this process writes them. A directory is a path,
or a URL of fsspec, which every worker reaches by itself.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .store import Store

if TYPE_CHECKING:
    from .study import Study

__all__ = ["by_dask", "by_joblib", "by_ray", "by_this", "find"]

Place = Path | str
"""A directory, or the URL of one."""

Share = tuple[int, int]
Files = dict[str, bytes]


def find(name: str) -> Callable[..., Iterator[object]]:
    """The adapter of that name."""
    known: dict[str, Callable[..., Iterator[object]]] = {"ray": by_ray, "dask": by_dask, "joblib": by_joblib}
    if name not in known:
        raise ValueError(f"backend {name!r}: there are local, {', '.join(known)}")
    return known[name]


def compute(study: Study, share: Share, directory: str | None) -> Files:
    """Computes a share into the directory, or hands back its chunks where there is none."""
    if directory is not None:
        study.share(*share, directory, threads=1)
        return {}
    with tempfile.TemporaryDirectory() as folder:
        study.share(*share, folder, threads=1)
        chunks = Path(folder) / "chunks"
        return {path.name: path.read_bytes() for path in sorted(chunks.iterdir())}


def keep(files: Files, directory: Place) -> None:
    """Writes chunks that were handed back; each is there as a whole or not at all."""
    for name, content in files.items():
        if isinstance(directory, str):
            Store(directory).put(f"chunks/{name}", content)
            continue
        part = directory / "chunks" / f".{name}.{os.getpid()}"
        part.write_bytes(content)
        part.replace(directory / "chunks" / name)


def target(directory: Place, shared: bool) -> str | None:
    """Where workers write; nowhere if they hand back what they computed."""
    if not shared:
        return None
    return directory if isinstance(directory, str) else str(directory.resolve())


def by_this(
    study: Study, shares: list[Share], directory: Place, *, shared: bool = True, threads: int | None = None
) -> Iterator[object]:
    """Shares one after the other, in this process."""
    for share in shares:
        study.share(*share, directory, threads)
        yield share


def by_ray(
    study: Study,
    shares: list[Share],
    directory: Place,
    *,
    shared: bool = True,
    pending: int | None = None,
    retries: int = 5,
    options: dict[str, Any] | None = None,
) -> Iterator[object]:
    """Shares as tasks of Ray.

    :param pending: most tasks that are given out at once; by default two for each processor of the cluster.
    :param retries: how often a task is tried again whose worker died.
    :param options: more for ``ray.remote``, as in ``{"resources": {...}}``.
    """
    import ray

    if not ray.is_initialized():
        ray.init(log_to_driver=False)
    task = ray.remote(num_cpus=1, max_retries=retries, **(options or {}))(compute)
    most = pending or max(2, 2 * int(ray.cluster_resources().get("CPU", 1)))
    whole = ray.put(study)
    waiting: list[Any] = []
    rest = iter(shares)
    place = target(directory, shared)
    try:
        while True:
            for share in rest:
                waiting.append(task.remote(whole, share, place))
                if len(waiting) >= most:
                    break
            if not waiting:
                return
            ready, waiting = ray.wait(waiting)
            for one in ready:
                keep(ray.get(one), directory)
                yield one
    finally:
        for one in waiting:
            ray.cancel(one, force=True)


def by_dask(
    study: Study,
    shares: list[Share],
    directory: Place,
    *,
    shared: bool = True,
    client: Any = None,
    pending: int | None = None,
) -> Iterator[object]:
    """Shares as tasks of Dask's distributed scheduler; by default a cluster of processes on this machine."""
    from distributed import Client, as_completed

    own = client is None
    client = client or Client(processes=True, threads_per_worker=1)
    try:
        most = pending or 2 * max(1, sum(client.ncores().values()))
        place = target(directory, shared)
        rest = iter(shares)

        def give(share: Share) -> Any:
            return client.submit(compute, study, share, place, pure=False)

        done = as_completed([give(share) for share, _ in zip(rest, range(most), strict=False)])
        for one in done:
            keep(one.result(), directory)
            for share in rest:
                done.add(give(share))
                break
            yield one
    finally:
        if own:
            client.close()


def by_joblib(
    study: Study, shares: list[Share], directory: Place, *, shared: bool = True, jobs: int = -1
) -> Iterator[object]:
    """Shares as tasks of joblib, in processes."""
    from joblib import Parallel, delayed

    place = target(directory, shared)
    tasks = (delayed(compute)(study, share, place) for share in shares)
    for files in Parallel(n_jobs=jobs, return_as="generator", pre_dispatch="2*n_jobs", batch_size=1)(tasks):
        keep(files, directory)
        yield files
