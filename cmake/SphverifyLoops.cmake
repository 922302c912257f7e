# SPDX-License-Identifier: GPL-3.0-or-later
# The loops over pairs are compiled once per instruction set, of templates in formulations/sweep; the program chooses a set at
# run time. Only here may the compiler fuse a multiplication and an addition.
set(SPHVERIFY_LOOP_TEMPLATES "${CMAKE_CURRENT_LIST_DIR}/../formulations/sweep" CACHE INTERNAL "")
if(NOT EXISTS "${SPHVERIFY_LOOP_TEMPLATES}/scheme_loops.cpp.in")
  set(SPHVERIFY_LOOP_TEMPLATES "${CMAKE_CURRENT_LIST_DIR}" CACHE INTERNAL "") # where they are installed
endif()

set(SPHVERIFY_INSTRUCTION_SETS baseline)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND SPHVERIFY_INSTRUCTION_SETS avx2)
endif()
list(GET SPHVERIFY_INSTRUCTION_SETS -1 SPHVERIFY_BEST_INSTRUCTION_SET)

# A source file that is compiled for an instruction set.
function(sphverify_hot_file set file)
  set(options -ffp-contract=fast -Wno-psabi)
  if(SPHVERIFY_SANITIZE)
    list(APPEND options -O1)
  else()
    list(APPEND options $<$<CONFIG:Release,RelWithDebInfo>:-O3>)
  endif()
  if(set STREQUAL "avx2" AND set IN_LIST SPHVERIFY_INSTRUCTION_SETS)
    list(APPEND options -mavx2 -mfma -mpopcnt)
  endif()
  set_source_files_properties("${file}" PROPERTIES SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON
    COMPILE_OPTIONS "${options}")
endfunction()

# sphverify_add_loops(TARGET FILE TEMPLATE): a file of a template for every instruction set, with the caller's `includes` and
# `instantiations` in it. Only the best set, the last, has loops made for certain records and for several terms.
function(sphverify_add_loops target file template)
  set(specialises 0)
  foreach(set IN LISTS SPHVERIFY_INSTRUCTION_SETS)
    if(set STREQUAL SPHVERIFY_BEST_INSTRUCTION_SET)
      set(specialises 1)
    endif()
    set(path "${CMAKE_CURRENT_BINARY_DIR}/generated/${file}_${set}.cpp")
    configure_file("${SPHVERIFY_LOOP_TEMPLATES}/${template}.cpp.in" "${path}" @ONLY)
    target_sources(${target} PRIVATE "${path}")
    sphverify_hot_file(${set} "${path}")
  endforeach()
endfunction()

# The loops of schemes.
# @param instantiations  explicit instantiations of what formulations/sweep/scheme_loops.hpp has
# @param includes  lines that bring the schemes
function(sphverify_add_scheme_loops target name instantiations includes)
  sphverify_add_loops(${target} "${name}" scheme_loops)
endfunction()

# Kernels over columns of distances, of formulations/sweep/kernel_columns.hpp.
function(sphverify_add_kernel_columns target name instantiations includes)
  sphverify_add_loops(${target} "${name}" kernel_columns)
endfunction()
