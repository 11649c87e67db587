"""Diagrams for other packages, which are imported when used."""

from __future__ import annotations

import html
import importlib
import math
import os
import tempfile
from collections.abc import Mapping, Sequence
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from ._frames import table_columns, values_by_label
from ._progress import fraction_bar

if TYPE_CHECKING:
    from ._diagram import Diagram

WALL, BOUNDARY, INTERIOR = 0, 1, 2  # Border.kind


def package(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        package = name.split(".")[0]
        raise ImportError(f"this needs the package {package}: pip install {package}") from error


def _require_polygon(diagram: Diagram) -> None:
    if diagram.domain.kind != "polygon":
        raise ValueError("only cells in the plane are polygons; see to_pyvista() for surfaces and volumes")


def _rings(diagram: Diagram) -> list[list[np.ndarray]]:
    """Per cell its boundary rings, outer ones counter-clockwise."""
    joined = diagram.joined
    vertices, loop = joined.vertices, joined.loop
    first, faces, loops = joined.vertex_offset, joined.face_offset, joined.loop_offset
    result = []
    for cell in range(len(diagram)):
        own = vertices[first[cell] : first[cell + 1]]
        result.append(
            [own[loop[loops[f] : loops[f + 1]]] for f in range(int(faces[cell]), int(faces[cell + 1]))]
        )
    return result


def _signed_area(ring: np.ndarray) -> float:
    x, y = (ring - ring[0]).T
    return float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2


def polygons(diagram: Diagram) -> list[Any]:
    _require_polygon(diagram)
    shapely = package("shapely")
    result = []
    for rings in _rings(diagram):
        outer = [shapely.Polygon(ring) for ring in rings if _signed_area(ring) > 0]
        holes = [ring for ring in rings if _signed_area(ring) < 0]
        if len(outer) == 1:
            result.append(shapely.Polygon(outer[0].exterior, holes))
            continue
        parts = []
        for polygon in outer:
            inside = [h for h in holes if polygon.covers(shapely.Point(h[0]))]
            parts.append(shapely.Polygon(polygon.exterior, inside))
        result.append(shapely.MultiPolygon(parts) if parts else shapely.Polygon())
    return result


def _images_seen(domain: Any, rings: list[np.ndarray], low: np.ndarray, high: np.ndarray) -> list[np.ndarray]:
    """How a cell must be moved for its images that reach into the view from `low` to `high`; 0 alone without periods."""
    if not rings:
        return []
    if not domain.is_periodic:
        return [np.zeros(2)]
    corners = np.vstack(rings)
    steps = range(-3, 4)  # the box around a lattice is wider than its periods
    moves = [a * domain.periods[0] + b * domain.periods[1] for a in steps for b in steps]
    unique = np.unique(np.array(moves), axis=0)
    return [by for by in unique if (corners.max(0) + by > low).all() and (corners.min(0) + by < high).all()]


def _values_to_colour(diagram: Diagram, color: Any) -> Optional[np.ndarray]:
    """A value of each cell; None where `color` is one colour, or none."""
    table = diagram._table
    if color is None or isinstance(color, tuple) or (isinstance(color, str) and color not in table_columns(table)):
        return None
    values: Any = values_by_label(color, table, "color")
    if isinstance(getattr(values, "dtype", None), np.dtype) and values.dtype.kind in "biuf":
        values = np.asarray(values)
    else:
        _, values = np.unique(np.asarray(values, dtype=str), return_inverse=True)
    if values.shape != (len(diagram),):
        raise ValueError(f"color has the shape {values.shape}; ({len(diagram)},) is expected, or a colour")
    return np.asarray(values)


def plot(diagram: Diagram, ax: Any, color: Any, style: dict[str, Any]) -> Any:
    _require_polygon(diagram)
    pyplot = package("matplotlib.pyplot")
    paths, patches = package("matplotlib.path"), package("matplotlib.collections")
    if ax is None:
        _, ax = pyplot.subplots()
    low, high = (np.array(end) for end in diagram.domain.bounds)
    pad = 0.02 * (high - low).max()
    low, high = low - pad, high + pad
    compound, cell_of = [], []
    for cell, rings in enumerate(_rings(diagram)):
        for by in _images_seen(diagram.domain, rings, low, high):
            closed = [paths.Path(np.vstack([ring, ring[:1]]) + by, closed=True) for ring in rings]
            compound.append(paths.Path.make_compound_path(*closed))
            cell_of.append(cell)
    look = {"edgecolor": "0.2", "linewidth": 0.6, **style}
    values = _values_to_colour(diagram, color)
    if values is not None:
        cells = patches.PathCollection(compound, array=values[cell_of], **look)
    else:
        cells = patches.PathCollection(compound, facecolor="0.92" if color is None else color, **look)
    ax.add_collection(cells)
    ax.plot(*diagram.positions.T, ".", color="0.2", markersize=2, zorder=3)
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    return ax


def to_geopandas(diagram: Diagram) -> Any:
    geopandas = package("geopandas")
    given: Any = diagram._table
    columns = table_columns(given)
    centroid = diagram.centroid
    values = {
        "seed": np.arange(len(diagram)),
        "weight": diagram.weights,
        "mass": diagram.mass,
        "cx": centroid[:, 0],
        "cy": centroid[:, 1],
        "status": diagram.status,
    }
    for key, value in values.items():
        columns[key if key not in columns else f"cell_{key}"] = value
    crs = diagram.domain.crs if diagram.domain.crs is not None else getattr(given, "crs", None)
    labels = getattr(given, "index", None)
    return geopandas.GeoDataFrame(columns, geometry=polygons(diagram), crs=crs, index=labels)


def _space(vertices: np.ndarray) -> np.ndarray:
    return vertices if vertices.shape[1] == 3 else np.column_stack([vertices, np.zeros(len(vertices))])


def _piece_arrays(diagram: Diagram) -> tuple[Any, np.ndarray]:
    """The cells and, per piece, its seed. In a solid the joined cells are the pieces."""
    if diagram.domain.is_solid:
        joined = diagram.joined
        seed = np.flatnonzero(np.diff(joined.face_offset.astype(np.int64)))
        arrays = {name: getattr(joined, name) for name in ("cell_dimension", "vertices", "loop_offset", "loop")}
        for name in ("vertex_offset", "face_offset"):
            arrays[name] = np.r_[0, getattr(joined, name)[1:][seed]]
        return SimpleNamespace(**arrays), seed
    cells = diagram.cells
    seed = np.repeat(np.arange(len(diagram)), np.diff(cells.cell_offset.astype(np.int64)))
    return cells, seed


def to_pyvista(diagram: Diagram) -> Any:
    pyvista = package("pyvista")
    cells, seed = _piece_arrays(diagram)
    points = _space(np.asarray(cells.vertices))
    first = cells.vertex_offset.astype(np.int64)
    if cells.cell_dimension == 2:
        faces = [np.r_[b - a, np.arange(a, b)] for a, b in zip(first[:-1], first[1:])]
        mesh = pyvista.PolyData(points, np.concatenate(faces) if faces else None)
    else:
        mesh = pyvista.UnstructuredGrid(*_polyhedra(cells, first), points)
    mesh.cell_data["seed"] = seed
    mesh.cell_data["mass"] = np.asarray(diagram.mass)[seed]
    mesh.cell_data["weight"] = np.asarray(diagram.weights)[seed]
    return mesh


def _polyhedra(cells: Any, first: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The arrays of a grid of VTK's polyhedra (type 42): per piece its size, faces and their corners."""
    faces, loops, loop = cells.face_offset.astype(np.int64), cells.loop_offset.astype(np.int64), cells.loop
    rows = []
    for p in range(len(first) - 1):
        row = [np.array([faces[p + 1] - faces[p]])]
        for f in range(faces[p], faces[p + 1]):
            corners = loop[loops[f] : loops[f + 1]].astype(np.int64) + first[p]
            row += [np.array([len(corners)]), corners]
        body = np.concatenate(row)
        rows.append(np.r_[len(body), body])
    count = len(first) - 1
    return (np.concatenate(rows) if rows else np.zeros(0, np.int64)), np.full(count, 42, np.uint8)


def to_meshio(diagram: Diagram) -> Any:
    meshio = package("meshio")
    cells, seed = _piece_arrays(diagram)
    points = _space(np.asarray(cells.vertices))
    first = cells.vertex_offset.astype(np.int64)
    blocks: list[tuple[str, Any]] = []
    order: list[np.ndarray] = []
    sizes = np.diff(first)
    for size in np.unique(sizes):
        pieces = np.flatnonzero(sizes == size)
        order.append(pieces)
        if cells.cell_dimension == 2:
            name = {3: "triangle", 4: "quad"}.get(int(size), "polygon")
            blocks.append((name, first[pieces][:, None] + np.arange(size)))
        else:
            blocks.append((f"polyhedron{size}", [_faces_of(cells, first, int(p)) for p in pieces]))
    data = {
        "seed": [seed[pieces] for pieces in order],
        "mass": [np.asarray(diagram.mass)[seed[pieces]] for pieces in order],
    }
    return meshio.Mesh(points, blocks, cell_data=data)


def _faces_of(cells: Any, first: np.ndarray, piece: int) -> list[np.ndarray]:
    faces, loops = cells.face_offset, cells.loop_offset
    return [
        cells.loop[loops[f] : loops[f + 1]].astype(np.int64) + first[piece]
        for f in range(int(faces[piece]), int(faces[piece + 1]))
    ]


def _field(value: Any) -> str:
    """As the fields of tables are: empty where there is no number."""
    if isinstance(value, (float, np.floating)):
        return repr(float(value)) if math.isfinite(value) else ""
    return "" if value is None else str(value)


def to_html(diagram: Diagram, path: str, columns: Optional[Mapping[str, Sequence[Any]]]) -> None:
    if columns is None:
        columns = table_columns(diagram._table)
        labels = getattr(diagram._table, "index", None)
        if labels is not None and not np.array_equal(labels, np.arange(len(labels))):
            columns = {str(labels.name or "label"): list(labels), **columns}
    if not isinstance(columns, Mapping):
        raise ValueError("columns is a mapping of names to values, such as {'name': table['name']}")
    texts = [[_field(value) for value in np.asarray(columns[key], dtype=object)] for key in columns]
    for key, fields in zip(columns, texts):
        if len(fields) != len(diagram):
            raise ValueError(f"the column {key} has {len(fields)} values, for {len(diagram)} seeds")
    if not path.lower().endswith(".html"):
        raise ValueError(f"{path} does not end in .html")
    rows = [field for row in zip(*texts) for field in row]
    with fraction_bar(diagram._progress, "page") as report:
        diagram._core.write_html(path, diagram._positions, diagram._weights, [str(key) for key in columns], rows, report)


class Embedded:
    """A page within a notebook."""

    def __init__(self, diagram: Diagram, columns: Optional[Mapping[str, Sequence[Any]]], height: int) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "view.html")
            to_html(diagram, path, columns)
            with open(path, encoding="utf-8") as file:
                self._page = file.read()
        self._height = height

    def _repr_html_(self) -> str:
        page = html.escape(self._page)
        return f'<iframe sandbox="allow-scripts" style="width:100%;height:{self._height}px;border:0" srcdoc="{page}"></iframe>'
