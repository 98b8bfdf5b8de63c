// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include "batch.h"

// Answers of a batch, item by item, become arrays, one for each thing that is told of an item.

namespace kios::python {

template <typename T>
py::array_t<T> makeArray(std::size_t n) {
  return py::array_t<T>(static_cast<py::ssize_t>(n));
}
inline py::array_t<double> makeVectors(std::size_t n) {
  return py::array_t<double>({static_cast<py::ssize_t>(n), py::ssize_t{3}});
}

/// Answers by item, asked for as runBatch() says: ask(i) for each i < n.
template <typename Ask>
auto runEach(std::size_t n, const BatchOptions& options, const char* what, const Ask& ask) {
  using Answer = std::invoke_result_t<Ask, std::size_t>;
  // Threads can't write neighbours in a std::vector<bool>.
  std::vector<std::conditional_t<std::is_same_v<Answer, bool>, char, Answer>> answers(n);
  runBatch(n, options, what, [&](std::size_t i) { answers[i] = ask(i); });
  return answers;
}

/// What `of`, a member or a function, has of each item: an array of numbers (n,), with integers as
/// int64 and char as bool, or of vectors (n, 3), or a list of strings. That of the one item if it
/// is asked about alone.
template <typename Item, typename Of>
py::object column(const std::vector<Item>& items, bool single, const Of& of) {
  using T = std::decay_t<std::invoke_result_t<Of, const Item&>>;
  if constexpr (std::is_same_v<T, std::string>) {
    py::list list;
    if (single) return py::str(std::invoke(of, items[0]));
    for (const Item& item : items) list.append(std::invoke(of, item));
    return list;
  } else if constexpr (std::is_arithmetic_v<T>) {
    using Integer = std::conditional_t<std::is_same_v<T, char>, bool, std::int64_t>;
    using Number =
        std::conditional_t<std::is_integral_v<T> && !std::is_same_v<T, bool>, Integer, T>;
    if (single) return py::cast(static_cast<Number>(std::invoke(of, items[0])));
    auto array = makeArray<Number>(items.size());
    Number* to = array.mutable_data();
    for (const Item& item : items) *to++ = static_cast<Number>(std::invoke(of, item));
    return array;
  } else {
    auto array = single ? makeArray<double>(3) : makeVectors(items.size());
    double* to = array.mutable_data();
    for (const Item& item : items) {
      const auto& v = std::invoke(of, item);
      for (int c = 0; c < 3; ++c) *to++ = v[c];
    }
    return array;
  }
}
template <typename Item>
py::object column(const std::vector<Item>& items, bool single) {
  return column(items, single, [](const Item& item) { return item; });
}
template <typename Item, typename... Of>
py::tuple columns(const std::vector<Item>& items, bool single, const Of&... of) {
  return py::make_tuple(column(items, single, of)...);
}

/// Items of lists, each with its list's number.
template <typename T>
auto flatten(const std::vector<std::vector<T>>& lists) {
  std::vector<std::pair<std::size_t, T>> items;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    for (const T& item : lists[i]) items.emplace_back(i, item);
  }
  return items;
}

}  // namespace kios::python
