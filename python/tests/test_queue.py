"""Diagrams on a queue of pyopencl, whose wheel brings a loader of OpenCL of its own."""

import gc
import subprocess
import sys
import threading

import numpy as np
import pytest
import scipy.sparse

import powercell as pc

cl = pytest.importorskip("pyopencl", reason="pyopencl is not installed")
import pyopencl.array  # noqa: E402
import pyopencl.tools  # noqa: E402


@pytest.fixture
def queue():
    """Of the device that powercell chooses by itself."""
    chosen = pc.Device.choose()._info.selector.split(":")
    device = cl.get_platforms()[int(chosen[0])].get_devices()[int(chosen[1])]
    return cl.CommandQueue(cl.Context([device]))


@pytest.mark.parametrize("dtype, tolerance", [(np.float64, 1e-12), (np.float32, 1e-4)])
@pytest.mark.parametrize("d", [2, 3])
def test_measures_are_those_of_diagram(rng, queue, d, dtype, tolerance):
    box = pc.Domain.box([0] * d, [1] * d)
    p, w = rng.random((500, d)).astype(dtype), (rng.random(500) * 0.005).astype(dtype)
    want = pc.Diagram(box, p, w)
    found = pc.DeviceDiagram(box, queue).compute(cl.array.to_device(queue, p), cl.array.to_device(queue, w))
    assert found.mass.queue is queue and found.mass.dtype == dtype and found.status.dtype == np.uint32
    assert found.check() is found
    assert np.array_equal(found.status.get(), want.status)
    size = want.mass.max()
    assert np.abs(found.mass.get() - want.mass).max() < tolerance * size
    live = want.status == pc.Status.OK
    assert found.centroid.shape == (500, d) and np.isnan(found.centroid.get()[~live]).all()
    big = want.mass > 0.1 * size
    assert np.abs(found.centroid.get() - want.centroid)[big].max() < 10 * tolerance
    assert np.abs(found.second_moment.get() - want.second_moment).max() < tolerance * want.second_moment.max()
    assert found.count()[pc.DeviceStatus.HIDDEN] == np.count_nonzero(~live)


@pytest.mark.parametrize("dtype, tolerance", [(np.float64, 1e-11), (np.float32, 1e-3)])
@pytest.mark.parametrize("d", [2, 3])
def test_walls_are_those_of_diagram(rng, queue, d, dtype, tolerance):
    box = pc.Domain.box([0] * d, [1] * d)
    p, w = rng.random((400, d)).astype(dtype), (rng.random(400) * 0.002).astype(dtype)
    want = pc.Diagram(box, p, w, decisions="fast").adjacency.to_scipy()
    diagram = pc.DeviceDiagram(box, queue)
    seeds, weights = cl.array.to_device(queue, p), cl.array.to_device(queue, w)
    found = diagram.compute(seeds, weights, adjacency=True)
    indptr, indices, data = found.adjacency.get()
    assert data.dtype == dtype and indptr.dtype == indices.dtype == np.uint32
    walls = scipy.sparse.csr_array((data, indices, indptr), shape=(400, 400))
    assert abs(walls - walls.T).max() == 0
    assert abs(walls - want).max() < tolerance
    assert diagram.compute(seeds, weights).adjacency is None
    again = diagram.compute(seeds, weights, adjacency=True, out=found)
    assert again.adjacency is found.adjacency and np.array_equal(again.adjacency.get()[2], data)
    exact = diagram.compute(seeds, weights, adjacency=len(data))
    assert np.array_equal(exact.adjacency.get()[1], indices)
    with pytest.raises(pc.Error, match=f"{len(data)} entries, and room for 100") as error:
        diagram.compute(seeds, weights, adjacency=100).adjacency.get()
    assert error.value.code == "invalid_argument"
    few = pc.DeviceDiagram(box, queue, wall_capacity=1000).compute(seeds, weights, adjacency=True)
    assert few.count()[pc.DeviceStatus.UNFINISHED] > 0


