// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solid/solid_pair.h"

namespace kios {

/// True if the plane of a triangle that meets another has all of a on one side and all of b, as
/// posed in a's frame, on the other, in exact arithmetic: the solids touch, but their interiors are
/// disjoint. Looked for only if a translation of `length`, which parts them, is one of rounding.
template <typename S>
bool partedByFace(SolidPair<S>& pair, double length);

}  // namespace kios
