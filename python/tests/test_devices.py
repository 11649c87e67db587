"""Groups of devices."""

import json
import os
import subprocess
import sys

import pytest

import powercell as pc

SCRIPT = """
import json
import numpy as np
import powercell as pc

cube = pc.Domain.box([0, 0, 0], [1, 1, 1])
points = np.random.default_rng(1).random((3000, 3))
one = pc.Diagram(cube, points, device=pc.devices()[0])
results = []
for device in ("all", [d.selector for d in pc.devices()], pc.devices(), pc.Device.group(pc.devices())):
    d = pc.Diagram(cube, points, device=device, chunk_pairs=200)
    same = np.array_equal(d.mass, one.mass) and np.array_equal(d.adjacency.indices, one.adjacency.indices)
    results.append([same, len(d.device.members), repr(d.device)])
print(json.dumps(results))
"""


def test_a_group_gives_what_one_device_gives():
    env = {**os.environ, "POCL_DEVICES": "basic pthread"}
    done = subprocess.run([sys.executable, "-c", SCRIPT], env=env, check=True, capture_output=True, text=True)
    results = json.loads(done.stdout)
    if results[0][1] < 2:
        pytest.skip("one device, whose driver is not PoCL")
    for same, count, text in results:
        assert same
        assert count == results[0][1]
        assert "a group of" in text


def test_a_single_device_is_its_own_member():
    device = pc.Device.choose()
    assert [member.selector for member in device.members] == [device.selector]
    group = pc.Device.group([device])
    assert group.selector == device.selector
    assert len(group.members) == 1
