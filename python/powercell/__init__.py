"""Power diagrams (weighted Voronoi, Laguerre) in polygons, on surfaces and in volumes, on any OpenCL device.

>>> import numpy as np, powercell as pc
>>> points = np.random.default_rng(1).random((1000, 3))
>>> d = pc.Diagram(pc.Domain.box([0, 0, 0], [1, 1, 1]), points, weights=np.full(1000, 0.01))
>>> bool(abs(d.mass.sum() - 1) < 1e-12)
True
"""

from ._runtime import show_packaged_runtime

show_packaged_runtime()

from . import _core  # noqa: E402
from ._core import version as _version  # noqa: E402
from ._device import Device, devices  # noqa: E402
from ._diagram import Adjacency, BoundaryWalls, Diagram, Status, regular_triangulation  # noqa: E402
from ._domain import Domain, read_domain  # noqa: E402
from ._errors import Error  # noqa: E402
from ._meshes import ball, mesh_quality, remesh, repair, sphere, torus  # noqa: E402
from ._outside import SeedsOutsideWarning  # noqa: E402
from ._queue import DeviceDiagram, DeviceMeasures, DeviceStatus  # noqa: E402
from ._sampling import sample  # noqa: E402
from ._seeds import Seeds, read_seeds  # noqa: E402
from ._transport import TransportSolver, transport  # noqa: E402
from ._treemap import Treemap, treemap  # noqa: E402

__version__: str = _version()

__all__ = [
    "Adjacency",
    "BoundaryWalls",
    "Device",
    "DeviceDiagram",
    "DeviceMeasures",
    "DeviceStatus",
    "Diagram",
    "Domain",
    "Error",
    "Seeds",
    "SeedsOutsideWarning",
    "Status",
    "TransportSolver",
    "Treemap",
    "ball",
    "devices",
    "mesh_quality",
    "read_domain",
    "read_seeds",
    "regular_triangulation",
    "remesh",
    "repair",
    "sample",
    "sphere",
    "torus",
    "transport",
    "treemap",
]
