// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Points, local depths and clashes over hard classes of solids, judged by integers and long doubles
// over all triangles and by dense samples.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fcl_kios/fcl_kios.h"
#include "scenario.h"
#include "scenes/cad_shapes.h"
#include "scenes/depth_oracle.h"
#include "scenes/oracle.h"
#include "scenes/placement.h"
#include "scenes/rational_oracle.h"
#include "scenes/shapes.h"
#include "scenes/triangle_families.h"

namespace kios::bench {
namespace {

using scenes::DepthOracle;
using scenes::Mesh;
using scenes::Random;
using Vec = fcl::Vector3d;

/// Two solids of extent about 1, and how b lies in a's frame.
struct StressClass {
  const char* name;
  Mesh a, b;
  fcl::Transform3d (*X_AB)(Random& random);
  double scale = 1;          ///< of all lengths
  Vec offset = Vec::Zero();  ///< of the vertices of both
  double world = 0;          ///< how far both are from the origin
};

fcl::Transform3d anywhere(Random& random) {
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.linear() = scenes::rotation(random);
  X.translation() = 0.8 * scenes::point(random);
  return X;
}
fcl::Transform3d same(Random&) { return fcl::Transform3d::Identity(); }
/// Next to nothing.
fcl::Transform3d near(Random& random) {
  return fcl::Transform3d(Eigen::Translation3d(scenes::displacement(random, -45, -10)));
}
/// Faces of cubes of side 1 that are flush but for rounding up to 1e-3, with an overhang.
fcl::Transform3d flush(Random& random) {
  const double gap = scenes::randomSign(random) * scenes::logUniform(random, -40, -10);
  return scenes::shift(random.uniform(-0.8, 0.8), 0.3, 1 + gap);
}
/// Faces, edges and corners coincide.
fcl::Transform3d onLattice(Random& random) {
  const auto half = [&] { return 0.5 * scenes::integer(random, -2, 2); };
  const double x = half(), y = half();
  return scenes::shift(x, y, half());
}
/// A rotation of six digits.
fcl::Transform3d toSixDigits(Random& random) {
  fcl::Transform3d X = anywhere(random);
  for (double& v : X.matrix().reshaped()) v = std::round(1e6 * v) / 1e6;
  return X;
}

Mesh stretched(Mesh mesh, const Vec& by, const Vec& to = Vec::Zero()) {
  for (Vec& p : mesh.vertices) p = p.cwiseProduct(by) + to;
  return mesh;
}
Mesh flipped(Mesh mesh) {
  for (fcl::Triangle& t : mesh.triangles) t.set(t[0], t[2], t[1]);
  return mesh;
}
/// With triangles of no area between two that share an edge no more, and points.
Mesh withDegenerates(Mesh mesh) {
  const fcl::Triangle t = mesh.triangles[0];
  const std::size_t middle = mesh.vertices.size();
  mesh.vertices.emplace_back(0.5 * (mesh.vertices[t[0]] + mesh.vertices[t[1]]));
  mesh.vertices.emplace_back(Vec::Zero());
  mesh.triangles[0] = {middle, t[1], t[2]};
  mesh.triangles.emplace_back(t[0], middle, t[2]);
  mesh.triangles.emplace_back(t[0], t[1], middle);
  mesh.triangles.emplace_back(middle + 1, middle + 1, middle + 1);
  return mesh;
}

std::vector<StressClass> stressClasses() {
  using namespace scenes;
  const Mesh torus = bumpyTorus(200), ball = icosphere(0.8, 1), cube = subdividedBox({1, 1, 1}, 2);
  const Mesh shell = merged({icosphere(1, 1), flipped(icosphere(0.9, 1)), icosphere(0.3, 1)});
  const Mesh crossing = merged({subdividedBox({1, 2, 2}, 1), subdividedBox({2, 1, 1}, 1)});
  const Vec far(1e9, -1e9, 5e8);
  return {{"ordinary", torus, ball, anywhere},
          {"1e-60 large", torus, ball, anywhere, 0x1p-200},
          {"1e60 large", torus, ball, anywhere, 0x1p200},
          {"vertices at 1e9", torus, ball, anywhere, 1, far},
          {"poses at 1e9", torus, ball, anywhere, 1, Vec::Zero(), 1e9},
          {"rotations to 6 digits", torus, ball, toSixDigits},
          {"size ratio 1e-6", cube, stretched(ball, Vec::Constant(1e-6), {0.5, 0.2, 0.1}), near},
          {"slivers", uvSphere(0.8, 6, 40), stripCylinder(12, 1.5, 0.02), anywhere},
          {"1e-7 flat", torus, stretched(ball, {1, 1, 1e-7}), anywhere},
          {"degenerate triangles", withDegenerates(cube), withDegenerates(ball), anywhere},
          {"cavities", shell, ball, anywhere},
          {"components that cross", crossing, ball, anywhere},
          {"at one place", torus, torus, same},
          {"nearly at one place", torus, torus, near},
          {"flush", cube, subdividedBox({1, 1, 1}, 3), flush},
          {"flush, at 1e9", cube, subdividedBox({1, 1, 1}, 3), flush, 1, Vec::Zero(), 1e9},
          {"on a lattice", cube, crossing, onLattice}};
}

/// A solid as it is asked about, and as it lies in the world.
struct Body {
  Body(const Mesh& mesh, const fcl::Transform3d& X)
      : X_W(X), posed(scenes::moved(X, mesh)), model(scenes::buildModel<kIOSd>(mesh)) {
    markSolid(*model);
    for (const Vec& p : mesh.vertices) most = std::max(most, p.stableNorm());
    most += X.translation().stableNorm();
    const Eigen::Matrix3d R = X.linear();
    skew = (R.transpose() * R - Eigen::Matrix3d::Identity()).norm();
  }
  const fcl::Transform3d X_W;
  const DepthOracle posed;
  const std::shared_ptr<Modeld> model;
  double most = 0, skew = 0;
};

/// Bounds what rounding and rotations to a few digits do to the oracle.
double roundingOf(const Body& a, const Body& b) {
  return (0x1p-46 + 4 * (a.skew + b.skew)) * (a.most + b.most) + 1e-300;
}

/// Counts of one query.
struct Tally {
  std::size_t questions = 0, wrong = 0, undecided = 0;
  double us = 0;
  template <typename Ask>
  auto ask(const Ask& query) {
    const double start = nowMicroseconds();
    auto answer = query();
    us += nowMicroseconds() - start;
    return answer;
  }
  void count(bool is_wrong, bool is_undecided = false) {
    ++questions;
    wrong += is_wrong ? 1 : 0;
    undecided += is_undecided ? 1 : 0;
  }
};

class Stress {
 public:
  Stress(const StressClass& of, const Options& options) : class_(of), random_(options.seed) {
    for (Mesh* mesh : {&class_.a, &class_.b}) {
      *mesh = stretched(*mesh, Vec::Constant(of.scale), of.offset);
    }
    const int rounds = options.quick ? 1 : 5, pairs = options.quick ? 3 : 4;
    for (int i = 0; i < rounds; ++i) {
      std::vector<Body> bodies = {Body(class_.a, worldPose(fcl::Transform3d::Identity()))};
      for (int k = 0; k < pairs; ++k) bodies.emplace_back(class_.b, worldPose(of.X_AB(random_)));
      askPoints(bodies[0], options.quick ? 12 : 60);
      for (int k = 1; k <= pairs; ++k) askDepth(bodies[0], bodies[k]);
      askClashes(bodies);
    }
  }

