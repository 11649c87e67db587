"""Seeds out of core: cells of pieces against one diagram, sources of any kind, stops, and refusals."""

import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import powercell as pc


class Boom(Exception):
    pass


@pytest.fixture
def parts(tmp_path):
    return tmp_path / "parts"


def computed(domain, positions, weights=None, **given):
    """The report and all that was given, joined."""
    rows = []
    given = {"name": "seeds of a test", "piece_seeds": 300, **given}
    report = pc.compute_out_of_core(domain, positions, weights, take=rows.append, **given)
    assert not os.path.exists(given["folder"])
    return report, Joined(rows)


class Joined:
    def __init__(self, rows):
        first = np.cumsum([0] + [len(r) for r in rows])
        assert [r.first for r in rows] == list(first[:-1])
        for name in ("mass", "centroid", "second_moment", "status", "indices", "data"):
            setattr(self, name, np.concatenate([getattr(r, name) for r in rows]))
        counts = np.concatenate([np.diff(r.indptr) for r in rows])
        self.indptr = np.concatenate([[0], np.cumsum(counts)])
        self.shift = None if rows[0].shift is None else np.concatenate([r.shift for r in rows])
        assert {int(self.indptr[-1])} == {r.all_walls for r in rows}
        self.domain_measure = rows[0].domain_measure

    def arrays(self):
        return [self.mass, self.centroid, self.second_moment, self.status, self.indptr, self.indices, self.data]


def same_bits(a, b):
    return all(u.tobytes() == v.tobytes() for u, v in zip(a.arrays(), b.arrays()))


def compare(whole, cells, walls=True):
    """Statuses and neighbours bit for bit, the others up to rounding."""
    assert np.array_equal(cells.status, whole.status)
    scale = whole.mass.mean()
    np.testing.assert_allclose(cells.mass, whole.mass, rtol=0, atol=1e-13 * scale)
    there = whole.mass > 0
    np.testing.assert_allclose(cells.centroid[there], whole.centroid[there], atol=1e-12)
    assert np.isnan(cells.centroid[whole.status != pc.Status.OK]).all()
    np.testing.assert_allclose(cells.second_moment, whole.second_moment, rtol=1e-9, atol=1e-15)
    assert np.array_equal(cells.indptr, whole.adjacency.indptr)
    assert cells.domain_measure == whole.domain_measure
    if walls:
        assert np.array_equal(cells.indices, whole.adjacency.indices)
        np.testing.assert_allclose(cells.data, whole.adjacency.data, rtol=0, atol=1e-10)


def check_report(report, whole):
    states = [int((whole.status == state).sum()) for state in pc.Status]
    assert [report.cells, report.hidden, report.duplicate] == states
    assert report.measure == pytest.approx(whole.mass.sum(), rel=1e-13)
    assert report.domain_measure == whole.domain_measure
    assert report.fetched >= report.neighbors and report.clipped >= report.cells
    assert report.bytes_read > 0 and report.bytes_written > 0 and report.rounds >= report.pieces
    assert min(report.sort, report.compute, report.gather) >= 0


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


class Sliced:
    """An array-like that is never there as a whole."""

    def __init__(self, array, most):
        self._array, self._most, self.shape, self.slices = array, most, array.shape, []

    def __getitem__(self, key):
        assert isinstance(key, slice) and key.stop - key.start <= self._most
        self.slices.append((key.start, key.stop))
        return self._array[key]

    def __array__(self, *_, **__):
        raise AssertionError("converted as a whole")

    def __len__(self):
        return len(self._array)


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


def stop_at(fraction):
    return lambda done: done < fraction


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


def test_stopped_by_progress_and_gone_on_with(rng, cube, parts):
    positions, weights = rng.random((900, 3)), 0.02 * rng.random(900)
    seen = []
    _, whole = computed(cube, positions, weights, walls=True, folder=parts, progress=seen.append)
    assert len(seen) > 10 and seen == sorted(seen) and 0 <= seen[0] and seen[-1] <= 1
    kept = []
    for fraction in (0.3, 0.5, 0.7, 0.95):
        with pytest.raises(pc.Error) as caught:
            computed(cube, positions, weights, walls=True, folder=parts, progress=stop_at(fraction))
        assert caught.value.code == "interrupted" and parts.exists()
    report, cells = computed(cube, positions, weights, walls=True, folder=parts, progress=lambda done: kept.append(done))
    assert report.kept > 1
    assert same_bits(cells, whole)


