// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// fcl::collide and fcl::distance of a mesh over k-IOS and an octree: against brute force over all
// cells and triangles in long double, in both orders, and against FCL's OBBRSS where it is right.

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include <fcl/geometry/octree/octree.h>

#include "fcl/mesh_cases.h"
#include "scalars.h"
#include "scenes/random.h"

namespace kios::testing {
namespace {

using Real = long double;
using scenes::ExactPoint;
using scenes::ExactTriangle;
using CellTriangle = std::pair<std::intptr_t, int>;

constexpr double kOccupied = 0.9, kUncertain = 0.6, kFree = 0.1;

/// Returns random cells of `kinds`: occupied, uncertain and free ones. Some are merged to larger
/// cells.
std::shared_ptr<octomap::OcTree> randomTree(double resolution, int cells, std::uint64_t seed,
                                            bool occupied_only) {
  auto tree = std::make_shared<octomap::OcTree>(resolution);
  scenes::Random random(seed);
  const auto coordinate = [&] { return static_cast<float>(random.uniform(-1, 1)); };
  for (int i = 0; i < cells; ++i) {
    const octomap::point3d p(coordinate(), coordinate(), coordinate());
    const double kind = occupied_only ? 0 : random.unit();
    const double occupancy = kind < 0.6 ? kOccupied : (kind < 0.8 ? kUncertain : kFree);
    tree->setNodeValue(p, octomap::logodds(occupancy), true);
  }
  const float r = static_cast<float>(resolution);
  for (int i = 0; i < 64; ++i) {  // a block that prune() merges
    const octomap::point3d p((0.5F + float(i % 4)) * r, (0.5F + float(i / 4 % 4)) * r,
                             (0.5F + float(i / 16)) * r);
    tree->setNodeValue(p, octomap::logodds(kOccupied), true);
  }
  tree->updateInnerOccupancy();
  tree->prune();
  return tree;
}

/// Holds a leaf of the octree, its query cell id, and its box in the octree's frame.
struct Leaf {
  std::intptr_t id;
  Vector3d center, half;
};

template <typename S>
std::vector<Leaf> occupiedLeaves(const fcl::OcTree<S>& octree, const octomap::OcTree& tree) {
  std::vector<Leaf> leaves;
  for (auto it = tree.begin_leafs(), end = tree.end_leafs(); it != end; ++it) {
    if (!octree.isNodeOccupied(&*it)) continue;
    leaves.push_back({&*it - octree.getRoot(), Vector3d(it.getX(), it.getY(), it.getZ()),
                      Vector3d::Constant(it.getSize() / 2)});
  }
  return leaves;
}

/// Returns the distance of a triangle and a full box, both in the box's frame.
Real boxDistance(const ExactPoint& half, const ExactTriangle& t) {
  for (const ExactPoint& p : t) {
    if ((p.cwiseAbs() - half).maxCoeff() <= 0) return 0;
  }
  Real least = std::numeric_limits<Real>::max();
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const Real side : {Real(-1), Real(1)}) {
      ExactPoint c[4];
      for (int i = 0; i < 4; ++i) {
        c[i][axis] = side * half[axis];
        c[i][u] = (i == 1 || i == 2 ? 1 : -1) * half[u];
        c[i][v] = (i >= 2 ? 1 : -1) * half[v];
      }
      least = std::min({least, scenes::triangleDistance(t, {c[0], c[1], c[2]}),
                        scenes::triangleDistance(t, {c[0], c[2], c[3]})});
    }
  }
  return least;
}

/// All that meets, and the least distance.
struct OctreeAnswer {
  std::set<CellTriangle> meeting;
  Real distance = std::numeric_limits<Real>::max();
};

