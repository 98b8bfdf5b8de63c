// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A rod passes a block while it turns over. Gradient descent on the smooth clearance of their k-IOS
// trees bends the path until the clearance is what we ask for.
//
// usage: optimise_trajectory [FILE.csv]
// Writes path, s, x, y, angle, then clearance and its slope by s: the smooth minimum over k-IOS,
// the plain minimum, and the minimum over FCL's RSS at the same
// level of its tree. scripts/plot draws it.
#include <fcl_kios/clearance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/RSS.h>
#include "shapes.h"

namespace {

using Point = std::array<double, 3>;  // x, y and the angle about z of the rod
using Path = std::vector<Point>;
using Mesh = shapes::Mesh<double>;

constexpr double kAsked = 0.3;  // clearance, in the lengths of the scene
constexpr double kBeta = 40;    // the smooth minimum lies at most log(pairs) / kBeta lower
constexpr int kLevel = 4;       // 16 volumes a model
constexpr int kWaypoints = 33;

/// Box around the origin with 6 x 6 squares on each face.
Mesh box(const fcl::Vector3d& size) {
  Mesh mesh;
  shapes::addBox<double>(mesh, size, fcl::Vector3d::Zero(), 6);
  return mesh;
}

/// FCL's counterpart of a cover: the RSS of the nodes at kLevel of its own tree.
std::vector<fcl::RSSd> rssCover(const Mesh& mesh) {
  fcl::BVHModel<fcl::RSSd> model;
  if (model.beginModel() != fcl::BVH_OK ||
      model.addSubModel(mesh.vertices, mesh.triangles) != fcl::BVH_OK ||
      model.endModel() != fcl::BVH_OK) {
    throw std::runtime_error("FCL built no model.");
  }
  std::vector<int> nodes = {0};
  for (int level = 0; level < kLevel; ++level) {
    std::vector<int> next;
    for (const int node : nodes) {
      const auto& bv = model.getBV(node);
      if (bv.isLeaf()) {
        next.push_back(node);
      } else {
        next.insert(next.end(), {bv.leftChild(), bv.rightChild()});
      }
    }
    nodes = next;
  }
  std::vector<fcl::RSSd> cover;
  for (const int node : nodes) cover.push_back(model.getBV(node).bv);
  return cover;
}

struct Scene {
  Scene() : Scene(box({0.9, 0.9, 0.9}), box({1.2, 0.2, 0.2})) {}
  Scene(const Mesh& block, const Mesh& rod)
      : block_cover(*kios::makeModel(block.vertices, block.triangles), kLevel),
        rod_cover(*kios::makeModel(rod.vertices, rod.triangles), kLevel),
        block_rss(rssCover(block)),
        rod_rss(rssCover(rod)) {}

  static kios::RelativePose<double> pose(const Point& at) {
    return {fcl::AngleAxisd(at[2], fcl::Vector3d::UnitZ()).toRotationMatrix(), {at[0], at[1], 0}};
  }
  kios::Clearance smooth(const Point& at) const {
    return kios::smoothClearance(block_cover, rod_cover, pose(at), kBeta);
  }
  kios::Clearance minimum(const Point& at) const {
    return kios::minimumClearance(block_cover, rod_cover, pose(at));
  }
  double rss(const Point& at) const {
    const auto X = pose(at);
    double least = HUGE_VAL;
    for (const fcl::RSSd& a : block_rss) {
      for (const fcl::RSSd& b : rod_rss) least = std::min(least, fcl::distance(X.R(), X.T(), a, b));
    }
    return least;
  }

  kios::Coverd block_cover, rod_cover;
  std::vector<fcl::RSSd> block_rss, rod_rss;
};

Point gradientOf(const kios::Clearance& c) {
  return {c.by_translation[0], c.by_translation[1], c.by_rotation[2]};
}

/// One component of K^-1 g, K the matrix of second differences with the ends held: steps in this
/// metric bend the whole path instead of a waypoint (as CHOMP does).
void smoothStep(std::vector<Point>& g, int component) {
  const std::size_t n = g.size() - 2;  // inner waypoints; K = tridiagonal (-1, 2, -1)
  std::vector<double> upper(n);
  double before = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double pivot = i == 0 ? 2 : 2 - upper[i - 1];
    upper[i] = 1 / pivot;
    before = (g[i + 1][component] + before) / pivot;
    g[i + 1][component] = before;
  }
  for (std::size_t i = n - 1; i-- > 0;) g[i + 1][component] += upper[i] * g[i + 2][component];
}

