#!/usr/bin/env python3
"""Writes the inputs that the fuzzers start from into corpus/TARGET/start_*.

The first byte of a file input chooses the format (files.cpp); inputs of the other targets are numbers and
choices (input.hpp), here random ones from a fixed seed. What the fuzzers found lies beside, under other names.
"""
import base64
import pathlib
import random
import struct
import zlib

here = pathlib.Path(__file__).parent
data = here.parent / "readers" / "data"

meshes = {".off": "@", ".obj": "A", ".ply": "B", ".stl": "C", ".mesh": "D", ".msh": "E", ".tet": "F", ".txt": "G"}
grids = {".vtk": "@", ".vtu": "A"}

small_meshes = {
    "@": "OFF\n# a square\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 1 2 255 0 0\n",
    "A": "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf -3 -2 -1\n",
    "B": "ply\nformat ascii 1.0\ncomment c\nelement vertex 3\nproperty float x\nproperty double y\nproperty float z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    "C": "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
         "endsolid a\n",
    "D": "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\nTetrahedra 1\n"
         "1 2 3 4 0\nTriangles 1\n1 2 3 0\nEnd\n",
    "E": "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
         "$Elements\n2\n1 4 2 0 1 1 2 3 4\n2 2 2 0 1 1 2 3\n$EndElements\n",
    "F": "4 1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 1 2 3\n",
    "G": "4 1\n0 0\n1 0\n1 1\n0 1\n0 1 2 3\n",
    "O": "4 2\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n0 0 1 2\n1 0 1 3\n",
}
polygons = {
    "geometry": '<{"type":"Polygon","coordinates":[[[0,0],[4,0],[4,4],[0,4],[0,0]],[[1,1],[2,1],[2,2],[1,1]]]}',
    "features": '<{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"a":1},"geometry":'
                '{"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[1,1],[0,0]]],[[[2,0],[3,0],[3,1],[2,0]]]]}}]}',
    "collection": '<{"type":"GeometryCollection","geometries":[{"type":"Polygon","coordinates":[[[0,0],[1,0],[0,1]]]}]}',
    "wkt": "=POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 2 1, 2 2, 1 1))",
    "wkt_multi": "=MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)), ((2 0, 3 0, 3 1, 2 0)))\nPOLYGON((5 5,6 5,6 6,5 5))",
    "wkt_collection": "=GEOMETRYCOLLECTION (POLYGON ((0 0, 4 0, 4 4, 0 0)), POLYGON ((1 0, 5 0, 5 4, 1 0)))",
    "svg_path": '><svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path fill-rule="evenodd" '
                'd="M0 0h9v9h-9zM1,1 l2 0 0 2 z m5 5 c1 0 2 1 2 2 s1 1 1 2 q1 1 2 0 t1 1 a1 2 30 1 0 2 2 z"/></svg>',
    "svg_shapes": '><svg><g transform="translate(1 2) rotate(30) scale(2,3)"><rect x="1" y="1" width="3" height="2" '
                  'rx="0.5"/><circle cx="5" cy="5" r="2"/><ellipse cx="1" cy="1" rx="2" ry="1"/></g>'
                  '<polygon points="0,0 1,0 1,1"/><polyline points="0 0 3 0 3 3" transform="matrix(1 0 0 1 9 9)"/></svg>',
}
seeds = {
    "rows": "00.5 0.5 1\n0.25 0.75 2\n",
    "csv": "1x,y,z,weight\n0,0,0,1\n1,2,3,4\n",
    "other_columns": "0name;w;y;x\na;1;2;3\nb;4;5;6\n",
    "count": "12\n0 0 0\n1 1 1\n",
    "random": "4100:0:0.5:7",
    "range": "4100000:-1e3:1e-3",
}
trees = {
    "table": "0id,parent,name,value\nworld,,World,\na,world,A,3\nb,world,\"B, \"\"b\"\"\",1.5\nc,a,C,2\nd,a,D,0\n",
    "table_rows": "00;;root;0\n1;0;one;4\n2;0;two;5\n",
    "table_implied_root": "0id\tparent\tvalue\n1\t0\t4\n2\t0\t5\n",
    "nested": '1{"name":"r","children":[{"name":"a","value":2},{"name":"a","children":[{"value":1},{"size":3}]}]}',
    "list": '1[{"id":1,"name":"r"},{"id":"a","parent":1,"value":2},{"id":"b","parentId":1,"weight":1e1}]',
    "layout": '2[{"id":"r","parent":"","name":"r","value":3,"polygon":[[0,0],[2,0],[2,1],[0,1]],"seed":[1,0.5]},'
              '{"id":"a","parent":"r","value":1,"polygon":[[0,0],[1,0],[1,1],[0,1]],"seed":[0.5,0.5]},'
              '{"id":"b","parent":"r","value":2,"polygon":[[1,0],[2,0],[2,1],[1,1]],"seed":[1.5,0.5]}]',
}
documents = {
    "masses": "01\n2.5\n",
    "masses_named": '0name;mass\na;1\n"b";2e3\n',
    "masses_column": "1x,y,area\n0,0,1\n1,1,2\n",
    "saved_polygon": '2{"powercell":"0.1.0","domain":{"kind":"polygon","measure":1},"cells":['
                     '{"seed":0,"position":[0.25,0.5],"weight":0,"status":"ok","measure":0.5,"centroid":[0.25,0.5],'
                     '"vertices":[[0,0],[0.5,0],[0.5,1],[0,1]],"faces":[[0,1,2,3]],"borders":[[-1,1,-1,-1]]},'
                     '{"seed":1,"position":[0.75,0.5],"weight":0,"status":"ok","measure":0.5,"centroid":[0.75,0.5],'
                     '"vertices":[[0.5,0],[1,0],[1,1],[0.5,1]],"faces":[[0,1,2,3]],"borders":[[-1,-1,-1,0]]}]}',
    "saved_volume": '2{"domain":{"kind":"volume","measure":0.5},"cells":[{"position":[0,0,0],"weight":1,"status":"ok",'
                    '"measure":0.5,"vertices":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]],"faces":[[0,2,1],[0,1,3],[0,3,2],[1,2,3]],'
                    '"borders":[-1,null,-2,-4]},{"position":[2,0,0],"weight":0,"status":"hidden","measure":null,'
                    '"vertices":[],"faces":[],"borders":[]}]}',
    "record": '4{"format":"powercell bench","format_version":1,"version":"0.1.0","revision":null,"date":"2026-01-01",'
              '"rows":[{"passed":true,"device":"d","selector":"0:0","domain":"cube","precision":"double","n":1000,'
              '"measures":{"cells_per_second":1e6},"adjacency":{"cells_per_second":5e5}},{"passed":false}]}',
}

