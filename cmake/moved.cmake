# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Headers of 0.2 that have moved, old=new: forwards of one line stand in their places in 0.3 alone.
file(REMOVE_RECURSE ${PROJECT_BINARY_DIR}/include/fcl_kios/engine
  ${PROJECT_BINARY_DIR}/include/fcl_kios/interior ${PROJECT_BINARY_DIR}/include/fcl_kios/motion
  ${PROJECT_BINARY_DIR}/include/fcl_kios/compiler.h
  ${PROJECT_BINARY_DIR}/include/fcl_kios/query/clearance.h
  ${PROJECT_BINARY_DIR}/include/fcl_kios/volume/exact_distance.h
  ${PROJECT_BINARY_DIR}/include/fcl_kios/volume/fit.h)
foreach(moved IN ITEMS
  build/fit.h=volume.h
  clearance/clearance.h=clearance.h
  clearance/exact_distance.h=clearance.h
  continuous/continuous.h=motion.h
  continuous/least_clearance.h=motion.h
  linkage/joint_range.h=linkage.h
  linkage/linkage.h=linkage.h
  model/bounds.h=model.h
  model/bv_traits.h=detail/bv_traits.h
  model/bvh_build.h=detail/bvh_build.h
  model/convert.h=model.h
  model/model.h=model.h
  model/motion_bounds.h=detail/motion_bounds.h
  model/prepare.h=model.h
  model/storage.h=storage.h
  paper/fit.h=paper.h
  query/distance.h=distance.h
  query/mesh_nodes.h=fcl_nodes.h
  query/mesh_queries.h=contact.h
  query/octree_queries.h=contact.h
  query/ray.h=rays.h
  query/shape_queries.h=contact.h
  scene/manager_query.h=scene.h
  scene/scene_distance.h=scene.h
  scene/scene_types.h=scene.h
  search/counts.h=detail/counts.h
  solid/closedness.h=solids.h
  solid/penetration.h=solids.h
  solid/repair.h=repair.h
  solid/self_intersections.h=repair.h
  solid/solids.h=solids.h
  triangle/distance.h=triangle.h
  triangle/intersection.h=triangle.h
  triangle/triangle.h=triangle.h
  volume/kios.h=volume.h
  volume/rigid.h=detail/rigid.h
  volume/separation.h=volume.h
  volume/specialisations.h=detail/specialisations.h)
  string(REGEX MATCH "(.*)=(.*)" moved ${moved})
  file(CONFIGURE OUTPUT include/fcl_kios/${CMAKE_MATCH_1}
    CONTENT "#pragma once\n#include \"fcl_kios/${CMAKE_MATCH_2}\"\n")
endforeach()
