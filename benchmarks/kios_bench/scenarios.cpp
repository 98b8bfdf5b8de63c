// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenario.h"

namespace kios::bench {

const std::vector<Scenario>& scenarios() {
  static const std::vector<Scenario> all = {
      {"falling", "the k-IOS paper's falling tori, from the PQP data, in order and shuffled",
       runFalling, 240},
      {"spinning",
       "the k-IOS paper's spinning bunny and torus, from the PQP data, in order and shuffled",
       runSpinning, 240},
      {"generated", "the same kind of scenes, made by the program; tori that the roots tell apart",
       runGenerated, 100},
      {"threshold", "distances with a bound on entry, from far to touching, of falling tori",
       runThreshold, 60},
      {"strips", "two chains of cylinders made of 100 to 400 long thin strips", runStrips, 5},
      {"robots", "two arms side by side, all pairs of links: UR5 (data) and generated 7-link arms",
       runRobots, 10},
      {"world",
       "a UR5's links (data) and parts of machines about tables, shelves, rooms, terrain, a "
       "building, as meshes, shapes and octrees; hot and cold; world/SCENE for one of them",
       runWorld, 14},
      {"coal", "four of these worlds as meshes, with Coal's OBBRSS beside FCL's, where it is found",
       runCoal, 0},
      {"robot_scenes",
       "scene queries of two arms, UR5s (data) or humanoids, self-distance too: closest pair, "
       "pairs "
       "within 0.1, clearances; smooth and random motion",
       runRobotScenes, 0},
      {"scene", "5,000 drifting bodies; an arm's 1,000 configurations amid 5,000 obstacles",
       runScene, 20},
      {"crowds",
       "2,000 different small bodies in FCL's manager: made and asked about, and asked again",
       runCrowds, 1},
      {"paper",
       "the k-IOS paper's Table I and Figures 5 and 6 in its own units: published fit, tuned fit, "
       "engine, FCL's RSS",
       runPaper, 0},
      {"fits",
       "every construction of k-IOS, choice of k and angle, and spheres, boxes, RSS and k-DOPs "
       "over "
       "one tree and traversal",
       runFits, 0},
      {"packing",
       "tests of two k-IOS in SIMD: four sphere pairs at a time as the paper, eight nodes at a "
       "time",
       runPacking, 0},
      {"exact", "exact distance of two k-IOS beside its bound and FCL's RSS", runExact, 0},
      {"shapes", "a mesh of 20k triangles against seven of FCL's shapes", runShapes, 20},
      {"octrees", "the same mesh against an octree", runOctrees, 20},
      {"continuous", "first contact in time of two tori on random motions, and FCL's",
       runContinuous, 10},
      {"motions",
       "straight paths in joint space, UR5 (data) or a generated arm amid obstacles, and two arms: "
       "proven, and sampled 0.01 rad apart",
       runMotions, 20},
#ifdef KIOS_HAVE_ROBOT
      {"mbm",
       "MotionBenchMaker's problems (data) by RRT-Connect: edges proven, sampled, and by FCL's "
       "manager",
       runMbm, 0},
#endif
      {"scaling",
       "bumpy tori of 1k to 80k triangles (1M by --max-triangles): gap 0.1, 1e-3, touching; build, "
       "preparation and memory",
       runScaling, 8},
      {"build",
       "endModel, preparation, the same mesh again, memory, for every volume of FCL: "
       "tori of 1k to 80k triangles (1M by --max-triangles), welded and not, and the UR5 (data)",
       runBuild, 1},
      {"solids",
       "points in solids; penetration of boxes, balls, tori, a bunny in a torus, links in a table",
       runSolids, 0},
      {"refit", "tori that sway by a tenth of their size: rebuild, refits, and queries after each",
       runRefit, 10},
      {"rays",
       "first, any and all hits of camera rays, random rays and rays at edges, bumpy tori and "
       "strips; "
       "FCL has no rays",
       runRays, 1024},
#ifdef KIOS_HAVE_PRELOAD
      {"preload", "a program that knows FCL alone, with and without the preloaded library; DART",
       runPreload, 0},
#endif
      {"error",
       "run time against error: tolerances, budgets and thresholds over moving pairs, FCL's nodes "
       "with their error members set",
       runError, 20},
      {"stability", "triangle distance and intersection over hard classes of pairs, and FCL's",
       runStability, 0},
  };
  return all;
}

}  // namespace kios::bench
