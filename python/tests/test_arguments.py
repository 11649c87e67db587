"""Arguments that are wrong, or right in an unusual form."""

import pickle

import numpy as np
import pytest

import powercell as pc


def value_error(part, call):
    with pytest.raises(ValueError, match=part):
        call()


def library_error(code, part, call):
    with pytest.raises(pc.Error, match=part) as caught:
        call()
    assert caught.value.code == code
    assert isinstance(caught.value, RuntimeError)


def test_shapes_and_types_are_named(square):
    value_error(r"positions has the shape \(5, 3\).*the domain is in the plane", lambda: pc.Diagram(square, np.zeros((5, 3))))
    value_error("positions has the type <U1", lambda: pc.Diagram(square, [["a", "b"]]))
    value_error("positions has the type object", lambda: pc.Diagram(square, np.zeros((2, 2), object)))
    value_error("positions has the type complex128", lambda: pc.Diagram(square, np.zeros((2, 2), complex)))
    value_error("positions is not an array", lambda: pc.Diagram(square, [[0, 1], [2]]))
    value_error(r"weights has the shape \(3,\); \(2,\)", lambda: pc.Diagram(square, np.zeros((2, 2)), [1, 2, 3]))
    value_error("positions is a masked array", lambda: pc.Diagram(square, np.ma.masked_less(np.eye(2), 1)))
    value_error("precision is 'half'", lambda: pc.Diagram(square, [[0, 0]], precision="half"))
    value_error("threads is -1", lambda: pc.Diagram(square, [[0, 0]], threads=-1))
    value_error("domain is a int", lambda: pc.Diagram(3, [[0, 0]]))
    value_error("device is a int", lambda: pc.Diagram(square, [[0, 0]], device=3))
    value_error("device is a int", lambda: pc.Diagram(square, [[0, 0]], device=[3]))
    value_error("a device of the list is None", lambda: pc.Diagram(square, [[0, 0]], device=[None]))
    first = pc.devices()[0]
    library_error("invalid_argument", "twice in a group", lambda: pc.Diagram(square, [[0, 0]], device=[first, first.selector]))
    library_error("invalid_argument", "at least one device", lambda: pc.Diagram(square, [[0, 0]], device=[]))
    value_error("triangles: row 0 has a number below 0", lambda: pc.Domain.surface(np.eye(3), [[0, 1, -1]]))
    value_error("triangles has the type float64", lambda: pc.Domain.surface(np.eye(3), [[0.0, 1, 2]]))
    value_error("low has 1 coordinates", lambda: pc.Domain.box([0], [1]))
    value_error("periodic has 3 values", lambda: pc.Domain.box([0, 0], [1, 1], [True] * 3))
    value_error("points is 0", lambda: pc.sample(square, 0))
    with pytest.raises(TypeError):
        pc.Domain("square")


def test_whole_numbers_are_checked(rng, square):
    p = rng.random((20, 2))
    diagram = pc.Diagram(square, p)
    value_error("chunk_pairs is -1; a whole number from 0", lambda: pc.Diagram(square, p, chunk_pairs=-1))
    value_error("threads is 1000000000000; a whole number from 0 to", lambda: pc.Diagram(square, p, threads=10**12))
    value_error("threads is 1.5; a whole number", lambda: pc.Diagram(square, p, threads=1.5))
    value_error("random_seed is -1", lambda: pc.sample(square, 10, random_seed=-1))
    value_error("iterations is -1", lambda: pc.sample(square, 10, iterations=-1))
    value_error("points is -3", lambda: pc.sample(square, -3))
    value_error("max_steps is -1", lambda: pc.transport(square, p, max_steps=-1))
    value_error("rounds is -1", lambda: pc.treemap({"a": 1, "b": 2}, rounds=-1))
    value_error("count is -5", lambda: pc.remesh(*pc.sphere(4), count=-5))
    value_error("samples is -1", lambda: diagram.verify(samples=-1))
    value_error("seeds: row 0 has a number below 0", lambda: diagram.select([-1]))
    value_error("progress is a int", lambda: pc.Diagram(square, p, progress=3))
    library_error("invalid_argument", "entry 0 of the selection is 20", lambda: diagram.select([20]))
    library_error("invalid_domain", "axis x: low 0 is not less than high -1", lambda: pc.Domain.box([0, 0], [-1, 1]))
    assert pc.Diagram(square, p, threads=np.int32(1)).mass.sum() == pytest.approx(1)
    for wrong in (-1, 20):
        with pytest.raises(IndexError, match=f"seed is {wrong}; 0 to 19 are expected"):
            diagram.adjacency.neighbors(wrong)


