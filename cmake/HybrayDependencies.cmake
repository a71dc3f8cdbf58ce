# Every package the project stands on. OpenImageIO, Highway and xxHash come through pkg-config: the CMake file of
# the first names libraries that Debian's package does not bring, and the last has none there.
find_package(embree 4 QUIET CONFIG)
if(embree_FOUND)
  set(HYBRAY_EMBREE_MAJOR 4)
else()
  find_package(embree 3 REQUIRED CONFIG)
  set(HYBRAY_EMBREE_MAJOR 3)
endif()
message(STATUS "Embree ${embree_VERSION}")

find_package(Boost REQUIRED CONFIG)  # headers alone
find_package(CLI11 REQUIRED CONFIG)
find_package(TBB REQUIRED CONFIG)
find_package(TinyGLTF REQUIRED CONFIG)
find_package(fmt REQUIRED CONFIG)
find_package(glm REQUIRED CONFIG)
find_package(nlohmann_json REQUIRED CONFIG)
find_package(spdlog REQUIRED CONFIG)
find_package(valijson REQUIRED CONFIG)

find_package(PkgConfig REQUIRED)
pkg_check_modules(OIIO REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)

if(HYBRAY_TESTS)
  find_package(GTest REQUIRED CONFIG)
endif()
if(HYBRAY_BENCH)
  find_package(benchmark REQUIRED CONFIG)
endif()
