// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "query/mesh_pair.h"

namespace kios {

/// True only if a plane between the vertices of two models proves their triangles, as placed in the
/// common frame, more than `margin` >= 0 apart; false says nothing. Planes are tried in a few
/// directions, and only for models of few vertices, whose trees and preparation would take longer.
template <typename S>
bool verticesApart(const MeshPair<S>& frame, double margin);

}  // namespace kios