def test_errors_of_the_library_have_codes(square):
    library_error("invalid_seed", "seed 1: coordinate y is NaN", lambda: pc.Diagram(square, [[0, 0], [0, np.nan]]))
    library_error("invalid_domain", "crosses itself at", lambda: pc.Domain.polygon([[0, 0], [1, 1], [1, 0], [0, 1]]))
    library_error("invalid_domain", "depend", lambda: pc.Domain.lattice([[1, 0], [2, 0]]))
    library_error("device_not_found", "no such device", lambda: pc.Diagram(square, [[0, 0]], device="no such device"))
    library_error("invalid_file", "missing.off", lambda: pc.read_domain("missing.off"))
    error = pickle.loads(pickle.dumps(pc.Error("text", "opencl")))
    assert (str(error), error.code) == ("text", "opencl")


def test_other_layouts_give_the_same(rng, square):
    p, w = rng.random((30, 2)), rng.random(30) * 0.01
    want = pc.Diagram(square, p, w).mass
    padded = np.zeros((30, 4))
    padded[:, ::2] = p
    for same in (np.asfortranarray(p), padded[:, ::2], p.tolist(), p.astype(">f8")):
        assert np.array_equal(pc.Diagram(square, same, w).mass, want)
    frozen = p.copy()
    frozen.flags.writeable = False
    assert np.array_equal(pc.Diagram(square, frozen, w[::-1][::-1]).mass, want)
    wide, whole = pc.Domain.box([0, 0], [64, 64]), (p * 64) // 1
    for kind in (np.int64, np.uint8, np.float16, np.longdouble):
        assert np.array_equal(pc.Diagram(wide, whole.astype(kind)).mass, pc.Diagram(wide, whole).mass)


def test_no_seeds(square):
    empty = pc.Diagram(square, np.zeros((0, 2)))
    assert empty.mass.shape == (0,) and empty.centroid.shape == (0, 2)
    assert empty.adjacency.indptr.tolist() == [0] and empty.dual.shape[0] == 0
    with pytest.raises(ValueError, match="np.empty"):
        pc.Diagram(square, [])
    assert pc.regular_triangulation(np.zeros((0, 3))).shape == (0, 4)
    library_error("invalid_argument", "no seeds", lambda: pc.transport(square, np.zeros((0, 2))))
    library_error("invalid_domain", "no triangles", lambda: pc.Domain.surface(np.zeros((0, 3)), np.zeros((0, 3), int)))


def test_arrays_given_are_copied(square):
    p = np.array([[0.25, 0.5], [0.75, 0.5]])
    diagram = pc.Diagram(square, p)
    p[:] = 0.9
    assert diagram.mass.tolist() == [0.5, 0.5]


def test_polygons_in_many_forms():
    shapely = pytest.importorskip("shapely")
    ring, hole = [[0, 0], [4, 0], [4, 4], [0, 4]], [[1, 1], [1, 2], [2, 2], [2, 1]]
    polygon = shapely.Polygon(ring, [hole])
    far = shapely.transform(polygon, lambda x: x + 10)
    assert pc.Domain.polygon(polygon).measure == 15
    assert pc.Domain.polygon(shapely.MultiPolygon([polygon, far])).measure == 30
    assert pc.Domain.polygon(polygon.__geo_interface__).measure == 15
    assert pc.Domain.polygon(np.array(ring)).measure == 16
    assert pc.Domain.polygon(ring).measure == 16
    assert pc.Domain.polygon([np.array(ring), np.array(hole)]).measure == 15
    assert pc.Domain.polygon([[ring, hole], [np.array(ring) + 10]]).measure == 31
    value_error("shape is a Point", lambda: pc.Domain.polygon(shapely.Point(0, 0)))


def test_readers(tmp_path):
    assert pc.read_domain("sphere:4").kind == "surface"
    (tmp_path / "a.csv").write_text("name,x,y,weight\nleft,.25,.5,.1\nright,.75,.5,0\n")
    seeds = pc.read_seeds(tmp_path / "a.csv")
    assert seeds.positions.tolist() == [[0.25, 0.5], [0.75, 0.5]] and seeds.weights.tolist() == [0.1, 0]
    assert seeds.columns["name"].tolist() == ["left", "right"] and seeds.columns["weight"].tolist() == [0.1, 0]
    (tmp_path / "b.txt").write_text("0 0 1\n1 1 1\n")
    value_error("pass dimension=2 or 3", lambda: pc.read_seeds(tmp_path / "b.txt"))
    assert pc.read_seeds(tmp_path / "b.txt", dimension=3).positions.shape == (2, 3)
    assert pc.read_seeds(tmp_path / "b.txt", dimension=2).weights.tolist() == [1, 1]
    (tmp_path / "c.csv").write_text("x,y,z\n0,0,1\n")
    assert pc.read_seeds(tmp_path / "c.csv").positions.tolist() == [[0, 0, 1]]
