# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# `cpack -G DEB`: the packages libfcl-kios<version>, the shared library, libfcl-kios-dev, and
# libfcl-kios-preload, which programs that know FCL alone preload, and python3-fcl-kios and
# libfcl-kios-robot, where these are built. For a build that was configured with -DCMAKE_INSTALL_PREFIX=/usr (Debian's library directories).
set(control_dir ${PROJECT_BINARY_DIR}/debian)
set(so_version ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(runtime_package libfcl-kios${so_version})
set(dev_package libfcl-kios-dev)
set(preload_package libfcl-kios-preload)
file(STRINGS package.xml maintainer REGEX "<maintainer ")
string(REGEX REPLACE ".*email=\"(.*)\">(.*)</.*" "\\2 <\\1>" maintainer "${maintainer}")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME fcl-kios)
set(CPACK_PACKAGE_VENDOR "The fcl_kios authors")
set(CPACK_PACKAGE_CONTACT "${maintainer}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL dev)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(text "Intersections of spheres as the bounding volume of the Flexible Collision
Library's meshes: collision and exact distance by FCL's own calls.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME ${dev_package})
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEV_DESCRIPTION
  "${text}\n.\nThis package holds the headers and what builds need.")
set(dev_depends "libfcl-dev (>= 0.7)" libccd-dev libeigen3-dev liboctomap-dev)
if(BUILD_SHARED_LIBS)
  list(PREPEND CPACK_COMPONENTS_ALL runtime)
  list(PREPEND dev_depends "${runtime_package} (= ${PROJECT_VERSION}-1)")
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${runtime_package})
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
  set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "${text}\n.\nThis package holds the shared library.")
  set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
  set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY "=")
  # CPack's scripts call ldconfig, Debian's policy asks for the trigger.
  file(WRITE ${control_dir}/triggers "activate-noawait ldconfig\n")
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${control_dir}/triggers)
else()
  list(APPEND dev_depends libhwy-dev)
endif()
if(TARGET fcl_kios_preload)
  list(APPEND CPACK_COMPONENTS_ALL preload)
  set(CPACK_DEBIAN_PRELOAD_PACKAGE_NAME ${preload_package})
  set(CPACK_DEBIAN_PRELOAD_PACKAGE_SECTION libs)
  set(CPACK_DEBIAN_PRELOAD_PACKAGE_DEPENDS "${runtime_package} (= ${PROJECT_VERSION}-1)")
  set(CPACK_DEBIAN_PRELOAD_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
  set(CPACK_COMPONENT_PRELOAD_DESCRIPTION
    "${text}\n.\nThis package holds the library to preload before programs that were built for FCL.")
endif()
if(TARGET fcl_kios_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(python_package python3-fcl-kios)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME ${python_package})
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  get_target_property(minor fcl_kios_python PYTHON_MINOR)
  math(EXPR next_minor "${minor} + 1")
  set(python "python3 (>= 3.${minor}), python3 (<< 3.${next_minor})")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "${runtime_package} (= ${PROJECT_VERSION}-1), ${python}, python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "${text}\n.\nThis package holds the Python package fcl_kios, with python-fcl's names.")
endif()
if(TARGET fcl_kios_robot)
  list(APPEND CPACK_COMPONENTS_ALL robot)
  set(robot_package libfcl-kios-robot)
  set(CPACK_DEBIAN_ROBOT_PACKAGE_NAME ${robot_package})
  set(CPACK_DEBIAN_ROBOT_PACKAGE_SECTION libdevel)
  # Its headers include the library's, and its CMake target finds theirs.
  set(CPACK_DEBIAN_ROBOT_PACKAGE_DEPENDS "${dev_package} (= ${PROJECT_VERSION}-1)")
  set(CPACK_DEBIAN_ROBOT_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
  if(BUILD_SHARED_LIBS)
    set(CPACK_DEBIAN_ROBOT_PACKAGE_CONTROL_EXTRA ${control_dir}/triggers)
  endif()
  set(CPACK_COMPONENT_ROBOT_DESCRIPTION
    "${text}\n.\nThis package holds the addon that reads robots from URDF, SRDF and planning scenes.")
endif()
list(JOIN dev_depends ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS)

# What Debian asks of every package's documentation. Not part of a plain installation.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(CONFIGURE OUTPUT ${control_dir}/changelog.Debian CONTENT [[
fcl-kios (@PROJECT_VERSION@-1) unstable; urgency=medium

  * Made by CPack; what changed stands in changelog.gz.

 -- @maintainer@  @date@
]] @ONLY)
file(ARCHIVE_CREATE OUTPUT ${control_dir}/changelog.Debian.gz PATHS ${control_dir}/changelog.Debian
  FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)
file(ARCHIVE_CREATE OUTPUT ${control_dir}/changelog.gz PATHS ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  set(doc_files DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${${component}_package}
    COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(FILES LICENSE RENAME copyright ${doc_files})
  install(FILES ${control_dir}/changelog.gz ${control_dir}/changelog.Debian.gz ${doc_files})
endforeach()

include(CPack)