def test_exceptions_come_out_unchanged_and_lose_no_piece(rng, cube, parts):
    positions = rng.random((900, 3))
    given = {"folder": parts, "name": "seeds", "piece_seeds": 300}
    calls = []

    def fail(rows):
        calls.append(rows.first)
        raise Boom("disk full")

    with pytest.raises(Boom, match="disk full"):
        pc.compute_out_of_core(cube, positions, take=fail, **given)
    assert calls == [0] and parts.exists()
    with pytest.raises(Boom, match="in progress"):
        computed(cube, positions, **given, progress=lambda done: (_ for _ in ()).throw(Boom("in progress")))
    assert parts.exists()
    report, cells = computed(cube, positions, **given)
    assert report.kept == report.pieces > 1 and report.clipped == 0
    compare(pc.Diagram(cube, positions), cells, walls=False)

    class Broken(Sliced):
        def __getitem__(self, key):
            if key.stop > 0:
                raise Boom("no network")
            return super().__getitem__(key)

    with pytest.raises(Boom, match="no network"):
        computed(cube, Broken(positions, 2**16), **given)
    with pytest.raises(Boom, match="no network"):
        computed(cube, positions, Broken(np.zeros(900), 2**16), **given)
    assert not parts.exists()  # nothing was finished


def test_a_source_that_shrinks_is_refused(square, parts):
    class Shrinks(Sliced):
        def __getitem__(self, key):
            return super().__getitem__(key)[: 10 if key.stop else 0]

    with pytest.raises(ValueError, match=r"positions has the shape \(10, 2\); \(50, 2\) is expected"):
        computed(square, Shrinks(np.random.default_rng(1).random((50, 2)), 100), folder=parts)


def test_ctrl_c_stops_it_and_the_same_call_goes_on(tmp_path):
    program = f"""
import os, signal, sys, threading, numpy as np, powercell as pc
positions = np.random.default_rng(1).random((4000, 3))
def stop(done):
    if done > 0.6 and sys.argv[1] == "stop":
        os.kill(os.getpid(), signal.SIGINT)
try:
    report = pc.compute_out_of_core(pc.Domain.box([0, 0, 0], [1, 1, 1]), positions, take=lambda rows: None, name="seeds",
                                    folder={str(tmp_path / 'parts')!r}, piece_seeds=500, progress=stop)
    print(report.kept > 2, report.cells)
except KeyboardInterrupt:
    print("KeyboardInterrupt")
"""
    said = []
    for way in ("stop", "go on"):
        done = subprocess.run([sys.executable, "-c", program, way], capture_output=True, text=True, timeout=120)
        assert (done.returncode, done.stderr) == (0, "")
        said.append(done.stdout)
    assert said == ["KeyboardInterrupt\n", "True 4000\n"]


