// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fcl/math/motion/interp_motion.h>
#include <fcl/math/motion/screw_motion.h>
#include <fcl/math/motion/spline_motion.h>
#include <fcl/math/motion/translation_motion.h>

#include "continuous_competitor.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/oracle.h"
#include "scenes/random.h"
#include "scenes/shapes.h"
#include "timing.h"

namespace kios::bench {
namespace {

constexpr struct {
  fcl::CCDMotionType type;
  const char* name;
} kMotions[] = {{fcl::CCDM_TRANS, "translation"},
                {fcl::CCDM_LINEAR, "linear"},
                {fcl::CCDM_SCREW, "screw"},
                {fcl::CCDM_SPLINE, "spline"}};

constexpr double kRadii = 2.5 * 1.46;  // of the tori

/// A motion within 2.5 radii; a spline turns by about a full turn. FCL's constructors from two
/// poses leave members of linear motions and splines unset.
std::shared_ptr<fcl::MotionBased> randomMotion(fcl::CCDMotionType type, scenes::Random& random) {
  const auto pose = scenes::randomPoses(2, kRadii, static_cast<std::uint64_t>(1e9 * random.unit()));
  const auto point = [&random](double far) {
    return fcl::Vector3d(random.uniform(-far, far), random.uniform(-far, far),
                         random.uniform(-far, far));
  };
  switch (type) {
    case fcl::CCDM_TRANS:
      return std::make_shared<fcl::TranslationMotiond>(pose[0], pose[1]);
    case fcl::CCDM_LINEAR:
      return std::make_shared<fcl::InterpMotion<double>>(pose[0].linear(), pose[0].translation(),
                                                         pose[1].linear(), pose[1].translation(),
                                                         fcl::Vector3d::Zero());
    case fcl::CCDM_SCREW:
      return std::make_shared<fcl::ScrewMotion<double>>(pose[0], pose[1]);
    case fcl::CCDM_SPLINE:
      break;
  }
  const auto far = [&] { return point(1.2 * kRadii); };
  const auto turn = [&] { return point(9); };
  return std::make_shared<fcl::SplineMotion<double>>(far(), far(), far(), far(), turn(), turn(),
                                                     turn(), turn());
}

scenes::Frame posesAt(const Motions& motions, double t) {
  scenes::Frame frame;
  motions.a->integrate(t);
  motions.a->getCurrentTransform(frame.X_WA);
  motions.b->integrate(t);
  motions.b->getCurrentTransform(frame.X_WB);
  return frame;
}

/// Time of the first of `samples` + 1 poses that collide; above 1 if none does.
double firstSample(const scenes::MeshOracle& oracle, const Motions& motions, int samples) {
  for (int i = 0; i <= samples; ++i) {
    const double t = static_cast<double>(i) / samples;
    const scenes::Frame frame = posesAt(motions, t);
    if (oracle.collide(frame.X_WA, frame.X_WB)) return t;
  }
  return 2;
}

/// Wrong: a contact missed, or reported after a sample that collides by more than the allowed
/// error, or at a time when the meshes are farther apart than they can come in that.
bool isWrong(const fcl::ContinuousCollisionResultd& result, const scenes::MeshOracle& oracle,
             const Motions& motions, double first, double time_error) {
  constexpr double kFastest = 60;  // lengths a unit of time
  if (!result.is_collide) return first <= 1;
  if (result.time_of_contact > first + time_error) return true;
  const scenes::Frame frame = posesAt(motions, result.time_of_contact);
  return oracle.distance(frame.X_WA, frame.X_WB) > kFastest * time_error;
}

}  // namespace

void runContinuous(const Options& options, Report& report) {
  const int queries = options.frames > 0 ? options.frames : (options.quick ? 6 : 40);
  const int samples = options.quick ? 50 : 200;
  const int size = options.quick ? 400 : 2000;
  const scenes::Mesh a = scenes::bumpyTorus(size), b = scenes::bumpyTorus(size / 2);
  const scenes::MeshOracle oracle(a, b);
  std::vector<std::unique_ptr<ContinuousCompetitor>> competitors;
  competitors.push_back(makeKiosContinuous());
  competitors.push_back(makeObbrssSampling());
  competitors.push_back(makeObbrssAdvancement());
  for (const auto& competitor : competitors) competitor->load(a, b);

  for (const auto& [type, motion_name] : kMotions) {
    scenes::Random random(options.seed);
    std::vector<Motions> motions;
    std::vector<double> first;
    for (int i = 0; i < queries; ++i) {
      motions.push_back({randomMotion(type, random), randomMotion(type, random)});
      first.push_back(firstSample(oracle, motions.back(), samples));
    }
    std::map<std::string, std::vector<double>> times;
    for (int repeat = 0; repeat < options.repeats; ++repeat) {
      for (const auto& competitor : competitors) {
        if (!competitor->serves(type)) continue;
        const double start = nowMicroseconds();
        for (const Motions& pair : motions) competitor->answer(pair);
        times[competitor->name()].push_back((nowMicroseconds() - start) / queries);
      }
    }
    std::vector<Row> rows;
    for (const auto& competitor : competitors) {
      if (!competitor->serves(type)) continue;
      Row row;
      row.wrong_verdicts = 0;
      TestCounts counts;
      for (std::size_t i = 0; i < motions.size(); ++i) {
        const auto result = competitor->answer(motions[i]);
        if (isWrong(result, oracle, motions[i], first[i], competitor->timeError())) {
          ++*row.wrong_verdicts;
        }
        const TestCounts of = competitor->count(motions[i]);
        counts.bv_tests += of.bv_tests;
        counts.leaf_tests += of.leaf_tests;
      }
      const std::vector<double>& repeat_us = times.at(competitor->name());
      row.scenario = std::string("continuous/") + motion_name;
      row.query = "continuous";
      row.bv = competitor->name();
      row.triangles = a.triangles.size() + b.triangles.size();
      row.frames = motions.size();
      row.abs_err = competitor->timeError();  // of the time
      row.median_us = median(repeat_us);
      row.min_us = *std::min_element(repeat_us.begin(), repeat_us.end());
      if (counts.bv_tests > 0) {
        row.bv_tests = static_cast<double>(counts.bv_tests) / queries;
        row.leaf_tests = static_cast<double>(counts.leaf_tests) / queries;
      }
      row.seed = options.seed;
      rows.push_back(row);
    }
    report.add(rows);
  }
}

}  // namespace kios::bench
