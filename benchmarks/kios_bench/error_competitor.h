// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "scenes/mesh.h"
#include "scenes/motions.h"

namespace kios::bench {

/// How inexact a distance may be. At most one of them is set; all unset asks for the exact one.
struct ErrorSetting {
  /// kBracket: kios::distance; kDistance: fcl::distance or FCL's node.
  enum Query { kDistance, kBracket, kBudget, kThreshold };
  Query query = kDistance;
  double rel_err = 0, abs_err = 0;
  std::optional<long long> budget;  ///< expansions
  std::optional<double> threshold;  ///< by the exact distance of each frame
};

struct ErrorQuestion {
  scenes::Frame poses;
  double distance = 0;  ///< exact
};

/// A bracket of the distance; without a lower bound where the query gives none. For kThreshold the
/// upper end is 0 if the pair is nearer than the threshold, infinity if not.
struct ErrorAnswer {
  double lower = std::numeric_limits<double>::quiet_NaN();
  double upper = std::numeric_limits<double>::infinity();
};

/// One bounding volume with two meshes.
class ErrorCompetitor {
 public:
  virtual ~ErrorCompetitor() = default;
  virtual const char* name() const = 0;
  virtual bool serves(const ErrorSetting& setting) const = 0;
  virtual void load(const scenes::Mesh& a, const scenes::Mesh& b) = 0;
  /// Answers questions[begin, end) into answers[begin, end), each with a fresh request and result.
  virtual void answer(const ErrorSetting& setting, const std::vector<ErrorQuestion>& questions,
                      std::size_t begin, std::size_t end, std::vector<ErrorAnswer>& answers) = 0;
};

/// Ours.
std::unique_ptr<ErrorCompetitor> makeKiosErrorCompetitor();

/// FCL's OBBRSS and RSS by their traversal nodes, whose error members FCL's own queries leave at 0.
/// A node stops at a pair that meets both of its errors: the one not asked for is infinite.
std::unique_ptr<ErrorCompetitor> makeObbrssErrorCompetitor();
std::unique_ptr<ErrorCompetitor> makeRssErrorCompetitor();

}  // namespace kios::bench
