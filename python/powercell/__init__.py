"""Power diagrams (weighted Voronoi, Laguerre) in polygons, on surfaces and in volumes, on any OpenCL device.

>>> import numpy as np, powercell as pc
>>> points = np.random.default_rng(1).random((1000, 3))
>>> d = pc.Diagram(pc.Domain.box([0, 0, 0], [1, 1, 1]), points, weights=np.full(1000, 0.01))
>>> bool(abs(d.mass.sum() - 1) < 1e-12)
True
"""

from ._runtime import provide_opencl

provide_opencl()

from . import _core  # noqa: E402
from ._core import (  # noqa: E402
    DensityIntegrals,
    ExchangeReport,
    LawCheck,
    MeshReport,
    OutOfCoreReport,
    Overlap,
    PartsApart,
    RegionsView,
    RepairCount,
    Spacing,
    Spectrum,
)
from ._core import version as _version  # noqa: E402
from ._cell_rows import CellRows, DistributedCells  # noqa: E402
from ._density import integrate  # noqa: E402
from ._device import (  # noqa: E402
    Device,
    DeviceLatencies,
    DeviceRates,
    DeviceTransfers,
    KernelBuilds,
    UnusableDevice,
    devices,
    kernel_builds,
    measure_device_latencies,
    measure_device_rates,
    measure_device_transfers,
    unusable_devices,
)
from ._device_cells import DeviceCells  # noqa: E402
from ._device_results import (  # noqa: E402
    DeviceAdjacency,
    DeviceBoundaryWalls,
    DeviceMeasures,
    DeviceStatus,
    DeviceUncertain,
)
from ._diagram import Diagram, prepare  # noqa: E402
from ._distributed import compute_distributed  # noqa: E402
from ._domain import Domain, read_domain  # noqa: E402
from ._errors import Error  # noqa: E402
from ._log import set_log  # noqa: E402
from ._meshes import ball, farthest_from, mesh_quality, remesh, repair, sphere, torus  # noqa: E402
from ._names import show_fields  # noqa: E402
from ._order import minkowski  # noqa: E402
from ._out_of_core import compute_out_of_core  # noqa: E402
from ._outside import HiddenSeedsWarning, SeedsOutsideWarning  # noqa: E402
from ._point_sets import random_points, spacing, spectrum  # noqa: E402
from ._queue import DeviceDiagram  # noqa: E402
from ._results import Adjacency, BoundaryWalls, Status  # noqa: E402
from ._sampling import sample  # noqa: E402
from ._saved import SavedDiagram  # noqa: E402
from ._seeds import Seeds, read_seeds  # noqa: E402
from ._transport import TransportSolver, transport  # noqa: E402
from ._triangulation import regular_triangulation  # noqa: E402
from ._treemap import Treemap, treemap  # noqa: E402
from ._voronoi import Voronoi, voronoi  # noqa: E402

for _kind in (member for member in vars(_core).values() if isinstance(member, type)):
    if _kind.__name__ not in ("Device", "Diagram", "DeviceDiagram", "Domain", "TransportSolver"):
        show_fields(_kind)

__version__: str = _version()

__all__ = [
    "Adjacency",
    "BoundaryWalls",
    "CellRows",
    "DensityIntegrals",
    "Device",
    "DeviceAdjacency",
    "DeviceBoundaryWalls",
    "DeviceCells",
    "DeviceDiagram",
    "DeviceLatencies",
    "DeviceMeasures",
    "DeviceRates",
    "DeviceStatus",
    "DeviceTransfers",
    "DeviceUncertain",
    "Diagram",
    "DistributedCells",
    "Domain",
    "Error",
    "ExchangeReport",
    "HiddenSeedsWarning",
    "KernelBuilds",
    "LawCheck",
    "MeshReport",
    "OutOfCoreReport",
    "Overlap",
    "PartsApart",
    "RegionsView",
    "RepairCount",
    "SavedDiagram",
    "Seeds",
    "SeedsOutsideWarning",
    "Spacing",
    "Spectrum",
    "Status",
    "TransportSolver",
    "Treemap",
    "UnusableDevice",
    "Voronoi",
    "ball",
    "compute_distributed",
    "compute_out_of_core",
    "devices",
    "farthest_from",
    "integrate",
    "kernel_builds",
    "measure_device_latencies",
    "measure_device_rates",
    "measure_device_transfers",
    "mesh_quality",
    "minkowski",
    "prepare",
    "random_points",
    "read_domain",
    "read_seeds",
    "regular_triangulation",
    "remesh",
    "repair",
    "sample",
    "set_log",
    "spacing",
    "spectrum",
    "sphere",
    "torus",
    "transport",
    "treemap",
    "unusable_devices",
    "voronoi",
]
