// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <memory>
#include <string>
#include <vector>

#include <fcl/math/bv/OBBRSS.h>
#include <fcl/math/motion/interp_motion.h>
#include <fcl/math/motion/screw_motion.h>
#include <fcl/math/motion/spline_motion.h>
#include <fcl/math/motion/translation_motion.h>

#include "calls.h"
#include "continuous_way.h"
#include "library.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/oracle.h"
#include "scenes/random.h"
#include "scenes/shapes.h"

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
  const auto far = [&] { return random.inCube(-1.2 * kRadii, 1.2 * kRadii); };
  const auto turn = [&] { return random.inCube(-9, 9); };
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

/// FCL's over OBBRSS: 1000 samples, which may miss what is between them, and its conservative
/// advancement, which can't serve splines.
Way obbrssWay(const scenes::Mesh& mesh_a, const scenes::Mesh& mesh_b, fcl::CCDSolverType solver) {
  constexpr double kTimeError = 1e-3;
  const auto a = scenes::buildModel<fcl::OBBRSSd>(mesh_a),
             b = scenes::buildModel<fcl::OBBRSSd>(mesh_b);
  const bool sampling = solver == fcl::CCDC_NAIVE;
  return {sampling ? "fcl_obbrss_sampling" : "fcl_obbrss_advancement", kTimeError, sampling,
          [a, b, solver](const Motions& motions, Tests* /*work*/) {
            const fcl::ContinuousCollisionRequestd request(1000, kTimeError, fcl::CCDM_TRANS,
                                                           fcl::GST_LIBCCD, solver);
            fcl::ContinuousCollisionResultd result;
            FclCalls::continuousCollide(a.get(), motions.a.get(), b.get(), motions.b.get(), request,
                                        result);
            return result;
          }};
}

}  // namespace

void reportContinuous(const Options& options, Report& report) {
  const int queries = options.frames > 0 ? options.frames : (options.quick ? 6 : 40);
  const int samples = options.quick ? 50 : 200;
  const int size = options.quick ? 400 : 2000;
  const scenes::Mesh a = scenes::bumpyTorus(size), b = scenes::bumpyTorus(size / 2);
  const scenes::MeshOracle oracle(a, b);
  std::vector<Way> ways = {obbrssWay(a, b, fcl::CCDC_NAIVE),
                           obbrssWay(a, b, fcl::CCDC_CONSERVATIVE_ADVANCEMENT)};
  for (const std::string& name : compared({kOurs})) {
    ways.insert(ways.begin(), libraryOf(name).continuous(name, a, b));
  }

  for (const auto& [type, motion_name] : kMotions) {
    scenes::Random random(options.seed);
    std::vector<Motions> motions;
    std::vector<double> first;
    for (int i = 0; i < queries; ++i) {
      motions.push_back({randomMotion(type, random), randomMotion(type, random)});
      first.push_back(firstSample(oracle, motions.back(), samples));
    }
    std::vector<const Way*> served;
    std::vector<Competitor> competitors;
    for (const Way& way : ways) {
      if (type == fcl::CCDM_SPLINE && !way.splines) continue;
      served.push_back(&way);
      competitors.push_back(
          {way.name, each([&](std::size_t i) { way.answer(motions[i], nullptr); })});
      competitors.back().rounds = roundsOf(way.name);
    }
    Race{motions.size(), options.repeats}.run(competitors);
    const Row base =
        baseRow(std::string("continuous/") + motion_name, "continuous", motions.size(), {a, b});
    std::vector<Row> rows;
    for (std::size_t w = 0; w < served.size(); ++w) {
      const Way& way = *served[w];
      Row row = base.of(competitors[w]);
      row.asked.abs_err = way.time_error;  // of the time
      row.errors.wrong = 0;
      Tests work;
      for (std::size_t i = 0; i < motions.size(); ++i) {
        const auto result = way.answer(motions[i], &work);
        if (isWrong(result, oracle, motions[i], first[i], way.time_error)) ++*row.errors.wrong;
      }
      if (work.bvs) row.tests = {*work.bvs / queries, *work.leaves / queries};
      rows.push_back(row);
    }
    report.add(rows);
  }
}

}  // namespace kios::bench
