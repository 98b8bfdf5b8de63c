// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Clashes of a building, planted, beside the contacts that FCL's manager finds.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fcl/math/bv/OBBRSS.h>

#include "fcl_kios/fcl_kios.h"
#include "managed_bodies.h"
#include "scenario.h"
#include "scenes/cad_shapes.h"
#include "scenes/motions.h"
#include "scenes/random.h"
#include "scenes/shapes.h"

namespace kios::bench {
namespace {

using scenes::Mesh;
using Vec = fcl::Vector3d;
using Pair = std::pair<std::size_t, std::size_t>;

/// A box along the building's axes, or the pipe along x that it holds.
struct Element {
  Vec low, high;
  bool pipe = false;
};

/// The status of a pair, and its depth or distance if that is known.
struct Known {
  ClashStatus status;
  double measure = -1;
};

constexpr double kClearance = 0.05;

/// By arithmetic of boxes; pipes are far from all but where they are planted.
std::optional<Known> knownOf(const Element& a, const Element& b) {
  if (a.pipe || b.pipe) return std::nullopt;
  if ((a.low - b.low).lpNorm<Eigen::Infinity>() <= 1e-6 &&
      (a.high - b.high).lpNorm<Eigen::Infinity>() <= 1e-6) {
    return Known{ClashStatus::kDuplicate, (a.low - b.low).norm()};
  }
  const Vec gap = (a.low - b.high).cwiseMax(b.low - a.high);
  if (gap.maxCoeff() < -1e-6) {
    const auto in = [](const Element& x, const Element& y) {
      return (x.low - y.low).minCoeff() > 0 && (y.high - x.high).minCoeff() > 0;
    };
    if (in(a, b) || in(b, a)) return Known{ClashStatus::kInside};
    return Known{ClashStatus::kOverlap, -gap.maxCoeff()};
  }
  const double distance = gap.cwiseMax(0).norm();
  if (distance > kClearance) return std::nullopt;
  return distance <= 1e-6 ? Known{ClashStatus::kTouch} : Known{ClashStatus::kClearance, distance};
}

/// Rooms of a slab, a column, a wall and a pipe each, flush with their neighbours; in every tenth
/// something is wrong.
class Building {
 public:
  Building(int bays, int floors, std::uint64_t seed) {
    scenes::Random random(seed);
    int room = 0;
    for (int f = 0; f < floors; ++f) {
      for (int y = 0; y < bays; ++y) {
        for (int x = 0; x < bays; ++x, ++room) {
          addRoom({6.0 * x, 5.0 * y, 3.0 * f}, 3.0 * (f + 1), room % 10 == 9 ? room / 10 % 6 : -1,
                  random.uniform(0, 0.6));
        }
      }
    }
    for (std::size_t i = 0; i < elements.size(); ++i) {
      for (std::size_t j = i + 1; j < elements.size(); ++j) {
        if (const auto known = knownOf(elements[i], elements[j])) expected[{i, j}] = *known;
      }
    }
  }

  std::vector<Element> elements;
  std::map<Pair, Known> expected;

