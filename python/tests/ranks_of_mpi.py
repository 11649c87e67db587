"""A program on ranks of MPI, which test_distributed.py runs: each rank compares its cells with one diagram of all seeds."""

import sys

import numpy as np
from mpi4py import MPI

import powercell as pc

comm = MPI.COMM_WORLD
rank, size = comm.Get_rank(), comm.Get_size()
cube = pc.Domain.box([0, 0, 0], [1, 1, 1])
rng = np.random.default_rng(5)
positions, weights = rng.random((3000, 3)), 0.01 * rng.random(3000)
own = np.flatnonzero(np.minimum((positions[:, 0] * size).astype(int), size - 1) == rank)  # slabs
cells = pc.compute_distributed(comm, cube, own, positions[own], weights[own], threads=1)

whole = pc.Diagram(cube, positions, weights)
assert np.array_equal(cells.status, whole.status[own])
np.testing.assert_allclose(cells.mass, whole.mass[own], rtol=0, atol=1e-14)
for place, seed in enumerate(own):
    assert np.array_equal(cells.neighbors(place), whole.adjacency.neighbors(seed))
assert abs(comm.allreduce(cells.mass.sum()) - 1) < 1e-12
sys.stdout.write(f"rank {rank} of {size}: {len(own)} seeds\n")
