// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/face_set.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <unordered_map>
#include <utility>

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

void FaceSet::take(const std::vector<bool>& dropped) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (!dropped[f]) faces_[kept++] = faces_[f];
  }
  faces_.resize(kept);
}

// The faces are a chain: each runs through its edges one way, and a surface is closed where as many
// run through an edge one way as the other. Copies have the same three corners. A patch of copies
// reaches as far as two and nothing else meet at an edge; with one face of each, wound to one side,
// it is closed within. Where that closes more than the copies do, one face of each stays.
int FaceSet::dropDoubles() {
  struct Edge {
    int sum = 0;  ///< of faces that pass it forward, less those that pass it backward
    std::vector<std::pair<std::size_t, int>> copies;  ///< and the way that the first face passes
    bool others = false;
  };
  struct Copies {
    std::vector<int> faces;
    std::vector<std::pair<std::size_t, int>> edges;  ///< likewise
    int sum = 0;  ///< of faces wound as the first one, less those that aren't
    int way = 0;  ///< in which one face would be wound relative to the first
  };
  std::map<std::array<int, 3>, std::size_t> by_corners;
  std::vector<Copies> all;
  std::vector<std::size_t> copies_of(faces_.size());
  const auto isOdd = [this](int f) { return sorted(faces_[index(f)].corners).second; };
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    copies_of[f] =
        by_corners.try_emplace(sorted(faces_[f].corners).first, all.size()).first->second;
    if (copies_of[f] == all.size()) all.emplace_back();
    Copies& copies = all[copies_of[f]];
    copies.faces.push_back(static_cast<int>(f));
    copies.sum += isOdd(copies.faces.front()) == isOdd(copies.faces.back()) ? 1 : -1;
  }
  std::vector<Edge> edges;
  const std::vector<Side> sides = this->sides();
  forEdges(sides, [&](std::size_t begin, std::size_t end) {
    Edge& edge = edges.emplace_back();
    for (std::size_t i = begin; i < end; ++i) {
      const int passes = sides[i].forward ? 1 : -1, f = sides[i].triangle;
      Copies& copies = all[copies_of[index(f)]];
      edge.sum += passes;
      edge.others |= copies.faces.size() == 1;
      if (copies.faces.front() != f) continue;
      copies.edges.emplace_back(edges.size() - 1, passes);
      if (copies.faces.size() > 1) edge.copies.emplace_back(copies_of[index(f)], passes);
    }
  });
  // Faces that all have backs enclose nothing: then the fronts stay.
  const bool hollow =
      std::all_of(all.begin(), all.end(), [](const Copies& copies) { return copies.sum == 0; });
  std::vector<bool> dropped(faces_.size(), false);
  for (std::size_t first = 0; first < all.size(); ++first) {
    if (all[first].faces.size() == 1 || all[first].way != 0) continue;
    std::vector<std::size_t> patch = {first};
    std::map<std::size_t, std::array<int, 2>> sums;  // of its copies, and of one face of each
    bool oriented = true, has_border = false;
    all[first].way = 1;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const Copies& copies = all[patch[i]];
      for (const auto& [e, passes] : copies.edges) {
        sums[e][0] += copies.sum * passes;
        sums[e][1] += copies.way * passes;
        const auto& there = edges[e].copies;
        if (there.size() != 2 || edges[e].others) {
          has_border = true;
          continue;
        }
        const auto& [next, next_passes] = there[there[0].first == patch[i] ? 1 : 0];
        const int way = -copies.way * passes * next_passes;
        oriented &= all[next].way == 0 || all[next].way == way;
        if (all[next].way == 0) patch.push_back(next);
        all[next].way = way;
      }
    }
    const auto openWith = [&](int k) {  // one face of each, turned or not; 0: as they are
      int open = 0;
      for (const auto& [e, sum] : sums) {
        open += std::abs(edges[e].sum + (k == 0 ? 0 : k * sum[1] - sum[0]));
      }
      return open;
    };
    const int k = openWith(-1) < openWith(1) ? -1 : 1;
    if (!oriented || (openWith(k) >= openWith(0) && (!hollow || has_border))) continue;
    for (const auto& [e, sum] : sums) edges[e].sum += k * sum[1] - sum[0];
    for (const std::size_t c : patch) {
      // The first face that is wound so stays; if none is, the first one, to be turned.
      const std::vector<int>& faces = all[c].faces;
      const auto wound = std::find_if(faces.begin(), faces.end(), [&](int f) {
        return (isOdd(f) == isOdd(faces.front())) == (all[c].way == k);
      });
      for (const int f : faces) dropped[index(f)] = true;
      dropped[index(wound == faces.end() ? faces.front() : *wound)] = false;
    }
  }
  const std::size_t before = faces_.size();
  take(dropped);
  return static_cast<int>(before - faces_.size());
}

void FaceSet::flip(std::size_t face) {
  std::swap(faces_[face].corners[1], faces_[face].corners[2]);
  faces_[face].flipped = !faces_[face].flipped;
}

void FaceSet::fill(const std::array<int, 3>& corners) { faces_.push_back({corners, -1}); }

void FaceSet::turnNeighbours() {
  struct Link {
    int to;
    bool turned;  ///< the two faces run through their edge the same way
  };
  std::vector<std::vector<Link>> links(faces_.size());
  const std::vector<Side> all = sides();
  forEdges(all, [&](std::size_t begin, std::size_t end) {
    if (end - begin != 2) return;
    const Side &a = all[begin], &b = all[begin + 1];
    links[index(a.triangle)].push_back({b.triangle, a.forward == b.forward});
    links[index(b.triangle)].push_back({a.triangle, a.forward == b.forward});
  });
  std::vector<int> turn(faces_.size(), -1);
  for (std::size_t first = 0; first < faces_.size(); ++first) {
    if (turn[first] >= 0) continue;
    // A surface that can't be oriented, such as a Moebius strip, keeps a seam.
    std::vector<int> patch = {static_cast<int>(first)};
    turn[first] = 0;
    std::size_t turned = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const Link& link : links[index(patch[i])]) {
        if (turn[index(link.to)] >= 0) continue;
        turn[index(link.to)] = turn[index(patch[i])] ^ (link.turned ? 1 : 0);
        turned += index(turn[index(link.to)]);
        patch.push_back(link.to);
      }
    }
    const int which = 2 * turned <= patch.size() ? 1 : 0;
    for (const int f : patch) {
      if (turn[index(f)] == which) flip(index(f));
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
  const Parts connected = partsOf(all, faces_.size(), across_branches);
  const std::vector<int>& part = connected.of;
  const std::size_t count = index(connected.count);
  std::vector<bool> closed(count, true);
  forEdges(all, [&](std::size_t begin, std::size_t end) {
    std::map<int, int> sums;  // of each part at the edge by itself
    for (std::size_t i = begin; i < end; ++i) {
      sums[part[index(all[i].triangle)]] += all[i].forward ? 1 : -1;
    }
    for (const auto& [p, sum] : sums) {
      if (sum != 0) closed[index(p)] = false;
    }
  });
  std::vector<Part> parts(count);
  std::vector<std::size_t> flipped(count, 0), given(count, 0);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const std::size_t p = index(part[f]);
    parts[p].faces.push_back(static_cast<int>(f));
    if (faces_[f].given < 0) continue;
    ++given[p];
    flipped[p] += faces_[f].flipped ? 1 : 0;
  }
  std::vector<Part> result;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (!closed[p]) continue;
    parts[p].as_given = flipped[p] == 0 || flipped[p] == given[p];
    result.push_back(std::move(parts[p]));
  }
  return result;
}

}  // namespace kios
