// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/mesh_fuzz/questions.h"

namespace kios::fuzz {

const std::vector<Question>& questions() {
  // name, weight, meshes, frames, least of both, in float too
  static const std::vector<Question> all = {{"distance", 4, 2, 1, 2, 1, true, askDistance},
                                            {"bracket", 4, 2, 1, 2, 1, true, askBracket},
                                            {"closer", 2, 2, 1, 2, 1, true, askCloser},
                                            {"contacts", 2, 2, 1, 2, 1, true, askContacts},
                                            {"kernel", 1, 2, 1, 2, 1, true, askKernel},
                                            {"ray", 2, 1, 1, 1, 1, true, askRay},
                                            {"scene", 2, 4, 4, 2, 1, true, askScene},
                                            {"refit", 2, 2, 1, 2, 1, true, askRefit},
                                            {"shape", 1, 1, 1, 1, 1, false, askShape},
                                            {"continuous", 0.3, 2, 2, 2, 2, false, askContinuous},
                                            {"linkage", 0.5, 3, 1, 2, 1, false, askLinkage},
                                            {"manager", 0.5, 4, 3, 2, 1, false, askManager},
                                            {"changing", 1, 3, 4, 3, 1, false, askChanging}};
  return all;
}

}  // namespace kios::fuzz