# 16 x 8 pixels: gray and progressive with an Exif orientation, RGB, and inks.
jpegs = {
    "gray": "/9j/4QAiRXhpZgAASUkqAAgAAAABABIBAwABAAAABgAAAAAAAAD/2wBDACgcHiMeGSgjISMtKygwPGRBPDc3PHtYXUlkkYCZlo+A"
            "jIqgtObDoKrarYqMyP/L2u71////m8H////6/+b9//j/wgALCAAIABABAREA/8QAFAABAAAAAAAAAAAAAAAAAAAAAP/aAAgBAQAA"
            "AAE//8QAFhAAAwAAAAAAAAAAAAAAAAAAAAES/9oACAEBAAEFAoSKP//EABcQAQADAAAAAAAAAAAAAAAAAAABISL/2gAIAQEABj8C"
            "tmH/xAAZEAEAAgMAAAAAAAAAAAAAAAABABEhMYH/2gAIAQEAAT8hA3gTeujP/9oACAEBAAAAEL//xAAZEAEAAwEBAAAAAAAAAAAA"
            "AAABABExUYH/2gAIAQEAAT8QuedmNaNBx3yf/9k=",
    "rgb": "/9j/2wBDACgcHiMeGSgjISMtKygwPGRBPDc3PHtYXUlkkYCZlo+AjIqgtObDoKrarYqMyP/L2u71////m8H////6/+b9//j/2wBD"
            "ASstLTw1PHZBQXb4pYyl+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj4+Pj/wAARCAAIABAD"
            "ASIAAhEBAxEB/8QAFAABAAAAAAAAAAAAAAAAAAAAAP/EACEQAAEDAQkAAAAAAAAAAAAAAAEAAgNRBBESEyEiIzHB/8QAFQEBAQAA"
            "AAAAAAAAAAAAAAAAAAH/xAAXEQEAAwAAAAAAAAAAAAAAAAAAEUFh/9oADAMBAAIRAxEAPwAYy26yxdkch8TbK7A0jIj1LqmqIppc"
            "P//Z",
    "inks": "/9j/7gAOQWRvYmUAZAAAAAAA/9sAQwAoHB4jHhkoIyEjLSsoMDxkQTw3Nzx7WF1JZJGAmZaPgIyKoLTmw6Cq2q2KjMj/y9ru9f//"
            "/5vB////+v/m/f/4/8AAFAgACAAQBEMRAE0RAFkRAEsRAP/EABUAAQEAAAAAAAAAAAAAAAAAAAAB/8QAJhAAAQIEBQUBAQAAAAAA"
            "AAAAAQIRAAMSIRMiQVHwIzFxkbFhof/aAA4EQwBNAFkASwAAPwBhoQUSlEJlyhUsnfT+fYgCUmgthSRUpmurlvMCEIUAXwpAzNd1"
            "ct7iuEuKenI0vmV2+2iOVOKepP0tlT2+WgQtaQC2LPOZrMnlvcAFKFBfFnGpTPZPLeIBEw0SyomZNzLP5tzaP//Z",
}


