"""Domains: what a diagram is restricted to."""

from __future__ import annotations

import os
from typing import Any, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import Indices, Reals, reals
from ._copies import restore_domain
from ._names import named_arguments
from ._shapes import crs_of, is_geographic, polygon_parts, surface_arrays, volume_arrays


class Domain:
    """A polygon, surface or volume that a diagram is restricted to. Immutable.

    It pickles with what it was made from, or with the path of its file, which then must be there and the same.

    Made by :meth:`box`, :meth:`lattice`, :meth:`polygon`, :meth:`surface`, :meth:`volume` or
    :func:`read_domain`.
    """

    def __init__(self, core: Any, crs: Any = None) -> None:
        self._core: Any
        if not isinstance(core, _core.Domain):
            raise TypeError("use Domain.box, .lattice, .polygon, .surface, .volume, or read_domain")
        self._core = core
        #: Coordinate system of a map, as it came in; None otherwise.
        self.crs = crs
        self._made_by: tuple[str, tuple[Any, ...]]

    @classmethod
    def _make(cls, name: str, arguments: tuple[Any, ...], crs: Any = None) -> Domain:
        if name == "read_domain":
            domain = cls(_core.read_domain(*arguments).domain, crs)
        else:
            domain = cls(getattr(_core.Domain, name)(*arguments), crs)
        domain._made_by = (name, arguments)
        return domain

    def __reduce__(self) -> tuple[Any, ...]:
        return restore_domain, (type(self), *self._made_by, self.crs, self.measure)

    def __copy__(self) -> Domain:
        return self

    def __deepcopy__(self, memo: Any) -> Domain:
        return self

    @classmethod
    @named_arguments
    def box(
        cls, low: ArrayLike, high: ArrayLike, periodic: Union[bool, Sequence[bool]] = False
    ) -> Domain:
        """An axis-aligned box.

        Parameters
        ----------
        low, high : (2,) or (3,) array_like
            Its corners.
        periodic : bool or sequence of bool
            Whether opposite sides are identified: along all axes, or one value an axis.

        Examples
        --------
        >>> import powercell as pc
        >>> pc.Domain.box([0, 0], [2, 3]).measure
        6.0
        """
        first = reals(low, "low", (None,))
        last = reals(high, "high", (len(first),), " as for low")
        if len(first) not in (2, 3):
            raise ValueError(f"low has {len(first)} coordinates; 2 or 3 are expected")
        axes = [periodic] * len(first) if isinstance(periodic, (bool, np.bool_)) else list(periodic)
        if len(axes) != len(first):
            raise ValueError(f"periodic has {len(axes)} values; one for each of {len(first)} axes is expected")
        return cls._make("box", (first.tolist(), last.tolist(), [bool(axis) for axis in axes]))

    @classmethod
    @named_arguments
    def lattice(cls, vectors: ArrayLike, origin: Optional[ArrayLike] = None) -> Domain:
        """The plane or space modulo a lattice, in any basis.

        Parameters
        ----------
        vectors : (2, 2) or (3, 3) array_like
            Rows are the lattice's vectors.
        origin : (d,) array_like, optional
        """
        rows = reals(vectors, "vectors", (None, None))
        if rows.shape not in ((2, 2), (3, 3)):
            raise ValueError(f"vectors has the shape {rows.shape}; (2, 2) or (3, 3) is expected")
        start = [] if origin is None else reals(origin, "origin", (len(rows),)).tolist()
        return cls._make("lattice", (rows.ravel().tolist(), start))

    @classmethod
    @named_arguments
    def polygon(cls, shape: Any, crs: Any = None, *, degrees: bool = False) -> Domain:
        """A polygon of one or more parts with holes.

        Parameters
        ----------
        shape
            A geometry of Shapely, a GeoSeries or GeoDataFrame, anything with ``__geo_interface__``, a mapping
            as in GeoJSON; or an (n, 2) array, a sequence of such rings (the outer one, then its holes), or a
            sequence of parts, each a sequence of rings.
        crs
            Coordinate system, kept for results. Default: that of a GeoSeries.
        degrees : bool
            Accept longitude and latitude, and take them as a plane.
        """
        own = crs_of(shape)
        in_degrees = is_geographic(crs if crs is not None else own)
        if own is not None and crs is not None and own != crs:
            raise ValueError(f"shape is in {own.to_string()}, but crs is {crs!r}; use shape.to_crs({crs!r})")
        crs = crs if crs is not None else own
        if in_degrees and not degrees:
            raise ValueError(
                "shape is in degrees, whose areas and distances mean little: project it first, e.g. "
                "shape.to_crs(shape.estimate_utm_crs()), or pass degrees=True to compute with degrees"
            )
        return cls._make("polygon", (polygon_parts(shape),), crs)

    @classmethod
    @named_arguments
    def surface(cls, vertices: Any, triangles: Optional[ArrayLike] = None) -> Domain:
        """A triangle mesh in space: open, closed or non-manifold.

        Parameters
        ----------
        vertices : (nv, 3) array_like
            Or, alone, a mesh of meshio, trimesh or PyVista.
        triangles : (nt, 3) array_like of int
            Indices of vertices, from 0.
        """
        return cls._make("surface", tuple(surface_arrays(vertices, triangles)))

    @classmethod
    @named_arguments
    def volume(cls, vertices: Any, tetrahedra: Optional[ArrayLike] = None) -> Domain:
        """A tetrahedral mesh.

        Parameters
        ----------
        vertices : (nv, 3) array_like
            Or, alone, a mesh of meshio or PyVista.
        tetrahedra : (nt, 4) array_like of int
            Indices of vertices, from 0, in either orientation.
        """
        return cls._make("volume", tuple(volume_arrays(vertices, tetrahedra)))

    @classmethod
    @named_arguments
    def solid(cls, vertices: Any, triangles: Optional[ArrayLike] = None) -> Domain:
        """The inside of a closed triangle surface, without any tetrahedra.

        Several shells, cavities and bodies in cavities are possible; triangles may have either orientation. Cells
        in a solid are whole (``Diagram.joined``), without convex pieces.

        Parameters
        ----------
        vertices, triangles
            As for :meth:`surface`.

        Raises
        ------
        Error
            ``invalid_domain`` for a surface that is open or crosses itself (where).

        Examples
        --------
        >>> import powercell as pc
        >>> pc.Domain.solid(*pc.sphere(4)).kind
        'volume'
        """
        return cls._make("solid", tuple(surface_arrays(vertices, triangles)))

    def wrapped(self, positions: ArrayLike) -> np.ndarray:
        """(n, d): points moved by whole periods into a periodic domain; elsewhere as they are."""
        points = reals(positions, "positions", (None, self.dimension))
        return np.array(self._core.wrapped(points)).reshape(-1, self.dimension)

    @property
    def is_solid(self) -> bool:
        return bool(self._core.is_solid)

    @property
    def kind(self) -> str:
        """``"polygon"``, ``"surface"`` or ``"volume"``."""
        return str(self._core.kind)

    @property
    def dimension(self) -> int:
        """Of the space: 2 or 3."""
        return int(self._core.dimension)

    @property
    def cell_dimension(self) -> int:
        """Of the cells: 2 for polygons and surfaces, 3 for volumes."""
        return int(self._core.cell_dimension)

    @property
    def measure(self) -> float:
        """Area or volume."""
        return float(self._core.measure)

    @property
    def bounds(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """The lower and upper corner of the bounding box."""
        return tuple(self._core.low), tuple(self._core.high)

    @property
    def is_periodic(self) -> bool:
        return bool(self._core.is_periodic)

    @property
    def periods(self) -> np.ndarray:
        """(d, d): the vectors that shifts count; rows of 0 for axes that are not periodic."""
        return np.array(self._core.periods)

    @property
    def region_count(self) -> int:
        """Number of :attr:`regions`."""
        return int(self._core.region_count)

    @property
    def regions(self) -> Any:
        """The convex regions (``RegionsView``): pieces of a polygon, triangles, tetrahedra; none in a solid.

        Examples
        --------
        >>> import powercell as pc
        >>> regions = pc.Domain.box([0, 0], [1, 1]).regions
        >>> regions.shape, regions.vertices.shape, regions.boundary_count
        ('polygon', (4, 2), 4)
        """
        return self._core.regions

    def random_points(self, count: int, random_seed: int = 1) -> tuple[Indices, Reals]:
        """Points uniform in area or volume; the same ones for the same random seed on every machine.

        Returns
        -------
        (count,) uint32, (count, d) float64
            The region that each point lies in (0 in a solid), and the points.

        Examples
        --------
        >>> import powercell as pc
        >>> regions, points = pc.Domain.box([0, 0, 0], [1, 1, 1]).random_points(5)
        >>> regions.tolist(), points.shape
        ([0, 0, 0, 0, 0], (5, 3))
        """
        found: Any = _core.region_points(self._core, {"count": count, "random_seed": random_seed})
        return found  # type: ignore[no-any-return]

    @property
    def report(self) -> Any:
        """The same as :attr:`notes` in numbers (``MeshReport``)."""
        return self._core.report

    @property
    def notes(self) -> list[str]:
        """What was left out of a mesh, and where it overlaps."""
        return list(self._core.notes)

    def __repr__(self) -> str:
        word = "area" if self.cell_dimension == 2 else "volume"
        periodic = "periodic " if self.is_periodic else ""
        low, high = ([f"{x:.6g}" for x in corner] for corner in self.bounds)
        within = " x ".join(f"[{a}, {b}]" for a, b in zip(low, high))
        return f"<powercell.Domain: {periodic}{self.kind} of {word} {self.measure:.6g} in {within}>"


def require_domain(domain: Any) -> None:
    if not isinstance(domain, Domain):
        raise ValueError(f"domain is a {type(domain).__name__}; a powercell.Domain is expected")


@named_arguments
def read_domain(path: Union[str, os.PathLike[str]], kind: str = "auto", *, degrees: bool = False) -> Domain:
    """Reads a domain, or makes a built-in one, as the tool's ``--domain`` does.

    Parameters
    ----------
    path : str or path
        A file: .geojson .json .gpkg .wkt .svg, .off .obj .ply .stl, .mesh .msh .vtu .vtk .tet .txt; or square,
        cube, disk, ball, sphere, torus (with ``:N`` for a resolution).
    kind : {"auto", "polygon", "surface", "volume"}
        For files that can be read as more than one.
    degrees : bool
        Accept a file that says that it is in longitude and latitude, and take them as a plane. Else it is an
        error, as for `Domain.polygon`.

    Examples
    --------
    >>> import powercell as pc
    >>> pc.read_domain("cube").measure
    1.0
    """
    loaded = _core.read_domain(os.fspath(path), kind)
    if loaded.is_in_degrees and not degrees:
        raise ValueError(
            f"{path} is in degrees ({loaded.crs}), whose areas and distances mean little: project it first, e.g. "
            "frame = geopandas.read_file(path); frame.to_crs(frame.estimate_utm_crs()), or pass degrees=True to "
            "compute with degrees"
        )
    domain = Domain(loaded.domain, loaded.crs or None)
    name = os.fspath(path)
    is_file = os.path.splitext(name)[1] != "" and os.path.exists(name)  # "cube" is a shape, whatever files there are
    domain._made_by = ("read_domain", (os.path.abspath(name) if is_file else name, kind))
    return domain
