// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A world of spheres about an arm, of which one moves before each question: moved in the linkage,
// or all added to a new one.
#include <algorithm>
#include <memory>
#include <vector>

#include <fcl/geometry/shape/sphere.h>

#include "fcl_kios/linkage.h"
#include "fcl_kios/model.h"
#include "motion_set.h"
#include "scenario.h"
#include "scenes/arms.h"

namespace kios::bench {

void reportMoved(const Options& options, Report& report) {
  const std::size_t spheres = options.quick ? 50 : 2000;
  const std::size_t asked = options.frames > 0 ? static_cast<std::size_t>(options.frames) : 400;
  const std::size_t questions = std::min(asked, options.quick ? std::size_t{10} : spheres);
  const auto ur5 = findUr5(options);
  const scenes::Cell cell = scenes::workCell(ur5 ? *ur5 : scenes::cadArm(), 8, 1, options.seed);
  scenes::Random random(options.seed);
  const auto ball = std::make_shared<fcl::Sphered>(0.02);
  const auto place = [&] {
    return fcl::Transform3d(Eigen::Translation3d(random.inCube(-1.5, 1.5)));
  };
  std::vector<fcl::Transform3d> first, later;
  std::vector<Eigen::VectorXd> q;
  for (std::size_t i = 0; i < spheres; ++i) first.push_back(place());
  for (std::size_t i = 0; i < questions; ++i) {
    later.push_back(place());
    q.push_back(vectorOf(scenes::randomJoints(cell, random)));
  }

  const Linkage bare = linkageOf(cell);
  const auto addSpheres = [&](Linkage& to, std::size_t moved) {
    for (std::size_t i = 0; i < spheres; ++i) to.addBody(-1, ball, i < moved ? later[i] : first[i]);
  };
  const auto touches = [&](const Linkage& linkage, std::size_t i) {
    return checkMotion(linkage, q[i], q[i]).verdict == MotionVerdict::kContact;
  };
  Linkage moved = bare;
  addSpheres(moved, 0);
  const auto move = [&](std::size_t i, const fcl::Transform3d& X) {
    moved.moveBody(cell.bodies() + static_cast<int>(i), X);
  };
  const auto reset = [&](std::size_t begin, std::size_t) {
    for (std::size_t i = 0; begin == 0 && i < questions; ++i) move(i, first[i]);
  };
  std::vector<int> contact(questions), anew(questions, -1);  // -1: it wasn't asked
  std::vector<Competitor> alone = {
      {"kios", each([&](std::size_t i) { move(i, later[i]); }), reset}};
  std::vector<Competitor> competitors = {{"kios", each([&](std::size_t i) {
                                            move(i, later[i]);
                                            contact[i] = touches(moved, i);
                                          }),
                                          reset},
                                         {"kios_anew", each([&](std::size_t i) {
                                            Linkage linkage = bare;
                                            addSpheres(linkage, i + 1);
                                            anew[i] = touches(linkage, i);
                                          })}};
  Race{questions, options.repeats, Race::kAll, Race::kAll, true}.run(alone);
  const std::size_t stride = competitors[1].stride = options.quick ? 2 : 20;
  Race{questions, options.repeats, Race::kAll, 1, true}.run(competitors);
  Row base = baseRow("motions/moved", "move", questions);
  std::vector<Row> rows = {base.of(alone[0]), base.of(competitors[0])};
  base.frames = (questions - 1) / stride + 1;
  rows.push_back(base.of(competitors[1]));
  rows[1].query = rows[2].query = "moved";
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < questions; ++i) wrong += anew[i] >= 0 && contact[i] != anew[i];
  rows[1].errors.wrong = wrong;
  for (Row& row : rows) row.bodies = spheres;
  report.add(rows);
}
}  // namespace kios::bench
