# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# How libfcl aligns Eigen's types, which -mavx, -march or EIGEN_DONT_ALIGN in a consumer's flags would
# change: FCL's structs would then have other offsets on its side. Measured with the options that
# FCL's target hands on, without those of this build; fcl_kios/detail/compiler.h compares.
if(NOT DEFINED FCL_KIOS_EIGEN_ALIGNMENT)
  string(REGEX REPLACE "(^| )-(m(arch|cpu|tune|avx|fma|sse)|DEIGEN_)[^ ]*" " " flags
    "${CMAKE_CXX_FLAGS}")
  get_target_property(fcl_options fcl INTERFACE_COMPILE_OPTIONS)
  if(fcl_options)
    list(JOIN fcl_options " " fcl_options)
    string(APPEND flags " ${fcl_options}")
  endif()
  get_target_property(eigen_dirs Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/alignment.cpp)
  set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
  foreach(bytes IN ITEMS 16 32 64 0 128)
    file(WRITE ${source} "#include <Eigen/Core>
static_assert(EIGEN_MAX_STATIC_ALIGN_BYTES == ${bytes}, \"\");\n")
    try_compile(aligned_to_${bytes} ${CMAKE_CURRENT_BINARY_DIR}/alignment ${source} CMAKE_FLAGS
      "-DCMAKE_CXX_FLAGS=${flags}" "-DINCLUDE_DIRECTORIES=${eigen_dirs}")
    if(aligned_to_${bytes})
      message(STATUS "libfcl aligns Eigen's types to ${bytes} bytes")
      set(FCL_KIOS_EIGEN_ALIGNMENT ${bytes} CACHE STRING
        "EIGEN_MAX_STATIC_ALIGN_BYTES with which libfcl was built")
      break()
    endif()
  endforeach()
  unset(CMAKE_TRY_COMPILE_TARGET_TYPE)
  if(NOT DEFINED FCL_KIOS_EIGEN_ALIGNMENT)
    message(FATAL_ERROR "fcl_kios: the alignment of Eigen's types in libfcl can't be measured; give "
      "it by -DFCL_KIOS_EIGEN_ALIGNMENT=16, or what EIGEN_MAX_STATIC_ALIGN_BYTES was.")
  endif()
endif()
