// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "inside_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "fcl_kios/solids.h"

namespace kios::python {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kAtOnce = 8;  ///< vertices, before it is seen what they prove
using Points = InsideGrid::Points;

constexpr double kTolerance = 1e-4;  ///< of the mesh's extent

/// A triangle's corners, and the box around it with room for the tolerance.
struct Corners {
  Corners(const Modeld& mesh, int triangle, double room) {
    for (int k = 0; k < 3; ++k) at[k] = mesh.vertices[mesh.tri_indices[triangle][k]];
    low = at[0].cwiseMin(at[1]).cwiseMin(at[2]).array() - room;
    high = at[0].cwiseMax(at[1]).cwiseMax(at[2]).array() + room;
  }
  Vector3d at[3], low, high;
};

struct Range {
  int first[3], last[3];

  std::size_t count() const {
    std::size_t n = 1;
    for (int c = 0; c < 3; ++c) n *= static_cast<std::size_t>(last[c] - first[c] + 1);
    return n;
  }
};

Range cellsOf(const Corners& t, const Vector3d& low, double cells_per_length,
              const int (&size)[3]) {
  Range range{};
  for (int c = 0; c < 3; ++c) {
    const auto cell = [&](double x) {
      return std::clamp(static_cast<int>((x - low[c]) * cells_per_length), 0, size[c] - 1);
    };
    range.first[c] = cell(t.low[c]);
    range.last[c] = cell(t.high[c]);
  }
  return range;
}

}  // namespace

std::unique_ptr<const InsideGrid> InsideGrid::of(const Modeld& mesh) {
  // A model of its own, as marks are shared with copies.
  const auto solid = makeModel<double>({mesh.vertices, mesh.vertices + mesh.num_vertices},
                                       {mesh.tri_indices, mesh.tri_indices + mesh.num_tris});
  try {
    markSolid(*solid);
  } catch (const std::invalid_argument&) {  // it isn't closed
    return nullptr;
  }
  std::unique_ptr<InsideGrid> grid(new InsideGrid);
  for (int most = 64; !grid->layOut(mesh, most); most /= 2) {
    if (most == 16) return nullptr;
  }
  grid->markSurface(mesh);
  grid->markRest(*solid);
  return grid;
}

bool InsideGrid::layOut(const Modeld& mesh, int most) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (int t = 0; t < mesh.num_tris; ++t) {
    const Corners corners(mesh, t, 0);
    low = low.cwiseMin(corners.low);
    high = high.cwiseMax(corners.high);
  }
  const double extent = (high - low).maxCoeff();
  const double largest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  // Far from its origin, or of no ordinary size, a mesh has none.
  if (!(extent > 1e-100 && largest < 1e3 * extent && largest < 1e100)) return false;
  tolerance_ = kTolerance * extent;
  cells_per_length_ = most / extent;
  low_ = low.array() - 1 / cells_per_length_;  // a layer of cells all around is outside
  for (int c = 0; c < 3; ++c) {
    size_[c] = static_cast<int>((high[c] - low_[c]) * cells_per_length_) + 2;
  }
  high_ = low_ + Vector3d(size_[0], size_[1], size_[2]) / cells_per_length_;
  constexpr std::size_t kMostTests = 1U << 22;
  std::size_t tests = 0;
  for (int t = 0; t < mesh.num_tris && tests < kMostTests; ++t) {
    const Corners corners(mesh, t, 2 * tolerance_);
    tests += cellsOf(corners, low_, cells_per_length_, size_).count();
  }
  return tests < kMostTests;
}

/// All cells that a triangle's box and plane meet, with room for the tolerance and all rounding.
void InsideGrid::markSurface(const Modeld& mesh) {
  constexpr std::uint8_t kUnknown = 255;
  cells_.assign(index(0, 0, size_[2]), kUnknown);
  const double half = 0.5 / cells_per_length_, room = 2 * tolerance_;
  for (int t = 0; t < mesh.num_tris; ++t) {
    const Corners corners(mesh, t, room);
    Vector3d normal = (corners.at[1] - corners.at[0]).cross(corners.at[2] - corners.at[0]);
    const double length = normal.norm();
    // The normal of a sliver may be wrong by rounding: then the box alone tells.
    const double longest = std::max((corners.at[1] - corners.at[0]).squaredNorm(),
                                    (corners.at[2] - corners.at[0]).squaredNorm());
    const bool has_plane = length > 1e-6 * longest;
    if (has_plane) normal /= length;
    const double reach = half * normal.lpNorm<1>() + room;
    const Range range = cellsOf(corners, low_, cells_per_length_, size_);
    for (int z = range.first[2]; z <= range.last[2]; ++z) {
      for (int y = range.first[1]; y <= range.last[1]; ++y) {
        for (int x = range.first[0]; x <= range.last[0]; ++x) {
          if (has_plane && std::abs(normal.dot(center(x, y, z) - corners.at[0])) > reach) continue;
          cells_[index(x, y, z)] = kSurface;
        }
      }
    }
  }
}

