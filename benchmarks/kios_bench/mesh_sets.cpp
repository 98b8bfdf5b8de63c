// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include <fcl/math/bv/OBB.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/math/bv/RSS.h>
#include <fcl/math/bv/kIOS.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/distance/mesh_distance_traversal_node.h>

#include "fcl_kios/paper.h"
#include "library.h"
#include "mesh_set_of.h"

namespace kios::bench {
namespace {

namespace nodes = fcl::detail;

template <typename BV, typename Calls, typename DistanceNode, typename CollisionNode>
std::unique_ptr<MeshSet> make(
    std::shared_ptr<fcl::detail::BVFitterBase<BV>> (*make_fitter)() = nullptr) {
  return std::make_unique<MeshSetOf<BV, Calls, DistanceNode, CollisionNode>>(make_fitter);
}

using RssDistance = nodes::MeshDistanceTraversalNodeRSSd;
using RssCollision = nodes::MeshCollisionTraversalNodeRSSd;

struct Entry {
  const char* name;
  std::unique_ptr<MeshSet> (*make)();
  bool by_default = true;
};

constexpr Entry kVolumes[] = {
    {kOurs, [] { return libraryOf(kOurs).mesh_set(); }},
    // Takes a hundred times OBBRSS's time.
    {"fcl_kios_builtin",
     [] {
       return make<fcl::kIOSd, FclCalls, nodes::MeshDistanceTraversalNodekIOSd,
                   nodes::MeshCollisionTraversalNodekIOSd>();
     },
     false},
    // fcl::collide copies, transforms and rebuilds both RSS models at every query.
    {"fcl_rss", [] { return make<fcl::RSSd, FclCalls, RssDistance, void>(); }},
    {"fcl_obbrss",
     [] {
       return make<fcl::OBBRSSd, FclCalls, nodes::MeshDistanceTraversalNodeOBBRSSd,
                   nodes::MeshCollisionTraversalNodeOBBRSSd>();
     }},
    // FCL has no distance between OBBs.
    {"fcl_obb",
     [] { return make<fcl::OBBd, FclCalls, void, nodes::MeshCollisionTraversalNodeOBBd>(); }},
    // FCL's binary trees by their nodes: the tuned fit, the paper's Method II as published, RSS.
    {kOurTree, [] { return libraryOf(kOurTree).tree_set(); }, false},
    {"kios_method_ii",
     [] {
       return makeKiosTree([]() -> std::shared_ptr<fcl::detail::BVFitterBase<kIOSd>> {
         return std::make_shared<PaperFitter<double>>(FitMethod::kMethodII);
       });
     },
     false},
    {"fcl_rss_tree",
     [] {
       return make<fcl::RSSd, NodeCalls<fcl::RSSd, RssDistance, RssCollision>, RssDistance,
                   RssCollision>();
     },
     false},
#ifdef KIOS_HAVE_COAL
    {kCoal, makeCoalSet, false},
#endif
};

}  // namespace

const char* name(Query query) {
  constexpr const char* kNames[] = {"distance",    "collide", "contacts",
                                    "closer_than", "build",   "refit"};
  return kNames[static_cast<int>(query)];
}

std::vector<std::string> volumeNames() {
  std::vector<std::string> names;
  for (const Entry& entry : kVolumes) names.emplace_back(entry.name);
  return names;
}

std::vector<std::string> defaultVolumeNames() {
  std::vector<std::string> names;
  for (const Entry& entry : kVolumes) {
    if (entry.by_default) names.emplace_back(entry.name);
  }
  return names;
}

std::unique_ptr<MeshSet> makeMeshSet(const std::string& name) {
  if (isBefore(name)) {
    const Library& library = libraryOf(name);
    return isOurs(name) ? library.mesh_set() : library.tree_set();
  }
  for (const Entry& entry : kVolumes) {
    if (name == entry.name) return entry.make();
  }
  throw std::invalid_argument("no bounding volume is called '" + name + "'; see --list");
}

}  // namespace kios::bench
