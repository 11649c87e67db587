"""The packages that bench/peers_python.py compares: how each is called for the same cells, and what its documents say of it.

Each peer has NAME, PACKAGE, the cases it can do, volumes(case) in the order of the seeds (a function of none that computes them,
where the package leaves that to its caller), and neighbours(case): volumes again, and the number of sides of walls between
cells, if it lists neighbours. Those that solve transport have transport(case): the masses, which ought to be equal. A case has positions p, weights w (None: Voronoi), the
dimension d and whether it is periodic; its domain is the unit square or cube.
"""

import numpy as np

THREADS = 2


class Powercell:
    name, package, module = "powercell", "powercell", "powercell"
    can = dict(weights="yes", domains="polygons with holes, surfaces, tetrahedra, solids, boxes", periodic="any axes, any lattice",
               walls="areas, images of neighbours", cells="yes", transport="yes")
    note = ""

    def does(self, case):
        return True

    def _diagram(self, case):
        import powercell as pc

        return pc.Diagram(pc.Domain.box([0] * case.d, [1] * case.d, periodic=case.periodic), case.p, case.w, threads=THREADS)

    def volumes(self, case):
        return self._diagram(case).mass

    def neighbours(self, case):
        diagram = self._diagram(case).compute(adjacency=True)
        return diagram.mass, len(diagram.adjacency.indices)

    def transport(self, case):
        import powercell as pc

        return pc.transport(pc.Domain.box([0] * case.d, [1] * case.d), case.p, tolerance=1e-6, threads=THREADS).mass


class Pyvoro2:
    name, package, module = "pyvoro2", "pyvoro2", "pyvoro2"
    can = dict(weights="yes", domains="boxes", periodic="boxes, along some axes; triclinic cells", walls="vertices of faces",
               cells="yes", transport="inverse problems")
    note = "voro++ in one thread"

    def does(self, case):
        return True

    def _result(self, case, faces):
        import pyvoro2
        from pyvoro2 import planar

        bounds = ((0, 1),) * case.d
        flags = dict(return_vertices=faces, return_adjacency=False, include_empty=True)
        if case.w is not None:
            flags.update(mode="power", weights=case.w)
        if case.d == 2:
            make, box = planar, planar.RectangularCell(bounds, periodic=(True, True)) if case.periodic else planar.Box(bounds)
            flags["return_edges"] = faces
        else:
            make = pyvoro2
            box = pyvoro2.OrthorhombicCell(bounds, periodic=(True,) * 3) if case.periodic else pyvoro2.Box(bounds)
            flags["return_faces"] = faces
        return make.compute(case.p, domain=box, **flags)

    def volumes(self, case):
        return self._result(case, False).cell_measures

    def neighbours(self, case):
        result = self._result(case, True)
        key = "edges" if case.d == 2 else "faces"
        return result.cell_measures, sum(side["adjacent_cell"] >= 0 for cell in result.cells for side in cell.get(key, ()))


class Multivoro:
    name, package, module = "multivoro", "multivoro", "multivoro"
    can = dict(weights="yes", domains="boxes", periodic="boxes, along some axes", walls="vertices of faces", cells="yes", transport="–")
    note = f"voro++ in {THREADS} threads; volumes summed from the vertices of its faces, which is not timed"

    def does(self, case):
        return case.d == 3

    def _cells(self, case):
        import multivoro

        radii = np.zeros(len(case.p)) if case.w is None else np.sqrt(case.w - case.w.min())
        limits = np.array([[0.0, 0, 0], [1, 1, 1]])
        return multivoro.compute_voronoi(case.p, limits=limits, radii=radii, periodic_boundaries=(case.periodic,) * 3, n_threads=THREADS)

    @staticmethod
    def _volume(cell):
        if not cell.is_successful:
            return 0.0
        faces, start, total = cell.get_face_vertices(), 0, 0.0
        corners = cell.get_vertices() - cell.get_vertices()[0]
        while start < len(faces):
            a, b = start + 1, start + 1 + faces[start]
            ring = corners[faces[a:b]]
            total += float(np.cross(ring[1:-1], ring[2:]).sum(0) @ ring[0])
            start = b
        return abs(total) / 6

    def volumes(self, case):
        cells = self._cells(case)
        return lambda: [self._volume(cell) for cell in cells]

    def neighbours(self, case):
        cells = self._cells(case)
        sides = sum(int(np.count_nonzero(np.asarray(c.get_neighbors(), np.int64) >= 0)) for c in cells if c.is_successful)
        return lambda: [self._volume(cell) for cell in cells], sides


class Scipy:
    name, package, module = "scipy", "scipy", "scipy.spatial"
    can = dict(weights="–", domains="none: outer cells are unbounded", periodic="–", walls="vertices of ridges", cells="yes", transport="–")
    note = "Qhull, with the seeds mirrored at each side of the box, and ConvexHull of each cell for its volume"

    def does(self, case):
        return case.w is None and not case.periodic

    def _voronoi(self, case):
        from scipy.spatial import Voronoi

        axis = np.arange(case.d)
        images = [np.where(axis == k, 2 * side - case.p, case.p) for k in range(case.d) for side in (0, 1)]
        return Voronoi(np.concatenate([case.p, *images]))

    def volumes(self, case):
        from scipy.spatial import ConvexHull

        voronoi = self._voronoi(case)
        return [ConvexHull(voronoi.vertices[voronoi.regions[voronoi.point_region[i]]]).volume for i in range(len(case.p))]

    def neighbours(self, case):
        sides = 2 * int((self._voronoi(case).ridge_points < len(case.p)).all(1).sum())
        return None, sides


