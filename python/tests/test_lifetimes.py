"""Objects across forks, threads, callbacks that call back, the interpreter's end, and 10^4 times."""

import multiprocessing
import os
import subprocess
import sys
import threading
import traceback

import numpy as np
import pytest

import powercell as pc

needs_fork = pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork here")


def in_a_fork(function):
    """What the function returns in a forked process, which also deletes its objects and ends as Python does."""
    reader, writer = multiprocessing.Pipe(duplex=False)
    pid = os.fork()
    if pid == 0:
        try:
            writer.send(function())
        except BaseException:
            writer.send(traceback.format_exc())
        finally:
            os._exit(0)
    assert reader.poll(60), "the forked process hangs"
    answer = reader.recv()
    os.waitpid(pid, 0)
    return answer


@needs_fork
def test_what_was_made_before_a_fork_is_refused_in_the_child(rng, square):
    p = rng.random((200, 2))
    diagram, solver = pc.Diagram(square, p), pc.TransportSolver(square, p)
    mass = diagram.mass

    def child():
        said = []
        for call in (
            lambda: diagram.cells,
            lambda: (diagram.set_weights(np.ones(200)), diagram.mass),
            lambda: (diagram.set_seeds(p), diagram.mass),
            lambda: pc.Diagram(square, p).mass,
            solver.solve,
            lambda: pc.sample(square, 10),
            pc.Device.choose,
            pc.devices,
        ):
            try:
                call()
                said.append("no error")
            except pc.Error as error:
                said.append(error.code)
        return said

    assert in_a_fork(child) == ["unsupported"] * 8
    assert np.array_equal(diagram.mass, mass)  # the parent goes on
    assert in_a_fork(lambda: float(mass.sum())) == mass.sum()  # results are memory like any other


@needs_fork
def test_a_forked_process_may_make_domains_and_delete_what_it_inherits(rng, square):
    held = [pc.Diagram(square, rng.random((200, 2))), pc.TransportSolver(square, rng.random((20, 2)))]
    held[0].compute()

    def child():
        held.clear()
        return pc.Domain.polygon([[0, 0], [2, 0], [0, 1]]).measure, pc.read_domain("ball:8").kind

    assert in_a_fork(child) == (1.0, "volume")


@needs_fork
def test_a_forked_process_ends_with_live_objects():
    program = """
import os, sys
import powercell as pc
d = pc.Diagram(pc.Domain.box([0, 0], [1, 1]), [[.5, .5], [.2, .1]])
d.mass
pid = os.fork()
if pid == 0:
    sys.exit(7)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stderr) == (7, "")


@pytest.mark.parametrize("method", ["spawn", "forkserver"])
def test_pools_that_do_not_fork_work(method, tmp_path):
    program = tmp_path / "areas.py"
    program.write_text(
        f"""
import multiprocessing, numpy as np, powercell as pc
def area(k):
    return float(pc.Diagram(pc.Domain.box([0, 0], [1, 1]), np.random.default_rng(k).random((50, 2))).mass.sum())
if __name__ == "__main__":
    area(0)
    with multiprocessing.get_context("{method}").Pool(2) as pool:
        print([round(a, 12) for a in pool.map(area, range(4))])
"""
    )
    done = subprocess.run([sys.executable, program], capture_output=True, text=True, timeout=200)
    assert done.stdout == "[1.0, 1.0, 1.0, 1.0]\n", done.stderr


def in_two_threads(work):
    failures = []

    def run(k):
        try:
            work(k)
        except BaseException:
            failures.append(traceback.format_exc())

    threads = [threading.Thread(target=run, args=(k,)) for k in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures, failures[0]


def test_threads_may_open_the_first_device_together():
    program = """
import sys, threading, powercell as pc
start = threading.Barrier(6)
def work(k):
    start.wait()
    found = len(pc.devices()) if k % 2 else pc.Diagram(pc.Domain.box([0, 0], [1, 1]), [[.5, .5]]).mass[0]
    sys.stdout.write(f"{found > 0}\\n")
for k in range(6):
    threading.Thread(target=work, args=(k,)).start()
