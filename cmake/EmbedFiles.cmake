# SPDX-License-Identifier: GPL-3.0-or-later
# sphverify_embed_files(TARGET NAME FILES ... LICENCES ...): compiles text files into a target, so that the program
# carries them wherever it runs. NAME is the function that finds them by path below the current source directory,
# declared by the target itself as `std::string_view NAME(std::string_view)` in namespace sphverify; the texts of
# LICENCES are joined under the name "licences". Files are read again whenever they change. One that is missing is
# left out and found empty.
#
# The file is also the script that writes the source when the target is built.

function(sphverify_embed_files target name)
  cmake_parse_arguments(ARG "" "" "FILES;LICENCES" ${ARGN})
  set(output "${CMAKE_CURRENT_BINARY_DIR}/generated/${name}.cpp")
  set(present "")
  foreach(file IN LISTS ARG_FILES ARG_LICENCES)
    if(EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/${file}")
      list(APPEND present "${CMAKE_CURRENT_SOURCE_DIR}/${file}")
    else()
      message(STATUS "${file} is missing: the program is built without it")
    endif()
  endforeach()
  add_custom_command(OUTPUT "${output}"
    COMMAND ${CMAKE_COMMAND} "-DROOT=${CMAKE_CURRENT_SOURCE_DIR}" "-DNAME=${name}" "-DOUTPUT=${output}"
      "-DFILES=${ARG_FILES}" "-DLICENCES=${ARG_LICENCES}" -P "${CMAKE_CURRENT_FUNCTION_LIST_FILE}"
    DEPENDS ${present} "${CMAKE_CURRENT_FUNCTION_LIST_FILE}" VERBATIM)
  target_sources(${target} PRIVATE "${output}")
  set_source_files_properties("${output}" PROPERTIES SKIP_PRECOMPILE_HEADERS ON
    COMPILE_OPTIONS -Wno-overlength-strings)
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE)
  return()
endif()

function(append_entry name text)
  if(text MATCHES "\\)EMBED\"")
    message(FATAL_ERROR "${name} holds the end mark of its own literal")
  endif()
  # Square brackets and semicolons have a meaning in lists, not in quoted text.
  file(APPEND "${OUTPUT}.new" "      {\"${name}\", view(R\"EMBED(${text})EMBED\")},\n")
endfunction()

file(WRITE "${OUTPUT}.new" "// Written by cmake/EmbedFiles.cmake.
#include <cstddef>
#include <string_view>

namespace sphverify {

std::string_view ${NAME}(std::string_view name);

// The length is known without counting, which compilers refuse to do for texts so long.
template <std::size_t size>
static constexpr std::string_view view(char const (&text)[size]) {
  return {text, size - 1};
}

std::string_view ${NAME}(std::string_view name) {
  struct Entry {
    std::string_view name, text;
  };
  static constexpr Entry entries[] = {
")
foreach(file IN LISTS FILES)
  if(EXISTS "${ROOT}/${file}")
    file(READ "${ROOT}/${file}" text)
    string(REGEX REPLACE "^page/" "" entry "${file}")
    append_entry("${entry}" "${text}")
  endif()
endforeach()
set(licences "")
foreach(file IN LISTS LICENCES)
  if(EXISTS "${ROOT}/${file}")
    file(READ "${ROOT}/${file}" text)
    string(REGEX REPLACE "^.*node_modules/(.*)/[^/]*$" "\\1" package "${file}")
    string(APPEND licences "${package}\n\n${text}\n\n")
  endif()
endforeach()
append_entry("licences" "${licences}")
file(APPEND "${OUTPUT}.new" "  };
  for (Entry const& entry : entries) {
    if (entry.name == name) return entry.text;
  }
  return {};
}

}  // namespace sphverify
")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
