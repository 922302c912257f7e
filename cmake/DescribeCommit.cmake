# SPDX-License-Identifier: GPL-3.0-or-later
# sphverify_describe_commit(SOURCE COMMIT DATE): which commit the sources are, and of when (RFC 5322): of git where they are
# its working tree, else of what `git archive` wrote into archived_commit.txt; "unknown" and nothing where neither is there.
function(sphverify_describe_commit source commit date)
  set(described unknown)
  set(committed "")
  find_program(GIT_PROGRAM git)
  if(GIT_PROGRAM AND EXISTS "${source}/.git")
    execute_process(COMMAND "${GIT_PROGRAM}" -C "${source}" describe --always --dirty --abbrev=12
                    OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
    if(NOT failed)
      set(described "${found}")
      execute_process(COMMAND "${GIT_PROGRAM}" -C "${source}" log -1 --format=%cD
                      OUTPUT_VARIABLE committed OUTPUT_STRIP_TRAILING_WHITESPACE)
    endif()
  else()
    file(STRINGS "${source}/cmake/archived_commit.txt" lines)
    list(GET lines 0 hash)
    list(GET lines 1 when)
    if(NOT hash MATCHES "Format")
      string(SUBSTRING "${hash}" 0 12 described)
      set(committed "${when}")
    endif()
  endif()
  set(${commit} "${described}" PARENT_SCOPE)
  set(${date} "${committed}" PARENT_SCOPE)
endfunction()
