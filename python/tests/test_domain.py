"""What domains tell of themselves."""

import gc

import numpy as np
import pytest

import powercell as pc


def test_regions_of_an_l_shaped_polygon():
    domain = pc.Domain.polygon([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]])
    regions = domain.regions
    assert len(regions) == domain.region_count == len(regions.source) >= 2
    assert regions.shape == "polygon" and (regions.dimension, regions.cell_dimension) == (2, 2)
    area = 0
    for r in range(len(regions)):
        corners = regions.vertices[regions.region_vertex[regions.region_offset[r] : regions.region_offset[r + 1]]]
        x, y = corners.T
        area += (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
        a, b = np.roll(corners, -1, axis=0) - corners, np.roll(corners, -2, axis=0) - np.roll(corners, -1, axis=0)
        assert (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] >= 0).all()  # convex, counter-clockwise
        assert regions.facet_offset[r + 1] - regions.facet_offset[r] == len(corners)
    assert area == pytest.approx(3)
    assert regions.boundary_count == 6
    assert sorted(regions.facet[regions.facet[:, 0] == 1, 1]) == [0, 1, 2, 3, 4, 5]
    assert (regions.facet[regions.facet[:, 0] == 2, 1] < len(regions)).all()


def test_regions_of_meshes_and_boxes():
    vertices, tetrahedra = pc.ball(2)
    domain = pc.Domain.volume(vertices, tetrahedra)
    regions = domain.regions
    assert regions.shape == "tetrahedron" and len(regions) == len(tetrahedra) == domain.region_count
    corners = regions.vertices[regions.region_vertex.reshape(-1, 4)]
    volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
    assert volumes.min() > 0 and volumes.sum() == pytest.approx(domain.measure)
    assert regions.source.tolist() == list(range(len(tetrahedra)))
    kept = regions.vertices
    del regions, domain
    gc.collect()
    assert kept.shape == (len(vertices), 3) and np.abs(kept).max() == pytest.approx(1)
    with pytest.raises(ValueError):
        kept[0] = 0
    box = pc.Domain.box([0, 0, 0], [1, 2, 3]).regions
    assert box.shape == "box" and box.vertices[7].tolist() == [1, 2, 3] and box.boundary_count == 6
    solid = pc.Domain.solid(*pc.sphere(2))
    assert solid.region_count == len(solid.regions) == 0 and solid.regions.vertices.size == 0


def test_reports_of_meshes():
    # Triangles 0 and 2 are halves of a square; 1 is flat, 3 repeats 0, and 4 overlaps both by 1/4.
    vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [2, 0, 0], [0.5, 0.5, 0]]
    domain = pc.Domain.surface(vertices, [[0, 1, 2], [0, 1, 4], [1, 3, 2], [2, 0, 1], [0, 1, 3]])
    report = domain.report
    assert report.flat.tolist() == [1] and report.repeated.tolist() == [[3, 0]]
    assert report.overlaps == 2 and report.overlap == pytest.approx(1 / 2)
    largest = report.largest
    assert (largest.first, largest.second) in ((0, 4), (2, 4)) and largest.measure == pytest.approx(1 / 4)
    at = {(0, 4): [1 / 2, 1 / 6, 0], (2, 4): [5 / 6, 1 / 2, 0]}[largest.first, largest.second]
    assert largest.at == pytest.approx(at)
    assert len(domain.notes) == 3 and domain.measure == pytest.approx(1.5)
    clean = pc.Domain.surface(*pc.sphere(2)).report
    assert (clean.flat.size, clean.repeated.shape, clean.overlaps) == (0, (0, 2), 0)


def test_devices_and_their_rates():
    device = pc.Device.choose()
    assert device.opencl_c_version.startswith("OpenCL C") and device.clock_mhz >= 0
    assert 0 < device.largest_allocation <= device.memory and device.max_work_group_size >= 1
    assert device.selector in [other.selector for other in pc.devices()]
    before = pc.kernel_builds()
    rates = pc.measure_device_rates(device)
    assert 1e6 < rates.copied_bytes < 1e14 and 1e6 < rates.operations < 1e15
    latencies = pc.measure_device_latencies(device)
    assert 0 < latencies.launch < 1 and 0 < latencies.transfer < 1
    transfers = pc.measure_device_transfers(device, 4096)
    assert 1e4 < transfers.to_device < 1e14 and 1e4 < transfers.to_host < 1e14
    for result in (rates, latencies, transfers):
        assert all(value >= 0 for name, value in result._asdict().items() if name.endswith("scatter"))
    after = pc.kernel_builds()
    assert after.seconds >= before.seconds and not after.running
    assert 0 <= device.build_seconds <= after.seconds
    with pytest.raises(ValueError, match="precision is 'half'"):
        pc.measure_device_rates(precision="half")
    with pytest.raises(pc.Error, match="0 bytes"):
        pc.measure_device_transfers(device, 0)
