// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/mesh_fuzz/questions.h"

namespace kios::fuzz {

const std::vector<Question>& questions() {
  // name, weight, meshes, frames, least of both, in float too, seconds. These are what the
  // queries of a case and their judge take where all features of two meshes lie within rounding of
  // each other, so that each is brute force; firstContact() takes 20000 such steps at most.
  static const std::vector<Question> all = {
      {"distance", 4, 2, 1, 2, 1, true, 1, askDistance},
      {"bracket", 4, 2, 1, 2, 1, true, 2, askBracket},
      {"closer", 2, 2, 1, 2, 1, true, 2, askCloser},
      {"contacts", 2, 2, 1, 2, 1, true, 1, askContacts},
      {"kernel", 1, 2, 1, 2, 1, true, 1, askKernel},
      {"ray", 2, 1, 1, 1, 1, true, 1, askRay},
      {"point", 1, 1, 1, 1, 1, true, 1, askPoint},
      {"scene", 2, 4, 4, 2, 1, true, 3, askScene},
      {"refit", 2, 2, 1, 2, 1, true, 2, askRefit},
      {"shape", 1, 1, 1, 1, 1, false, 1, askShape},
      {"continuous", 0.3, 2, 2, 2, 2, false, 6, askContinuous},
      {"linkage", 0.5, 3, 1, 2, 1, false, 1, askLinkage},
      {"depth", 0.5, 2, 1, 2, 1, false, 4, askDepth},
      {"clashes", 0.5, 3, 1, 2, 1, false, 12, askClashes},
      {"manager", 0.5, 4, 3, 2, 1, false, 3, askManager},
      {"changing", 1, 3, 4, 3, 1, false, 3, askChanging}};
  return all;
}

}  // namespace kios::fuzz