  std::vector<Row> rows() const {
    std::vector<Row> rows;
    for (const auto& [query, tally] :
         {std::pair("nearest", &nearest_), std::pair("signed", &signed_),
          std::pair("winding", &winding_), std::pair("depth", &depth_),
          std::pair("deeper", &deeper_), std::pair("clashes", &clashes_)}) {
      rows.push_back(baseRow(std::string("stress/") + class_.name, query, tally->questions,
                             {class_.a, class_.b}));
      Row& row = rows.back();
      row.bv = "kios";
      row.times.median_us = row.times.min_us = tally->us / static_cast<double>(row.frames);
      row.errors.wrong = tally->wrong;
      row.errors.undecided = tally->undecided;
    }
    return rows;
  }

 private:
  /// b's pose where a's is the identity, moved about the middle of a and then far off.
  fcl::Transform3d worldPose(fcl::Transform3d X) const {
    X.translation() = X.translation() * class_.scale + class_.offset - X.linear() * class_.offset;
    X.translation() += class_.world * Vec(1, -1, 0.5);
    return X;
  }

  /// On corners, edges and faces or next to them, and anywhere, in the model's frame.
  Vec drawPoint(const Mesh& mesh) {
    const auto last = static_cast<int>(mesh.triangles.size()) - 1;
    const auto& t = mesh.triangles[static_cast<std::size_t>(scenes::integer(random_, 0, last))];
    const Vec &p = mesh.vertices[t[0]], &q = mesh.vertices[t[1]], &r = mesh.vertices[t[2]];
    const double u = random_.unit();
    const Vec on[] = {p, p + u * (q - p), p + u * (q - p) + (1 - u) * random_.unit() * (r - p)};
    const Vec at = on[scenes::integer(random_, 0, 2)];
    const int how = scenes::integer(random_, 0, 3);
    if (how == 0) return at;
    return at +
           class_.scale * scenes::displacement(random_, how == 1 ? -50 : -3, how == 1 ? -3 : 3);
  }

