"""Seeds on several ranks: threads that meet, and ranks of MPI."""

import os
import pathlib
import shutil
import subprocess
import sys
import threading

import numpy as np
import pytest

import powercell as pc
from powercell import _distributed


class Boom(Exception):
    pass


class Threads:
    """What the ranks of a group share: places for messages, and a barrier that breaks if one does not come."""

    def __init__(self, size):
        self.size = size
        self.barrier = threading.Barrier(size, timeout=60)
        self.letters = [None] * size


class Rank:
    """A rank that is a thread, with the part of mpi4py's interface that is needed."""

    def __init__(self, group, rank):
        self.group, self.rank = group, rank

    def Get_rank(self):
        return self.rank

    def Get_size(self):
        return self.group.size

    def allgather(self, value):
        return [letters[self.rank] for letters in self._meet([value] * self.group.size)]

    def alltoall(self, values):
        assert len(values) == self.group.size and all(isinstance(value, bytes) for value in values)
        return [letters[self.rank] for letters in self._meet(values)]

    def _meet(self, values):
        self.group.letters[self.rank] = values
        self.group.barrier.wait()
        letters = list(self.group.letters)
        self.group.barrier.wait()  # nobody writes the next ones before all have these
        return letters


def on_ranks(size, work):
    """What work(comm) returns or raises on each rank."""
    group, results = Threads(size), [None] * size

    def run(rank):
        try:
            results[rank] = work(Rank(group, rank))
        except BaseException as error:
            results[rank] = error

    threads = [threading.Thread(target=run, args=(rank,)) for rank in range(size)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return results


def compare(whole, all_ids, own, cells):
    assert np.array_equal(cells.status, whole.status[own])
    np.testing.assert_allclose(cells.mass, whole.mass[own], rtol=0, atol=1e-13 * whole.mass.mean())
    there = cells.mass > 0
    np.testing.assert_allclose(cells.centroid[there], whole.centroid[own][there], atol=1e-12)
    np.testing.assert_allclose(cells.second_moment, whole.second_moment[own], rtol=1e-9, atol=1e-15)
    assert cells.domain_measure == whole.domain_measure
    assert len(cells.indptr) == len(own) + 1 and len(cells.data) == len(cells.indices)
    for place, seed in enumerate(own):
        assert np.array_equal(cells.neighbors(place), all_ids[whole.adjacency.neighbors(seed)])


@pytest.mark.parametrize("ranks, redistribute", [(1, False), (3, False), (3, True), (4, True)])
def test_cells_are_those_of_one_diagram(rng, cube, ranks, redistribute):
    positions, weights = rng.random((1200, 3)), 0.02 * rng.random(1200)
    ids = np.arange(1200, dtype=np.int64) * 10**12 + 7  # ascending, so that ties are decided alike
    whole = pc.Diagram(cube, positions, weights)
    assert (whole.status == pc.Status.HIDDEN).any()
    # The last rank has no seeds; of the others each has those at random, in an order of its own.
    share = rng.integers(0, max(1, ranks - 1), 1200)
    order = [rng.permutation(np.flatnonzero(share == rank)) for rank in range(ranks)]

    def work(comm):
        own = order[comm.Get_rank()]
        return pc.compute_distributed(
            comm, cube, ids[own], positions[own], weights[own], redistribute=redistribute, threads=1
        )

    found = on_ranks(ranks, work)
    for own, cells in zip(order, found):
        assert not isinstance(cells, BaseException), cells
        compare(whole, ids, own, cells)
        assert cells.report.rounds == found[0].report.rounds >= 1
        assert cells.shift is None
        assert cells.report.fetched == found[0].report.fetched
    assert (found[0].report.fetched > 0) == (ranks > 1)
    assert (found[0].report.redistributed > 0) == redistribute
    assert "seeds" in repr(found[0])
    with pytest.raises(IndexError, match="0 to"):
        found[0].neighbors(len(order[0]))
    with pytest.raises(ValueError, match="read-only"):
        found[0].mass[:] = 0


def test_walls_of_a_periodic_box_have_shifts(rng):
    box = pc.Domain.box([0, 0, 0], [1, 1, 1], periodic=(True, False, True))
    positions, ids = rng.random((300, 3)), np.arange(300)
    positions[::7, 0] += 2
    whole = pc.Diagram(box, positions)
    order = [ids[0::2], ids[1::2], ids[:0]]
    found = on_ranks(3, lambda comm: pc.compute_distributed(comm, box, order[comm.Get_rank()], positions[order[comm.Get_rank()]]))
    for own, cells in zip(order, found):
        assert not isinstance(cells, BaseException), cells
        compare(whole, ids, own, cells)
        assert cells.shift.shape == (len(cells.data), box.dimension)
        for place, seed in enumerate(own):
            begin, end = whole.adjacency.indptr[seed : seed + 2]
            assert np.array_equal(cells.shift[cells.indptr[place] : cells.indptr[place + 1]], whole.adjacency.shift[begin:end])


def test_long_messages_go_in_pieces(rng, square, monkeypatch):
    monkeypatch.setattr(_distributed, "_MOST_BYTES", 1000)
    positions = rng.random((400, 2))
    whole, ids = pc.Diagram(square, positions), np.arange(400)
    cells = on_ranks(
        2, lambda comm: pc.compute_distributed(comm, square, ids[comm.Get_rank() :: 2], positions[comm.Get_rank() :: 2])
    )
    for rank in range(2):
        compare(whole, ids, ids[rank::2], cells[rank])


def codes_and_texts(results):
    assert all(isinstance(error, pc.Error) for error in results), results
    return {(error.code, str(error)) for error in results}


def test_errors_are_those_of_all_ranks(rng, square, cube):
    positions = rng.random((60, 2))

    def part(comm, **changed):
        rank = comm.Get_rank()
        given = {"domain": square, "ids": np.arange(20) + 20 * rank, "positions": positions[20 * rank :][:20].copy()}
        return {**given, **{key: change(given[key]) for key, change in changed.items() if rank == 1}}

    def bad_row(rows):
        rows[3, 1] = np.nan
        return rows

    errors = codes_and_texts(on_ranks(3, lambda comm: pc.compute_distributed(comm, **part(comm, positions=bad_row))))
    assert len(errors) == 1 and next(iter(errors))[0] == "invalid_seed" and "23" in next(iter(errors))[1]
    errors = codes_and_texts(on_ranks(3, lambda comm: pc.compute_distributed(comm, **part(comm, ids=lambda ids: ids * 0 + 5))))
    assert len(errors) == 1 and "id 5" in next(iter(errors))[1]
    other = pc.Domain.box([0, 0], [2, 1])
    errors = codes_and_texts(on_ranks(3, lambda comm: pc.compute_distributed(comm, **part(comm, domain=lambda _: other))))
    assert len(errors) == 1 and "the vertices of the domain" in next(iter(errors))[1]
    surface = pc.Domain.surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    errors = codes_and_texts(on_ranks(2, lambda comm: pc.compute_distributed(comm, surface, [comm.Get_rank()], [[0.5, 0.5, 0]])))
    assert len(errors) == 1 and next(iter(errors))[0] == "unsupported"


def test_an_exception_on_one_rank_ends_all(rng, cube):
    positions = rng.random((300, 3))

    def fail(fraction):
        raise Boom("as thrown")

    def work(comm):
        rank = comm.Get_rank()
        return pc.compute_distributed(
            comm, cube, np.arange(100) + 100 * rank, positions[100 * rank :][:100], progress=fail if rank == 1 else None
        )

    results = on_ranks(3, work)
    assert isinstance(results[1], Boom) and str(results[1]) == "as thrown"
    assert codes_and_texts([results[0], results[2]]) == {("interrupted", str(results[0]))}
    assert str(results[0]).startswith("rank 1: ")


def test_a_wrong_argument_of_one_rank_is_told_to_the_others(square):
    def work(comm):
        rank = comm.Get_rank()
        wrong = {"weights": [1, 2, 3]} if rank == 2 else {}
        return pc.compute_distributed(comm, square, [rank], [[0.2 + 0.3 * rank, 0.5]], **wrong)

    results = on_ranks(3, work)
    assert isinstance(results[2], ValueError) and "weights has the shape" in str(results[2])
    assert codes_and_texts(results[:2]) == {("invalid_argument", f"rank 2: {results[2]}")}
    results = on_ranks(2, lambda comm: pc.compute_distributed(comm, square, [], [], device="none" if comm.rank else None))
    assert len(codes_and_texts(results)) == 2 and str(results[0]) == f"rank 1: {results[1]}"
    assert results[0].code == results[1].code
    results = on_ranks(2, lambda comm: pc.compute_distributed(comm, square, [], [], precision="half"))
    assert all(isinstance(error, ValueError) and "half" in str(error) for error in results)


def test_an_exception_of_the_communicator_comes_out_unchanged(square):
    class Broken(Rank):
        def alltoall(self, values):
            raise Boom("no network")

    with pytest.raises(Boom, match="no network"):
        pc.compute_distributed(Broken(Threads(1), 0), square, [0], [[0.5, 0.5]])


def test_arguments(square):
    alone = Rank(Threads(1), 0)
    with pytest.raises(ValueError, match="comm is a list without Get_rank, .*pass a communicator of mpi4py"):
        pc.compute_distributed([], square, [0], [[0.5, 0.5]])
    with pytest.raises(ValueError, match="domain is a str"):
        pc.compute_distributed(alone, "square", [0], [[0.5, 0.5]])
    with pytest.raises(ValueError, match="ids has the shape"):
        pc.compute_distributed(alone, square, [0, 1], [[0.5, 0.5]])
    with pytest.raises(ValueError, match="ids: row 0 has a number below 0"):
        pc.compute_distributed(alone, square, [-1], [[0.5, 0.5]])
    with pytest.raises(ValueError, match="positions has the shape"):
        pc.compute_distributed(alone, square, [0], [[0.5, 0.5, 0.5]])
    cells = pc.compute_distributed(alone, square, [], [])
    assert len(cells.mass) == 0 and cells.domain_measure == 1


@pytest.mark.parametrize("ranks", [1, 3])
def test_ranks_of_mpi(ranks):
    pytest.importorskip("mpi4py")
    mpirun = shutil.which("mpirun")
    if not mpirun:
        pytest.skip("there is no mpirun")
    # Open MPI refuses root and more ranks than cores without these.
    environment = {
        **os.environ,
        **{name: "1" for name in ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM")},
        "OMPI_MCA_rmaps_base_oversubscribe": "1",
        "OMPI_MCA_hwloc_base_binding_policy": "none",
        "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
    }
    program = pathlib.Path(__file__).with_name("ranks_of_mpi.py")
    done = subprocess.run(
        [mpirun, "-n", str(ranks), sys.executable, str(program)], env=environment, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    assert sorted(line.split(":")[0] for line in done.stdout.splitlines()) == [f"rank {k} of {ranks}" for k in range(ranks)]