def png(width, height, bits, colour, rows):
    """A PNG; `rows` with the filter's byte before each."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    parts = [chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, 0))]
    if colour == 3:
        parts += [chunk(b"PLTE", bytes(range(12))), chunk(b"tRNS", b"\xff\0\x80\x40")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def write(target, name, content):
    folder = here / "corpus" / target
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"start_{name}").write_bytes(content if isinstance(content, bytes) else content.encode())


for selector, text in small_meshes.items():
    write("meshes", f"small_{selector}", selector + text)
for path in sorted(data.iterdir()):
    if path.suffix in meshes and path.stat().st_size < 7000:
        write("meshes", path.name, meshes[path.suffix].encode() + path.read_bytes())
    elif path.suffix in grids and path.stat().st_size < 6000:
        write("grids", path.name, grids[path.suffix].encode() + path.read_bytes())
    elif path.suffix == ".npy":
        write("seeds", path.name, b"2" + path.read_bytes())
        write("seeds", path.name + "_3", b"3" + path.read_bytes())
for name, text in polygons.items():
    write("polygons", name, text)
for name, text in seeds.items():
    write("seeds", name, text)
for name, text in trees.items():
    write("trees", name, text)
for name, text in documents.items():
    write("documents", name, text)
for name, bits, colour, rows in (("gray", 8, 0, b"\0\x10\x80\1\x20\xf0"), ("rgba", 8, 6, b"\0" + bytes(range(8)) + b"\2" * 9),
                                 ("deep", 16, 4, b"\0" + bytes(range(8)) + b"\4" * 9), ("bits", 1, 0, b"\0\x80\0\x40"),
                                 ("palette", 2, 3, b"\0\x10\0\xe0")):
    write("documents", f"png_{name}", b"5" + png(2, 2, bits, colour, rows))
    write("documents", f"png_{name}_mended", b"6" + png(2, 2, bits, colour, rows))
for name, text in jpegs.items():
    write("documents", f"jpeg_{name}", b"5" + base64.b64decode(text))

generator = random.Random(1)
for target in ("domains", "diagrams", "c_interface", "device_diagrams", "triangulations", "treemaps", "transports",
               "samplings", "remeshings"):
    for k in range(12):
        write(target, f"random_{k}", bytes(generator.randrange(256) for _ in range(40 + 40 * k)))