  void askPoints(const Body& body, int count) {
    const WindingTree tree(*body.model);
    const Mesh& mesh = class_.a;
    const DepthOracle own(mesh);
    PointRequest request;
    request.X_WM = body.X_W;
    const double rounding = class_.world > 0 ? roundingOf(body, body) : 0;
    for (int i = 0; i < count; ++i) {
      const Vec p = drawPoint(mesh), p_W = body.X_W * p;
      const NearestPoint found = nearest_.ask([&] { return nearestPoint(*body.model, p); });
      const auto& t = mesh.triangles[static_cast<std::size_t>(found.triangle)];
      const std::array<Vec, 3> triangle = {mesh.vertices[t[0]], mesh.vertices[t[1]],
                                           mesh.vertices[t[2]]};
      const double exact = own.distance(p);
      const double bound =
          0x1p-48 * static_cast<double>(scenes::extent({{p, p, p}, triangle})) + 1e-300;
      const auto off = static_cast<double>(
          scenes::rationalDistance(Vec(Eigen::Map<const Vec>(found.point)), triangle));
      nearest_.count(!(std::abs(found.distance - exact) <= bound) ||
                     (found.distance == 0) != (exact == 0) ||
                     !(off <= bound + 0x1p-48 * body.most));

      const double signed_distance =
          signed_.ask([&] { return signedDistance(*body.model, p_W, request); });
      const bool on = exact <= rounding;  // that far the pose moves it
      signed_.count(!(std::abs(std::abs(signed_distance) - exact) <= bound + rounding) ||
                    (!on && (signed_distance < 0) != own.holds(p)));

      const double error = std::pow(10, random_.uniform(-8, 0));
      const double number = winding_.ask([&] { return tree.at(p, error); });
      if (!(exact > 1e-6 * class_.scale)) continue;  // long doubles lose their digits
      long double sum = 0;
      for (const fcl::Triangle& v : mesh.triangles) {
        sum +=
            scenes::windingOf({mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]}, p);
      }
      winding_.count(!(std::abs(number - static_cast<double>(sum)) <= error + 1e-9));
    }
  }

  double deepest(const Body& a, const Body& b) {
    const DepthOracle &p = a.posed, &q = b.posed;
    return std::max({scenes::deepestSample(p, q, 4), scenes::deepestSample(q, p, 4),
                     scenes::largestBall(p, q, 100, random_)});
  }
  static bool isProven(const Body& a, const Body& b, const double (&point)[3], double lower) {
    const double rounding = roundingOf(a, b);
    const Vec p = Eigen::Map<const Vec>(point);
    return lower <= rounding ||
           scenes::provenDepth(a.posed, b.posed, p, rounding) >= lower - rounding;
  }

  void askDepth(const Body& a, const Body& b) {
    const double rounding = roundingOf(a, b), sample = deepest(a, b);
    LocalDepthRequest request;
    request.max_pieces = 3000;
    const LocalDepthResult found =
        depth_.ask([&] { return localDepth(*a.model, a.X_W, *b.model, b.X_W, request); });
    // docs/solids.md has how wide rounding leaves a bracket.
    const bool narrow =
        found.upper - found.lower <= request.rel_err * found.upper + 1500 * rounding;
    depth_.count(!(found.lower >= 0 && found.lower <= found.upper) ||
                     sample > found.upper + rounding || !isProven(a, b, found.point, found.lower) ||
                     (found.complete && !narrow),
                 !found.complete);
    const double t = 0.5 * (found.lower + found.upper) * random_.uniform(0.5, 1.5);
    const auto deeper = deeper_.ask([&]() -> std::optional<bool> {
      try {
        return deeperThan(*a.model, a.X_W, *b.model, b.X_W, t, request.max_pieces);
      } catch (const std::runtime_error&) {
        return std::nullopt;
      }
    });
    const bool contradicted = deeper && (*deeper ? !(t < found.upper + rounding)
                                                 : std::max(sample, found.lower) > t + rounding);
    deeper_.count(contradicted, !deeper);
  }

