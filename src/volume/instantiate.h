// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A name between angle brackets can't stand in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)

/// Instantiates a function template, which must have no overloads, for both scalars.
#define KIOS_INSTANTIATE_FUNCTION(function)             \
  template decltype(function<double>) function<double>; \
  template decltype(function<float>) function<float>

// NOLINTEND(bugprone-macro-parentheses)
