// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "scenario.h"

namespace kios::bench {

const std::vector<Scenario>& scenarios() {
  static const std::vector<Scenario> all = {
      {"tori", "falling spinning generated scaling",
       "the k-IOS paper's moving pairs (data), the same kind made by the program, and bumpy tori "
       "of "
       "1k to 80k triangles: gap 0.1, 1e-3, touching",
       runTori, 100},
      {"robots", "ur5 generated parts scenes",
       "two arms side by side, all pairs of links: UR5 (data), generated, machine parts; "
       "scene queries of them and of humanoids",
       runRobots, 10},
      {"world", "SCENE coal",
       "a UR5's links (data) and parts of machines about tables, shelves, rooms, terrain, a "
       "building, as meshes, shapes and octrees; hot and cold; Coal's OBBRSS beside, if named",
       runWorld, 14},
      {"scene", "bodies crowds",
       "5,000 drifting bodies; an arm's 1,000 configurations amid 5,000 obstacles; 2,000 different "
       "small bodies in FCL's manager: made and asked about, and asked again",
       runScene, 20},
      {"shapes", "", "a mesh of 20k triangles against eight shapes and an octree", runShapes, 20},
      {"rays", "",
       "first, any and all hits of camera rays, random rays and rays at edges, bumpy tori and "
       "strips; FCL has no rays",
       runRays, 1024},
      {"solids", "contains penetration depth points",
       "points in solids; penetration and local depth of boxes, balls, a blob in a torus, links in "
       "a table; 100,000 nearest points and signed distances, beside balls of radius 0; winding "
       "numbers",
       runSolids, 0},
      {"clashes", "1000 10000 pieces",
       "clashes, touches and duplicates planted in a building of some 1,000 and 10,000 slabs, "
       "columns, "
       "walls and pipes; its contacts by FCL's manager; time against the width of depths",
       runClashes, 1},
      {"motions", "paths range moved continuous",
       "straight paths in joint space, UR5 (data) or a generated arm amid obstacles, and two arms: "
       "proven, and sampled 0.01 rad apart; the least clearance over ranges; contact amid spheres "
       "of which one moves; first contact in time "
       "of two tori on random motions",
       runMotions, 20},
#ifdef KIOS_HAVE_ROBOT
      {"mbm", "panda ur5",
       "MotionBenchMaker's problems (data) by RRT-Connect: edges proven, sampled, and by FCL's "
       "manager",
       runMbm, 0},
#endif
      {"build", "models refit",
       "endModel, the same mesh again, memory: tori of 1k to 80k triangles, and "
       "the UR5 (data); refits of tori that sway",
       runBuild, 8},
      {"error", "",
       "run time against error: tolerances, budgets and thresholds over moving pairs, FCL's nodes "
       "with their error members set",
       runError, 20},
      {"paper", "", "the k-IOS paper's constructions and volumes of others over one tree", runPaper,
       0},
      {"stability", "triangles queries",
       "triangle distance and intersection over hard classes of pairs, and FCL's; points, local "
       "depths and clashes over hard classes of solids",
       runStability, 0},
#ifdef KIOS_HAVE_PRELOAD
      {"preload", "",
       "a program that knows FCL alone, with and without the preloaded library; DART", runPreload,
       0},
#endif
  };
  return all;
}

}  // namespace kios::bench