  /// Against all pairs: distances and sides of corners by the oracles, depths by samples.
  void askClashes(const std::vector<Body>& bodies) {
    std::vector<ClashPart> parts;
    for (const Body& body : bodies) {
      ClashPart& part = parts.emplace_back();
      part.geometry = body.model;
      part.X_WP = body.X_W;
      part.name = std::to_string(parts.size());
    }
    ClashRequest request;
    request.touch = class_.scale * std::pow(10, random_.uniform(-9, -3));
    request.clearance = 0.2 * class_.scale;
    request.max_pieces = 3000;
    const auto clashes = clashes_.ask([&] { return findClashes(parts, request); });
    auto next = clashes.begin();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < bodies.size(); ++j) {
        const bool listed = next != clashes.end() && next->a == i && next->b == j;
        const ClashResult* const clash = listed ? &*next++ : nullptr;
        clashes_.count(isWrong(bodies[i], bodies[j], request, clash), clash && !clash->decided);
      }
    }
    clashes_.wrong += static_cast<std::size_t>(clashes.end() - next);  // made up, or out of order
  }

  bool isWrong(const Body& a, const Body& b, const ClashRequest& request,
               const ClashResult* clash) {
    const double rounding = roundingOf(a, b), touch = request.touch;
    const fcl::Transform3d I = fcl::Transform3d::Identity();
    const double apart = scenes::MeshOracle(a.posed.mesh, b.posed.mesh).distance(I, I);
    const auto cornersIn = [](const DepthOracle& in, const DepthOracle& of) {
      return static_cast<std::size_t>(std::count_if(of.mesh.vertices.begin(),
                                                    of.mesh.vertices.end(),
                                                    [&](const Vec& p) { return in.holds(p); }));
    };
    const bool far = apart > rounding;
    const std::size_t of_a = far ? cornersIn(b.posed, a.posed) : 0,
                      of_b = far ? cornersIn(a.posed, b.posed) : 0;
    if (!clash) return apart < request.clearance - rounding || of_a + of_b > 0;
    if (!(clash->lower >= 0 && clash->lower <= clash->upper)) return true;
    if (clash->status == ClashStatus::kDuplicate) {
      double most = 0;
      for (std::size_t v = 0; v < a.posed.mesh.vertices.size(); ++v) {
        most = std::max(most, (a.posed.mesh.vertices[v] - b.posed.mesh.vertices[v]).stableNorm());
      }
      return !(most <= touch + rounding && clash->lower <= most + rounding &&
               clash->upper >= most - rounding);
    }
    if (!clash->deep) {
      const bool held = clash->lower <= apart + rounding && clash->upper >= apart - rounding;
      const bool fits = clash->status == ClashStatus::kTouch
                            ? apart <= touch + rounding
                            : apart >= touch - rounding && apart <= request.clearance + rounding;
      return !held || !fits || of_a + of_b > 0;
    }
    const double sample = deepest(a, b);
    if (sample > clash->upper + rounding) return true;
    if (!isProven(a, b, clash->point_a, clash->lower) &&
        !isProven(a, b, clash->point_b, clash->lower)) {
      return true;
    }
    if (clash->status == ClashStatus::kTouch) return sample > touch + rounding;
    if (clash->status == ClashStatus::kOverlap) return clash->decided && !(clash->lower > touch);
    return clash->status != ClashStatus::kInside || apart == 0 ||
           (far && of_a < a.posed.mesh.vertices.size() && of_b < b.posed.mesh.vertices.size());
  }

  StressClass class_;
  Random random_;
  Tally nearest_, signed_, winding_, depth_, deeper_, clashes_;
};

}  // namespace

void reportStress(const Options& options, Report& report) {
  for (const StressClass& of : stressClasses()) report.add(Stress(of, options).rows());
}

}  // namespace kios::bench
