// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace kios {

/// The threads that a request asks for; 0 asks for one a core. Throws std::invalid_argument if it
/// is negative.
std::size_t threadsFor(int asked);

/// Calls work(i) once for each i < count, in this thread and others. Of what it throws, that of the
/// least i is thrown again, once all others have ended.
void inThreads(std::size_t count, std::size_t threads,
               const std::function<void(std::size_t)>& work);

}  // namespace kios
