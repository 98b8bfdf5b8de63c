// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenario.h"

namespace kios::bench {

const std::vector<Scenario>& scenarios() {
  static const std::vector<Scenario> all = {
      {"falling", "the k-IOS paper's falling tori, from the PQP data", runFalling},
      {"spinning", "the k-IOS paper's spinning bunny and torus, from the PQP data", runSpinning},
      {"falling_shuffled", "distances of 'falling' in a random order of its frames",
       runFallingShuffled},
      {"spinning_shuffled", "the same of 'spinning'", runSpinningShuffled},
      {"generated", "the same kind of scenes, made by the program", runGenerated},
      {"soup", "the generated falling tori, their triangles shrunk apart", runSoup},
      {"threshold", "distances with a bound on entry, from far to touching, of falling tori",
       runThreshold},
      {"rootreject", "pairs that the roots decide: collide, and distance with a bound on entry",
       runRootReject},
      {"strips", "two chains of cylinders made of 100 to 400 long thin strips", runStrips},
      {"robots", "two arms side by side, all pairs of links: UR5 (data) and generated 7-link arms",
       runRobots},
      {"robot_scenes",
       "scene queries of two arms, UR5s (data) or humanoids, self-distance too: closest pair, "
       "pairs "
       "within 0.1, clearances; smooth and random motion",
       runRobotScenes},
      {"scene", "5,000 drifting bodies; an arm's 1,000 configurations amid 5,000 obstacles",
       runScene},
      {"paper",
       "the k-IOS paper's Table I and Figures 5 and 6 in its own units: published fit, tuned fit, "
       "engine, FCL's RSS",
       runPaper},
      {"fits",
       "every construction of k-IOS, choice of k and angle, and spheres, boxes, RSS and k-DOPs "
       "over "
       "one tree and traversal",
       runFits},
      {"packing",
       "tests of two k-IOS in SIMD: four sphere pairs at a time as the paper, eight nodes at a "
       "time",
       runPacking},
      {"exact", "exact distance of two k-IOS beside its bound and FCL's RSS", runExact},
      {"shapes", "a mesh of 20k triangles against seven of FCL's shapes", runShapes},
      {"octrees", "the same mesh against an octree", runOctrees},
      {"continuous", "first contact in time of two tori on random motions, and FCL's",
       runContinuous},
      {"motions",
       "straight paths in joint space, UR5 (data) or a generated arm amid obstacles, and two arms: "
       "proven, and sampled 0.01 rad apart",
       runMotions},
      {"scaling",
       "bumpy tori of 1k to 80k triangles (1M by --max-triangles): gap 0.1, 1e-3, touching; build, "
       "preparation and memory",
       runScaling},
      {"build",
       "endModel, preparation, first query, the same mesh again, memory, for every volume of FCL: "
       "tori of 1k to 80k triangles (1M by --max-triangles), welded and not, and the UR5 (data)",
       runBuild},
      {"solids",
       "points in solids; penetration of boxes, balls, tori, a bunny in a torus, links in a table",
       runSolids},
      {"refit", "tori that sway by a tenth of their size: rebuild, refits, and queries after each",
       runRefit},
      {"rays",
       "first, any and all hits of camera rays, random rays and rays at edges, bumpy tori and "
       "strips; "
       "FCL has no rays",
       runRays},
#ifdef KIOS_HAVE_PRELOAD
      {"preload", "a program that knows FCL alone, with and without the preloaded library; DART",
       runPreload},
#endif
      {"error",
       "run time against error: tolerances, budgets and thresholds over moving pairs, FCL's nodes "
       "with their error members set",
       runError},
      {"stability", "triangle distance and intersection over hard classes of pairs, and FCL's",
       runStability},
  };
  return all;
}

}  // namespace kios::bench