 private:
  void addRoom(const Vec& at, double top, int fault, double shift) {
    const double floor = at.z() + 0.2;
    const double sunk = fault == 0 ? 0.02 : 0;
    add(at, {6, 5, 0.2});
    elements.push_back({Vec(at.x(), at.y(), floor - sunk), Vec(at.x() + 0.4, at.y() + 0.4, top)});
    elements.push_back({Vec(at.x() + 0.4, at.y(), floor), Vec(at.x() + 6, at.y() + 0.15, top)});
    const Element wall = elements.back();
    add(Vec(at.x() + 1, at.y() + 2 + shift, floor + 2.2), {4, 0.2, 0.2});
    elements.back().pipe = true;
    const std::size_t pipe = elements.size() - 1;
    if (fault == 1) {  // the same wall, a hair away
      elements.push_back({wall.low + Vec(0, 3e-7, 0), wall.high + Vec(0, 3e-7, 0)});
    } else if (fault == 2) {  // an anchor cast into the slab
      add(at + Vec(3, 3, 0.06), {0.08, 0.08, 0.08});
    } else if (fault == 3) {  // a duct too near to the wall
      add(Vec(at.x() + 2, wall.high.y() + 0.03, floor + 1), {2, 0.3, 0.3});
    } else if (fault == 4) {  // a crate on the floor
      add(Vec(at.x() + 2, at.y() + 3.5, floor), {1, 0.7, 1});
    } else if (fault == 5) {  // a cupboard where the pipe goes
      add(Vec(at.x() + 2, at.y() + 1.8 + shift, floor), {0.5, 0.6, 2.5});
      expected[{pipe, elements.size() - 1}] = {ClashStatus::kOverlap};
    }
  }
  void add(const Vec& low, const Vec& size) { elements.push_back({low, low + size}); }
};

/// The elements as parts, turned and moved as one: equal ones share a model of each kind.
struct Parts {
  explicit Parts(const Building& building) {
    fcl::Transform3d site(Eigen::AngleAxisd(0.3, Vec::UnitZ()));
    site.translation() = Vec(1200, -340, 20);
    const Mesh pipe =
        scenes::moved(fcl::Transform3d(Eigen::Translation3d(-2, 0, 0) *
                                       Eigen::AngleAxisd(std::acos(0.0), Vec::UnitY())),
                      scenes::turnedPart({{0, 0}, {0.1, 0}, {0.1, 4}, {0, 4}}, 24));
    std::map<std::array<double, 3>, std::size_t> kinds;
    std::vector<std::shared_ptr<Modeld>> models;
    std::vector<std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>>> others;
    for (const Element& element : building.elements) {
      const Vec size = element.high - element.low;
      const auto [kind, fresh] =
          kinds.try_emplace({size.x(), size.y(), element.pipe ? 0 : size.z()}, models.size());
      if (fresh) {
        const Mesh mesh = element.pipe ? pipe : scenes::subdividedBox(size, 1);
        models.push_back(scenes::buildModel<kIOSd>(mesh));
        markSolid(*models.back());
        others.push_back(scenes::buildModel<fcl::OBBRSSd>(mesh));
      }
      ClashPart& part = parts.emplace_back();
      part.geometry = models[kind->second];
      part.X_WP = site * Eigen::Translation3d(0.5 * (element.low + element.high));
      part.name = std::to_string(parts.size());
      triangles += static_cast<std::size_t>(models[kind->second]->num_tris);
      ours.add(models[kind->second], fcl::Transform3d(part.X_WP));
      fcls.add(others[kind->second], fcl::Transform3d(part.X_WP));
    }
    ours.setup();
    fcls.setup();
  }

