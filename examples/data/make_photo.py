#!/usr/bin/env python3
"""Renders a gray picture to stipple, by ray tracing: three balls on a table in the light of one lamp.

usage: make_photo.py [FILE.png [WIDTH]]
"""
import struct
import sys
import zlib

import numpy as np

LIGHT = np.array([-4.5, -4.0, 5.5])
BALLS = [((-1.15, 0.1, 1.0), 1.0, 0.85), ((0.95, -0.55, 0.7), 0.7, 0.45), ((0.35, -1.75, 0.38), 0.38, 0.95)]


def hits(origin, way):
    """Distance along each ray to the nearest ball (infinite if there is none), and the index of that ball."""
    nearest = np.full(way.shape[:-1], np.inf)
    which = np.full(way.shape[:-1], -1)
    for k, (centre, radius, _) in enumerate(BALLS):
        to = origin - np.array(centre)
        half = np.sum(to * way, axis=-1)
        inside = half**2 - np.sum(to * to, axis=-1) + radius**2
        distance = -half - np.sqrt(np.maximum(inside, 0))
        good = (inside > 0) & (distance > 1e-4) & (distance < nearest)
        nearest = np.where(good, distance, nearest)
        which = np.where(good, k, which)
    return nearest, which


def lit(point, normal, albedo):
    """Lambert's law with shadows and some light from the sky."""
    to = LIGHT - point
    to /= np.linalg.norm(to, axis=-1, keepdims=True)
    shadow, _ = hits(point + 1e-3 * normal, to)
    cosine = np.maximum(np.sum(normal * to, axis=-1), 0) * np.isinf(shadow)
    return albedo * (0.12 + 0.1 * np.maximum(normal[..., 2], 0) + 0.85 * cosine)


def render(width):
    height = width * 3 // 4
    eye = np.array([0.0, -7.0, 2.6])
    x, y = np.meshgrid(np.linspace(-1, 1, width), np.linspace(0.75, -0.75, height))
    way = np.stack([0.42 * x, np.ones_like(x), 0.42 * y - 0.27], axis=-1)
    way /= np.linalg.norm(way, axis=-1, keepdims=True)
    distance, which = hits(eye, way)
    table = np.where(way[..., 2] < 0, -eye[2] / np.minimum(way[..., 2], -1e-9), np.inf)
    on_ball = distance < table
    point = eye + np.where(np.isfinite(np.minimum(distance, table)), np.minimum(distance, table), 0)[..., None] * way
    gray = 0.75 + 0.2 * np.clip(y, 0, 1)  # the wall behind
    checks = np.where((np.floor(point[..., 0] * 1.2) + np.floor(point[..., 1] * 1.2)) % 2 == 0, 0.8, 0.55)
    far = np.clip((point[..., 1] + 1) / 12, 0, 1)
    floor = lit(point, np.broadcast_to([0.0, 0.0, 1.0], point.shape), checks)
    gray = np.where(np.isfinite(table) & ~on_ball, (1 - far) * floor + far * 0.75, gray)
    for k, (centre, radius, albedo) in enumerate(BALLS):
        normal = (point - np.array(centre)) / radius
        shine = normal @ ((LIGHT - centre) / np.linalg.norm(LIGHT - centre) - [0, 0.93, -0.35])
        ball = lit(point, normal, albedo) + 0.5 * np.clip(shine / 1.9, 0, 1) ** 40
        gray = np.where(on_ball & (which == k), ball, gray)
    return np.clip(gray, 0, 1)


def main():
    path = sys.argv[1] if len(sys.argv) > 1 else "photo.png"
    width = int(sys.argv[2]) if len(sys.argv) > 2 else 800
    linear = render(2 * width)
    linear = (linear[::2, ::2] + linear[1::2, ::2] + linear[::2, 1::2] + linear[1::2, 1::2]) / 4
    coded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    rows = np.round(255 * coded).astype(np.uint8)

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    header = struct.pack(">IIBBBBB", rows.shape[1], rows.shape[0], 8, 0, 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + row.tobytes() for row in rows), 9)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b""))


if __name__ == "__main__":
    main()
