"""Seeds out of core: stops, other threads, and refusals."""

import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import powercell as pc
from out_of_core import Boom, Sliced, compare, computed, same_bits, stop_at


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
