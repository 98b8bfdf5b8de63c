// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "robot_impl.h"

namespace kios {
std::vector<LinkPair> Robot::linkPairs(const PairOptions&) const { return {}; }
}  // namespace kios