class Vtk:
    name, package, module = "VTK", "vtk", "vtk"
    can = dict(weights="–", domains="the box of the seeds, padded", periodic="–", walls="adjacency graph", cells="yes", transport="–")
    note = "vtkVoronoiFlower3D and vtkCellSizeFilter; compared in the box that its cells fill"

    def does(self, case):
        return case.d == 3 and case.w is None and not case.periodic

    def _output(self, case, kind):
        import vtk
        from vtk.util.numpy_support import numpy_to_vtk

        vtk.vtkSMPTools.Initialize(THREADS)
        points, data, cells = vtk.vtkPoints(), vtk.vtkPolyData(), vtk.vtkVoronoiFlower3D()
        points.SetData(numpy_to_vtk(case.p))
        data.SetPoints(points)
        cells.SetInputData(data)
        cells.SetPadding(0)
        getattr(cells, f"SetOutputTypeTo{kind}")()
        cells.Update()
        return cells.GetOutputDataObject(0) if kind == "AdjacencyGraph" else cells.GetUnstructuredGridOutput()

    def volumes(self, case):
        import vtk
        from vtk.util.numpy_support import vtk_to_numpy

        grid, sizes = self._output(case, "Voronoi"), vtk.vtkCellSizeFilter()
        bounds = np.array(grid.GetBounds()).reshape(3, 2)
        case.box = bounds[:, 0], bounds[:, 1]
        sizes.SetInputData(grid)
        sizes.Update()
        return vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume"))


class Pysdot:
    name, package, module = "pysdot", "pysdot", "pysdot"
    can = dict(weights="yes", domains="unions of convex parts, images", periodic="by copies that the caller adds",
               walls="derivatives by weights", cells="yes", transport="yes")
    note = "with cut_id=2**64 - 1: its default, -1, fails with NumPy 2"

    def does(self, case):
        return not case.periodic

    @staticmethod
    def _domain(case):
        from pysdot.domain_types import ConvexPolyhedraAssembly

        domain = ConvexPolyhedraAssembly()
        domain.add_box([0.0] * case.d, [1.0] * case.d, 1.0, 2**64 - 1)
        return domain

    def _diagram(self, case):
        import pysdot

        return pysdot.PowerDiagram(case.p, np.zeros(len(case.p)) if case.w is None else case.w, self._domain(case))

    def transport(self, case):
        import pysdot

        solver = pysdot.OptimalTransport(case.p, None, self._domain(case))
        solver.adjust_weights()
        return solver.pd.integrals()

    def volumes(self, case):
        return self._diagram(case).integrals()

    def neighbours(self, case):
        made = self._diagram(case).der_integrals_wrt_weights()
        return made.v_values, int(len(made.m_columns) - len(case.p))


class Freud:
    name, package, module = "freud", "freud-analysis", "freud"
    can = dict(weights="–", domains="–", periodic="boxes, triclinic", walls="areas", cells="vertices", transport="–")
    note = "positions in single precision; a box is periodic even where its periodic is set to False"

    def does(self, case):
        return case.d == 3 and case.w is None and case.periodic

    def _voronoi(self, case):
        import freud

        return freud.locality.Voronoi().compute((freud.box.Box(1, 1, 1), case.p - 0.5))

    def volumes(self, case):
        return self._voronoi(case).volumes

    def neighbours(self, case):
        voronoi = self._voronoi(case)
        return voronoi.volumes, len(voronoi.nlist)


class Peclet:
    name, package, module = "peclet-voro", "peclet-voro", "peclet.voro"
    can = dict(weights="small ones", domains="–", periodic="boxes at the origin, along all axes", walls="counts", cells="–", transport="optimisers of volumes")
    note = "Kokkos on CPUs; a seed outside its own cell loses it"

    def does(self, case):
        return case.d == 3 and case.periodic

    def volumes(self, case):
        from peclet import voro

        cells = voro.Tessellation()
        cells.set_domain([1.0, 1.0, 1.0])
        if case.w is not None:
            cells.set_weights(case.w)
        cells.build(case.p)
        return cells.get_volumes()


class Sdot:
    name, package, module, more = "sdot", "sdot", "sdot", ["jax"]  # which it imports and does not ask for
    can = dict(weights="yes", domains="convex", periodic="groups of isometries", walls="derivatives", cells="yes", transport="yes")
    note = "cells in double precision (kernel_dtype), which is not its default"

    def does(self, case):
        return not case.periodic

    def volumes(self, case):
        import sdot

        half_spaces = np.vstack([np.eye(case.d), -np.eye(case.d)]), np.r_[np.ones(case.d), np.zeros(case.d)]
        return sdot.PowerDiagram(case.p, case.w, half_spaces, kernel_dtype="FP64").measures


class Pyvoro:
    name, package, module = "pyvoro", "pyvoro", "pyvoro"
    can = dict(weights="yes", domains="boxes", periodic="boxes", walls="vertices of faces", cells="yes", transport="–")
    note = ""

    def does(self, case):
        return case.d == 3

    def volumes(self, case):
        import pyvoro

        radii = [] if case.w is None else np.sqrt(case.w - case.w.min()).tolist()
        cells = pyvoro.compute_voronoi(case.p.tolist(), [[0, 1]] * 3, 0.1, radii=radii, periodic=[case.periodic] * 3)
        return [cell["volume"] for cell in cells]


PEERS = [Powercell(), Pyvoro2(), Multivoro(), Scipy(), Vtk(), Pysdot(), Sdot(), Freud(), Peclet(), Pyvoro()]