template <typename S>
OctreeAnswer bruteForce(const std::vector<Leaf>& leaves, const fcl::Transform3<S>& X_WO,
                        const Mesh& mesh, const fcl::Transform3<S>& X_WM) {
  OctreeAnswer answer;
  const auto R_WO = X_WO.linear().template cast<Real>();
  const auto R_WM = X_WM.linear().template cast<Real>();
  for (std::size_t j = 0; j < mesh.triangles.size(); ++j) {
    ExactTriangle t;
    const auto c = corners(mesh, static_cast<std::intptr_t>(j));
    for (int k = 0; k < 3; ++k) {
      t[k] =
          R_WO.transpose() *
          (R_WM * c[k].template cast<S>().template cast<Real>() +
           (X_WM.translation().template cast<Real>() - X_WO.translation().template cast<Real>()));
    }
    const ExactPoint middle = (t[0] + t[1] + t[2]) / 3;
    const Real radius =
        std::max({(t[0] - middle).norm(), (t[1] - middle).norm(), (t[2] - middle).norm()});
    for (const Leaf& leaf : leaves) {
      const ExactPoint center = leaf.center.cast<Real>(), half = leaf.half.cast<Real>();
      const Real apart = (middle - center).norm() - radius - half.norm();
      if (apart > 0 && apart >= answer.distance) continue;
      const Real d = boxDistance(
          half, {ExactPoint(t[0] - center), ExactPoint(t[1] - center), ExactPoint(t[2] - center)});
      answer.distance = std::min(answer.distance, d);
      if (d == 0) answer.meeting.emplace(leaf.id, static_cast<int>(j));
    }
  }
  return answer;
}

KIOS_SCALAR_SUITE(Octree);

TYPED_TEST(Octree, EqualsBruteForce) {
  using S = TypeParam;
  constexpr bool kDouble = std::is_same_v<S, double>;
  int apart = 0, touching = 0;
  for (const Mesh& mesh : {scenes::bumpyTorus(160), scenes::randomSoup(40, 1, 1e-2, 1, 3)}) {
    const auto model = scenes::buildModel<kIOS<S>>(mesh);
    for (int i = 0; i < 10; ++i) {
      const auto tree = randomTree(0.125, 40, 7 + i, i % 2 == 0);
      const fcl::OcTree<S> octree(tree);
      const auto leaves = occupiedLeaves(octree, *tree);
      const Vector3d offset = i % 5 == 4 && kDouble ? Vector3d(1e9, -1e9, 3e8) : Vector3d(0, 0, 0);
      const Frame frame = randomFrames(1, i % 2 == 0 ? 0.6 : 2, 30 + i, offset).front();
      const fcl::Transform3<S> X_WO(frame.X_WA.cast<S>()), X_WM(frame.X_WB.cast<S>());
      const OctreeAnswer expected = bruteForce(leaves, X_WO, mesh, X_WM);
      const fcl::CollisionGeometry<S>*o = &octree, *m = model.get();

      for (const bool turned : {false, true}) {
        const fcl::DistanceRequest<S> request(true);
        fcl::DistanceResult<S> result;
        const S d = turned ? fcl::distance(m, X_WM, o, X_WO, request, result)
                           : fcl::distance(o, X_WO, m, X_WM, request, result);
        EXPECT_EQ(d, result.min_distance);
        EXPECT_NEAR(d, static_cast<double>(expected.distance), kDouble ? 1e-14 : 2e-6);
        EXPECT_EQ(result.o1, o);
        EXPECT_EQ(result.o2, m);
        const double world = (kDouble ? 1e-15 : 1e-6) * (X_WO.translation().norm() + 10);
        EXPECT_NEAR((result.nearest_points[0] - result.nearest_points[1]).norm(), d, world);
        EXPECT_LE(distanceToTriangle(result.nearest_points[1].template cast<double>(),
                                     X_WM.template cast<double>(), mesh, result.b2),
                  world);
        const auto leaf = std::find_if(leaves.begin(), leaves.end(),
                                       [&](const Leaf& l) { return l.id == result.b1; });
        ASSERT_NE(leaf, leaves.end());
        const fcl::Vector3<S> local =
            X_WO.linear().transpose() * (result.nearest_points[0] - X_WO.translation());
        EXPECT_LE(
            ((local.template cast<double>() - leaf->center).cwiseAbs() - leaf->half).maxCoeff(),
            2 * world);
        ++(d > 0 ? apart : touching);

        for (const bool enable_contact : {false, true}) {
          const fcl::CollisionRequest<S> all(kAllContacts, enable_contact);
          fcl::CollisionResult<S> contacts;
          turned ? fcl::collide(m, X_WM, o, X_WO, all, contacts)
                 : fcl::collide(o, X_WO, m, X_WM, all, contacts);
          std::set<CellTriangle> found;
          for (std::size_t c = 0; c < contacts.numContacts(); ++c) {
            const auto& contact = contacts.getContact(c);
            EXPECT_EQ(contact.o1, o);
            EXPECT_EQ(contact.o2, m);
            EXPECT_TRUE(found.emplace(contact.b1, static_cast<int>(contact.b2)).second);
            if (!enable_contact) continue;
            EXPECT_NEAR(contact.normal.norm(), 1, 1e-6);
            EXPECT_GE(contact.penetration_depth, 0);
          }
          EXPECT_EQ(found, expected.meeting);
          for (const std::size_t limit : {1U, 2U}) {
            fcl::CollisionResult<S> few;
            const fcl::CollisionRequest<S> few_wanted(limit, enable_contact);
            turned ? fcl::collide(m, X_WM, o, X_WO, few_wanted, few)
                   : fcl::collide(o, X_WO, m, X_WM, few_wanted, few);
            EXPECT_EQ(few.numContacts(), std::min(limit, found.size()));
          }
        }
      }
    }
  }
  EXPECT_GT(apart, 4);
  EXPECT_GT(touching, 10);
}

