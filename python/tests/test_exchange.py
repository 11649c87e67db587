"""Exchange with Shapely, GeoPandas, matplotlib, PyVista, meshio and trimesh, where they are installed."""

import base64
import html
import json
import math
import zlib

import numpy as np
import pytest

import powercell as pc


def test_polygons_of_cells(rng):
    shapely = pytest.importorskip("shapely")
    domain = pc.Domain.polygon(shapely.Point(0, 0).buffer(1).difference(shapely.Point(0, 0).buffer(0.5)))
    diagram = pc.Diagram(domain, np.vstack([rng.normal(size=(20, 2)), [[0, 0]]]), [*[0.0] * 20, 0.5])
    cells = diagram.polygons()
    assert [cell.area for cell in cells] == pytest.approx(diagram.mass.tolist(), abs=1e-12)
    assert all(cell.is_valid for cell in cells)


def test_geopandas_keeps_columns_and_crs():
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    land = geopandas.GeoSeries([shapely.box(0, 0, 1000, 1000)], crs="EPSG:32633")
    shops = geopandas.GeoDataFrame(
        {"name": ["north", "south"], "mass": [5, 6]},
        geometry=geopandas.points_from_xy([500, 500], [750, 250]),
        crs="EPSG:32633",
    )
    areas = pc.Diagram(pc.Domain.polygon(land), shops).to_geopandas()
    assert areas.crs == land.crs and areas.geometry.area.tolist() == pytest.approx([500_000, 500_000])
    assert areas["name"].tolist() == ["north", "south"] and areas["mass"].tolist() == [5, 6]
    assert areas["cell_mass"].tolist() == pytest.approx([500_000, 500_000])
    assert pc.Diagram(pc.Domain.polygon(land), shops.geometry).to_geopandas().crs == land.crs
    with pytest.raises(ValueError, match="degrees"):
        pc.Domain.polygon(land.to_crs("EPSG:4326"))
    with pytest.raises(ValueError, match="positions are in EPSG:4326"):
        pc.Diagram(pc.Domain.polygon(land), shops.to_crs("EPSG:4326"))


def test_files_in_degrees_are_refused_as_shapes_are(tmp_path):
    ring = [[11, 44], [13, 44], [13, 46], [11, 46], [11, 44]]
    for name in ("EPSG:4326", "urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4258"):
        file = tmp_path / "land.geojson"
        crs = {"type": "name", "properties": {"name": name}}
        file.write_text(json.dumps({"type": "Polygon", "coordinates": [ring], "crs": crs}))
        with pytest.raises(ValueError, match="in degrees .*project it first.*degrees=True"):
            pc.read_domain(file)
        assert pc.read_domain(file, degrees=True).measure == pytest.approx(4)
    file.write_text(json.dumps({"type": "Polygon", "coordinates": [ring]}))
    assert pc.read_domain(file).measure == pytest.approx(4)  # nothing says so


def test_plot(rng, square):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    diagram = pc.Diagram(square, rng.random((20, 2)))
    axes = diagram.plot(color=diagram.mass)
    assert len(axes.collections[0].get_paths()) == 20
    assert diagram.plot(ax=axes, color="red") is axes
    with pytest.raises(ValueError, match="in the plane"):
        pc.Diagram(pc.Domain.box([0] * 3, [1] * 3), rng.random((2, 3))).plot()


def test_pyvista(rng, cube):
    pytest.importorskip("pyvista")
    diagram = pc.Diagram(cube, rng.random((20, 3)))
    mesh = diagram.to_pyvista()
    assert mesh.n_cells == 20 and mesh.volume == pytest.approx(1)
    assert np.array_equal(mesh["seed"], np.arange(20))
    flat = pc.Diagram(pc.Domain.box([0, 0], [1, 2]), rng.random((20, 2))).to_pyvista()
    assert flat.area == pytest.approx(2)
    sphere = pc.Domain.surface(*pc.sphere(4))
    surface = pc.Diagram(sphere, rng.normal(size=(10, 3))).to_pyvista()
    assert surface.area == pytest.approx(sphere.measure)
    assert pc.Domain.surface(surface.triangulate()).measure == pytest.approx(sphere.measure)


def test_meshes_of_other_packages(rng):
    meshio = pytest.importorskip("meshio")
    vertices, tetrahedra = pc.ball(3)
    volume = pc.Domain.volume(meshio.Mesh(vertices, [("tetra", tetrahedra)]))
    assert volume.measure == pc.Domain.volume(vertices, tetrahedra).measure
    with pytest.raises(ValueError, match="no cells of the kind triangle"):
        pc.Domain.surface(meshio.Mesh(vertices, [("tetra", tetrahedra)]))
    out = pc.Diagram(pc.Domain.box([0, 0], [1, 1]), rng.random((9, 2))).to_meshio()
    assert sum(len(block.data) for block in out.cells) == 9
    trimesh = pytest.importorskip("trimesh")
    box = trimesh.creation.box()
    assert pc.Domain.surface(box).measure == pytest.approx(6)


def test_html(square):
    text = pc.Diagram(square, [[0.5, 0.5]])._repr_html_()
    assert "<table>" in text and "polygon of area 1" in text


def test_pages(square, cube, rng, tmp_path):
    for domain, d in ((square, 2), (cube, 3), (pc.Domain.surface(*pc.sphere(4)), 3), (pc.Domain.solid(*pc.sphere(4)), 3)):
        diagram = pc.Diagram(domain, rng.random((20, d)), rng.random(20) / 100)
        path = tmp_path / "view.html"
        diagram.to_html(path, {"size": [*range(19), math.nan], "<town>": ["Ulm", "Bern"] * 10})
        text = path.read_text(encoding="utf-8")
        data = json.loads(text.split('id="diagram">')[1].split("</script>")[0])
        assert data["seeds"] == 20 and data["check"]["domain_measure"] == diagram.domain_measure
        assert [column["name"] for column in data["columns"]] == ["size", "<town>"]
        assert [column["type"] for column in data["columns"]] == ["number", "text"]
        packed = text.split('id="array-measure">')[1].split("</script>")[0]
        assert np.array_equal(np.frombuffer(zlib.decompress(base64.b64decode(packed))), diagram.mass)
    shown = diagram.view(height=300)._repr_html_()
    assert shown.startswith("<iframe") and "height:300px" in shown and html.escape(text[:200]) in shown
    with pytest.raises(ValueError, match="3 values, for 20 seeds"):
        diagram.to_html(path, {"size": [1, 2, 3]})
    with pytest.raises(ValueError, match="end in .html"):
        diagram.to_html(tmp_path / "view.txt")
    with pytest.raises(pc.Error, match="cannot create|No such file"):
        diagram.to_html(tmp_path / "nowhere" / "view.html")