  std::vector<ClashPart> parts;
  ManagedBodies ours, fcls;
  std::size_t triangles = 0;
};

/// Pairs that the library misjudges, misses or makes up, leaves undecided, or brackets wrongly.
std::size_t wrongOf(const std::vector<ClashResult>& clashes, std::map<Pair, Known> expected) {
  constexpr double kRounding = 1e-9;  // of points at 1,200
  std::size_t wrong = 0;
  for (const ClashResult& clash : clashes) {
    const auto known = expected.find({clash.a, clash.b});
    if (known == expected.end()) {
      ++wrong;
      continue;
    }
    const auto [status, measure] = known->second;
    const bool bracketed =
        measure < 0 || (clash.lower <= measure + kRounding && clash.upper >= measure - kRounding);
    wrong += clash.status == status && clash.decided && bracketed ? 0 : 1;
    expected.erase(known);
  }
  return wrong + expected.size();
}

/// Contacts that are missed, or of pairs that are apart. Touches may be either, by rounding.
std::size_t wrongOf(const std::vector<Pair>& contacts, const std::map<Pair, Known>& expected) {
  std::size_t wrong = 0, clashing = 0;
  for (const auto& [pair, known] : expected) {
    clashing += known.status != ClashStatus::kTouch && known.status != ClashStatus::kClearance;
  }
  for (const Pair& pair : contacts) {
    const auto known = expected.find(pair);
    const bool apart = known == expected.end() || known->second.status == ClashStatus::kClearance;
    if (apart) ++wrong;
    if (!apart && known->second.status != ClashStatus::kTouch) --clashing;
  }
  return wrong + clashing;
}

void findContacts(ManagedBodies& bodies, std::vector<Pair>& contacts) {
  contacts.clear();
  bodies.collide([&](int a, int b) {
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    fcl::collide(bodies.object(a), bodies.object(b), request, result);
    if (result.isCollision()) contacts.emplace_back(std::min(a, b), std::max(a, b));
    return false;
  });
}

/// Brackets of one run that those of another contradict.
std::size_t contradictions(const std::vector<ClashResult>& x, const std::vector<ClashResult>& y) {
  if (x.size() != y.size()) return x.size() + y.size();
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    wrong += x[i].a != y[i].a || x[i].b != y[i].b || x[i].lower > y[i].upper ||
             y[i].lower > x[i].upper ||
             (x[i].decided && y[i].decided && x[i].status != y[i].status);
  }
  return wrong;
}

/// Time against the width of depths' brackets, by the pieces that a pair may take: of solids
/// at random poses, each in some others.
void reportPieces(const std::string& name, const Mesh& mesh, double half_width,
                  const Options& options, Report& report) {
  std::vector<ClashPart> parts;
  const auto model = scenes::buildModel<kIOSd>(mesh);
  markSolid(*model);
  Row base = baseRow("clashes/pieces/" + name, "clashes", 1);
  for (const fcl::Transform3d& X :
       scenes::randomPoses(options.quick ? 12 : 60, half_width, options.seed)) {
    ClashPart& part = parts.emplace_back();
    part.geometry = model;
    part.X_WP = X;
    part.name = std::to_string(parts.size());
    base.triangles += mesh.triangles.size();
  }
  const std::vector<long long> pieces = {0, 10, 30, 100, 300, 1000, 3000, 10000};
  std::vector<std::vector<ClashResult>> found(pieces.size());
  std::vector<Competitor> competitors;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    competitors.push_back({"kios", [&, i](std::size_t, std::size_t) {
                             ClashRequest request;
                             request.max_pieces = pieces[i];
                             found[i] = findClashes(parts, request);
                           }});
  }
  Race{1, options.repeats, Race::kAll, Race::kAll, true}.run(competitors);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    Row& row = rows.emplace_back(base.of(competitors[i]));
    std::size_t deep = 0, undecided = 0;
    double width = 0;
    for (const ClashResult& clash : found[i]) {
      undecided += clash.decided ? 0 : 1;
      if (!clash.deep || clash.status == ClashStatus::kTouch) continue;
      width += (clash.upper - clash.lower) / clash.upper;
      ++deep;
    }
    row.asked.budget = static_cast<double>(pieces[i]);
    row.errors.mean_rel = width / static_cast<double>(std::max<std::size_t>(1, deep));
    row.errors.undecided = undecided;
    row.errors.wrong = contradictions(found[i], found.back());
    row.bodies = parts.size();
    row.pairs.total = found[i].size();
  }
  report.add(rows);
}

}  // namespace

void runClashes(const Options& options, Report& report) {
  if (wanted(options, "pieces")) {
    reportPieces("balls", scenes::icosphere(0.5, options.quick ? 1 : 3), 1.2, options, report);
    reportPieces("tori", scenes::bumpyTorus(options.quick ? 100 : 400), 4, options, report);
  }
  struct Size {
    const char* part;
    int bays, floors;
  };
  for (const auto& [part, bays, floors] : {Size{"1000", 8, 4}, Size{"10000", 20, 6}}) {
    if (!wanted(options, part)) continue;
    const Building building(options.quick ? 4 : bays, options.quick ? 2 + floors / 2 : floors,
                            options.seed);
    Parts parts(building);
    ClashRequest request;
    request.clearance = kClearance;
    std::vector<ClashResult> clashes;
    std::vector<Pair> ours, fcls;
    std::vector<Competitor> competitors = {
        {"kios", [&](std::size_t, std::size_t) { clashes = findClashes(parts.parts, request); }},
        {"kios", [&](std::size_t, std::size_t) { findContacts(parts.ours, ours); }},
        {"fcl_manager", [&](std::size_t, std::size_t) { findContacts(parts.fcls, fcls); }}};
    Race{1, options.repeats, Race::kAll, Race::kAll, true}.run(competitors);
    Row base = baseRow(std::string("clashes/") + part, "contact", 1);
    base.triangles = parts.triangles;
    std::vector<Row> rows;
    for (const Competitor& competitor : competitors) rows.push_back(base.of(competitor));
    rows[0].query = "clashes";
    rows[0].bodies = parts.parts.size();
    rows[0].pairs.total = clashes.size();
    rows[0].errors.wrong = wrongOf(clashes, building.expected);
    rows[1].pairs.total = ours.size();
    rows[1].errors.wrong = wrongOf(ours, building.expected);
    rows[2].pairs.total = fcls.size();
    rows[2].errors.wrong = wrongOf(fcls, building.expected);
    report.add(rows);
  }
}

}  // namespace kios::bench
