// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "worlds.h"

#include <algorithm>
#include <cmath>

#include "cad_parts.h"
#include "cad_shapes.h"
#include "motions.h"
#include "oracle.h"
#include "placement.h"
#include "random.h"
#include "shapes.h"

namespace kios::scenes {
namespace {

using fcl::Transform3d;
using fcl::Vector3d;

Board board(const Vector3d& size, double x, double y, double z) { return {size, shift(x, y, z)}; }

/// Returns a tray without a lid, centred on (x, y), whose inside is `size` and begins at z.
std::vector<Board> tray(const Vector3d& size, double wall, double x, double y, double z) {
  const double width = size.x() + 2 * wall, middle = z + size.z() / 2;
  return {board({width, size.y() + 2 * wall, wall}, x, y, z - wall / 2),
          board({wall, size.y(), size.z()}, x - (size.x() + wall) / 2, y, middle),
          board({wall, size.y(), size.z()}, x + (size.x() + wall) / 2, y, middle),
          board({width, wall, size.z()}, x, y - (size.y() + wall) / 2, middle),
          board({width, wall, size.z()}, x, y + (size.y() + wall) / 2, middle)};
}

std::vector<Board> tableWithLegs() {
  std::vector<Board> boards = {board({1.2, 0.8, 0.04}, 0, 0, 0.73)};
  for (const double x : {-0.55, 0.55}) {
    for (const double y : {-0.35, 0.35}) boards.push_back(board({0.06, 0.06, 0.71}, x, y, 0.355));
  }
  return boards;
}

std::vector<Board> shelf() {
  std::vector<Board> boards = {board({0.02, 0.4, 2}, -0.51, 0, 1),
                               board({0.02, 0.4, 2}, 0.51, 0, 1),
                               board({1.04, 0.01, 2}, 0, 0.205, 1)};
  for (int i = 0; i < 6; ++i) boards.push_back(board({1, 0.4, 0.02}, 0, 0, 0.05 + 0.38 * i));
  return boards;
}

/// Returns a floor, a ceiling and three walls of 8 x 6 x 3 m inside.
World room() {
  World world =
      boxWorld("room", {board({8.4, 6.4, 0.2}, 0, 0, -0.1), board({8.4, 6.4, 0.2}, 0, 0, 3.1),
                        board({0.2, 6, 3}, -4.1, 0, 1.5), board({0.2, 6, 3}, 4.1, 0, 1.5),
                        board({8.4, 0.2, 3}, 0, 3.1, 1.5)});
  world.lower = Vector3d(-4, -3, 0);
  world.upper = Vector3d(4, 3, 3);
  return world;
}

std::vector<Board> bins() {
  std::vector<Board> boards;
  for (int i = 0; i < 4; ++i) {
    for (Board& part : tray({0.3, 0.4, 0.2}, 0.01, 0.4 * (i % 2), 0.5 * (i / 2), 0.01)) {
      boards.push_back(part);
    }
  }
  return boards;
}

std::vector<Board> stairs() {
  std::vector<Board> boards;
  for (int i = 0; i < 12; ++i) {
    boards.push_back(board({0.28, 1.2, 0.18 * (i + 1)}, 0.28 * i, 0, 0.09 * (i + 1)));
  }
  return boards;
}

/// Returns a square of cells x cells squares, each of two triangles, over hills.
World terrain(const std::string& name, double cell, int cells, double height, std::uint64_t seed) {
  constexpr int kWaves = 12;
  Random random(seed);
  World world;
  world.name = name;
  world.mesh = sheet(cell * cells, cell * cells, cells, cells, 0);
  struct Wave {
    double x, y, phase, height;
  };
  std::vector<Wave> waves;
  for (int i = 0; i < kWaves; ++i) {
    const double number = std::exp(random.uniform(0, std::log(cells / 3.0)));
    const double length = cell * cells / number, angle = random.uniform(-kPi, kPi);
    waves.push_back({2 * kPi * std::cos(angle) / length, 2 * kPi * std::sin(angle) / length,
                     random.uniform(-kPi, kPi), height / number});
  }
  for (Vector3d& p : world.mesh.vertices) {
    for (const Wave& w : waves) p.z() += w.height * std::sin(w.x * p.x() + w.y * p.y() + w.phase);
  }
  return world;
}

/// Returns slabs of 30 x 20 m on columns, four storeys, and between them parts of machines in
/// hundreds.
World building(int triangles) {
  std::vector<Board> slabs;
  for (int storey = 0; storey < 4; ++storey) {
    const double z = 3.5 * storey;
    slabs.push_back(board({30, 20, 0.3}, 0, 0, z - 0.15));
    slabs.push_back(board({30, 0.2, 3.2}, 0, 10.1, z + 1.6));
    slabs.push_back(board({0.2, 20, 3.2}, -15.1, 0, z + 1.6));
    for (int i = 0; i < 8; ++i) {
      slabs.push_back(board({0.4, 0.4, 3.2}, -10.5 + 7 * (i % 4), i < 4 ? -6 : 6, z + 1.6));
    }
  }
  std::vector<Mesh> kinds = cadParts();
  kinds.push_back(filletedBar(0.04, 0.04, 3, 0.01, 6));
  kinds.push_back(tube(0.05, 0.06, 6, 24));
  std::vector<Mesh> parts = {boxWorld("", slabs).mesh};
  Random random(triangles);
  const auto turns = randomPoses(triangles / 100 + 1, 1, triangles);
  std::size_t count = parts[0].triangles.size();
  for (std::size_t i = 0; count < static_cast<std::size_t>(triangles); ++i) {
    Transform3d X = turns[i % turns.size()];
    const double x = random.uniform(-14, 14), y = random.uniform(-9, 9);
    X.translation() = Vector3d(x, y, 3.5 * std::floor(random.uniform(0, 4)) + random.uniform(0, 3));
    parts.push_back(moved(X, kinds[i % kinds.size()]));
    count += parts.back().triangles.size();
  }
  World world;
  world.name = "building";
  world.mesh = merged(parts);
  return world;
}

/// Returns 150 triangles 1 to 2 m long and 1 mm wide.
World needles() {
  Random random(7);
  World world;
  world.name = "needles";
  for (const Transform3d& X : randomPoses(150, 0.7, 7)) {
    const double length = random.uniform(1, 2);
    world.mesh =
        merged({world.mesh, moved(X, singleTriangle({-length / 2, 0, 0}, {length / 2, 0, 0},
                                                    {length / 2, 0.001, 0}))});
  }
  return world;
}

struct SurfacePoint {
  Vector3d p, normal;
};

/// Draws points of triangles, by area and by number in turn.
class Surface {
 public:
  explicit Surface(const World& world) : world_(world) {
    for (const fcl::Triangle& t : world.mesh.triangles) {
      total_ += cross(t).norm();
      sums_.push_back(total_);
    }
  }

