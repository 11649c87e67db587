import os

from conan import ConanFile
from conan.tools.build import can_run
from conan.tools.cmake import CMake, cmake_layout


class PowercellTest(ConanFile):
    """Builds a program in C++ and one in C against the package, and runs them where a device for OpenCL is."""

    settings = "os", "arch", "compiler", "build_type"
    generators = "CMakeDeps", "CMakeToolchain"
    test_type = "explicit"

    def requirements(self):
        self.requires(self.tested_reference_str)

    def layout(self):
        cmake_layout(self)

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def test(self):
        if can_run(self):
            for program in ("host_cpp", "c_transport"):
                self.run(os.path.join(self.cpp.build.bindir, program), env="conanrun")
