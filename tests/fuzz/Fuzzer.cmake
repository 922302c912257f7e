# SPDX-License-Identifier: GPL-3.0-or-later
# The readers, compiled by Clang for libFuzzer with sanitizers. What they call beside, loops over pairs and integration, is
# that of the libraries of another build, which would take an hour to compile so: SPHVERIFY_FUZZ names its folder.
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  message(FATAL_ERROR "libFuzzer comes with Clang: cmake --preset fuzz")
endif()

# Those of a room that are meant, together in files as the other build puts them together: names that files have for
# themselves do not meet.
set(sources)
function(sphverify_fuzz_room room count wanted)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${room}/*.cpp")
  list(FILTER files EXCLUDE REGEX "/harness/cli/|/codes/without_hdf5.cpp$")
  set(number 0)
  foreach(file IN LISTS files)
    math(EXPR group "${number} / ${count}")
    math(EXPR number "${number} + 1")
    file(RELATIVE_PATH name "${PROJECT_SOURCE_DIR}/${room}" "${file}")
    if(NOT name MATCHES "${wanted}" OR (name MATCHES "/hdf5/" AND NOT HDF5_FOUND))
      continue()
    endif()
    set_source_files_properties("${file}" PROPERTIES UNITY_GROUP "${room}-${group}")
    list(APPEND sources "${file}")
  endforeach()
  set(sources ${sources} PARENT_SCOPE)
endfunction()
sphverify_fuzz_room(reports 8 "^([a-z_]+|json/.*)\\.cpp$")
string(CONCAT wanted "^(gate/(read_|judge|measure|select|gates|text).*|evaluate/(state|against).*|codes/(external_code|read_|snapshot|hdf5/(file|read)).*"
  "|codes/assess.cpp|study/(read_|journal|merge|memory|no_effect|par|study|expand).*|study/wall_facts.*|measure/ladder_table.*)$")
sphverify_fuzz_room(harness 6 "${wanted}")
file(GLOB targets CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/fuzz/targets/*.cpp")
if(NOT HDF5_FOUND)
  list(FILTER targets EXCLUDE REGEX "hdf5.cpp$")
endif()
set_source_files_properties(${targets} PROPERTIES UNITY_GROUP targets)
file(GLOB plugins CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/formulations/plugins/*.cpp")
set_source_files_properties(${plugins} PROPERTIES UNITY_GROUP plugins)

add_executable(sphverify-fuzz ${sources} ${targets} ${plugins} tests/fuzz/target.cpp tests/fuzz/fuzzer.cpp)
set_target_properties(sphverify-fuzz PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
target_include_directories(sphverify-fuzz PRIVATE "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/include"
  "${SPHVERIFY_FUZZ}/harness/generated")
target_precompile_headers(sphverify-fuzz PRIVATE <Eigen/Core> <fmt/format.h> <functional> <nlohmann/json.hpp>)
sphverify_compile_options(sphverify-fuzz)
set(sanitizers address,undefined)
target_compile_options(sphverify-fuzz PRIVATE -O1 -gline-tables-only -D_GLIBCXX_ASSERTIONS -fno-omit-frame-pointer
  -fsanitize=fuzzer-no-link,${sanitizers} -fno-sanitize-recover=all -Wno-all -Wno-extra -Wno-shadow -Wno-conversion)
# Those libraries hold the readers, too: of two definitions the first one is taken, which is ours.
target_link_options(sphverify-fuzz PRIVATE -fsanitize=fuzzer,${sanitizers} -Wl,-z,muldefs)
set(rest)
foreach(room IN ITEMS harness reports cases formulations)
  list(APPEND rest "${SPHVERIFY_FUZZ}/${room}/libsphverify_${room}.a")
endforeach()
target_link_libraries(sphverify-fuzz PRIVATE -Wl,--start-group ${rest} -Wl,--end-group Eigen3::Eigen GSL::gsl Boost::headers
  fmt::fmt nlohmann_json::nlohmann_json TBB::tbb ${CMAKE_DL_LIBS} SUNDIALS::cvodes_shared SUNDIALS::arkode_shared
  SUNDIALS::nvecserial_shared SUNDIALS::sunlinsolklu_shared)
include(tests/fuzz/Common.cmake)
sphverify_fuzz_target(sphverify-fuzz)