// Contacts and exact cost sources are those of OBBRSS models, whose box-triangle test is the GJK
// solver's.
TEST(Octree, ContactsAndCostsAreThoseOfObbrss) {
  const Mesh mesh = scenes::bumpyTorus(160);
  const auto ours = kiosModel(mesh);
  const auto theirs = scenes::buildModel<fcl::OBBRSSd>(mesh);
  std::size_t contacts = 0, costs = 0;
  for (int i = 0; i < 12; ++i) {
    const auto tree = randomTree(0.25, 30, 50 + i, false);
    const fcl::OcTreed octree(tree);
    const Frame frame = randomFrames(1, 0.8, 60 + i).front();
    for (const bool approximate : {false, true}) {
      for (const double density : {1.0, 0.5}) {
        ours->cost_density = theirs->cost_density = density;
        const fcl::CollisionRequestd request(kAllContacts, false, 100000, true, approximate);
        fcl::CollisionResultd a, b;
        fcl::collide(&octree, frame.X_WA, ours.get(), frame.X_WB, request, a);
        fcl::collide(&octree, frame.X_WA, theirs.get(), frame.X_WB, request, b);
        EXPECT_EQ(contactPairs(a), contactPairs(b));
        contacts += a.numContacts();
        std::vector<fcl::CostSourced> sa, sb;
        a.getCostSources(sa);
        b.getCostSources(sb);
        costs += sa.size();
        if (approximate) continue;  // the root volumes' boxes differ
        ASSERT_EQ(sa.size(), sb.size());
        for (std::size_t c = 0; c < sa.size(); ++c) {
          EXPECT_NEAR(sa[c].total_cost, sb[c].total_cost, 1e-12);
        }
      }
    }
  }
  EXPECT_GT(contacts, 20u);
  EXPECT_GT(costs, 20u);
}

