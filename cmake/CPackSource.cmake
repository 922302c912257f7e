# SPDX-License-Identifier: GPL-3.0-or-later
# Read by cpack before it makes a package. The source archive holds what is committed, as `git archive` gives it, and not
# what else lies in the working tree.
if(CPACK_INSTALL_CMAKE_PROJECTS)
  return()  # packages of what is installed
endif()
set(committed "${CPACK_PACKAGE_DIRECTORY}/_CPack_Packages/committed")
file(REMOVE_RECURSE "${committed}")
file(MAKE_DIRECTORY "${committed}")
execute_process(COMMAND git -C "${CPACK_SPHVERIFY_SOURCE_DIR}" archive --format=tar --output "${committed}.tar" HEAD
                RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "A source archive is made of a git repository, and ${CPACK_SPHVERIFY_SOURCE_DIR} is none")
endif()
file(ARCHIVE_EXTRACT INPUT "${committed}.tar" DESTINATION "${committed}")
set(CPACK_INSTALLED_DIRECTORIES "${committed}" /)
set(CPACK_PACKAGING_INSTALL_PREFIX "")
