#!/usr/bin/env python3
"""Writes italy.geojson from italy_lonlat.txt: python3 make_italy.py > italy.geojson

The map is the Lambert azimuthal equal-area projection about 12.5 E, 42.5 N on a sphere of radius
6371.0072 km, in kilometres:

    k = sqrt(2 / (1 + sin(p0) sin(p) + cos(p0) cos(p) cos(l - l0)))
    x = R k cos(p) sin(l - l0)
    y = R k (cos(p0) sin(p) - sin(p0) cos(p) cos(l - l0))

so the area of a cell is its area on the ground, in square kilometres.
"""

import json
import math
import pathlib

RADIUS = 6371.0072  # of the sphere with the area of the WGS 84 ellipsoid, km
LON0, LAT0 = math.radians(12.5), math.radians(42.5)


def project(lon, lat):
    lon, lat = math.radians(lon) - LON0, math.radians(lat)
    k = math.sqrt(2 / (1 + math.sin(LAT0) * math.sin(lat) + math.cos(LAT0) * math.cos(lat) * math.cos(lon)))
    x = RADIUS * k * math.cos(lat) * math.sin(lon)
    y = RADIUS * k * (math.cos(LAT0) * math.sin(lat) - math.sin(LAT0) * math.cos(lat) * math.cos(lon))
    return [round(x, 3), round(y, 3)]


def main():
    parts = []
    for line in pathlib.Path(__file__).with_name("italy_lonlat.txt").read_text().splitlines():
        if line.startswith("part"):
            parts.append([[]])
        elif line.startswith("hole"):
            parts[-1].append([])
        elif line and not line.startswith("#"):
            parts[-1][-1] += [project(*map(float, point.split(","))) for point in line.split()]
    for part in parts:
        for ring in part:
            ring.append(ring[0])  # GeoJSON repeats the first point
    print(json.dumps({
        "type": "Feature",
        "properties": {"name": "Italy", "source": "Natural Earth 1:50m, public domain", "unit": "km"},
        "geometry": {"type": "MultiPolygon", "coordinates": parts},
    }, separators=(",", ":")))


main()
