# SPDX-License-Identifier: GPL-3.0-or-later
# What both programs need that hand input to the readers: the fuzzer and the replay of its corpus.
function(sphverify_fuzz_target program)
  add_library(${program}-plugin MODULE "${PROJECT_SOURCE_DIR}/tests/fuzz/plugin_of_text.c")
  target_include_directories(${program}-plugin PRIVATE "${PROJECT_SOURCE_DIR}/include")
  add_dependencies(${program} ${program}-plugin)
  target_compile_definitions(${program} PRIVATE "SPHVERIFY_FUZZ_BESIDE=\"${PROJECT_SOURCE_DIR}/tests/fuzz/beside\""
    "SPHVERIFY_FUZZ_PLUGIN=\"$<TARGET_FILE:${program}-plugin>\"")
  if(HDF5_FOUND)
    target_compile_definitions(${program} PRIVATE SPHVERIFY_FUZZ_HDF5)
    target_include_directories(${program} PRIVATE ${HDF5_INCLUDE_DIRS})
    target_link_libraries(${program} PRIVATE ${HDF5_LIBRARIES})
  endif()
endfunction()
