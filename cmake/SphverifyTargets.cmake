# SPDX-License-Identifier: GPL-3.0-or-later
# sphverify_room(NAME ...): one library per room of the house, named sphverify::NAME.
# Sources are all .cpp files of the room, so that adding one touches no list; the build re-globs by itself.
# Heavy headers of libraries are precompiled: they are most of the time that a file takes to compile.
function(sphverify_room name)
  cmake_parse_arguments(ARG "" "" "LINK;EXCLUDE;PRECOMPILE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  foreach(pattern IN LISTS ARG_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX "${pattern}")
  endforeach()
  add_library(sphverify_${name} STATIC ${sources})
  add_library(sphverify::${name} ALIAS sphverify_${name})
  set_target_properties(sphverify_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(sphverify_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/sphverify> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(sphverify_${name} PUBLIC ${ARG_LINK})
  target_precompile_headers(sphverify_${name} PRIVATE ${ARG_PRECOMPILE})
  sphverify_compile_options(sphverify_${name})
endfunction()

# For code that is not hot and slow to compile, such as what reads and writes documents.
function(sphverify_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Compiles so many files as one, where a full build is wanted: what they include is then read, and what it makes is then
# compiled, once for all of them. They must not share names that are theirs alone.
function(sphverify_compile_together target count)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${SPHVERIFY_UNITY} UNITY_BUILD_BATCH_SIZE ${count})
endfunction()

function(sphverify_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  # -fno-math-errno changes no result: it only lets sqrt be an instruction.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    -fno-math-errno -ffp-contract=off $<$<BOOL:${SPHVERIFY_WARNINGS_AS_ERRORS}>:-Werror>)
  if(SPHVERIFY_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${SPHVERIFY_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${SPHVERIFY_SANITIZE})
    if(SPHVERIFY_SANITIZE MATCHES "undefined")
      target_compile_options(${target} PUBLIC -fno-sanitize-recover=all)
    endif()
  endif()
  if(SPHVERIFY_COVERAGE)
    target_compile_options(${target} PUBLIC --coverage)
    target_link_options(${target} PUBLIC --coverage)
  endif()
endfunction()
