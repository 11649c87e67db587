"""Pictures of diagrams, and their cells as other packages have them."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, Optional, Union

from . import _looks


class Shown:
    """The part of :class:`Diagram` that draws its cells and hands them to other packages."""

    # `self` is a Diagram, which this file cannot import.

    def polygons(self: Any) -> list[Any]:
        """The cells as Shapely geometries, empty where a seed has none. Polygon domains only."""
        return _looks.polygons(self)

    def plot(self: Any, ax: Any = None, color: Any = None, **style: Any) -> Any:
        """Draws cells and seeds with matplotlib. Polygon domains only.

        Parameters
        ----------
        ax : matplotlib axes, optional
            Default: those of a new figure.
        color : (n,) array_like, str or a colour, optional
            Values or categories mapped to colours, or a column of the table that the seeds are from by its name; or one
            colour for all cells.
        **style
            Passed to ``PolyCollection``.

        Returns
        -------
        matplotlib axes
        """
        self._require_all("plot()")
        return _looks.plot(self, ax, color, style)

    def to_geopandas(self: Any) -> Any:
        """A GeoDataFrame of the cells, with mass, centroid and status, and the columns and CRS that came in."""
        self._require_all("to_geopandas()")
        return _looks.to_geopandas(self)

    def to_pyvista(self: Any) -> Any:
        """A PyVista mesh of the cells with the arrays ``seed``, ``mass`` and ``weight``."""
        self._require_all("to_pyvista()")
        return _looks.to_pyvista(self)

    def to_meshio(self: Any) -> Any:
        """A meshio mesh of the pieces of the cells with the arrays ``seed`` and ``mass``."""
        self._require_all("to_meshio()")
        return _looks.to_meshio(self)

    def to_html(
        self: Any, path: Union[str, os.PathLike[str]], columns: Optional[Mapping[str, Sequence[Any]]] = None
    ) -> None:
        """Writes a page for a browser that turns, slices and colours the cells, and shows the row of the one chosen.

        Parameters
        ----------
        path : str or path
            Ends in .html.
        columns : mapping of str to (n,) sequences, optional
            Numbers or texts of the seeds, to colour by and to show, as of ``Seeds.columns`` or a data frame. Default:
            the columns that came in with the seeds.

        Raises
        ------
        Error
            ``unsupported`` above 250,000 seeds in a volume, a million elsewhere.
        """
        self._require_all("to_html()")
        _looks.to_html(self, os.fspath(path), columns)

    def view(self: Any, columns: Optional[Mapping[str, Sequence[Any]]] = None, height: int = 560) -> Any:
        """The page of :meth:`to_html` within a notebook, ``height`` pixels high."""
        self._require_all("view()")
        return _looks.Embedded(self, columns, height)
