// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every construction of k-IOS and the volumes of others over one tree and one traversal.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "contest.h"
#include "fcl_kios/paper.h"
#include "paper/fcl_policies.h"
#include "paper/kios_policy.h"
#include "paper/spheres_policy.h"
#include "paper/variant_tree.h"
#include "scenario.h"
#include "scenes/motions.h"
#include "scenes/placement.h"
#include "scenes/random.h"
#include "verdicts.h"

namespace kios::bench {
namespace {

using namespace paper;

using Poses = std::vector<RelativePose<double>>;
using Split = std::shared_ptr<const MeshSplit>;

/// Two nodes of the splits of both meshes at a pose, and the distance of their triangles.
struct NodePair {
  int a, b;
  RelativePose<double> X_AB;
  double distance;
};

/// Holds means over the nodes of both trees: numbers that describe a volume, as the paper counts;
/// bytes that it takes here; its spheres, 0 if it has none.
struct FitSize {
  double numbers = 0, bytes = 0, spheres = 0;
};

/// A volume over the splits of two meshes. All share splits, traversal and leaf tests, so that they
/// differ by their volumes alone.
struct FitTrees {
  std::function<VariantResult(const RelativePose<double>&X_AB)> distance, collide;
  /// Returns the bound of two nodes, for a distance query.
  std::function<double(const NodePair& pair)> bound;
  FitSize size;
};

/// Holds a volume and its fit.
struct FitEntrant {
  std::string name;
  std::function<FitTrees(const Split& a, const Split& b)> build;
};

using Entrants = std::vector<FitEntrant>;

/// size_of(volume) is its FitSize.
template <typename Policy, typename SizeOf>
void add(Entrants& all, const std::string& name, const Policy& policy, SizeOf size_of) {
  using Tree = VariantTree<Policy>;
  const auto build = [policy, size_of](const Split& split_a, const Split& split_b) {
    const auto a = std::make_shared<const Tree>(split_a, policy);
    const auto b = std::make_shared<const Tree>(split_b, policy);
    FitTrees trees;
    trees.distance = [a, b](const RelativePose<double>& X_AB) { return a->distance(*b, X_AB); };
    trees.collide = [a, b](const RelativePose<double>& X_AB) { return a->collide(*b, X_AB); };
    trees.bound = [a, b](const NodePair& pair) {
      return a->policy().separation(a->volumes()[pair.a], b->volumes()[pair.b],
                                    a->policy().place(a->shared(), b->shared(), pair.X_AB),
                                    std::numeric_limits<double>::infinity());
    };
    const auto nodes = static_cast<double>(a->volumes().size() + b->volumes().size());
    for (const Tree* tree : {a.get(), b.get()}) {
      for (const auto& volume : tree->volumes()) {
        const FitSize size = size_of(volume);
        trees.size.numbers += size.numbers;
        trees.size.bytes += size.bytes;
        trees.size.spheres += size.spheres;
      }
    }
    for (double* const sum : {&trees.size.numbers, &trees.size.bytes, &trees.size.spheres}) {
      *sum /= nodes;
    }
    return trees;
  };
  all.push_back({name, build});
}

/// Returns spheres with their own radii, or with one that all but S0 share.
FitSize sizeOf(const kIOSd& bv, bool shared_radius) {
  const int k = bv.k();
  const bool shares = shared_radius && k > 1;
  return {shares ? 4.0 + 3 * (k - 1) + 1 : 4.0 * k, sizeof bv, static_cast<double>(k)};
}

void addKios(Entrants& all, const std::string& name, const FitOptions& options) {
  const bool shared = options.shared_radius;
  add(all, name, KiosPolicy(options), [shared](const kIOSd& bv) { return sizeOf(bv, shared); });
}

template <typename Policy>
void addKind(Entrants& all, const std::string& name, const Policy& policy) {
  add(all, name, policy, [](const Spheres& bv) {
    return FitSize{double(bv.floats), 4.0 * bv.floats, double(bv.all.size())};
  });
}

/// The paper's kinds (III-A) and its scale of k (V-B).
void addKinds(Entrants& all) {
  FitOptions every;
  every.count = SphereCount::kAll;
  addKind(all, "kios_k3", OrientedKios<3>(every));
  addKind(all, "kios_k7", OrientedKios<7>(every));
  addKind(all, "kios_axis_aligned", AxisAlignedKios());
  // Through the corners of an icosahedron: k = 13.
  const double g = (1 + std::sqrt(5.0)) / 2;
  const std::vector<fcl::Vector3d> six = {{0, 1, g},  {0, 1, -g}, {1, g, 0},
                                          {1, -g, 0}, {g, 0, 1},  {-g, 0, 1}};
  addKind(all, "kios_fixed_6", FixedDirectionKios(six, every));
}

template <typename Policy>
void addOther(Entrants& all, const std::string& name, double numbers) {
  const auto size_of = [numbers](const auto& bv) { return FitSize{numbers, sizeof bv, 0}; };
  add(all, name, Policy(), size_of);
}

/// Returns all constructions of k-IOS, and the volumes that they are compared with.
std::vector<FitEntrant> fitEntrants() {
  Entrants all;
  addKios(all, "kios_method_i", FitMethod::kMethodI);
  addKios(all, "kios_method_i_at_angle", FitMethod::kMethodIAtAngle);
  addKios(all, "kios_method_ii", FitMethod::kMethodII);
  FitOptions shared(FitMethod::kMethodII), every, narrow;
  shared.shared_radius = true;
  addKios(all, "kios_method_ii_shared", shared);
  addKios(all, "kios_tuned", FitMethod::kTuned);
  every.count = SphereCount::kAll;
  addKios(all, "kios_tuned_k5", every);
  narrow.angle = scenes::kPi / 8;  // for the paper's pi/6
  addKios(all, "kios_tuned_22deg", narrow);
  addKinds(all);
  // In the paper's words: two corners, a corner with axes and lengths, ...
  addOther<AabbPolicy>(all, "fcl_aabb", 6);
  addOther<OrientedPolicy<fcl::RSSd>>(all, "fcl_rss", 15);
  addOther<OrientedPolicy<fcl::OBBRSSd>>(all, "fcl_obbrss", 30);
  return all;
}

double distanceOf(const MeshSplit& a, const MeshSplit::Node& m, const MeshSplit& b,
                  const MeshSplit::Node& n, const RelativePose<double>& X_AB) {
  double distance = std::numeric_limits<double>::infinity();
  for (int s = 0; s < m.count; ++s) {
    const TriangleVertices<double> p = a.corners(a.triangle(m.first + s));
    for (int t = 0; t < n.count; ++t) {
      TriangleVertices<double> q = b.corners(b.triangle(n.first + t));
      for (Point<double>& corner : q) corner = X_AB * corner;
      distance = std::min(distance, triangleDistance(p, q).distance);
    }
  }
  return distance;
}

/// Returns pairs of nodes of up to 64 triangles and of similar size, turned at random and moved to
/// between a hundredth of their size and that size apart, each with its true distance.
std::vector<NodePair> sampleNodes(const MeshSplit& a, const MeshSplit& b, int count,
                                  std::uint64_t seed) {
  constexpr int kMostTriangles = 64;
  scenes::Random random(seed);
  const auto draw = [&random](const MeshSplit& of) {
    for (;;) {
      const int i = static_cast<int>(random.unit() * static_cast<double>(of.nodes().size()));
      if (of.nodes()[static_cast<std::size_t>(i)].count <= kMostTriangles) return i;
    }
  };
  const auto poses = scenes::randomPoses(100 * count, 1, seed);
  std::vector<NodePair> pairs;
  for (fcl::Transform3d X : poses) {
    if (static_cast<int>(pairs.size()) == count) break;
    const int i = draw(a), j = draw(b);
    const MeshSplit::Node &m = a.nodes()[static_cast<std::size_t>(i)],
                          &n = b.nodes()[static_cast<std::size_t>(j)];
    const double size = std::max(m.extent, n.extent);
    if (std::min(m.extent, n.extent) < 0.3 * size) continue;
    const fcl::Vector3d at_a = a.corners(a.triangle(m.first))[0];
    const fcl::Vector3d at_b = b.corners(b.triangle(n.first))[0];
    const fcl::Vector3d apart = X.translation().normalized() * (2.5 * random.unit() * size);
    X.translation() = at_a + apart - X.linear() * at_b;
    const RelativePose<double> X_AB(X.linear(), X.translation());
    const double distance = distanceOf(a, m, b, n, X_AB);
    if (distance < 0.01 * size || distance > size) continue;
    pairs.push_back({i, j, X_AB, distance});
  }
  return pairs;
}

struct Bounds {
  double tightness = 0;   // mean of bound / true distance
  std::size_t wrong = 0;  // above the true distance
};

Bounds boundsOf(const FitTrees& trees, const std::vector<NodePair>& pairs) {
  constexpr double kRounding = 1e-12;
  Bounds bounds;
  for (const NodePair& pair : pairs) {
    const double bound = std::max(0.0, trees.bound(pair));
    bounds.tightness += bound / pair.distance / static_cast<double>(pairs.size());
    if (bound > pair.distance * (1 + kRounding)) ++bounds.wrong;
  }
  return bounds;
}

/// Holds an entrant, its trees, and what it did in the race of one query.
struct Lane {
  const FitEntrant* entrant;
  FitTrees trees;
  double build_us_per_triangle;
  Bounds bounds;
  std::vector<double> answers;
  long long bv_tests, leaf_tests;  // of all repeats
};

std::vector<Lane> built(const std::vector<FitEntrant>& entrants, const Split& a, const Split& b,
                        const std::vector<NodePair>& nodes, int repeats) {
  std::vector<Lane> lanes;
  const double triangles = a->triangleCount() + b->triangleCount();
  for (const FitEntrant& entrant : entrants) {
    FitTrees trees;
    std::vector<Competitor> builder = {
        {"", [&](std::size_t, std::size_t) { trees = entrant.build(a, b); }}};
    Race{1, repeats}.run(builder);
    const double us = timesOf(builder[0], 1, nullptr).median_us;
    lanes.push_back({&entrant, trees, us / triangles, boundsOf(trees, nodes), {}, 0, 0});
  }
  return lanes;
}

/// Asks all frames, the lanes taking turns at blocks of them; one row for each.
std::vector<Row> ask(Row row, bool collide, const Poses& poses, int repeats,
                     const std::vector<Question>& questions, const Verdicts& verdicts,
                     std::vector<Lane>& lanes) {
  constexpr std::size_t kBlock = 64;
  std::vector<Competitor> competitors;
  for (Lane& lane : lanes) {
    lane.answers.assign(poses.size(), 0);
    lane.bv_tests = lane.leaf_tests = 0;
    competitors.push_back({lane.entrant->name, each([&lane, &poses, collide](std::size_t i) {
                             const VariantResult result = collide ? lane.trees.collide(poses[i])
                                                                  : lane.trees.distance(poses[i]);
                             lane.answers[i] = collide ? (result.contact ? 1 : 0) : result.distance;
                             lane.bv_tests += result.bv_tests;
                             lane.leaf_tests += result.leaf_tests;
                           })});
  }
  Race{poses.size(), repeats, kBlock}.run(competitors);
  const Query query = collide ? Query::kCollide : Query::kDistance;
  const double asked = static_cast<double>(poses.size()) * repeats;
  row.query = name(query);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const Lane& lane = lanes[i];
    Row& of = rows.emplace_back(row.of(competitors[i]));
    of.tests = {static_cast<double>(lane.bv_tests) / asked,
                static_cast<double>(lane.leaf_tests) / asked};
    of.volumes.build_us_per_triangle = lane.build_us_per_triangle;
    of.volumes.floats_per_bv = lane.trees.size.numbers;
    of.volumes.bytes_per_triangle = 2 * lane.trees.size.bytes;  // of volumes
    if (lane.trees.size.spheres > 0) of.volumes.mean_spheres = lane.trees.size.spheres;
    of.errors = compare(lane.answers, verdicts, query, questions, row.extent);
    of.volumes.tightness = lane.bounds.tightness;
    *of.errors.wrong += lane.bounds.wrong;
  }
  return rows;
}

void reportScene(const std::string& scenario, const scenes::MovingPair& pair,
                 const Options& options, Report& report) {
  const std::vector<scenes::Frame> frames = chosenFrames(pair.frames, options);
  Poses poses;
  for (const scenes::Frame& frame : frames) poses.emplace_back(frame.X_WA, frame.X_WB);
  const auto a = std::make_shared<const MeshSplit>(pair.a);
  const auto b = std::make_shared<const MeshSplit>(pair.b);
  const auto nodes = sampleNodes(*a, *b, options.quick ? 100 : 1000, options.seed);
  const scenes::MeshOracle oracle(pair.a, pair.b);
  const std::vector<FitEntrant> entrants = fitEntrants();
  std::vector<Lane> lanes = built(entrants, a, b, nodes, options.repeats);

  const Row base = baseRow(scenario, "", frames.size(), {pair.a, pair.b});
  for (const bool collide : {false, true}) {
    const Query query = collide ? Query::kCollide : Query::kDistance;
    const std::vector<Question> questions = pairTask("", query, frames).questions;
    const Verdicts verdicts =
        judge([&oracle](Query q, const Question& question) { return truth(oracle, q, question); },
              query, questions, options.oracle_frames);
    report.add(ask(base, collide, poses, options.repeats, questions, verdicts, lanes));
  }
}

}  // namespace

void runPaper(const Options& options, Report& report) {
  constexpr int kFrames = 200;
  Options ours = options;
  if (ours.frames == 0) ours.frames = options.quick ? 10 : kFrames;
  if (const auto data = findData(options); data && !options.quick) {
    reportScene("fits/falling", scenes::loadFalling(*data), ours, report);
    reportScene("fits/spinning", scenes::loadSpinning(*data, 2400), ours, report);
    return;
  }
  reportScene("fits/falling_generated", generatedFalling(), ours, report);
  if (options.quick) return;
  reportScene("fits/spinning_generated", generatedSpinning(), ours, report);
}

}  // namespace kios::bench
