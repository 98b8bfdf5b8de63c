// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace kios {

/// A number that no other call in this process returned; never 0.
std::uint64_t nextStamp();

}  // namespace kios
