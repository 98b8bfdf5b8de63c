// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "mesh.h"

namespace kios::scenes {

/// Returns a place with four posts on z = 0, 0.2 x 0.2 x 1, at x and y = +-`at`: nothing small that
/// stands between them is above all of it.
Mesh withPosts(const Mesh& place, double at);

}  // namespace kios::scenes