  SurfacePoint draw(bool by_area, Random& random) const {
    const std::size_t count = sums_.size();
    for (int attempt = 0;; ++attempt) {
      const double u = random.unit();
      const std::size_t at =
          by_area ? std::upper_bound(sums_.begin(), sums_.end(), u * total_) - sums_.begin()
                  : static_cast<std::size_t>(u * static_cast<double>(count));
      const fcl::Triangle& t = world_.mesh.triangles[std::min(at, count - 1)];
      double v = random.unit(), w = random.unit();
      if (v + w > 1) v = 1 - v, w = 1 - w;
      const auto& q = world_.mesh.vertices;
      const Vector3d p = q[t[0]] + v * (q[t[1]] - q[t[0]]) + w * (q[t[2]] - q[t[0]]);
      const Vector3d normal = cross(t).normalized();
      const Vector3d above = p + 0.05 * normal;
      const bool within = (above.array() >= world_.lower.array()).all() &&
                          (above.array() <= world_.upper.array()).all();
      if (within || attempt == kMaxAttempts) return {p, normal};
    }
  }

 private:
  static constexpr int kMaxAttempts = 1000;

  Vector3d cross(const fcl::Triangle& t) const {
    const auto& q = world_.mesh.vertices;
    return (q[t[1]] - q[t[0]]).cross(q[t[2]] - q[t[0]]);
  }

