# SPDX-License-Identifier: GPL-3.0-or-later
# What `cpack` makes (docs/packages.md): two Debian packages of what is installed, the component `program` as sphverify and
# `dev` as sphverify-dev; and with --config CPackSourceConfig.cmake (target package_source) the source archive.
set(CPACK_PACKAGE_NAME sphverify)
set(CPACK_PACKAGE_VENDOR "The sphverify developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own, the first line of its description
set(CPACK_PACKAGE_CONTACT "The sphverify developers <developers@sphverify.invalid>")  # there is no address yet
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(debian_version "${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME sphverify)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS sphverify-dev)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "verifies formulations of smoothed particle hydrodynamics with walls
sphverify runs formulations of smoothed particle hydrodynamics (SPH) with walls
on cases that have an exact solution, and reports errors with observed orders,
conservation, cost and stability as JSON, as tables and as one HTML page. Gates
turn them into a verdict for continuous integration. Formulations in shared
libraries and the snapshots of other codes are judged on the same scale.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME sphverify-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
# What the headers include, and what find_package(sphverify) looks for (sphverify-config.cmake.in).
set(dev_depends "sphverify (= ${debian_version})" libboost-dev libcli11-dev libeigen3-dev libfmt-dev libgsl-dev libsuitesparse-dev
    libsundials-dev libtbb-dev nlohmann-json3-dev)
if(HDF5_FOUND)
  list(APPEND dev_depends libhdf5-dev)
endif()
list(JOIN dev_depends ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_DEV_DESCRIPTION "SPH formulations of your own, verified by sphverify
Headers, static libraries and the CMake package of sphverify: a header with a
scheme, a kernel, a treatment of walls or a case, and six lines of CMake make a
program that has all commands of sphverify and these parts beside its own.")

# Documents that only Debian asks for: not of `cmake --install`, only of the packages.
install(FILES packaging/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program EXCLUDE_FROM_ALL)
install(CODE "set(source \"${PROJECT_SOURCE_DIR}\")
set(version \"${debian_version}\")
set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/doc\")" COMPONENT program EXCLUDE_FROM_ALL)
install(SCRIPT "${PROJECT_SOURCE_DIR}/cmake/WriteDebianChangelogs.cmake" COMPONENT program EXCLUDE_FROM_ALL)
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
file(CREATE_LINK sphverify "${PROJECT_BINARY_DIR}/packages/sphverify-dev" SYMBOLIC)
install(FILES "${PROJECT_BINARY_DIR}/packages/sphverify-dev" DESTINATION ${CMAKE_INSTALL_DATADIR}/doc COMPONENT dev EXCLUDE_FROM_ALL)

# The source archive: what is committed, no more (CPackSource.cmake).
set(CPACK_SOURCE_GENERATOR TXZ)
set(CPACK_SOURCE_PACKAGE_FILE_NAME "sphverify-${PROJECT_VERSION}")
set(CPACK_SOURCE_STRIP_FILES OFF)
set(CPACK_PROJECT_CONFIG_FILE "${PROJECT_SOURCE_DIR}/cmake/CPackSource.cmake")
set(CPACK_SPHVERIFY_SOURCE_DIR "${PROJECT_SOURCE_DIR}")
include(CPack)
