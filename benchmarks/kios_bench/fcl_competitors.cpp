// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <stdexcept>

#include <fcl/math/bv/OBB.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/math/bv/RSS.h>
#include <fcl/math/bv/kIOS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include "mesh_set.h"
#include "node_queries.h"
#include "shape_competitor.h"

namespace kios::bench {
namespace {

namespace nodes = fcl::detail;

// FCL's own functions: this file must not see the overloads of our header.
struct FclQueries {
  static void distance(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                       const fcl::DistanceRequestd& request, fcl::DistanceResultd& result) {
    fcl::distance(a, b, request, result);
  }
  static void collide(const fcl::CollisionObjectd* a, const fcl::CollisionObjectd* b,
                      const fcl::CollisionRequestd& request, fcl::CollisionResultd& result) {
    fcl::collide(a, b, request, result);
  }
  static std::nullptr_t fitter() { return nullptr; }
  static std::optional<std::string> simdTarget() { return std::nullopt; }
};

struct ObbrssTraits : FclQueries,
                      CountedByNodes<nodes::MeshDistanceTraversalNodeOBBRSSd,
                                     nodes::MeshCollisionTraversalNodeOBBRSSd> {
  using BV = fcl::OBBRSSd;
  static constexpr const char* kName = "fcl_obbrss";
};

struct BuiltinKiosTraits : FclQueries,
                           CountedByNodes<nodes::MeshDistanceTraversalNodekIOSd,
                                          nodes::MeshCollisionTraversalNodekIOSd> {
  using BV = fcl::kIOSd;
  static constexpr const char* kName = "fcl_kios_builtin";
};

// fcl::collide copies, transforms and rebuilds both RSS models at every query.
struct RssTraits : FclQueries, CountedByNodes<nodes::MeshDistanceTraversalNodeRSSd, NoNode> {
  using BV = fcl::RSSd;
  static constexpr const char* kName = "fcl_rss";
};

// Both queries of RSS in the models as they are, by FCL's own nodes.
struct RssTreeTraits
    : NodeQueries<nodes::MeshDistanceTraversalNodeRSSd, nodes::MeshCollisionTraversalNodeRSSd> {
  using BV = fcl::RSSd;
  static constexpr const char* kName = "fcl_rss_tree";
  static std::nullptr_t fitter() { return nullptr; }
};

// FCL has no distance between OBBs.
struct ObbTraits : FclQueries, CountedByNodes<NoNode, nodes::MeshCollisionTraversalNodeOBBd> {
  using BV = fcl::OBBd;
  static constexpr const char* kName = "fcl_obb";
};

template <typename Traits>
std::unique_ptr<Competitor> makeFclCompetitor() {
  return std::make_unique<MeshSet<Traits>>();
}

struct Entry {
  const char* name;
  std::unique_ptr<Competitor> (*make)();
  bool by_default = true;
};

constexpr Entry kCompetitors[] = {
    {"kios", makeKiosCompetitor},
    {BuiltinKiosTraits::kName, makeFclCompetitor<BuiltinKiosTraits>},
    {RssTraits::kName, makeFclCompetitor<RssTraits>},
    {ObbrssTraits::kName, makeFclCompetitor<ObbrssTraits>},
    {ObbTraits::kName, makeFclCompetitor<ObbTraits>},
    {"kios_tree", makeKiosTreeCompetitor, false},
    {"kios_method_ii", makeMethodTwoCompetitor, false},
    {RssTreeTraits::kName, makeFclCompetitor<RssTreeTraits>, false},
};

}  // namespace

std::unique_ptr<ShapeCompetitor> makeObbrssShapeCompetitor() {
  return std::make_unique<MeshAndShape<ObbrssTraits>>();
}

const char* name(Query query) {
  switch (query) {
    case Query::kDistance:
      return "distance";
    case Query::kCollide:
      return "collide";
    case Query::kThreshold:
      return "threshold";
    case Query::kBuild:
      return "build";
    case Query::kPrepare:
      return "prepare";
    case Query::kRefit:
      return "refit";
  }
  return "";
}

std::vector<std::string> competitorNames() {
  std::vector<std::string> names;
  for (const Entry& entry : kCompetitors) names.emplace_back(entry.name);
  return names;
}

std::vector<std::string> defaultCompetitorNames() {
  std::vector<std::string> names;
  for (const Entry& entry : kCompetitors) {
    if (entry.by_default) names.emplace_back(entry.name);
  }
  return names;
}

std::unique_ptr<Competitor> makeCompetitor(const std::string& name) {
  for (const Entry& entry : kCompetitors) {
    if (name == entry.name) return entry.make();
  }
  throw std::invalid_argument("no bounding volume is called '" + name + "'; see --list");
}

}  // namespace kios::bench
