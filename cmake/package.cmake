# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Installation: library, headers, CMake package, pkg-config file, ROS manifest. All relocatable.
include(CMakePackageConfigHelpers)

# Two components: `runtime`, what a program that is linked to the shared library needs, and `dev`.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev)
install(TARGETS fcl_kios fcl_kios_force_include EXPORT fcl_kiosTargets
  LIBRARY COMPONENT runtime NAMELINK_COMPONENT dev
  ARCHIVE COMPONENT dev)
install(DIRECTORY include/ ${PROJECT_BINARY_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN *.h)
install(FILES package.xml LICENSE examples/cube.stl DESTINATION ${CMAKE_INSTALL_DATADIR}/fcl_kios)

# The empty file by which ROS 2 knows that a package is installed in this prefix.
file(WRITE ${PROJECT_BINARY_DIR}/ament_marker "")
install(FILES ${PROJECT_BINARY_DIR}/ament_marker RENAME fcl_kios
  DESTINATION ${CMAKE_INSTALL_DATADIR}/ament_index/resource_index/packages)

# CMake package.
set(cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/fcl_kios)
install(EXPORT fcl_kiosTargets NAMESPACE fcl_kios:: DESTINATION ${cmake_dir})
configure_package_config_file(cmake/fcl_kiosConfig.cmake.in
  ${PROJECT_BINARY_DIR}/fcl_kiosConfig.cmake INSTALL_DESTINATION ${cmake_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/fcl_kiosConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/fcl_kiosConfig.cmake
  ${PROJECT_BINARY_DIR}/fcl_kiosConfigVersion.cmake DESTINATION ${cmake_dir})

# pkg-config: everything hangs on the place of the .pc file; FCL is named by directory only where
# it lies outside the compiler's own search paths.
file(RELATIVE_PATH pc_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
cmake_path(APPEND pc_prefix_dir "\${pcfiledir}" "${pc_prefix}")
string(REGEX REPLACE "/$" "" pc_prefix "${pc_prefix_dir}")
cmake_path(ABSOLUTE_PATH CMAKE_INSTALL_LIBDIR BASE_DIRECTORY "\${prefix}" OUTPUT_VARIABLE pc_libdir)
cmake_path(ABSOLUTE_PATH CMAKE_INSTALL_INCLUDEDIR BASE_DIRECTORY "\${prefix}"
  OUTPUT_VARIABLE pc_includedir)

get_target_property(fcl_include_dirs fcl INTERFACE_INCLUDE_DIRECTORIES)
list(REMOVE_DUPLICATES fcl_include_dirs)
list(REMOVE_ITEM fcl_include_dirs ${CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES} /usr/include)
list(TRANSFORM fcl_include_dirs PREPEND " -I" OUTPUT_VARIABLE pc_fcl_includedir)
list(JOIN pc_fcl_includedir "" pc_fcl_includedir)

get_target_property(fcl_file fcl LOCATION)
cmake_path(GET fcl_file PARENT_PATH fcl_library_dir)
set(pc_fcl_libdir "")
if(NOT fcl_library_dir IN_LIST CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES)
  set(pc_fcl_libdir " -L${fcl_library_dir}")
endif()

# pkg-config wants the file of a private requirement even where nobody links statically.
set(pc_requires_private "")
if(NOT BUILD_SHARED_LIBS)
  set(pc_requires_private libhwy)
endif()

configure_file(cmake/fcl_kios.pc.in fcl_kios.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/fcl_kios.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
foreach(addon IN ITEMS clearance paper)
  configure_file(cmake/addon.pc.in fcl_kios_${addon}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/fcl_kios_${addon}.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()
