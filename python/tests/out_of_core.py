"""Seeds out of core in tests: computing them as a whole, and comparing with one diagram."""

import os

import numpy as np
import pytest

import powercell as pc


class Boom(Exception):
    pass


def computed(domain, positions, weights=None, **given):
    """The report and all that was given, joined."""
    rows = []
    given = {"name": "seeds of a test", "piece_seeds": 300, **given}
    report = pc.compute_out_of_core(domain, positions, weights, take=rows.append, **given)
    assert not os.path.exists(given["folder"])
    return report, Joined(rows)


class Joined:
    def __init__(self, rows):
        first = np.cumsum([0] + [len(r) for r in rows])
        assert [r.first for r in rows] == list(first[:-1])
        for name in ("mass", "centroid", "second_moment", "status", "indices", "data"):
            setattr(self, name, np.concatenate([getattr(r, name) for r in rows]))
        counts = np.concatenate([np.diff(r.indptr) for r in rows])
        self.indptr = np.concatenate([[0], np.cumsum(counts)])
        self.shift = None if rows[0].shift is None else np.concatenate([r.shift for r in rows])
        assert {int(self.indptr[-1])} == {r.all_walls for r in rows}
        self.domain_measure = rows[0].domain_measure

    def arrays(self):
        return [self.mass, self.centroid, self.second_moment, self.status, self.indptr, self.indices, self.data]


class Sliced:
    """An array-like that is never there as a whole."""

    def __init__(self, array, most):
        self._array, self._most, self.shape, self.slices = array, most, array.shape, []

    def __getitem__(self, key):
        assert isinstance(key, slice) and key.stop - key.start <= self._most
        self.slices.append((key.start, key.stop))
        return self._array[key]

    def __array__(self, *_, **__):
        raise AssertionError("converted as a whole")

    def __len__(self):
        return len(self._array)


def same_bits(a, b):
    return all(u.tobytes() == v.tobytes() for u, v in zip(a.arrays(), b.arrays()))


def compare(whole, cells, walls=True):
    """Statuses and neighbours bit for bit, the others up to rounding."""
    assert np.array_equal(cells.status, whole.status)
    scale = whole.mass.mean()
    np.testing.assert_allclose(cells.mass, whole.mass, rtol=0, atol=1e-13 * scale)
    there = whole.mass > 0
    np.testing.assert_allclose(cells.centroid[there], whole.centroid[there], atol=1e-12)
    assert np.isnan(cells.centroid[whole.status != pc.Status.OK]).all()
    np.testing.assert_allclose(cells.second_moment, whole.second_moment, rtol=1e-9, atol=1e-15)
    assert np.array_equal(cells.indptr, whole.adjacency.indptr)
    assert cells.domain_measure == whole.domain_measure
    if walls:
        assert np.array_equal(cells.indices, whole.adjacency.indices)
        np.testing.assert_allclose(cells.data, whole.adjacency.data, rtol=0, atol=1e-10)


def check_report(report, whole):
    states = [int((whole.status == state).sum()) for state in pc.Status]
    assert [report.cells, report.hidden, report.duplicate] == states
    assert report.measure == pytest.approx(whole.mass.sum(), rel=1e-13)
    assert report.domain_measure == whole.domain_measure
    assert report.fetched >= report.neighbors and report.clipped >= report.cells
    assert report.bytes_read > 0 and report.bytes_written > 0 and report.rounds >= report.pieces
    assert min(report.sort, report.compute, report.gather) >= 0


def stop_at(fraction):
    return lambda done: done < fraction
