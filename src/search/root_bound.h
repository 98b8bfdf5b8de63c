// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "search/float_frame.h"
#include "volume/rounding.h"

namespace kios::engine {

/// Lower bound of the distance of two models by the boxes of their roots; not positive where that
/// proves nothing. It tells most near pairs of CAD parts apart before anything is built for a
/// search. Any bound above `required` may be given in place of the best.
double rootBound(const TreeRoot& a, const TreeRoot& b, const TreePose& X_AB,
                 double required = kInfinity);

}  // namespace kios::engine
