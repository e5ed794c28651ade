"""Conan 2 recipe: the libraries of TVG, of the tree that this file lies in (conan create packaging/conan)."""

import os

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy

_EXPORTED = ("CMakeLists.txt", "LICENSE", "cmake/*", "libcodec/*")


class TvgConan(ConanFile):
    name = "tvg"
    version = "0.2.0"
    description = "Streaming codec and container for time-variant geometry"
    license = "MIT"
    topics = ("compression", "mesh", "animation", "streaming")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "encoder": [True, False]}
    default_options = {"shared": False, "encoder": True}

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for pattern in _EXPORTED:
            copy(self, pattern, root, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def validate(self):
        check_min_cppstd(self, 20)

    def requirements(self):
        self.requires("xxhash/[>=0.8 <1]", visible=False)
        if self.options.encoder:
            self.requires("eigen/[>=3.4 <4]", visible=False)
            self.requires("nanoflann/[>=1.4 <2]", visible=False)
            self.requires("openmesh/[>=9.0 <10]")
            self.requires("zstd/[>=1.5 <2]")

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["BUILD_SHARED_LIBS"] = bool(self.options.shared)
        toolchain.cache_variables["TVG_BUILD_ENCODER"] = bool(self.options.encoder)
        for part in ("TOOL", "PLAYER", "TESTS"):
            toolchain.cache_variables[f"TVG_BUILD_{part}"] = False
        folder = self.dependencies["xxhash"].cpp_info.includedirs[0]
        toolchain.cache_variables["TVG_XXHASH_INCLUDE_DIR"] = folder
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        # The package's own tvgConfig.cmake is what programs find, with its targets tvg::decoder, tvg::encoder, tvg::tvg.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "tvg")]