/// Cells that touch by a face and have no surface are alike: one of each such set is asked.
void InsideGrid::markRest(const Modeld& solid) {
  struct Place {
    int at[3];
  };
  std::vector<Place> open;
  const fcl::Transform3d identity = fcl::Transform3d::Identity();
  for (int z = 0; z < size_[2]; ++z) {
    for (int y = 0; y < size_[1]; ++y) {
      for (int x = 0; x < size_[0]; ++x) {
        if (cells_[index(x, y, z)] <= kOutside) continue;
        const std::uint8_t kind =
            contains<double>(solid, identity, center(x, y, z)) ? kInside : kOutside;
        cells_[index(x, y, z)] = kind;
        open.push_back({{x, y, z}});
        while (!open.empty()) {
          const Place place = open.back();
          open.pop_back();
          for (int side = 0; side < 6; ++side) {
            Place next = place;
            int& moved = next.at[side / 2];
            moved += side % 2 == 0 ? 1 : -1;
            if (moved < 0 || moved >= size_[side / 2]) continue;
            std::uint8_t& cell = cells_[index(next.at[0], next.at[1], next.at[2])];
            if (cell <= kOutside) continue;
            cell = kind;
            open.push_back(next);
          }
        }
      }
    }
  }
}

SpreadVertices::SpreadVertices(const Modeld& mesh) {
  // The triangles' connected parts, by their shared vertices.
  std::vector<int> root(static_cast<std::size_t>(mesh.num_vertices));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::size_t v) {
    auto at = static_cast<int>(v);
    while (root[static_cast<std::size_t>(at)] != at) {
      int& up = root[static_cast<std::size_t>(at)];
      up = root[static_cast<std::size_t>(up)];
      at = up;
    }
    return at;
  };
  for (int t = 0; t < mesh.num_tris; ++t) {
    const fcl::Triangle& triangle = mesh.tri_indices[t];
    const int first = find(triangle[0]);
    for (int k = 1; k < 3; ++k) root[static_cast<std::size_t>(find(triangle[k]))] = first;
  }
  std::vector<int> sizes(root.size(), 0);
  for (int t = 0; t < mesh.num_tris; ++t) {
    ++sizes[static_cast<std::size_t>(find(mesh.tri_indices[t][0]))];
  }
  const auto largest =
      static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  std::vector<Vector3d> all;
  for (std::size_t v = 0; v < root.size(); ++v) {
    if (find(v) == largest) all.push_back(mesh.vertices[v]);
  }
  constexpr std::size_t kMostTried = 4096, kMost = 48;
  const std::size_t stride = all.size() / kMostTried + 1;
  std::vector<double> apart;  // of each that is tried, squared, from those taken
  for (std::size_t i = 0; i < all.size(); i += stride) {
    all[i / stride] = all[i];
    apart.push_back(std::numeric_limits<double>::infinity());
  }
  std::vector<Vector3d> taken;
  for (std::size_t next = 0; taken.size() < kMost && apart[next] > 0;) {
    taken.push_back(all[next]);
    for (std::size_t i = 0; i < apart.size(); ++i) {
      apart[i] = std::min(apart[i], (all[i] - all[next]).squaredNorm());
    }
    next = static_cast<std::size_t>(std::max_element(apart.begin(), apart.end()) - apart.begin());
  }
  for (const Vector3d& p : taken) {
    largest_ = std::max(largest_, p.cwiseAbs().maxCoeff());
    center_ += p / static_cast<double>(taken.size());
  }
  for (const Vector3d& p : taken) radius_ = std::max(radius_, 1.01 * (p - center_).norm());
  vertices_.resize((taken.size() + 3) / 4);
  for (std::size_t i = 0; i < 4 * vertices_.size(); ++i) {
    const Vector3d& p = taken[std::min(i, taken.size() - 1)];
    for (int c = 0; c < 3; ++c) vertices_[i / 4].at[c][i % 4] = static_cast<float>(p[c]);
  }
}

bool SpreadVertices::crosses(const InsideGrid& grid, const fcl::Transform3d& X) const {
  const Eigen::Matrix3d R = X.linear();
  if (grid.isFar(R * center_ + X.translation(), radius_)) return false;
  // Well within what queries take for rigid, and where coordinates of floats err by far less than
  // the tolerance.
  const double error = (R.transpose() * R - Eigen::Matrix3d::Identity()).squaredNorm();
  const double size = 3 * largest_ + X.translation().cwiseAbs().maxCoeff();
  if (!(error < 1e-10 && R.determinant() > 0 && size < 32 / kTolerance * grid.tolerance())) {
    return false;
  }
  const fcl::Transform3d to_cells = grid.toCells();
  const Eigen::Matrix3f turn = (to_cells.linear() * R).cast<float>();
  const Eigen::Vector3f shift = (to_cells * Vector3d(X.translation())).cast<float>();
  constexpr unsigned int kBoth = 1U << InsideGrid::kInside | 1U << InsideGrid::kOutside;
  unsigned int met = 0;
  for (const Points& p : vertices_) {
    Points moved;
    for (int c = 0; c < 3; ++c) {
      moved.at[c] = turn(c, 0) * p.at[0] + turn(c, 1) * p.at[1] + turn(c, 2) * p.at[2] + shift[c];
    }
    met |= grid.cellsAt(moved);
    if ((met & kBoth) == kBoth) return true;
  }
  return false;
}

}  // namespace kios::python
