// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "volume_tree.h"

namespace kios::inspect {

using Color = std::array<std::uint8_t, 3>;  ///< sRGB

/// Gives one colour a node: hues go around the circle once, in the order of the content, so that a
/// volume's parts have colours like its own; neighbours differ in lightness. `place`: which of its
/// level's volumes it is.
Color colorOf(const VolumeTree& tree, int node, std::size_t place);

/// Returns the colour of the first and the second mesh.
Color meshColor(int which);

}  // namespace kios::inspect
