find_package(PkgConfig REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
# Bullet's CMake package is broken in Debian 12; pkg-config is right and knows both precisions.
pkg_check_modules(BULLET_F32 REQUIRED IMPORTED_TARGET bullet)
pkg_check_modules(BULLET_F64 REQUIRED IMPORTED_TARGET bullet-float64)
# What reads .bullet files is in no package description.
foreach(suffix IN ITEMS "" "-float64")
  set(precision f32)
  if(suffix)
    set(precision f64)
  endif()
  string(TOUPPER ${precision} PRECISION)
  find_library(BULLET_IMPORTER_${PRECISION} BulletWorldImporter${suffix} REQUIRED)
  find_library(BULLET_FILE_${PRECISION} BulletFileLoader${suffix} REQUIRED)
  add_library(bullet_world_importer_${precision} INTERFACE)
  target_link_libraries(bullet_world_importer_${precision} INTERFACE
    "${BULLET_IMPORTER_${PRECISION}}" "${BULLET_FILE_${PRECISION}}"
    PkgConfig::BULLET_${PRECISION})
endforeach()
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
# Debian's name for the build without MPI first: plain `hdf5` may be one with it.
pkg_search_module(HDF5 REQUIRED IMPORTED_TARGET hdf5-serial hdf5)
# Its CMake package in Debian 12 wants Draco beside it; pkg-config does not.
pkg_check_modules(ASSIMP REQUIRED IMPORTED_TARGET assimp)
# Lua built as C++: its errors unwind our functions. Plain `lua5.4` jumps over their destructors.
pkg_check_modules(LUA REQUIRED IMPORTED_TARGET lua5.4-c++)
find_package(hwy REQUIRED)
find_package(TBB REQUIRED)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
if(LIMBER_TESTS)
  find_package(GTest REQUIRED)
  find_package(rapidcheck REQUIRED)
  find_package(benchmark REQUIRED)
endif()