@pytest.mark.parametrize("d, periodic", [(2, False), (3, False), (3, True)])
def test_cells_are_those_of_diagram(rng, queue, d, periodic):
    box = pc.Domain.box([0] * d, [1] * d, periodic=periodic)
    p = rng.random((200, d))
    want = pc.Diagram(box, p).cells
    diagram = pc.DeviceDiagram(box, queue)
    seeds = cl.array.to_device(queue, p)
    found = diagram.compute(seeds, cells=True, uncertain=True)
    diagram.repair(seeds, out=found)
    cells = found.cells.get()
    assert cells["counts"].tolist() == [len(want.region), len(want.vertices), len(want.border), len(want.loop)]
    assert np.array_equal(cells["cell_offset"], want.cell_offset)
    assert np.array_equal(cells["vertex_offset"], want.vertex_offset)
    assert np.array_equal(cells["face_offset"], want.face_offset)
    assert ("loop" in cells) == (d == 3) and ("shift" in cells) == periodic
    for i in range(200):  # faces in any order
        faces = slice(*want.face_offset[i : i + 2])
        columns = [np.hstack([of["border"][faces]] + ([of["shift"][faces, :d]] if periodic else []))
                   for of in (cells, {"border": want.border, "shift": want.shift})]  # fmt: skip
        assert sorted(map(tuple, columns[0])) == sorted(map(tuple, columns[1]))
        corners = [np.sort(x[slice(*want.vertex_offset[i : i + 2])], axis=0) for x in (cells["vertices"], want.vertices)]
        assert corners[0] == pytest.approx(corners[1], abs=1e-6)
    counts = found.cells.counts.get()
    exact = diagram.compute(seeds, cells=counts)
    assert np.array_equal(exact.cells.get()["border"], diagram.compute(seeds, cells=True).cells.get()["border"])
    assert diagram.compute(seeds, cells=counts, out=exact).cells is exact.cells
    short = diagram.compute(seeds, cells=[200, *(counts[1:] // 2)])
    with pytest.raises(pc.Error, match=f"the cells have 200 pieces, {counts[1]} vertices") as caught:
        short.cells.get()
    assert caught.value.code == "invalid_argument"
    assert diagram.compute(seeds[:0], cells=True).cells.get()["vertex_offset"].tolist() == [0]
    with pytest.raises(ValueError, match="four numbers"):
        diagram.compute(seeds, cells=5)


@pytest.mark.parametrize("dtype, tolerance", [(np.float64, 1e-11), (np.float32, 1e-3)])
@pytest.mark.parametrize("d", [2, 3])
def test_boundary_walls_are_those_of_diagram(rng, queue, d, dtype, tolerance):
    box = pc.Domain.box([0] * d, [1] * d)
    p = rng.random((300, d)).astype(dtype)
    want = pc.Diagram(box, p, precision="double" if dtype == np.float64 else "float").boundary_walls
    diagram = pc.DeviceDiagram(box, queue)
    seeds = cl.array.to_device(queue, p)
    found = diagram.compute(seeds, boundary_walls=True, uncertain=True)
    diagram.repair(seeds, out=found)
    indptr, indices, data = found.boundary_walls.get()
    assert data.dtype == dtype and indptr.dtype == indices.dtype == np.uint32
    assert np.array_equal(indptr, want.indptr) and np.array_equal(indices, want.indices)
    assert data == pytest.approx(want.data, abs=tolerance)
    for facet in range(2 * d):
        assert data[indices == facet].sum() == pytest.approx(1, abs=10 * tolerance)
    assert found.adjacency is None and diagram.compute(seeds).boundary_walls is None
    both = diagram.compute(seeds, adjacency=True, boundary_walls=True, out=found)
    assert both.boundary_walls is found.boundary_walls
    assert np.array_equal(both.adjacency.get()[1], diagram.compute(seeds, adjacency=True).adjacency.get()[1])
    assert np.array_equal(diagram.compute(seeds, boundary_walls=len(data)).boundary_walls.get()[0], indptr)
    with pytest.raises(pc.Error, match=rf"{len(data)} entries, and room for 10; give compute\(boundary_walls=") as error:
        diagram.compute(seeds, boundary_walls=10).boundary_walls.get()
    assert error.value.code == "invalid_argument"
    assert diagram.compute(seeds[:0], boundary_walls=True).boundary_walls.get()[0].tolist() == [0]


@pytest.mark.parametrize("dtype, tolerance", [(np.float64, 1e-11), (np.float32, 1e-3)])
@pytest.mark.parametrize("solid", [False, True])
def test_masses_are_those_of_a_density_at_vertices(rng, queue, solid, dtype, tolerance):
    mesh = pc.Domain.volume(*pc.ball(3)) if solid else pc.Domain.surface(*pc.sphere(4))
    p = rng.uniform(-1, 1, (100, 3)).astype(dtype)
    values = rng.random(len(mesh.regions.vertices)).astype(dtype)
    other = rng.random(len(values)).astype(dtype)
    want = pc.integrate(pc.Diagram(mesh, p), values)
    diagram = pc.DeviceDiagram(mesh, queue)
    seeds, density = cl.array.to_device(queue, p), cl.array.to_device(queue, values)
    found = diagram.compute(seeds, density=density, uncertain=True)
    assert found.density is density
    diagram.repair(seeds, out=found)
    size = want.mass.max()
    assert found.mass.get() == pytest.approx(want.mass, abs=tolerance * size)
    assert found.second_moment.get() == pytest.approx(want.second_moment, abs=4 * tolerance * size)
    big = want.mass > 0.1 * size
    assert found.centroid.get()[big] == pytest.approx(want.centroid[big], abs=10 * tolerance)
    # Changed on the device, and a part of an array.
    density.set(other)
    changed = diagram.compute(seeds, density=density).mass.get()
    assert changed == pytest.approx(pc.integrate(pc.Diagram(mesh, p), other).mass, abs=tolerance * size)
    part = cl.array.to_device(queue, np.concatenate([values, other]))[len(values) :]
    assert np.array_equal(diagram.compute(seeds, density=part).mass.get(), changed)
    uniform = diagram.compute(seeds, out=found)
    assert uniform.density is None
    assert uniform.mass.get() == pytest.approx(pc.Diagram(mesh, p).mass, abs=tolerance * size)


def test_repair_of_ties_keeps_the_density(queue):
    mesh = pc.Domain.volume(*pc.ball(2))
    grid = np.stack(np.meshgrid(*[np.linspace(-0.75, 0.75, 4)] * 3), axis=-1).reshape(-1, 3)
    values = 1 + mesh.regions.vertices[:, 0]
    diagram = pc.DeviceDiagram(mesh, queue)
    seeds, density = cl.array.to_device(queue, grid), cl.array.to_device(queue, np.ascontiguousarray(values))
    found = diagram.compute(seeds, density=density, uncertain=True)
    diagram.compute(seeds)  # without: repair() takes that of the results
    assert diagram.repair(seeds, out=found) == 56  # those of the corners are far outside
    assert found.mass.get() == pytest.approx(pc.integrate(pc.Diagram(mesh, grid), values).mass, abs=1e-12)


def test_both_loaders_name_the_same_devices(queue):
    device = pc.Device.from_queue(queue)
    assert device.name == queue.device.name.strip() and device.queue is queue
    assert pc.Device.choose(device._info.selector).name == device.name
    assert pc.Device.from_queue(queue) is device


def test_kernels_of_the_caller_run_before_and_after(rng, queue, square):
    """Seeds that a kernel writes, and masses that a kernel reads, with no wait in between."""
    source = """
        __kernel void halve(__global double *x) { x[get_global_id(0)] *= 0.5; }
        __kernel void times(__global const double *x, __global double *y) {
          y[get_global_id(0)] = 3 * x[get_global_id(0)];
        }"""
    program = cl.Program(queue.context, source).build()
    p = rng.random((300, 2))
    seeds = cl.array.to_device(queue, 2 * p, async_=True)
    program.halve(queue, (600,), None, seeds.base_data)
    mass = pc.DeviceDiagram(square, queue).compute(seeds).mass
    tripled = cl.array.empty_like(mass)
    program.times(queue, (300,), None, mass.base_data, tripled.base_data)
    assert tripled.get() == pytest.approx(3 * pc.Diagram(square, p).mass, rel=1e-10)


def test_events_of_another_queue_are_waited_for(rng, queue, square):
    other = cl.CommandQueue(queue.context)
    p = rng.random((300, 2))
    gate = cl.UserEvent(queue.context)
    seeds = cl.array.empty(other, (300, 2), np.float64)
    seeds.add_event(cl.enqueue_copy(other, seeds.base_data, p, is_blocking=False, wait_for=[gate]))
    found = pc.DeviceDiagram(square, queue).compute(seeds)
    assert found.event.command_execution_status != cl.command_execution_status.COMPLETE
    gate.set_status(cl.command_execution_status.COMPLETE)
    other.flush()
    assert found.mass.get() == pytest.approx(pc.Diagram(square, p).mass, rel=1e-10)


def test_arrays_are_written_again_and_may_be_parts_of_buffers(rng, queue, square):
    diagram = pc.DeviceDiagram(square, queue)
    p = rng.random((2, 200, 2))
    both = cl.array.to_device(queue, p)
    first = diagram.compute(both[0])
    want = first.mass.get()
    second = diagram.compute(both[1], out=first)  # its offset in the buffer is not 0
    assert second.measures is first.measures
    assert second.mass.get() == pytest.approx(pc.Diagram(square, p[1]).mass, rel=1e-10)
    assert want == pytest.approx(pc.Diagram(square, p[0]).mass, rel=1e-10)
    pool = cl.tools.MemoryPool(cl.tools.ImmediateAllocator(queue))
    pooled = diagram.compute(cl.array.to_device(queue, p[0], allocator=pool))
    assert pooled.mass.allocator is pool and np.array_equal(pooled.mass.get(), want)


def test_cells_that_only_the_host_can_compute_are_reported(queue, square):
    angle = np.linspace(0, 2 * np.pi, 301)[:-1]
    ring = 0.5 + 0.4 * np.column_stack([np.cos(angle), np.sin(angle)])
    p = np.vstack([ring, [[0.5, 0.5]]])
    found = pc.DeviceDiagram(square, queue).compute(cl.array.to_device(queue, p))
    assert found.count() == {0: 300, 1: 0, 2: 0, 3: 0, 4: 1}
    assert found.status.get()[300] == pc.DeviceStatus.UNFINISHED and np.isnan(found.measures.get()[300]).all()
    want = pc.Diagram(square, p).mass
    assert found.mass.get()[:300] == pytest.approx(want[:300], rel=1e-9)
    with pytest.raises(pc.Error, match="1 of 301 seeds are left to the host.*repair.*seed 300") as caught:
        found.check()
    assert caught.value.code == "unsupported"
    p[7] = np.nan
    with pytest.raises(pc.Error, match="seed 7") as caught:
        pc.DeviceDiagram(square, queue).compute(cl.array.to_device(queue, p)).check()
    assert caught.value.code == "invalid_seed"


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_repair_makes_results_exact(queue, square, dtype):
    """A grid of which all cells tie, one of many faces, and invalid seeds between them."""
    axis = (np.arange(8) + 0.5) / 8
    grid = np.stack(np.meshgrid(axis, axis), -1).reshape(-1, 2)
    angle = np.linspace(0, 2 * np.pi, 301)[:-1]
    p = np.vstack([grid, 0.5 + 0.04 * np.column_stack([np.cos(angle), np.sin(angle)]), [[0.5, 0.5]]]).astype(dtype)
    want = pc.Diagram(square, p, precision="double" if dtype == np.float64 else "float")
    bad = np.insert(p, [0, 40], np.nan, axis=0)
    valid = np.isfinite(bad).all(axis=1)
    diagram = pc.DeviceDiagram(square, queue)
    seeds = cl.array.to_device(queue, bad)
    found = diagram.compute(seeds, adjacency=True, uncertain=True)
    assert found.count()[pc.DeviceStatus.UNFINISHED] == 1
    assert np.isnan(found.mass.get()[-1])
    listed = found.uncertain.get()
    assert len(bad) - 1 in listed and np.all(np.diff(listed.astype(int)) > 0) and valid[listed].all()
    assert diagram.repair(seeds, out=found) == len(listed)
    assert np.array_equal(found.status.get()[valid], want.status)
    assert (found.status.get()[~valid] == pc.DeviceStatus.INVALID).all()
    assert found.mass.get()[valid] == pytest.approx(want.mass, rel=1e-4, abs=1e-9)
    indptr, indices, data = found.adjacency.get()
    walls = scipy.sparse.csr_array((data, indices, indptr), shape=(len(bad), len(bad))).tocsr()[valid][:, valid]
    exact = want.adjacency.to_scipy()
    assert abs(walls - walls.T).max() == 0
    assert np.array_equal(walls.indptr, exact.indptr) and np.array_equal(walls.indices, exact.indices)
    again = diagram.compute(seeds, adjacency=True, uncertain=True, out=found)
    assert again.uncertain is found.uncertain and np.array_equal(again.uncertain.get(), listed)
    few = diagram.compute(seeds, uncertain=3)
    with pytest.raises(pc.Error, match=f"{len(listed)} seeds are uncertain, and there is room for 3"):
        few.uncertain.get()
    with pytest.raises(pc.Error, match=f"{len(listed)} seeds are uncertain, and their list has room for 3") as caught:
        diagram.repair(seeds, out=few)
    assert caught.value.code == "invalid_argument"
    with pytest.raises(ValueError, match="out has no list"):
        diagram.repair(seeds, out=diagram.compute(seeds))
    none = diagram.compute(seeds[:0], uncertain=True)
    assert len(none.uncertain.get()) == 0 and diagram.repair(seeds[:0], out=none) == 0


def test_periodic_domains(rng, queue):
    box = pc.Domain.box([0, 0, 0], [1, 1, 1], periodic=True)
    p = rng.random((500, 3)) * 3 - 1
    want = pc.Diagram(box, p)
    seeds = cl.array.to_device(queue, p)
    diagram = pc.DeviceDiagram(box, queue, image_capacity=5000)
    found = diagram.compute(seeds, adjacency=True, uncertain=True)
    diagram.repair(seeds, out=found)
    assert found.mass.get() == pytest.approx(want.mass, abs=1e-10)
    assert found.centroid.get() == pytest.approx(want.centroid, abs=1e-8)
    indptr, indices, data = found.adjacency.get()
    assert np.array_equal(indptr, want.adjacency.indptr) and np.array_equal(indices, want.adjacency.indices)
    assert np.array_equal(found.adjacency.get_shift(), want.adjacency.shift)
    assert diagram.compute(seeds, adjacency=True, out=found).adjacency is found.adjacency
    few = pc.DeviceDiagram(box, queue, image_capacity=10).compute(seeds)
    assert few.count()[pc.DeviceStatus.UNFINISHED] == 500


def test_regions_beyond_the_room_are_unfinished(rng, queue):
    ball = pc.Domain.volume(*pc.ball(4))
    p = rng.uniform(-1, 1, (100, 3))
    seeds = cl.array.to_device(queue, p)
    whole = pc.DeviceDiagram(ball, queue).compute(seeds).check()
    assert whole.mass.get() == pytest.approx(pc.Diagram(ball, p).mass, abs=1e-12)
    count = pc.DeviceDiagram(ball, queue, pair_capacity=50).compute(seeds).count()
    assert count[pc.DeviceStatus.UNFINISHED] > 0


def test_wrong_arguments_are_named(rng, queue, square):
    diagram = pc.DeviceDiagram(square, queue)

    def device(x):
        return cl.array.to_device(queue, np.asarray(x))

    good = device(rng.random((4, 2)))
    for part, call in [
        ("positions is a ndarray", lambda: diagram.compute(np.zeros((4, 2)))),
        (r"positions has the shape \(4, 3\); \(n, 2\)", lambda: diagram.compute(device(np.zeros((4, 3))))),
        ("positions has the type int64", lambda: diagram.compute(device(np.zeros((4, 2), np.int64)))),
        ("positions is not C-contiguous", lambda: diagram.compute(device(np.zeros((2, 4))).T)),
        (r"weights has the shape \(3,\); \(4,\)", lambda: diagram.compute(good, device(np.zeros(3)))),
        ("weights has the type float32", lambda: diagram.compute(good, device(np.zeros(4, np.float32)))),
        ("adjacency is 0", lambda: diagram.compute(good, adjacency=0)),
        ("boundary_walls is 'all'", lambda: diagram.compute(good, boundary_walls="all")),
        ("uncertain is 0", lambda: diagram.compute(good, uncertain=0)),
        ("density is a ndarray", lambda: diagram.compute(good, density=np.ones(4))),
        ("density has the type float32", lambda: diagram.compute(good, density=device(np.ones(4, np.float32)))),
        (
            "density has 9 values; 12 are expected",
            lambda: pc.DeviceDiagram(pc.Domain.surface(*pc.sphere(1)), queue).compute(
                device(np.zeros((1, 3))), density=device(np.ones(9))
            ),
        ),
        ("wall_capacity is -1", lambda: pc.DeviceDiagram(square, queue, wall_capacity=-1)),
        ("queue is a int", lambda: pc.DeviceDiagram(square, 3)),
        ("queue is a Device without", lambda: pc.DeviceDiagram(square, pc.devices()[0])),
        ("positions is an array of pyopencl.*DeviceDiagram", lambda: pc.Diagram(square, good)),
    ]:
        with pytest.raises(ValueError, match=part):
            call()
    elsewhere = cl.CommandQueue(cl.Context([queue.device]))
    for code, call in [
        ("invalid_argument", lambda: diagram.compute(cl.array.to_device(elsewhere, np.zeros((4, 2))))),
        ("unsupported", lambda: diagram.compute(good, density=device(np.ones(4)))),
        ("unsupported", lambda: pc.DeviceDiagram(pc.Domain.solid(*pc.sphere(4)), queue)),
        ("invalid_argument", lambda: pc.Device.from_queue(out_of_order(queue))),
    ]:
        with pytest.raises(pc.Error) as caught:
            call()
        assert caught.value.code == code


def out_of_order(queue):
    properties = cl.command_queue_properties.OUT_OF_ORDER_EXEC_MODE_ENABLE
    return cl.CommandQueue(queue.context, properties=properties)


def test_no_seeds_on_a_queue(queue, square):
    none = pc.DeviceDiagram(square, queue).compute(cl.array.empty(queue, (0, 2), np.float64))
    assert none.mass.shape == (0,) and none.status.shape == (0,) and sum(none.count().values()) == 0


def test_a_host_diagram_on_the_queue_of_the_caller(rng, queue, square):
    p = rng.random((100, 2))
    diagram = pc.Diagram(square, p, device=pc.Device.from_queue(queue))
    assert diagram.mass.sum() == pytest.approx(1, abs=1e-12)


def test_results_outlive_the_diagram_and_its_queue(rng, square, queue):
    p = rng.random((100, 2))
    found = pc.DeviceDiagram(square, queue).compute(cl.array.to_device(queue, p))
    del queue
    gc.collect()
    assert found.check().mass.get() == pytest.approx(pc.Diagram(square, p).mass, rel=1e-10)


def test_one_device_diagram_in_two_threads(rng, queue, square):
    diagram = pc.DeviceDiagram(square, queue)
    seeds = [rng.random((500, 2)) for _ in range(2)]
    want = [pc.Diagram(square, p).mass for p in seeds]
    wrong = []

    def work(k):
        mine = cl.array.to_device(queue, seeds[k])
        for _ in range(20):
            if not np.allclose(diagram.compute(mine).mass.get(), want[k], rtol=1e-9, atol=0):
                wrong.append(k)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_objects_on_a_queue_may_live_when_the_interpreter_ends():
    program = (
        "import numpy as np, pyopencl as cl, pyopencl.array, powercell as pc\n"
        "queue = cl.CommandQueue(cl.create_some_context(interactive=False))\n"
        "d = pc.DeviceDiagram(pc.Domain.box([0, 0], [1, 1]), queue)\n"
        "m = d.compute(cl.array.to_device(queue, np.random.rand(100, 2)))\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stderr) == (0, "")
