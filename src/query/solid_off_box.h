// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/kios_model.h"
#include "query/posed_solid.h"

namespace kios {

/// True only if a bounded solid and the content of a prepared model are apart along an axis of the
/// solid's frame or of the box of the model's root: most bodies near a box, or a hair above it,
/// need no search then. False says nothing; nothing is prepared.
template <typename S>
bool solidOffBox(const Model<S>& model, const PosedSolid<S>& posed);

}  // namespace kios
