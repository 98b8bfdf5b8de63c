// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/face_set.h"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

namespace kios {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Returns the corners in ascending order, and whether that turns the face.
std::pair<std::array<int, 3>, bool> sorted(std::array<int, 3> c) {
  bool odd = false;
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)}) {
    if (c[at(i)] <= c[at(j)]) continue;
    std::swap(c[at(i)], c[at(j)]);
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

int FaceSet::dropDoubles() {
  const std::size_t before = faces_.size();
  // The first face of each orientation stays.
  std::map<std::array<int, 3>, std::array<int, 2>> first;
  std::vector<bool> dropped(faces_.size(), false);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const auto [corners, odd] = sorted(faces_[f].corners);
    int& same = first.try_emplace(corners, std::array<int, 2>{-1, -1}).first->second[odd ? 1 : 0];
    if (same < 0) {
      same = static_cast<int>(f);
    } else {
      dropped[f] = true;
    }
  }
  take(dropped);

  // Faces and their backs. A back goes where all edges are open as it is, or where everything has
  // one and the fronts alone are closed.
  first.clear();
  std::vector<int> front(faces_.size(), -1);  // by back
  std::vector<bool> paired(faces_.size(), false);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const auto [found, is_new] = first.try_emplace(sorted(faces_[f].corners).first,
                                                   std::array<int, 2>{static_cast<int>(f), -1});
    if (is_new) continue;
    front[f] = found->second[0];
    paired[f] = paired[at(front[f])] = true;
  }
  const std::vector<Side> all = sides();
  const Parts parts = partsOf(all, faces_.size(), true);
  std::vector<bool> only_pairs(at(parts.count), true);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (!paired[f]) only_pairs[at(parts.of[f])] = false;
  }
  std::vector<int> open(faces_.size(), 0);  // edges of an odd number of faces, by face
  forEdges(all, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && (end - begin) % 2 == 1; ++i) ++open[at(all[i].triangle)];
    // Fronts and backs: an odd number of fronts leaves them open.
    if ((end - begin) % 4 != 0) only_pairs[at(parts.of[at(all[begin].triangle)])] = false;
  });
  dropped.assign(faces_.size(), false);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (front[f] >= 0) dropped[f] = open[f] == 3 || only_pairs[at(parts.of[f])];
  }
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
    links[at(a.triangle)].push_back({b.triangle, a.forward == b.forward});
    links[at(b.triangle)].push_back({a.triangle, a.forward == b.forward});
  });
  std::vector<int> turn(faces_.size(), -1);
  for (std::size_t first = 0; first < faces_.size(); ++first) {
    if (turn[first] >= 0) continue;
    // A surface that can't be oriented, such as a Moebius strip, keeps a seam.
    std::vector<int> patch = {static_cast<int>(first)};
    turn[first] = 0;
    std::size_t turned = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const Link& link : links[at(patch[i])]) {
        if (turn[at(link.to)] >= 0) continue;
        turn[at(link.to)] = turn[at(patch[i])] ^ (link.turned ? 1 : 0);
        turned += at(turn[at(link.to)]);
        patch.push_back(link.to);
      }
    }
    const int which = 2 * turned <= patch.size() ? 1 : 0;
    for (const int f : patch) {
      if (turn[at(f)] == which) flip(at(f));
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
  const std::size_t count = at(connected.count);
  std::vector<bool> closed(count, true);
  forEdges(all, [&](std::size_t begin, std::size_t end) {
    std::map<int, int> sums;  // of each part at the edge by itself
    for (std::size_t i = begin; i < end; ++i) {
      sums[part[at(all[i].triangle)]] += all[i].forward ? 1 : -1;
    }
    for (const auto& [p, sum] : sums) {
      if (sum != 0) closed[at(p)] = false;
    }
  });
  std::vector<Part> parts(count);
  std::vector<std::size_t> flipped(count, 0), given(count, 0);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const std::size_t p = at(part[f]);
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
