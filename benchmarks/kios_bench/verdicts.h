// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <functional>
#include <vector>

#include "mesh_set.h"
#include "scenes/oracle.h"

namespace kios::bench {

/// The oracle's answers to some of the questions.
struct Verdicts {
  std::vector<std::size_t> questions;
  std::vector<double> answers;  // exact distance, or the number of contacts
};

/// Holds the true answer of a question: the distance, also where a threshold is asked about, or the
/// number of contacts, at most 1 for kCollide.
using TruthOf = std::function<double(Query query, const Question& question)>;

/// Returns the truth of two meshes.
double truth(const scenes::MeshOracle& oracle, Query query, const Question& question);

/// Judges `wanted` of the questions, spread evenly with a step that varies, so that it
/// falls on every pair of meshes where each frame asks the same pairs in turn; all of them for 0.
Verdicts judge(const TruthOf& truth, Query query, const std::vector<Question>& questions,
               int wanted);

/// Errors and wrong verdicts of the answers. For kCloserThan no verdict is wrong where distance and
/// threshold, unless it is 0, agree within 16 eps of the scale that `extent` and they set.
Errors compare(const std::vector<double>& answers, const Verdicts& verdicts, Query query,
               const std::vector<Question>& questions, double extent);

}  // namespace kios::bench
