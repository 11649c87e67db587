"""Domains and diagrams that are pickled and copied, and positions and precisions as other packages have them."""

import copy
import multiprocessing
import pickle

import numpy as np
import pytest

import powercell as pc

DOMAINS = {
    "box": lambda: pc.Domain.box([0, 0], [2, 3], periodic=[True, False]),
    "lattice": lambda: pc.Domain.lattice([[1, 0, 0], [0.2, 1, 0], [0, 0.3, 1]]),
    "polygon": lambda: pc.Domain.polygon([[0, 0], [2, 0], [1, 1], [2, 2], [0, 2]], crs="EPSG:3857"),
    "surface": lambda: pc.Domain.surface(*pc.sphere(3)),
    "volume": lambda: pc.Domain.volume(*pc.ball(2)),
    "solid": lambda: pc.Domain.solid(*pc.sphere(3)),
    "built-in": lambda: pc.read_domain("disk:20"),
}


@pytest.mark.parametrize("name", DOMAINS)
def test_domains_pickle_and_copy(name):
    domain = DOMAINS[name]()
    again = pickle.loads(pickle.dumps(domain))
    assert again.measure == domain.measure and again.kind == domain.kind and again.crs == domain.crs
    assert again.is_periodic == domain.is_periodic and again.is_solid == domain.is_solid
    assert copy.copy(domain) is domain and copy.deepcopy(domain) is domain
    _, points = domain.random_points(20)
    assert (pc.Diagram(again, points).mass == pc.Diagram(domain, points).mass).all()


def test_domains_of_files_pickle_by_their_path(tmp_path, monkeypatch):
    path = tmp_path / "square.wkt"
    path.write_text("POLYGON((0 0, 2 0, 2 2, 0 2, 0 0))")
    monkeypatch.chdir(tmp_path)
    packed = pickle.dumps(pc.read_domain("square.wkt"))
    monkeypatch.chdir("/")
    assert pickle.loads(packed).measure == 4


def test_domains_of_files_that_changed_are_refused(tmp_path):
    path = tmp_path / "square.wkt"
    path.write_text("POLYGON((0 0, 2 0, 2 2, 0 2, 0 0))")
    packed = pickle.dumps(pc.read_domain(path))
    path.write_text("POLYGON((0 0, 3 0, 3 3, 0 3, 0 0))")
    with pytest.raises(ValueError, match="has changed since"):
        pickle.loads(packed)


def test_shapes_are_not_files_of_their_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cube").write_text("")
    assert pickle.loads(pickle.dumps(pc.read_domain("cube"))).measure == 1


def _diagram():
    points = np.random.default_rng(1).random((50, 2))
    return pc.Diagram(pc.Domain.box([0, 0], [1, 1]), points, np.linspace(0, 1e-3, 50), precision="double")


def _mass(diagram):
    return diagram.mass


def test_diagrams_pickle_and_copy():
    diagram = _diagram()
    for again in (pickle.loads(pickle.dumps(diagram)), copy.copy(diagram), copy.deepcopy(diagram)):
        assert (again.mass == diagram.mass).all()
        again.set_weights(np.zeros(50))
        assert (again.mass != diagram.mass).any()
    diagram.select([7, 3])
    assert (pickle.loads(pickle.dumps(diagram)).mass == diagram.mass).all()


def test_diagrams_go_to_another_process():
    diagram = _diagram()
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert (pool.apply(_mass, (diagram,)) == diagram.mass).all()


def test_diagrams_of_an_open_device_are_not_copied():
    diagram = pc.Diagram(pc.Domain.box([0, 0], [1, 1]), [[0.5, 0.5]], device=pc.devices()[0])
    with pytest.raises(TypeError, match="with the device's name"):
        pickle.dumps(diagram)


def test_no_positions_are_meant_only_as_an_array():
    box = pc.Domain.box([0, 0], [1, 1])
    with pytest.raises(ValueError, match=r"np.empty\(\(0, 2\)\)"):
        pc.Diagram(box, [])
    assert len(pc.Diagram(box, np.empty((0, 2)))) == 0


def test_points_of_shapely():
    shapely = pytest.importorskip("shapely")
    box, xy = pc.Domain.box([0, 0], [1, 1]), np.array([[0.2, 0.5], [0.8, 0.4], [0.5, 0.9]])
    points = [shapely.Point(*row) for row in xy]
    for given in (points, tuple(points), np.array(points, dtype=object), shapely.MultiPoint(points)):
        assert (pc.Diagram(box, given).positions == xy).all()
    with pytest.raises(ValueError, match="row 3 is a LineString; points are expected"):
        pc.Diagram(box, [*points, shapely.LineString([(0, 0), (1, 1)])])
    for wrong in ({"a": [1, 2]}, "points", 3):
        with pytest.raises(ValueError):
            pc.Diagram(box, wrong)
    with pytest.raises(ValueError, match="in the plane"):
        pc.Diagram(pc.Domain.box([0, 0, 0], [1, 1, 1]), points)


def test_geometry_arrays_and_labels_of_geopandas():
    geopandas = pytest.importorskip("geopandas")
    pandas = pytest.importorskip("pandas")
    box, xy = pc.Domain.box([0, 0], [1, 1]), np.array([[0.2, 0.5], [0.8, 0.4], [0.5, 0.9]])
    points = geopandas.points_from_xy(*xy.T)
    assert (pc.Diagram(box, points).positions == xy).all()
    kind = pandas.Categorical(["a", "b", "a"])
    frame = geopandas.GeoDataFrame({"kind": kind}, geometry=points, index=["p", "q", "r"])
    cells = pc.Diagram(box, frame).to_geopandas()
    assert list(cells.index) == ["p", "q", "r"]
    assert cells.kind.dtype == "category" and list(cells.kind) == ["a", "b", "a"]
    assert np.allclose(cells.area, cells.mass)
    frame.index = ["p", "p", "r"]
    assert list(pc.Diagram(box, frame).to_geopandas().index) == ["p", "p", "r"]
    frame.index = ["p", "q", "r"]
    assert list(pc.Diagram(box, frame.geometry).to_geopandas().index) == ["p", "q", "r"]


def test_precisions_of_numpy():
    box, xy = pc.Domain.box([0, 0], [1, 1]), [[0.2, 0.5], [0.8, 0.4]]
    double, single = (pc.Diagram(box, xy, precision=name) for name in ("double", "float"))
    for precision in (np.float32, np.dtype("float32"), "float32", single.precision):
        assert pc.Diagram(box, xy, precision=precision).precision == single.precision
    assert pc.Diagram(box, xy, precision=np.float64).precision == double.precision
    with pytest.raises((ValueError, pc.Error)):
        pc.Diagram(box, xy, precision=np.int32)
    with pytest.raises(ValueError, match="precision"):
        pc.Diagram(box, xy, precision=3.5)


def test_plots_do_not_draw_into_each_other():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    diagram = _diagram()
    first, second = diagram.plot(), diagram.plot()
    assert first is not second
    assert diagram.plot(ax=first) is first
    pyplot.close("all")
