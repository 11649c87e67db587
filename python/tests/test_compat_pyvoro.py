"""powercell.compat.pyvoro against the examples of pyvoro, Diagram, and pyvoro2, which has the same engine."""

import numpy as np
import pytest
import powercell as pc
import powercell.compat.pyvoro as pyvoro

RNG = np.random.default_rng(3)


def volume_of(cell):
    """By the faces, counterclockwise seen from outside."""
    x = np.array(cell["vertices"])
    total = 0.0
    for face in cell["faces"]:
        loop = x[face["vertices"]]
        for a, b in zip(loop[1:-1], loop[2:]):
            total += loop[0] @ np.cross(a, b) / 6
    return total


def test_the_example_of_pyvoro():
    cells = pyvoro.compute_voronoi(
        [[1.0, 2.0, 3.0], [4.0, 5.5, 6.0]], [[0.0, 10.0], [0.0, 10.0], [0.0, 10.0]], 2.0, radii=[1.3, 1.4]
    )
    assert sum(cell["volume"] for cell in cells) == pytest.approx(1000)
    assert cells[0]["original"] == [1.0, 2.0, 3.0] and type(cells[0]["vertices"][0]) is list
    sides = sorted(face["adjacent_cell"] for face in cells[0]["faces"])
    assert sides[-1] == 1 and {-5, -3, -1} <= set(sides)
    for face in cells[0]["faces"]:
        axis, end = divmod(-face["adjacent_cell"] - 1, 2)
        if face["adjacent_cell"] < 0:
            assert {cells[0]["vertices"][k][axis] for k in face["vertices"]} == {10.0 * end}


@pytest.mark.parametrize("periodic", [[False] * 3, [True] * 3, [True, False, False]])
def test_cells_of_space_are_polyhedra_with_the_neighbours_of_the_diagram(periodic):
    points, radii = RNG.random((80, 3)) * [2, 1, 1], RNG.random(80) * 0.2
    limits = [[0, 2], [0, 1], [0, 1]]
    cells = pyvoro.compute_voronoi(points.tolist(), limits, 0.3, radii=radii.tolist(), periodic=periodic)
    diagram = pc.Diagram(pc.Domain.box([0, 0, 0], [2, 1, 1], periodic=periodic), points, radii=radii)
    for i, cell in enumerate(cells):
        assert cell["volume"] == diagram.mass[i]
        assert volume_of(cell) == pytest.approx(cell["volume"], rel=1e-9, abs=1e-15)
        expected = sorted(diagram.adjacency.neighbors(i).tolist())
        assert sorted(face["adjacent_cell"] for face in cell["faces"] if face["adjacent_cell"] >= 0) == expected
        edges = sum(len(face["vertices"]) for face in cell["faces"]) // 2
        assert sum(map(len, cell["adjacency"])) == 2 * edges
        if cell["faces"]:
            assert len(cell["vertices"]) - edges + len(cell["faces"]) == 2  # Euler
    walls = {face["adjacent_cell"] for cell in cells for face in cell["faces"] if face["adjacent_cell"] < 0}
    assert walls == {-1 - 2 * axis - end for axis in range(3) for end in (0, 1) if not periodic[axis]}


def test_cells_of_the_plane():
    points = RNG.random((60, 2)) * 10
    cells = pyvoro.compute_2d_voronoi(points, [[0.0, 10.0], [0.0, 10.0]], 2.0, radii=RNG.random(60), z_height=1)
    assert sum(cell["volume"] for cell in cells) == pytest.approx(100)
    for cell in cells:
        assert isinstance(cell["original"], np.ndarray)
        assert all(len(face["vertices"]) == 2 for face in cell["faces"])
        assert len(cell["faces"]) == len(cell["vertices"])
        assert all(len(near) == 2 for near in cell["adjacency"])
    assert {face["adjacent_cell"] for cell in cells for face in cell["faces"] if face["adjacent_cell"] < 0} == {-1, -2, -3, -4}


def test_the_same_as_pyvoro2():
    pyvoro2 = pytest.importorskip("pyvoro2")
    points, radii = RNG.random((200, 3)), RNG.random(200) * 0.03
    theirs = pyvoro2.compute(
        points, domain=pyvoro2.Box(((0, 1), (0, 1), (0, 1))), mode="power", radii=radii, return_faces=True
    )
    cells = pyvoro.compute_voronoi(points, [[0, 1]] * 3, 0.2, radii)
    for cell in theirs.cells:
        own = cells[cell["id"]]
        assert own["volume"] == pytest.approx(cell["volume"], rel=1e-9)
        assert len(own["vertices"]) == len(cell["vertices"])
        assert sorted(face["adjacent_cell"] for face in own["faces"]) == sorted(
            face["adjacent_cell"] for face in cell["faces"]
        )


def test_hidden_seeds_and_refusals():
    box = [[0, 1]] * 3
    cells = pyvoro.compute_voronoi([[0.5, 0.5, 0.5], [0.51, 0.5, 0.5]], box, 1, radii=[0.4, 0.001])
    assert cells[1]["volume"] == 0 and cells[1]["faces"] == [] == cells[1]["vertices"]
    assert cells[0]["volume"] == pytest.approx(1)
    assert pyvoro.compute_voronoi([], box, 1) == []
    with pytest.raises(ValueError, match="point 1 is outside the limits"):
        pyvoro.compute_voronoi([[0.5] * 3, [0.5, 0.5, 2]], box, 1)
    with pytest.raises(ValueError, match="3 pairs of low and high"):
        pyvoro.compute_voronoi([[0.5] * 3], [[0, 1]] * 2, 1)
    with pytest.raises(ValueError, match="radii"):
        pyvoro.compute_voronoi([[0.5] * 3], box, 1, radii=[1, 2])
