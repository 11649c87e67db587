import os
import shutil

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir
from conan.tools.gnu import PkgConfigDeps

required_conan_version = ">=2.0"

# What the command line tool needs besides the libraries, and the least version.
TOOL_PACKAGES = {
    "cairo": "1.16",
    "cli11": "2.2",
    "fmt": "9",
    "geos": "3.9",
    "libjpeg": "9",
    "libpng": "1.6",
    "nlohmann_json": "3.11",
    "proj": "8.2",
    "pugixml": "1.12",
    "sqlite3": "3.40",
    "zlib": "1.2",
}


class PowercellConan(ConanFile):
    """powercell has no public address yet: the source is the clone that this recipe lies in."""

    name = "powercell"
    description = "Power diagrams (weighted Voronoi, Laguerre) in polygons, on surfaces and in volumes, on any OpenCL device"
    license = "BSD-3-Clause"
    topics = ("voronoi", "power-diagram", "laguerre", "optimal-transport", "opencl")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False], "with_flann": [True, False], "with_tool": [True, False]}
    default_options = {"shared": False, "fPIC": True, "with_flann": True, "with_tool": False}
    implements = ["auto_shared_fpic"]

    def set_version(self):
        words = load(self, os.path.join(self.recipe_folder, "../../CMakeLists.txt")).split()
        self.version = words[words.index("project(powercell") + 2]

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "../..")
        for file in ("CMakeLists.txt", "LICENSE", "THIRD_PARTY.md"):
            shutil.copy2(os.path.join(root, file), self.export_sources_folder)
        for folder in ("apps", "cmake", "examples/data", "include", "kernels", "lib"):
            copy(self, "*", os.path.join(root, folder), os.path.join(self.export_sources_folder, folder))

    def requirements(self):
        self.requires("opencl-icd-loader/[>=2021]", transitive_headers=True)
        self.requires("opencl-headers/[>=2021]", transitive_headers=True)  # powercell/opencl.hpp
        self.requires("muparser/[>=2.3]")
        self.requires("boost/[>=1.74]", libs=False)
        self.requires("eigen/[>=3.4]", libs=False)
        if self.options.with_flann:
            self.requires("flann/[>=1.9.2]")
            self.requires("lz4/[>=1.9]")
        if self.options.with_tool:
            for name, version in TOOL_PACKAGES.items():
                self.requires(f"{name}/[>={version}]")

    def validate(self):
        check_min_cppstd(self, 20)
        if self.settings.os != "Linux":
            raise ConanInvalidConfiguration("powercell has been built on Linux only")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["POWERCELL_FLANN"] = bool(self.options.with_flann)
        toolchain.cache_variables["POWERCELL_APPS"] = bool(self.options.with_tool)
        toolchain.cache_variables["POWERCELL_TESTS"] = False
        toolchain.cache_variables["POWERCELL_ARCHIVES"] = False
        toolchain.generate()
        CMakeDeps(self).generate()
        PkgConfigDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        for file in ("LICENSE", "THIRD_PARTY.md"):
            copy(self, file, self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()
        for folder in ("lib/cmake", "lib/pkgconfig", "share/doc"):  # Conan makes its own
            rmdir(self, os.path.join(self.package_folder, folder))

    def _link(self, component, packages):
        """Links packages, {name: (target, library)}; of those that the profile takes from the platform Conan has no target,
        and a static library needs them by name."""
        known = {dependency.ref.name for dependency in self.dependencies.direct_host.values()}
        for name, (target, library) in packages.items():
            if name in known:
                component.requires.append(target)
            elif library and not self.options.shared:
                component.system_libs.append(library)

    def package_info(self):
        core = self.cpp_info.components["core"]
        core.libs = ["powercell_core"]
        core.set_property("cmake_target_name", "powercell::core")
        core.set_property("pkg_config_name", "powercell-core")
        if not self.options.shared:
            core.defines = ["POWERCELL_STATIC"]
            core.system_libs = ["m", "pthread"]
        packages = {
            "opencl-icd-loader": ("opencl-icd-loader::opencl-icd-loader", "OpenCL"),
            "opencl-headers": ("opencl-headers::opencl-headers", None),
            "boost": ("boost::headers", None),
        }
        if self.options.with_flann:
            packages |= {"flann": ("flann::flann", None), "lz4": ("lz4::lz4", "lz4")}
        self._link(core, packages)

        applications = self.cpp_info.components["applications"]
        applications.libs = ["powercell_applications"]
        applications.set_property("cmake_target_name", "powercell::applications")
        applications.requires = ["core"]
        self._link(applications, {"muparser": ("muparser::muparser", "muparser"), "eigen": ("eigen::eigen", None)})

        both = self.cpp_info.components["powercell"]
        both.set_property("cmake_target_name", "powercell::powercell")
        both.set_property("pkg_config_name", "powercell")
        both.libdirs, both.includedirs = [], []
        both.requires = ["core", "applications"]

        if self.options.with_tool:
            tool = self.cpp_info.components["tool"]
            tool.libdirs, tool.includedirs = [], []
            self._link(tool, {name: (f"{name}::{name}", None) for name in TOOL_PACKAGES})
