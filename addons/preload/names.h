// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The symbols that the interposer defines in place of libfcl.so.0.7's, as the Itanium ABI mangles
// them. test/preload/symbols.sh compares them with libfcl's.

/// Follows the declaration of a function of ours that is to have such a name.
#define KIOS_STANDS_FOR(name) __asm__(name) __attribute__((visibility("default"), used))

// fcl::collide<double> and fcl::distance<double>.
#define KIOS_COLLIDE_OBJECTS                                                            \
  "_ZN3fcl7collideIdEEmPKNS_15CollisionObjectIT_EES5_RKNS_16CollisionRequestIS2_EERNS_" \
  "15CollisionResultIS2_EE"
#define KIOS_COLLIDE                                                                       \
  "_ZN3fcl7collideIdEEmPKNS_17CollisionGeometryIT_EERKN5Eigen9TransformIS2_Li3ELi1ELi0EEE" \
  "S5_SA_RKNS_16CollisionRequestIS2_EERNS_15CollisionResultIS2_EE"
#define KIOS_DISTANCE_OBJECTS                                                             \
  "_ZN3fcl8distanceIdEET_PKNS_15CollisionObjectIS1_EES5_RKNS_15DistanceRequestIS1_EERNS_" \
  "14DistanceResultIS1_EE"
#define KIOS_DISTANCE                                                                         \
  "_ZN3fcl8distanceIdEET_PKNS_17CollisionGeometryIS1_EERKN5Eigen9TransformIS1_Li3ELi1ELi0EEE" \
  "S5_SA_RKNS_15DistanceRequestIS1_EERNS_14DistanceResultIS1_EE"

// The functions that fit a volume, one of which every build or refit of a model calls:
// getCovariance for each node that is fitted from its triangles, one of the others for each leaf of
// a refit from the leaves up.
#define KIOS_GET_COVARIANCE                                                                       \
  "_ZN3fcl13getCovarianceIdEEvPKN5Eigen6MatrixIT_Li3ELi1ELi0ELi3ELi1EEES6_PNS_8TriangleEPjiRNS2_" \
  "IS3_Li3ELi3ELi0ELi3ELi3EEE"
#define KIOS_FIT_FUNCTION(SPACE, NAME, VOLUME)                                                \
  "_ZN3fcl6detail" SPACE "4" NAME "IdEEvPKN5Eigen6MatrixIT_Li3ELi1ELi0ELi3ELi1EEERNS_" VOLUME \
  "IS5_EE"
#define KIOS_FITN_FUNCTION(SPACE, VOLUME)                                                  \
  "_ZN3fcl6detail" SPACE "4fitnIdEEvPKN5Eigen6MatrixIT_Li3ELi1ELi0ELi3ELi1EEEiRNS_" VOLUME \
  "IS5_"                                                                                   \
  "EE"
#define KIOS_FITTER(VOLUME) \
  "_ZN3fcl6detail6FitterIdNS_" VOLUME "IdEEE3fitEPKN5Eigen6MatrixIdLi3ELi1ELi0ELi3ELi1EEEiRS3_"

// A geometry's end: the destructor of models calls it. Another model may be copied to its place,
// without a fit.
#define KIOS_END_OF_GEOMETRY "_ZN3fcl17CollisionGeometryIdED2Ev"
