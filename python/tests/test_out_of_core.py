"""Seeds out of core: cells of pieces against one diagram, and sources of any kind."""

import os

import numpy as np
import pytest

import powercell as pc
from out_of_core import Sliced, check_report, compare, computed, same_bits, stop_at


@pytest.mark.parametrize("d", [2, 3])
def test_cells_are_those_of_one_diagram(rng, square, cube, d, parts):
    domain = square if d == 2 else cube
    positions, weights = rng.random((1500, d)), 0.02 * rng.random(1500)
    positions[700:720] = positions[:20]
    whole = pc.Diagram(domain, positions, weights)
    assert all((whole.status == state).any() for state in pc.Status)
    report, cells = computed(domain, positions, weights, walls=True, folder=parts)
    assert report.pieces >= 5 and report.kept == 0 and report.fetched > 0
    compare(whole, cells)
    check_report(report, whole)
    assert cells.shift is None
    counted_report, counted = computed(domain, positions, weights, folder=str(parts))  # the folder as a str too
    compare(whole, counted, walls=False)
    assert len(counted.indices) == len(counted.data) == 0 and counted_report.neighbors == report.neighbors
    assert counted.mass.tobytes() == cells.mass.tobytes()


def test_walls_of_a_periodic_box_have_shifts(rng, parts):
    box = pc.Domain.box([0, 0, 0], [1, 1, 1], periodic=(True, False, True))
    positions = rng.random((700, 3))
    positions[::7, 0] += 2
    whole = pc.Diagram(box, positions)
    report, cells = computed(box, positions, walls=True, folder=parts)
    assert report.pieces > 2
    compare(whole, cells)
    assert np.array_equal(cells.shift, whole.adjacency.shift)
    rows = []
    pc.compute_out_of_core(box, positions[:0], take=rows.append, walls=True, folder=parts, name="none")
    assert rows == []
    pc.compute_out_of_core(box, positions[:1], take=rows.append, folder=parts, name="one")
    assert rows[0].shift is None and len(rows) == 1


def test_without_weights_they_are_zero(rng, square, parts):
    positions = rng.random((800, 2))
    _, cells = computed(square, positions, walls=True, folder=parts)
    compare(pc.Diagram(square, positions), cells)
    assert same_bits(cells, computed(square, positions, np.zeros(800), walls=True, folder=parts)[1])


def test_rows_may_be_kept_and_are_read_only(rng, square, parts):
    positions = rng.random((400, 2))
    rows = []
    pc.compute_out_of_core(square, positions, take=rows.append, walls=True, folder=parts, name="seeds", piece_seeds=100)
    whole = pc.Diagram(square, positions)
    assert len(rows) > 3 and sum(len(r) for r in rows) == 400
    last = rows[-1]
    mass = last.mass
    for place in range(len(last)):
        assert np.array_equal(last.neighbors(place), whole.adjacency.neighbors(last.first + place))
    with pytest.raises(IndexError, match="0 to"):
        last.neighbors(len(last))
    with pytest.raises(ValueError, match="read-only"):
        last.mass[:] = 0
    assert repr(rows[0]) == f"<powercell.CellRows of seeds 0 to {len(rows[0]) - 1}>"
    del rows, last
    assert np.allclose(mass, whole.mass[-len(mass) :])  # holds its rows
    pc.compute_out_of_core(square, positions, take=(rows := []).append, folder=parts, name="seeds")
    with pytest.raises(ValueError, match="walls=True"):
        rows[0].neighbors(0)


def test_arrays_are_read_twice_in_blocks_of_rows(rng, square, parts):
    positions, weights = rng.random((150_000, 2)), 1e-6 * rng.random(150_000)
    points, heavy = Sliced(positions, 2**16), Sliced(weights, 2**16)
    report, cells = computed(square, points, heavy, folder=parts, piece_seeds=100_000)
    for source in (points, heavy):
        blocks = [block for block in source.slices if block != (0, 0)]
        assert len(blocks) == 6 and blocks[:3] == blocks[3:]
        assert blocks[0][0] == 0 and blocks[2][1] == 150_000
    assert report.pieces > 1
    compare(pc.Diagram(square, positions, weights), cells, walls=False)


