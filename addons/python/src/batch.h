// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

#include <pybind11/pybind11.h>

namespace kios::python {

namespace py = pybind11;

/// The options that all batches share.
struct BatchOptions {
  py::object threads;   ///< how many at most; None: all cores that the process may use
  py::object progress;  ///< called with how many items were done since the last call; or None
};

/// The number that Python gave, or that of the cores for None. Throws std::invalid_argument unless
/// it is an int of at least 1.
int threadsOf(const py::object& threads);

/// Calls work(i) once for each i < n, in many threads and without the GIL, which the caller holds.
/// Signals are looked at, and progress is told, every 20 ms, between two items of the calling
/// thread; what they raise ends the batch. What work() throws ends it, too: of several the one with
/// the least i, which `what` [i] names where it is std::invalid_argument. Threads are started only
/// for batches that take longer than that costs; none is left when this returns.
void runBatch(std::size_t n, const BatchOptions& options, const char* what,
              const std::function<void(std::size_t i)>& work);

}  // namespace kios::python

/// From Python they come as a tuple.
template <>
struct pybind11::detail::type_caster<kios::python::BatchOptions> {
  PYBIND11_TYPE_CASTER(kios::python::BatchOptions, const_name("tuple"));
  bool load(handle source, bool /*convert*/) {
    if (!PyTuple_Check(source.ptr()) || PyTuple_GET_SIZE(source.ptr()) != 2) return false;
    const auto options = reinterpret_borrow<tuple>(source);
    value = {options[0], options[1]};
    return true;
  }
};
