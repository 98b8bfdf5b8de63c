// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenario.h"

namespace kios::bench {

const std::vector<Scenario>& scenarios() {
  static const std::vector<Scenario> all = {
      {"falling", "the k-IOS paper's falling tori, from the PQP data", runFalling},
      {"spinning", "the k-IOS paper's spinning bunny and torus, from the PQP data", runSpinning},
      {"generated", "the same kind of scenes, made by the program", runGenerated},
      {"scaling", "bumpy tori of 1k to 80k triangles: gap 0.1, 1e-3, touching; build and memory",
       runScaling},
      {"stability", "triangle distance and intersection over hard classes of pairs, and FCL's",
       runStability},
  };
  return all;
}

}  // namespace kios::bench
