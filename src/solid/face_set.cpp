// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/face_set.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <unordered_map>
#include <utility>

#include <Eigen/Geometry>
#include "volume/rounding.h"

namespace kios {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// Returns the corners in ascending order, and whether that turns the face.
std::pair<std::array<int, 3>, bool> sorted(std::array<int, 3> c) {
  bool odd = false;
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)}) {
    if (c[index(i)] <= c[index(j)]) continue;
    std::swap(c[index(i)], c[index(j)]);
    odd = !odd;
  }
  return {c, odd};
}

}  // namespace

FaceSet::FaceSet(const std::vector<fcl::Triangle>& triangles, const std::vector<int>& by) {
  faces_.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const fcl::Triangle& given = triangles[t];
    const std::array<int, 3> c = {by[given[0]], by[given[1]], by[given[2]]};
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) {
      ++degenerate_;
    } else {
      faces_.push_back({c, static_cast<int>(t)});
    }
  }
}

std::vector<Side> FaceSet::sides() const {
  return sidesOf(faces_.size(), [this](std::size_t f) { return faces_[f].corners; });
}

// The faces are a chain: each runs through its edges one way, and a surface is closed where as many
// run through an edge one way as the other. Copies have the same three corners. A patch of copies
// reaches as far as two and nothing else meet at an edge; with one face of each, wound to one side,
// it is closed within. Where that closes more than the copies do, one face of each stays.
int FaceSet::dropDoubles() {
  // What belongs to some copies is kept with the first of them.
  std::map<std::array<int, 3>, std::size_t> by_corners;
  std::vector<std::vector<int>> copies(faces_.size());
  std::vector<int> sum(faces_.size(), 0);  // of copies wound as the first one, less the others
  std::vector<std::size_t> first_of;
  const auto isOdd = [this](int f) { return sorted(faces_[index(f)].corners).second; };
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    first_of.push_back(by_corners.try_emplace(sorted(faces_[f].corners).first, f).first->second);
    std::vector<int>& alike = copies[first_of.back()];
    alike.push_back(static_cast<int>(f));
    sum[first_of.back()] += isOdd(alike.front()) == isOdd(alike.back()) ? 1 : -1;
  }
  struct Edge {
    int sum = 0;  ///< of faces that pass it forward, less those that pass it backward
    bool within_patch = false;
  };
  std::vector<Edge> edges;
  std::vector<std::vector<std::pair<std::size_t, int>>> passes(faces_.size());  // edge and way
  std::vector<Side> joints;  // of the first of copies, where two and nothing else meet
  const std::vector<Side> sides = this->sides();
  forEdges(sides, [&](std::size_t begin, std::size_t end) {
    Edge& edge = edges.emplace_back();
    std::vector<Side> firsts;
    edge.within_patch = true;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t f = index(sides[i].triangle);
      const int way = sides[i].forward ? 1 : -1;
      edge.sum += way;
      edge.within_patch &= copies[first_of[f]].size() > 1;
      if (first_of[f] != f) continue;
      firsts.push_back(sides[i]);
      passes[f].emplace_back(edges.size() - 1, way);
    }
    edge.within_patch &= firsts.size() == 2;
    if (edge.within_patch) joints.insert(joints.end(), firsts.begin(), firsts.end());
  });
  Parts parts = partsOf(joints, faces_.size(), false);
  // Faces that all have backs enclose nothing: then the fronts stay.
  bool hollow = true;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    hollow &= copies[f].empty() || sum[f] == 0;
    if (copies[f].size() > 1 && parts.of[f] < 0) parts.triangles.push_back({static_cast<int>(f)});
  }
  std::sort(parts.triangles.begin(), parts.triangles.end());
  std::vector<bool> dropped(faces_.size(), false);
  for (const std::vector<int>& patch : parts.triangles) {
    std::map<std::size_t, std::array<int, 2>> sums;  // of its copies, and of one face of each
    bool oriented = true, has_border = false;
    for (const int f : patch) {
      for (const auto& [e, way] : passes[index(f)]) {
        sums[e][0] += sum[index(f)] * way;
        sums[e][1] += parts.turned[index(f)] ? -way : way;
        has_border |= !edges[e].within_patch;
      }
    }
    int open[3] = {0, 0, 0};  // with one face of each, turned or not; 1: as they are
    for (const auto& [e, both] : sums) {
      oriented &= !edges[e].within_patch || both[1] == 0;
      const int others = edges[e].sum - both[0];
      open[0] += std::abs(others - both[1]);
      open[1] += std::abs(edges[e].sum);
      open[2] += std::abs(others + both[1]);
    }
    const int k = open[0] < open[2] ? -1 : 1;
    if (!oriented || (open[1 + k] >= open[1] && (!hollow || has_border))) continue;
    for (const auto& [e, both] : sums) edges[e].sum += k * both[1] - both[0];
    for (const int first : patch) {
      // The first face that is wound so stays; if none is, the first one, to be turned.
      const std::vector<int>& alike = copies[index(first)];
      const bool as_first = parts.turned[index(first)] == (k < 0);
      const auto wound = std::find_if(alike.begin(), alike.end(), [&](int f) {
        return (isOdd(f) == isOdd(first)) == as_first;
      });
      for (const int f : alike) dropped[index(f)] = true;
      dropped[index(wound == alike.end() ? first : *wound)] = false;
    }
  }
  std::size_t kept = 0;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (!dropped[f]) faces_[kept++] = faces_[f];
  }
  const std::size_t before = faces_.size();
  faces_.resize(kept);
  return static_cast<int>(before - kept);
}

