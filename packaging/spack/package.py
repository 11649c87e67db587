# Spack 1.0 or later.
from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Powercell(CMakePackage):
    """Power diagrams (weighted Voronoi, Laguerre) in polygons, on surfaces and in volumes, exact, on any OpenCL device;
    and optimal transport, blue noise sampling, remeshing and treemaps built on them."""

    # powercell has no public address yet, so neither homepage nor url nor git are set: the source is a clone, as in
    # `spack develop` or `spack dev-build`.
    license("BSD-3-Clause")

    version("0.2.0")

    variant("shared", default=True, description="Build shared libraries")
    variant("flann", default=True, description="Neighbours from FLANN's lists, beside the library's own search")
    variant("tool", default=True, description="Build the command line tool")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("pkgconfig", type="build")

    depends_on("opencl@1.2:")
    depends_on("muparser@2.3:")
    depends_on("boost@1.74:", type=("build", "link"))
    depends_on("eigen@3.4:", type="build")
    with when("+flann"):
        depends_on("flann@1.9.2:")
        depends_on("lz4")
    with when("+tool"):
        depends_on("cairo+pdf+png")
        depends_on("cli11@2.2:", type="build")
        depends_on("fmt@9:")
        depends_on("geos@3.9:")
        depends_on("jpeg")
        depends_on("libpng")
        depends_on("nlohmann-json@3.11:", type="build")
        depends_on("proj@8.2:")
        depends_on("pugixml")
        depends_on("sqlite")
        depends_on("zlib-api")

    # C++20 with <span>, <bit> and ranges.
    conflicts("%gcc@:10")

    def cmake_args(self):
        return [
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
            self.define_from_variant("POWERCELL_FLANN", "flann"),
            self.define_from_variant("POWERCELL_APPS", "tool"),
            self.define("POWERCELL_ARCHIVES", False),
            self.define("POWERCELL_TESTS", self.run_tests),
        ]