"""
    for _ in range(3):
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120)
        assert (done.returncode, done.stdout, done.stderr) == (0, "True\n" * 6, "")


def test_one_solver_in_two_threads_serves_one_after_the_other(rng, square):
    p = rng.random((100, 2))
    targets = [np.full(100, 0.01), np.r_[np.full(50, 0.005), np.full(50, 0.015)]]
    solver = pc.TransportSolver(square, p, density=lambda x, y: 1.0)

    def work(k):
        for _ in range(3):
            solver.set_masses(targets[k])
            result = solver.solve()
            assert result.converged
            assert any(np.abs(result.mass - target).max() < 1e-7 for target in targets)

    in_two_threads(work)


def test_two_threads_replace_the_seeds_of_one_diagram(rng, cube):
    diagram = pc.Diagram(cube, rng.random((500, 3)))
    sets = [rng.random((300, 3)), rng.random((700, 3))]

    def work(k):
        for _ in range(10):
            diagram.set_seeds(sets[k])
            mass, cells = diagram.mass, diagram.cells
            assert len(mass) in (300, 700) and abs(mass.sum() - 1) < 1e-12
            assert len(cells.cell_offset) in (301, 701)
            assert diagram.adjacency.indptr[-1] > 0

    in_two_threads(work)


def reentered(call):
    with pytest.raises(pc.Error, match="from within its own progress or density function") as caught:
        call()
    assert caught.value.code == "invalid_argument"


def test_a_callback_cannot_call_what_runs_it(rng, square):
    p = rng.random((2000, 2))
    diagram = pc.Diagram(square, p, progress=lambda fraction: diagram.set_seeds(p))
    reentered(diagram.compute)
    solver = pc.TransportSolver(square, p[:50])
    reentered(lambda: solver.solve(progress=lambda step: solver.solve()))
    dense = pc.TransportSolver(square, p[:50], density=lambda x, y: dense.set_tolerance(1e-3) or 1.0)
    reentered(dense.solve)
    one = pc.Diagram(square, p, progress=lambda fraction: other.compute() and None)
    other = pc.Diagram(square, p, progress=lambda fraction: one.mass is None)
    reentered(one.compute)
    third, seen = pc.Diagram(square, p[:10]), []  # any other object may be used
    pc.Diagram(square, p, progress=lambda fraction: seen.append(third.mass.sum())).compute()
    assert seen and np.allclose(seen, 1)


def test_the_interpreter_may_end_while_threads_compute():
    program = """
import threading, time, numpy as np, powercell as pc
rng = np.random.default_rng(1)
square = pc.Domain.box([0, 0], [1, 1])
def diagrams():
    d = pc.Diagram(square, rng.random((2000, 2)), progress=lambda f: None)
    while True:
        d.set_seeds(rng.random((2000, 2)))
        d.mass
def solve():
    pc.sample(square, 2000, density=lambda x, y: 1 + x, mode="quantise", iterations=10000, movement=0)
for work in (diagrams, diagrams, solve):
    threading.Thread(target=work, daemon=True).start()
time.sleep(1.5)
print("ending", flush=True)
"""
    for _ in range(3):
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120)
        assert (done.returncode, done.stdout, done.stderr) == (0, "ending\n", "")


def resident():
    """Bytes in memory, of /proc as Linux writes it."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="memory is read from /proc")
@pytest.mark.parametrize("what, rounds", [("diagrams", 10_000), ("seeds", 4000), ("errors", 2000), ("solvers", 1000), ("out of core", 400)])
def test_nothing_leaks(rng, square, what, rounds, tmp_path):
    p = rng.random((20, 2))
    kept = pc.Diagram(square, p, progress=lambda fraction: None)

    def diagrams():
        d = pc.Diagram(square, p, progress=lambda fraction: None)
        d.compute(cells=True)
        assert len(d.mass) == len(d.cells.cell_offset) - 1 == len(d.adjacency.indptr) - 1

    def seeds():
        kept.set_seeds(p, np.zeros(20))
        assert len(kept.mass) == len(kept.adjacency.indptr) - 1

    def errors():
        for wrong in ([[0.5, np.nan]], [[0.5, 0.5, 0.5]]):
            with pytest.raises((pc.Error, ValueError)):
                pc.Diagram(square, wrong)
        with pytest.raises(ZeroDivisionError):
            pc.Diagram(square, p, progress=lambda fraction: 1 / 0).compute()

    def solvers():
        pc.TransportSolver(square, p, density=lambda x, y: 1.0)
        assert pc.transport(square, p, tolerance=1e-2, progress=lambda step: None).converged

    def out_of_core():
        given = {"folder": tmp_path / "parts", "name": "seeds", "walls": True, "piece_seeds": 10}
        rows = []
        pc.compute_out_of_core(square, p, np.zeros(20), take=rows.append, **given)
        assert len(rows[-1].mass) == len(rows[-1].indptr) - 1
        with pytest.raises(ZeroDivisionError):
            pc.compute_out_of_core(square, p, take=lambda rows: 1 / 0, **given)
        pc.compute_out_of_core(square, p, take=lambda rows: None, **given)  # removes the folder

    once = {"diagrams": diagrams, "seeds": seeds, "errors": errors, "solvers": solvers, "out of core": out_of_core}[what]
    for _ in range(rounds // 4):
        once()
    before = resident()
    for _ in range(rounds):
        once()
    assert resident() - before < 2**20 + 256 * rounds