// Approximate costs are those of FCL's own traversal for the root volume's box.
TYPED_TEST(Octree, ApproximateCostsAreThoseOfTheRootsBox) {
  using S = TypeParam;
  const auto model = scenes::buildModel<kIOS<S>>(scenes::bumpyTorus(160));
  std::size_t costs = 0;
  for (int i = 0; i < 16; ++i) {
    const fcl::OcTree<S> octree(randomTree(0.125, 1 << (i % 8), 90 + i, i % 3 == 0));
    const Frame frame = randomFrames(1, 0.8, 60 + i).front();
    const fcl::Transform3<S> X_WO(frame.X_WA.cast<S>()), X_WM(frame.X_WB.cast<S>());
    model->cost_density = static_cast<S>(0.5 * (i % 3));  // 0: free
    const fcl::OBB<S> volume = toOBB(model->getBV(0).bv, X_WM);
    fcl::Box<S> box(2 * volume.extent);
    const fcl::Transform3<S> X_WBox =
        Eigen::Translation<S, 3>(volume.To) * fcl::Transform3<S>(volume.axis);
    box.cost_density = model->cost_density;
    for (const std::size_t limit : {7U, 1000000U}) {
      fcl::CollisionResult<S> ours, theirs;
      fcl::collide(&octree, X_WO, model.get(), X_WM,
                   fcl::CollisionRequest<S>(1, false, limit, true, true), ours);
      if (!model->isFree()) {
        const fcl::CollisionGeometry<S>*o = &octree, *root = &box;
        fcl::collide(o, X_WO, root, X_WBox, fcl::CollisionRequest<S>(1, false, limit, true, false),
                     theirs);
      }
      std::vector<fcl::CostSource<S>> a, b;
      ours.getCostSources(a);
      theirs.getCostSources(b);
      ASSERT_EQ(a.size(), b.size()) << i << ' ' << limit;
      const S reach = 1 + X_WO.translation().norm() + octree.getRootBV().max_[0];
      for (std::size_t c = 0; c < a.size(); ++c) {
        EXPECT_NEAR(a[c].total_cost, b[c].total_cost,
                    256 * std::numeric_limits<S>::epsilon() * reach * reach * reach);
        EXPECT_EQ(a[c].cost_density, b[c].cost_density);
      }
      costs += a.size();
    }
  }
  EXPECT_GT(costs, 200u);
}

TEST(Octree, EmptyOctreesTouchNothing) {
  const auto model = kiosModel(scenes::icosphere(1, 1));
  const fcl::OcTreed empty(0.1);
  const Transform3d I = Transform3d::Identity();
  fcl::CollisionResultd contacts;
  EXPECT_EQ(fcl::collide(model.get(), I, &empty, I, fcl::CollisionRequestd(), contacts), 0u);
  fcl::DistanceResultd distance;
  fcl::distance(&empty, I, model.get(), I, fcl::DistanceRequestd(), distance);
  EXPECT_EQ(distance.min_distance, std::numeric_limits<double>::max());
  EXPECT_EQ(distance.o1, nullptr);
}

TEST(Octree, BoundsAndErrorsAreHonoured) {
  const auto model = kiosModel(scenes::bumpyTorus(2000));
  const auto tree = randomTree(0.0625, 400, 5, true);
  const fcl::OcTreed octree(tree);
  for (const Frame& frame : randomFrames(10, 4, 8)) {
    fcl::DistanceRequestd request;
    fcl::DistanceResultd exact;
    SearchCounts full, loose;
    const double d = distanceOctree(octree, frame.X_WA, *model, frame.X_WB, request, exact, &full);
    if (d == 0) continue;
    fcl::DistanceResultd bounded(0.99 * d);
    EXPECT_EQ(fcl::distance(&octree, frame.X_WA, model.get(), frame.X_WB, request, bounded),
              0.99 * d);
    EXPECT_EQ(bounded.o1, nullptr);
    request.rel_err = 0.2;
    fcl::DistanceResultd near;
    distanceOctree(octree, frame.X_WA, *model, frame.X_WB, request, near, &loose);
    EXPECT_GE(near.min_distance, d * (1 - 1e-14));
    EXPECT_LE(near.min_distance, 1.2 * d);
    EXPECT_LE(loose.leaf_kernels, full.leaf_kernels);
    EXPECT_LT(full.leaf_kernels, 2000);  // of 2000 x 400
  }
}

}  // namespace
}  // namespace kios::testing
