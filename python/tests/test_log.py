"""The log: its lines, its levels, and that it holds up nothing."""

import subprocess
import sys
import threading

import numpy as np
import pytest

import powercell as pc


@pytest.fixture
def lines():
    seen = []
    yield seen
    pc.set_log(None)


def test_lines_come_by_level(rng, square, lines):
    p = rng.random((3000, 2))
    pc.set_log(lambda level, line: lines.append((level, line)))
    pc.Diagram(square, p, chunk_pairs=1000).mass
    assert lines and {level for level, _ in lines} == {"info"}
    assert any("3000 seeds" in line or "3,000 seeds" in line for _, line in lines)
    assert not any("pairs clipped" in line for _, line in lines)
    lines.clear()
    pc.set_log(lambda level, line: lines.append((level, line)), "detail")
    pc.Diagram(square, p, chunk_pairs=1000).mass
    chunks = [line for level, line in lines if level == "detail" and "pairs clipped" in line]
    assert len(chunks) == 3 and "info" in {level for level, _ in lines}
    pc.set_log(None)
    count = len(lines)
    pc.Diagram(square, p).mass
    assert len(lines) == count
    with pytest.raises(ValueError, match="level is 'all'"):
        pc.set_log(print, "all")
    with pytest.raises(ValueError, match="sink is a int"):
        pc.set_log(3)


def test_what_a_sink_raises_is_reported_and_stops_nothing(square, lines, monkeypatch):
    caught = []
    monkeypatch.setattr(sys, "unraisablehook", lambda unraisable: caught.append(unraisable.exc_type))
    codes = []

    def sink(level, line):
        try:
            pc.set_log(None)
        except pc.Error as error:
            codes.append(error.code)
        raise ZeroDivisionError

    pc.set_log(sink)
    assert pc.Diagram(square, [[0.5, 0.5]]).mass.tolist() == [1]
    assert caught and set(caught) == {ZeroDivisionError}
    assert set(codes) == {"invalid_argument"}


def test_threads_that_log_do_not_wait_for_each_other(square, lines):
    pc.set_log(lambda level, line: lines.append(line), "detail")

    def work(seed):
        p = np.random.default_rng(seed).random((500, 2))
        for _ in range(10):
            pc.TransportSolver(square, p[:20]).solve()
            pc.Diagram(square, p, chunk_pairs=200).mass
            vertices, triangles = pc.sphere(2)
            pc.Domain.surface(vertices, np.vstack([triangles, [[0, 0, 1]]]))

    threads = [threading.Thread(target=work, args=(seed,), daemon=True) for seed in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(120)
    assert not any(thread.is_alive() for thread in threads)
    assert any("domain" in line for line in lines)


def test_a_sink_may_be_set_when_the_interpreter_ends():
    code = """
import threading, time, numpy as np, powercell as pc
pc.set_log(lambda level, line: None, "detail")
square, p = pc.Domain.box([0, 0], [1, 1]), np.random.default_rng(1).random((2000, 2))
def work():
    while True: pc.Diagram(square, p, chunk_pairs=100).mass
threading.Thread(target=work, daemon=True).start()
time.sleep(0.5)
print("done")
"""
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert (ran.returncode, ran.stdout, ran.stderr) == (0, "done\n", "")