def test_a_killed_process_loses_no_finished_piece(tmp_path):
    path = tmp_path / "seeds.npy"
    np.save(path, np.random.default_rng(1).random((4000, 3)))
    program = f"""
import os, signal, numpy as np, powercell as pc
def kill(done):
    if done > 0.6: os.kill(os.getpid(), signal.SIGKILL)
pc.compute_out_of_core(pc.Domain.box([0, 0, 0], [1, 1, 1]), np.load({str(path)!r}, mmap_mode="r"), take=lambda rows: None,
                       folder={str(tmp_path / 'parts')!r}, piece_seeds=500, progress=kill)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120)
    assert done.returncode == -signal.SIGKILL, done.stderr
    cube = pc.Domain.box([0, 0, 0], [1, 1, 1])
    report, cells = computed(cube, np.load(path, mmap_mode="r"), folder=tmp_path / "parts", name=None, piece_seeds=500)
    assert 2 < report.kept < report.pieces
    compare(pc.Diagram(cube, np.load(path)), cells, walls=False)


def test_functions_may_compute_and_other_threads_run(rng, square, parts):
    positions, ran = rng.random((3000, 2)), []
    other = pc.Diagram(square, positions[:50])
    go_on = threading.Event()

    def count():
        while not go_on.is_set():
            ran.append(1)
            time.sleep(0.001)

    class Computes(Sliced):
        def __getitem__(self, key):
            assert other.mass.sum() == pytest.approx(1)
            return super().__getitem__(key)

    thread = threading.Thread(target=count)
    thread.start()
    sums = []

    def take(rows):
        before = len(ran)
        sums.append(rows.mass.sum() * pc.Diagram(square, positions[:10]).mass.sum())
        assert len(ran) >= before

    before = len(ran)
    pc.compute_out_of_core(square, Computes(positions, 2**16), take=take, folder=parts, name="seeds", piece_seeds=500)
    after = len(ran)
    go_on.set()
    thread.join()
    assert sum(sums) == pytest.approx(1, rel=1e-12) and after > before + 5


def test_wrong_seeds_are_named(rng, square, parts):
    for array, row, column in (("positions", 456, 1), ("weights", 777, None)):
        positions, weights = rng.random((1000, 2)), np.zeros(1000)
        if array == "positions":
            positions[row, column] = np.nan
        else:
            weights[row] = np.inf
        with pytest.raises(pc.Error) as of_diagram:
            pc.Diagram(square, positions, weights).compute()
        with pytest.raises(pc.Error) as caught:
            computed(square, positions, weights, folder=parts)
        assert caught.value.code == "invalid_seed" and str(row) in str(caught.value)
        assert str(caught.value) == str(of_diagram.value)
        assert not parts.exists()


def test_domains_and_options_of_one_diagram_alone_are_refused(square, parts):
    surface = pc.Domain.surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    solid = pc.Domain.solid([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    for domain in (surface, solid):
        with pytest.raises(pc.Error, match="out of core") as caught:
            computed(domain, [[0.1, 0.1, 0.1]], folder=parts)
        assert caught.value.code == "unsupported"
    with pytest.raises(pc.Error, match="double precision") as caught:
        computed(square, [[0.5, 0.5]], folder=parts, precision="float")
    assert caught.value.code == "unsupported"
    with pytest.raises(pc.Error, match="the least is") as caught:
        computed(square, [[0.5, 0.5]], folder=parts, memory=2**20)
    assert caught.value.code == "invalid_argument"
    parts.mkdir()
    (parts / "photos").mkdir()
    with pytest.raises(pc.Error, match="for something else"):
        computed(square, [[0.5, 0.5]], folder=parts)
    assert (parts / "photos").exists()


def test_a_folder_is_for_one_computation(rng, square, parts):
    positions = rng.random((900, 2))
    with pytest.raises(pc.Error):
        computed(square, positions, folder=parts, progress=stop_at(0.6))
    for differ, text in (({"name": "others"}, "the seeds"), ({"walls": True}, "whether walls"), ({"memory": 2**31}, "the memory")):
        with pytest.raises(pc.Error, match=f"differs in .*{text}") as caught:
            computed(square, positions, folder=parts, **differ)
        assert caught.value.code == "invalid_argument"
    assert computed(square, positions, folder=parts)[0].kept > 0


def test_arguments(square, parts):
    points = np.full((5, 2), 0.5)
    for given, text in (
        ({"positions": np.zeros((5, 3))}, r"positions has the shape \(5, 3\); \(n, 2\) is expected, since the domain is in the plane"),
        ({"positions": np.zeros(5)}, "positions has the shape"),
        ({"positions": np.zeros((5, 2), complex)}, "positions has the type complex128"),
        ({"positions": np.zeros((5, 2), complex), "device": "none"}, "positions has the type complex128"),
        ({"positions": [["a", "b"]]}, "positions has the type"),
        ({"positions": 3.0}, "positions has the shape"),
        ({"positions": np.ma.masked_less(np.array(points), 1)}, "positions is a masked array"),
        ({"weights": np.zeros(4)}, r"weights has the shape \(4,\); \(5,\) is expected, one for each seed"),
        ({"weights": np.zeros((5, 1))}, "weights has the shape"),
        ({"weights": np.array(["a"] * 5)}, "weights has the type"),
        ({"domain": "square"}, "domain is a str"),
        ({"take": None}, "take is a NoneType"),
        ({"name": ""}, "name is ''"),
        ({"name": 5}, "name is 5"),
        ({"memory": -1}, "memory is -1; a whole number"),
        ({"memory": "4G"}, "memory is '4G'; a whole number"),
        ({"piece_seeds": 0.5}, "piece_seeds is 0.5"),
        ({"threads": -1}, "threads is -1"),
        ({"precision": "half"}, "precision is 'half'"),
        ({"progress": 3}, "progress is a int"),
    ):
        call = {"domain": square, "positions": points, "take": print, "folder": parts, "name": "seeds", **given}
        with pytest.raises(ValueError, match=text):
            pc.compute_out_of_core(**call)
        assert not parts.exists()
    with pytest.raises(TypeError):
        computed(square, points, folder=3)
    with pytest.raises(pc.Error, match="folder"):
        computed(square, points, folder="")