/// Descends sum |p(i+1) - p(i)|^2 / 2 + weight sum max(0, asked - clearance)^2 / 2.
Path optimise(const Scene& scene, Path path) {
  constexpr double kWeight = 4, kStep = 0.03;
  for (int iteration = 0; iteration <= 300; ++iteration) {
    std::vector<Point> g(path.size(), Point{0, 0, 0});
    double cost = 0, least = HUGE_VAL;
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      const kios::Clearance clearance = scene.smooth(path[i]);
      const Point slope = gradientOf(clearance);
      const double missing = std::max(0.0, kAsked - clearance.value);
      least = std::min(least, clearance.value);
      cost += kWeight * missing * missing / 2;
      for (int c = 0; c < 3; ++c) {
        const double step = path[i + 1][c] - path[i][c], last = path[i][c] - path[i - 1][c];
        cost += step * step / 2;
        g[i][c] = last - step - kWeight * missing * slope[c];
      }
    }
    if (iteration % 50 == 0) {
      std::printf("iteration %3d: cost %.5f, least smooth clearance %.4f\n", iteration, cost,
                  least);
    }
    for (int c = 0; c < 3; ++c) smoothStep(g, c);
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      for (int c = 0; c < 3; ++c) path[i][c] -= kStep * g[i][c];
    }
  }
  return path;
}

/// Catmull-Rom spline through the waypoints, s in [0, 1]: a C1 path.
Point at(const Path& path, double s) {
  const int last = static_cast<int>(path.size()) - 1;
  const int i = std::min(last - 1, static_cast<int>(s * last));
  const double t = s * last - i;
  const auto point = [&](int k) -> const Point& { return path[static_cast<std::size_t>(k)]; };
  Point p;
  for (int c = 0; c < 3; ++c) {
    const double p0 = point(i)[c], p1 = point(i + 1)[c];
    const double m0 = i == 0 ? p1 - p0 : (p1 - point(i - 1)[c]) / 2;
    const double m1 = i + 1 == last ? p1 - p0 : (point(i + 2)[c] - p0) / 2;
    p[c] = p0 + t * (m0 + t * (3 * (p1 - p0) - 2 * m0 - m1 + t * (2 * (p0 - p1) + m0 + m1)));
  }
  return p;
}

void write(std::ofstream& csv, const char* name, const Scene& scene, const Path& path) {
  constexpr int kSamples = 800;
  constexpr double kStep = 1e-6;
  for (int k = 1; k < kSamples; ++k) {
    const double s = static_cast<double>(k) / kSamples;
    const Point p = at(path, s), next = at(path, s + kStep), last = at(path, s - kStep);
    const kios::Clearance smooth = scene.smooth(p), plain = scene.minimum(p);
    double smooth_slope = 0, plain_slope = 0;
    for (int c = 0; c < 3; ++c) {
      const double velocity = (next[c] - last[c]) / (2 * kStep);
      smooth_slope += gradientOf(smooth)[c] * velocity;
      plain_slope += gradientOf(plain)[c] * velocity;
    }
    const double rss_slope = (scene.rss(next) - scene.rss(last)) / (2 * kStep);
    csv << name << ',' << s << ',' << p[0] << ',' << p[1] << ',' << p[2] << ',' << smooth.value
        << ',' << smooth_slope << ',' << plain.value << ',' << plain_slope << ',' << scene.rss(p)
        << ',' << rss_slope << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  const char* const file = argc > 1 ? argv[1] : "trajectory.csv";
  const Scene scene;
  Path path;
  for (int i = 0; i < kWaypoints; ++i) {
    const double s = static_cast<double>(i) / (kWaypoints - 1);
    path.push_back({3 * s - 1.5, 1.2, 3.14159265358979 * (s - 0.5)});  // flat above the block
  }
  const Path bent = optimise(scene, path);
  std::ofstream csv(file);
  csv << "path,s,x,y,angle,smooth,smooth_slope,minimum,minimum_slope,rss,rss_slope\n";
  csv.precision(12);
  write(csv, "initial", scene, path);
  write(csv, "optimised", scene, bent);
  if (!csv) {
    std::cerr << "can't write " << file << '\n';
    return 1;
  }
  std::cout << "wrote " << file << '\n';
}
