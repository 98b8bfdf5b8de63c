// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace kios {

/// Returns memory for an array that the caller fills at once; `delete[]` frees it where its items
/// have no destructor.
void* memoryToFill(std::size_t bytes);

}  // namespace kios