void FaceSet::flip(std::size_t face) {
  std::swap(faces_[face].corners[1], faces_[face].corners[2]);
  faces_[face].flipped = !faces_[face].flipped;
}

void FaceSet::fill(const std::array<int, 3>& corners) { faces_.push_back({corners, -1}); }

// A surface that can't be oriented, such as a Moebius strip, keeps a seam.
void FaceSet::turnNeighbours() {
  const Parts parts = partsOf(sides(), faces_.size(), false);
  for (const std::vector<int>& part : parts.triangles) {
    const auto isTurned = [&](int f) { return parts.turned[index(f)]; };
    const auto turned = std::count_if(part.begin(), part.end(), isTurned);
    const bool fewer = 2 * static_cast<std::size_t>(turned) <= part.size();
    for (const int f : part) {
      if (isTurned(f) == fewer) flip(index(f));
    }
  }
}

std::vector<std::vector<int>> FaceSet::holes() const {
  // A hole passes an edge against the face.
  std::multimap<int, int> next;
  const std::vector<Side> all = sides();
  forEdges(all, [&](std::size_t begin, std::size_t end) {
    if (end - begin != 1) return;
    const Side& s = all[begin];
    if (s.forward) {
      next.emplace(s.high, s.low);
    } else {
      next.emplace(s.low, s.high);
    }
  });
  std::vector<std::vector<int>> holes;
  std::unordered_map<int, std::size_t> place;  // on the way
  while (!next.empty()) {
    // Where the way comes back to a vertex, it has been round a hole.
    std::vector<int> way = {next.begin()->first};
    place = {{way.front(), 0}};
    while (!way.empty()) {
      const auto step = next.find(way.back());
      if (step == next.end()) {  // the way's start, or an end, where faces aren't oriented
        place.erase(way.back());
        way.pop_back();
        continue;
      }
      const int to = step->second;
      next.erase(step);
      const auto [seen, is_new] = place.try_emplace(to, way.size());
      if (is_new) {
        way.push_back(to);
        continue;
      }
      const std::size_t begin = seen->second;
      holes.emplace_back(way.begin() + static_cast<std::ptrdiff_t>(begin), way.end());
      for (std::size_t i = begin + 1; i < way.size(); ++i) place.erase(way[i]);
      way.resize(begin + 1);
    }
  }
  return holes;
}

std::vector<FaceSet::Part> FaceSet::closedParts(bool across_branches) const {
  const std::vector<Side> all = sides();
  Parts parts = partsOf(all, faces_.size(), across_branches);
  std::vector<bool> closed(parts.triangles.size(), true);
  forEdges(all, [&](std::size_t begin, std::size_t end) {
    std::map<int, int> sums;  // of each part at the edge by itself
    for (std::size_t i = begin; i < end; ++i) {
      sums[parts.of[index(all[i].triangle)]] += all[i].forward ? 1 : -1;
    }
    for (const auto& [p, sum] : sums) {
      if (sum != 0) closed[index(p)] = false;
    }
  });
  std::vector<Part> result;
  for (std::size_t p = 0; p < closed.size(); ++p) {
    if (!closed[p]) continue;
    std::size_t flipped = 0, given = 0;
    for (const int f : parts.triangles[p]) {
      const Face& face = faces_[index(f)];
      given += face.given >= 0 ? 1 : 0;
      flipped += face.given >= 0 && face.flipped ? 1 : 0;
    }
    result.push_back({std::move(parts.triangles[p]), flipped == 0 || flipped == given});
  }
  return result;
}

double perimeterOf(const std::vector<fcl::Vector3d>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    sum += (corners[(i + 1) % corners.size()] - corners[i]).stableNorm();
  }
  return sum;
}

std::vector<std::array<int, 3>> fillHole(const std::vector<fcl::Vector3d>& corners,
                                         const std::function<bool(int, int)>& avoid) {
  const std::size_t n = corners.size();
  // Areas are in parts of the perimeter's square, so that they are below 1 and don't vanish.
  const double perimeter = perimeterOf(corners);
  const double unit = perimeter > 0 ? 1 / perimeter : 0;
  const auto area = [&](std::size_t i, std::size_t j, std::size_t k) {
    const fcl::Vector3d u = (corners[j] - corners[i]) * unit, v = (corners[k] - corners[i]) * unit;
    return u.cross(v).norm();
  };
  constexpr double kAvoided = 1e6;
  // least[i n + j]: of the part that the diagonal from i to j cuts off, by way of the corner
  // middle.
  std::vector<double> least(n * n, 0);
  std::vector<std::size_t> middle(n * n, 0);
  for (std::size_t span = 2; span < n; ++span) {
    for (std::size_t i = 0; i + span < n; ++i) {
      const std::size_t j = i + span;
      double best = kInfinity;
      for (std::size_t m = i + 1; m < j; ++m) {
        const double sum = least[i * n + m] + least[m * n + j] + area(i, m, j);
        if (!(sum < best)) continue;
        best = sum;
        middle[i * n + j] = m;
      }
      const bool diagonal = span + 1 < n;
      if (diagonal && avoid(static_cast<int>(i), static_cast<int>(j))) best += kAvoided;
      least[i * n + j] = best;
    }
  }
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, n - 1}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j - i < 2) continue;
    const std::size_t m = middle[i * n + j];
    triangles.push_back({static_cast<int>(i), static_cast<int>(m), static_cast<int>(j)});
    open.emplace_back(m, j);
    open.emplace_back(i, m);
  }
  return triangles;
}

}  // namespace kios