  const World& world_;
  std::vector<double> sums_;
  double total_ = 0;
};

}  // namespace

World boxWorld(const std::string& name, const std::vector<Board>& boards) {
  std::vector<Mesh> boxes;
  for (const Board& b : boards) boxes.push_back(moved(b.X_WB, subdividedBox(b.size, 1)));
  World world;
  world.name = name;
  world.mesh = merged(boxes);
  world.boards = boards;
  return world;
}

std::vector<World> boxWorlds() {
  return {boxWorld("table_top", {board({1.2, 0.8, 0.04}, 0, 0, 0.73)}),
          boxWorld("table", tableWithLegs()),
          boxWorld("floor", {board({10, 10, 0.1}, 0, 0, -0.05)}),
          room(),
          boxWorld("shelf", shelf()),
          boxWorld("crate", tray({0.6, 0.4, 0.3}, 0.015, 0, 0, 0.015)),
          boxWorld("bins", bins()),
          boxWorld("stairs", stairs())};
}

std::vector<World> meshWorlds(int triangles) {
  World strips;
  strips.name = "strips";
  strips.mesh = stripCylinder(200, 2, 0.003);
  return {terrain("terrain_1m", 1, 30, 1.5, 1),
          terrain("terrain_10m", 10, 30, 15, 2),
          terrain("terrain_5cm", 0.05, 120, 0.3, 3),
          building(triangles),
          needles(),
          strips};
}

std::vector<Transform3d> posesNear(const World& world, const Mesh& link, int count,
                                   std::uint64_t seed) {
  // Gaps from which one is drawn log-uniformly; negative: the link is pushed in.
  constexpr double kGaps[kGapsOfPoses][2] = {{-1e-4, -3e-2}, {2e-4, 5e-3}, {5e-3, 5e-2},
                                             {-1e-4, -3e-2}, {2e-4, 5e-3}, {5e-2, 0.5},
                                             {0.5, 3}};
  constexpr int kKinds = kGapsOfPoses;
  constexpr int kAttempts = 30;
  Random random(seed);
  const Surface surface(world);
  const MeshOracle oracle(world.mesh, link);
  const std::vector<Transform3d> turns = randomPoses(kAttempts * count, 1, seed + 1);
  std::vector<Transform3d> poses;
  for (int i = 0; i < count; ++i) {
    const auto& [least, most] = kGaps[i % kKinds];
    Transform3d X;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      X = turns[static_cast<std::size_t>(kAttempts * i + attempt)];
      const double gap = least * std::pow(most / least, random.unit());
      const auto [p, normal] = surface.draw(i / kKinds % 2 == 0, random);
      Vector3d lowest = X.linear() * link.vertices.front();
      for (const Vector3d& v : link.vertices) {
        const Vector3d turned = X.linear() * v;
        if (turned.dot(normal) < lowest.dot(normal)) lowest = turned;
      }
      X.translation() = p + gap * normal - lowest;
      if (oracle.collide(Transform3d::Identity(), X) == (gap < 0)) break;
    }
    poses.push_back(X);
  }
  return poses;
}

std::vector<Vector3d> scannedTable(double spacing, double noise, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vector3d> points;
  const auto scan = [&](const Vector3d& corner, const Vector3d& u, const Vector3d& v) {
    const Vector3d normal = u.cross(v).normalized();
    const int nu = static_cast<int>(u.norm() / spacing), nv = static_cast<int>(v.norm() / spacing);
    for (int i = 0; i < nu; ++i) {
      for (int j = 0; j < nv; ++j) {
        const double a = (i + random.unit()) / nu, b = (j + random.unit()) / nv;
        points.push_back(corner + a * u + b * v + random.uniform(-noise, noise) * normal);
      }
    }
  };
  scan({-0.8, -0.5, 0.75}, {1.6, 0, 0}, {0, 1, 0});    // the table's top
  scan({-1.2, 0.6, 0}, {2.4, 0, 0}, {0, 0, 2});        // the wall behind it
  scan({-0.2, 0.1, 0.75}, {0.3, 0, 0}, {0, 0, 0.25});  // a box on it, its front and its side
  scan({0.1, 0.1, 0.75}, {0, 0.3, 0}, {0, 0, 0.25});
  scan({-0.2, 0.1, 1}, {0.3, 0, 0}, {0, 0.3, 0});
  return points;
}

}  // namespace kios::scenes