@pytest.mark.parametrize("dtype", [np.float32, np.float64, ">f8", np.int16])
def test_a_file_that_is_mapped_needs_no_name(rng, dtype, tmp_path, parts):
    domain = pc.Domain.box([0, 0], [30000, 30000])
    path = tmp_path / "seeds.npy"
    np.save(path, (30000 * rng.random((1000, 2))).astype(dtype))
    np.save(tmp_path / "weights.npy", (1000 * rng.random(1000)).astype(np.float32))
    seeds = np.load(path, mmap_mode="r")
    heavy = np.load(tmp_path / "weights.npy", mmap_mode="r")
    whole = pc.Diagram(domain, seeds, heavy)
    _, cells = computed(domain, seeds, heavy, walls=True, folder=parts, name=None)
    assert np.array_equal(cells.indices, whole.adjacency.indices) and np.array_equal(cells.status, whole.status)
    np.testing.assert_allclose(cells.mass, whole.mass, rtol=0, atol=1e-12 * whole.mass.mean())
    for other in (np.load(path), np.load(path, mmap_mode="r+"), np.load(path, mmap_mode="c"), seeds * 1, list(np.load(path))):
        with pytest.raises(ValueError, match="name is missing.*mmap_mode"):
            computed(domain, other, folder=parts, name=None)
    with pytest.raises(ValueError, match="name is missing"):
        computed(domain, seeds, np.zeros(1000), folder=parts, name=None)


def test_a_mapped_file_is_told_from_others(rng, square, tmp_path, parts):
    path = tmp_path / "seeds.npy"
    array = rng.random((1000, 2))
    np.save(path, array)
    seeds = np.load(path, mmap_mode="r")

    def stopped(given):
        with pytest.raises(pc.Error) as caught:
            computed(square, given, folder=parts, name=None, piece_seeds=100, progress=stop_at(0.6))
        return caught.value

    first, others = seeds[:450], [seeds[50:500], seeds[449::-1], seeds[:450, ::-1], seeds[:900:2]]
    assert stopped(first).code == "interrupted"
    for other in others:
        error = stopped(other)
        assert error.code == "invalid_argument" and "differs in the seeds" in str(error)
    again = np.load(path, mmap_mode="r")[:450]  # as in another process
    report, cells = computed(square, again, folder=parts, name=None, piece_seeds=100)
    assert report.kept > 0
    compare(pc.Diagram(square, array[:450]), cells, walls=False)
    assert stopped(first).code == "interrupted"
    os.utime(path, ns=(1, 1))
    error = stopped(np.load(path, mmap_mode="r")[:450])
    assert error.code == "invalid_argument" and "differs in the seeds" in str(error)


def test_a_file_that_changes_while_it_is_read_is_refused(rng, square, tmp_path, parts, monkeypatch):
    path = tmp_path / "seeds.npy"
    np.save(path, rng.random((1000, 2)))
    seeds = np.load(path, mmap_mode="r")

    def touch(done):
        os.utime(path, ns=(1, 1))  # after the first time that seeds are read

    with pytest.raises(pc.Error, match=r"positions: .*seeds.npy was changed") as caught:
        computed(square, seeds, folder=parts, name=None, progress=touch)
    assert caught.value.code == "invalid_file"
    assert not parts.exists()


def test_data_sets_of_other_packages(rng, square, tmp_path, parts):
    h5py = pytest.importorskip("h5py")
    positions = rng.random((500, 2), dtype=np.float32)
    with h5py.File(tmp_path / "seeds.h5", "w") as file:
        file["x"] = positions
        _, cells = computed(square, file["x"], walls=True, folder=parts)
    compare(pc.Diagram(square, positions), cells)
