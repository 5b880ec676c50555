# Every library comes from the system (Debian 12 package in brackets); docs/dependencies.md says why each was chosen.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(glm REQUIRED)                                   # [libglm-dev]
find_package(fmt REQUIRED)                                   # [libfmt-dev]
find_package(CLI11 REQUIRED)                                 # [libcli11-dev]
find_package(nlohmann_json REQUIRED)                         # [nlohmann-json3-dev]
find_package(simdjson REQUIRED)                              # [libsimdjson-dev]
find_package(CGAL REQUIRED)                                  # [libcgal-dev]
find_package(GDAL CONFIG REQUIRED)                           # [libgdal-dev] DXF, GeoJSON, Shapefile, CRS
find_package(pugixml REQUIRED)                               # [libpugixml-dev] CityGML, city rules
find_package(TinyGLTF REQUIRED)                              # [libtinygltf-dev]
find_package(LibArchive REQUIRED)                            # [libarchive-dev]
find_package(ZLIB REQUIRED)                                  # [zlib1g-dev]
find_package(TBB REQUIRED)                                   # [libtbb-dev]
find_package(embree 3 REQUIRED)                              # [libembree-dev]
find_package(PNG REQUIRED)                                   # [libpng-dev]
find_package(HDF5 REQUIRED COMPONENTS C)                     # [libhdf5-dev]
find_package(MPI REQUIRED COMPONENTS C)                      # [libopenmpi-dev]
find_package(Boost REQUIRED)                                 # [libboost-dev] CRC only
find_package(GTest REQUIRED)                                 # [libgtest-dev]
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)  # [libtomlplusplus-dev]
pkg_check_modules(epoxy REQUIRED IMPORTED_TARGET epoxy)      # [libepoxy-dev]
find_package(glfw3 REQUIRED)                                 # [libglfw3-dev]
pkg_check_modules(imgui REQUIRED IMPORTED_TARGET imgui)      # [libimgui-dev]
pkg_check_modules(egl REQUIRED IMPORTED_TARGET egl)          # [libegl-dev]
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash) # [libxxhash-dev]

# Not needed: one benchmark compares our grid with it, and is built where it is found [libopenvdb-dev]. Its own
# FindOpenVDB.cmake wants Boost.Iostreams, which the benchmark does not use.
find_path(OPENVDB_INCLUDE_DIR openvdb/openvdb.h)
find_library(OPENVDB_LIBRARY openvdb)
if(OPENVDB_INCLUDE_DIR AND OPENVDB_LIBRARY)
  add_library(OpenVDB UNKNOWN IMPORTED)
  set_target_properties(OpenVDB PROPERTIES
    IMPORTED_LOCATION ${OPENVDB_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${OPENVDB_INCLUDE_DIR})
endif()
