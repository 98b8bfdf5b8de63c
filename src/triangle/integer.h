// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

namespace kios {

/// v 2^1074, an integer for every finite double.
boost::multiprecision::cpp_int integer(double v);

}  // namespace kios
