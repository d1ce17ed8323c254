option(LIMBER_TESTS "build tests and benchmarks" ON)
option(LIMBER_WERROR "treat warnings as errors" OFF)
# The compiler's calls at every branch are fuzz_scripts' own: no other program links with them.
option(LIMBER_FUZZ "have fuzz_scripts, to be built alone, see which code of the scripting runs" OFF)
set(LIMBER_SANITIZE "" CACHE STRING "sanitizers, for instance address,undefined")

# Without a preset CMake would build without optimisation. Release is -O3 -DNDEBUG; no -march: one
# binary runs everywhere, and vector instructions are chosen at run time (single-precision springs
# differ by target, see docs/accuracy.md; all else does not, see -ffp-contract below).
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release or RelWithDebInfo" FORCE)
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Without this sloppiness ccache would not keep what uses precompiled headers; by dependencies it
  # need not preprocess each file first, a second each.
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env
    CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_DEPEND=1 "${CCACHE}")
endif()

# What every target of the project is compiled with; outside libraries are not touched.
add_library(limber_build_flags INTERFACE)
target_compile_options(limber_build_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
  $<$<BOOL:${LIMBER_WERROR}>:-Werror>
  # Fused multiply-add would make results depend on the machine's instruction set.
  -ffp-contract=off
  # What ccache needs to see of precompiled headers.
  $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
if(LIMBER_SANITIZE)
  target_compile_options(limber_build_flags INTERFACE
    -fsanitize=${LIMBER_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(limber_build_flags INTERFACE -fsanitize=${LIMBER_SANITIZE})
endif()

# limber_precompile(TARGET HEADER ...): what nearly every file of a target includes, read once. Each
# file still names what it needs: the build with -D LIMBER_PRECOMPILE=OFF says whether it does.
option(LIMBER_PRECOMPILE "precompile the headers that nearly every file includes" ON)
function(limber_precompile target)
  if(NOT LIMBER_PRECOMPILE)
    return()
  endif()
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <numeric> <optional>
    <span> <string> <unordered_map> <utility> <vector> <Eigen/Core> <Eigen/Geometry> ${ARGN})
endfunction()

# limber_unite(TARGET): all sources of a folder in one compilation, for a build in half the time. Names
# of two files' anonymous namespaces in one folder may then not be the same. LIMBER_UNITE=OFF rebuilds
# less after a change; the preset `dev` has it OFF, so that each file is seen to stand alone.
option(LIMBER_UNITE "compile the sources of a folder at once" ON)
function(limber_unite target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${LIMBER_UNITE} UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    string(MAKE_C_IDENTIFIER "${folder}" group)
    set_property(SOURCE "${source}" PROPERTY UNITY_GROUP "${group}")
  endforeach()
endfunction()
