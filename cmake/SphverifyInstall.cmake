# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the program, the libraries with their headers, the schemas, the ready-made studies, documentation and examples,
# and exports sphverify::formulations, sphverify::cases, sphverify::reports, sphverify::harness and sphverify::program for
# find_package(sphverify), with sphverify_add_program for programs that have parts of their own.
#
# Component `program` (the default, CMakeLists.txt) is what one needs to run it, `dev` what one needs to build against it:
# a Debian package each (SphverifyPackages.cmake). `plain` holds what Debian keeps under other names.
include(CMakePackageConfigHelpers)

install(TARGETS sphverify_formulations sphverify_cases sphverify_reports sphverify_harness sphverify_program
        EXPORT sphverify-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
install(TARGETS sphverify RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# Manual and completion: a build for another machine may have none.
install(DIRECTORY ${PROJECT_BINARY_DIR}/share/ DESTINATION ${CMAKE_INSTALL_DATADIR} OPTIONAL)
# Where Debian's python3 of any version looks below /usr; elsewhere PYTHONPATH names it (docs/python.md).
install(DIRECTORY python/sphverify DESTINATION lib/python3/dist-packages FILES_MATCHING PATTERN "*.py"
        PATTERN "__pycache__" EXCLUDE)
install(DIRECTORY formulations cases harness reports DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sphverify COMPONENT dev
        FILES_MATCHING PATTERN "*.hpp" REGEX "/(studies|page|schema)$" EXCLUDE)
# A plug-in needs this header and a compiler, nothing of the libraries.
install(FILES include/sphverify/plugin.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sphverify)
install(DIRECTORY cases/studies reports/schema DESTINATION ${CMAKE_INSTALL_DATADIR}/sphverify)
# As in the repository, so that links from one to the other lead somewhere.
install(FILES README.md CONTRIBUTING.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs examples DESTINATION ${CMAKE_INSTALL_DOCDIR} USE_SOURCE_PERMISSIONS
        PATTERN __pycache__ EXCLUDE PATTERN build EXCLUDE)
install(FILES LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT plain)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/sphverify)
install(EXPORT sphverify-targets NAMESPACE sphverify:: DESTINATION ${package_dir} COMPONENT dev)
configure_package_config_file(cmake/sphverify-config.cmake.in ${PROJECT_BINARY_DIR}/sphverify-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/sphverify-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES cmake/SphverifyLoops.cmake cmake/SphverifyAddProgram.cmake cmake/program_main.cpp.in
              formulations/sweep/kernel_columns.cpp.in formulations/sweep/scheme_loops.cpp.in
        DESTINATION ${package_dir} COMPONENT dev)
install(FILES ${PROJECT_BINARY_DIR}/sphverify-config.cmake ${PROJECT_BINARY_DIR}/sphverify-config-version.cmake
        DESTINATION ${package_dir} COMPONENT dev)
