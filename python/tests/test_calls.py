"""Progress, exceptions in callbacks, interrupts, threads and forks."""

import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import powercell as pc


def test_progress_is_called_and_may_stop(rng, cube):
    seen = []
    pc.Diagram(cube, rng.random((3000, 3)), chunk_pairs=1000, progress=seen.append).compute()
    assert seen and seen == sorted(seen) and 0 <= seen[0] and seen[-1] == 1
    stopping = pc.Diagram(cube, rng.random((3000, 3)), chunk_pairs=1000, progress=lambda fraction: fraction < 0.5)
    with pytest.raises(pc.Error) as caught:
        stopping.compute()
    assert caught.value.code == "interrupted"


def test_progress_of_checks_and_integrals(rng, square):
    diagram = pc.Diagram(square, rng.random((500, 2)))
    seen = []
    checks = diagram.verify(progress=seen.append)
    assert seen == pytest.approx(np.arange(1, len(checks) + 1) / len(checks))
    assert all(check.passed for check in checks)
    with pytest.raises(pc.Error) as caught:
        diagram.verify(progress=lambda fraction: False)
    assert caught.value.code == "interrupted"
    seen.clear()
    pc.integrate(pc.Diagram(square, rng.random((500, 2)), progress=seen.append), "x")
    assert seen and 0 <= min(seen) and max(seen) == 1
    with pytest.raises(Boom):
        pc.integrate(pc.Diagram(square, rng.random((500, 2)), progress=boom), "x")


class Boom(Exception):
    pass


def boom(*_):
    raise Boom("as thrown")


def test_exceptions_in_callbacks_come_out_unchanged(rng, square):
    p = rng.random((200, 2))
    diagram = pc.Diagram(square, p, progress=boom)
    with pytest.raises(Boom, match="as thrown"):
        diagram.compute()
    with pytest.raises(Boom):
        pc.transport(square, p, progress=boom)
    with pytest.raises(Boom):
        pc.transport(square, p, density=boom)
    with pytest.raises(Boom):
        pc.sample(square, 50, progress=boom)
    with pytest.raises(Boom):
        pc.remesh(*pc.sphere(4), count=50, progress=boom)
    with pytest.raises(Boom):
        pc.treemap({str(k): k + 1 for k in range(200)}, progress=boom)


def test_a_bar_is_shown_where_tqdm_is(rng, square, capsys):
    pytest.importorskip("tqdm")
    pc.Diagram(square, rng.random((100, 2)), progress=True).mass
    pc.transport(square, rng.random((50, 2)), progress=True)
    shown = capsys.readouterr().err
    assert "power diagram" in shown and "transport" in shown


def test_ctrl_c_stops_a_long_call():
    program = """
import numpy as np, powercell as pc
box = pc.Domain.box([0, 0, 0], [1, 1, 1])
p = np.random.default_rng(1).random((5000, 3))
pc.Diagram(box, p[:10]).mass
print("running", flush=True)
try:
    pc.sample(box, p, mode="quantise", iterations=100000, movement=0)
except KeyboardInterrupt:
    print("stopped", flush=True)
"""
    process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "running\n"
    time.sleep(1)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=60)
    assert out == "stopped\n" and process.returncode == 0


def test_other_threads_run_meanwhile(rng, cube):
    p = rng.random((30_000, 3))
    pc.Diagram(cube, p[:100]).mass
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.monotonic()
    pc.Diagram(cube, p).mass
    took = time.monotonic() - start
    done.set()
    thread.join()
    assert len([t for t in ticks if t > start]) > 5 * took  # with the lock held there would be none


def test_one_diagram_in_two_threads(rng, cube):
    p = rng.random((2000, 3))
    diagram = pc.Diagram(cube, p)
    want = [pc.Diagram(cube, p, np.full(2000, k) * p[:, 0]).mass.copy() for k in range(2)]
    wrong = []

    def work(k):
        for _ in range(10):
            diagram.set_weights(np.full(2000, k) * p[:, 0])
            mass = diagram.mass
            if not any(np.array_equal(mass, one) for one in want):
                wrong.append(k)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork here")
def test_a_forked_process_is_told(square):
    pc.Diagram(square, [[0.5, 0.5]]).mass
    reader, writer = multiprocessing.Pipe(duplex=False)

    def child():
        try:
            pc.Diagram(square, [[0.5, 0.5]]).mass
            writer.send("no error")
        except pc.Error as error:
            writer.send(f"{error.code}: {error}")

    process = multiprocessing.get_context("fork").Process(target=child)
    process.start()
    assert reader.poll(30)
    answer = reader.recv()
    process.join()
    assert answer.startswith("unsupported: this process was forked") and "spawn" in answer


def test_objects_may_live_when_the_interpreter_ends():
    program = (
        "import powercell as pc\n"
        "d = pc.Diagram(pc.Domain.box([0, 0], [1, 1]), [[.5, .5]], progress=lambda f: None)\n"
        "m = d.mass; s = pc.TransportSolver(d.domain, [[.5, .5]], density=lambda x, y: 1.0); s.solve()\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("loader", ["the system's", "Khronos'"])
def test_a_packaged_driver_is_used_where_the_system_has_none(loader):
    program = """
import importlib.util, pathlib, sys
import importlib.metadata
try:
    importlib.metadata.files("intel-opencl-rt") or sys.exit("none")
    importlib.metadata.files("intel-cmplr-lib-rt")
except importlib.metadata.PackageNotFoundError:
    sys.exit("none")
folder = pathlib.Path(importlib.util.find_spec("powercell").origin).parent
spec = importlib.util.spec_from_file_location("runtime", folder / "_runtime.py")
runtime = importlib.util.module_from_spec(spec)
spec.loader.exec_module(runtime)
runtime.VENDORS = pathlib.Path("/no/such/folder")
runtime.provide_opencl()
import powercell as pc
names = [device.platform for device in pc.devices()]
assert names and all("Intel" in name for name in names), names
loaders = {line.split()[-1] for line in open("/proc/self/maps") if "libOpenCL" in line}
assert len(loaders) == 1 and loaders.pop().startswith(sys.argv[1]), loaders
assert abs(pc.Diagram(pc.Domain.box([0, 0], [1, 1]), [[.2, .3], [.5, .5]]).mass.sum() - 1) < 1e-12
"""
    folder, environment = "/", dict(os.environ)
    if loader == "Khronos'":
        folder = environment["LD_LIBRARY_PATH"] = os.path.join(sys.prefix, "lib")  # the driver's package has that loader
    done = subprocess.run([sys.executable, "-c", program, folder], capture_output=True, text=True, timeout=200, env=environment)
    if done.stderr.strip() == "none":
        pytest.skip("powercell[cpu] is not installed")
    assert done.returncode == 0, done.stderr
