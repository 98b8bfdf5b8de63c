// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "preload/calls.h"

namespace kios::preload {

/// What of an FCL isn't as in the libfcl.so.0.7 that this library was built for: nullptr if all is
/// that is looked at. A copy that a program brings along may have been built with other flags. Its
/// tables of virtual functions are compared by size; then its constructors make objects, which are
/// read, and compared with this library's own.
const char* differenceOf(const Calls& fcl);

}  // namespace kios::preload
