// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// Included once a target: what searches of two trees share, in this order.
#include "search/simd/node_test-inl.h"
//
#include "search/simd/box_test-inl.h"
//
#include "search/simd/frontier-inl.h"
//
#include "search/simd/leaf_cull-inl.h"
//
#include "search/simd/leaf_pair-inl.h"
//
#include "search/simd/triangle_leaf-inl.h"
//
#include "search/simd/triangle_bounds-inl.h"
//
#include "search/simd/expansion-inl.h"
//
#include "search/simd/traverse-inl.h"
//
#include "search/simd/descent-inl.h"
//
#include "search/simd/leaf_distance-inl.h"
//
#include "search/simd/leaf_bracket-inl.h"
