// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// usage: program [write|check FILE [PART...]]
// Knows FCL alone: every entry point, request and state of models that a program may have, as often
// as it takes for the preloaded library to have its copies.
#include <algorithm>
#include <new>
#include <thread>

#include "ask.h"
#include "preload/fcl_meshes.h"

namespace {

using fcl::Transform3d;

/// The requests that a program may make of two meshes.
template <typename BV>
void askMeshes(const std::string& name) {
  const auto a = build<BV>(torus(24, 16)), b = build<BV>(torus(20, 15, 0.9));
  std::mt19937 random(3);
  // FCL copies and builds both models over RSS for each verdict.
  const int poses = std::is_same<BV, fcl::RSSd>::value ? 50 : 120;
  for (int i = 0; i < poses; ++i) {
    const Transform3d X_WA = randomPose(random, 0, 3),
                      X_WB = X_WA * randomPose(random, i % 3 == 0 ? 3.0 : 0.2, 3.2);
    askCollide(name + "_verdict", a, X_WA, b, X_WB, fcl::CollisionRequestd());
    askCollide(name + "_contacts", a, X_WA, b, X_WB, fcl::CollisionRequestd(7, true));
    askCollide(name + "_ids", a, X_WA, b, X_WB, fcl::CollisionRequestd(5, false));
    if (!std::is_same<BV, fcl::OBBd>::value) {
      askDistance(name + "_distance", a, X_WA, b, X_WB, fcl::DistanceRequestd(true));
      if (i % 4 != 0) continue;
      askDistance(name + "_errors", a, X_WA, b, X_WB, fcl::DistanceRequestd(true, false, 1.0, 5.0));
      askDistance(name + "_solver_first", a, X_WA, b, X_WB,
                  fcl::DistanceRequestd(true, true, fcl::GST_INDEP));
      askDistance(name + "_bounded", a, X_WA, b, X_WB, fcl::DistanceRequestd(), 0.4);
      askDistance(name + "_touched", a, X_WA, b, X_WB, fcl::DistanceRequestd(), -1.0);
    }
    if (i % 8 != 0) continue;
    fcl::CollisionRequestd request(3, true, 4, true, i % 16 == 0);
    askCollide(name + "_costs", a, X_WA, b, X_WB, request);
    request = fcl::CollisionRequestd(1, false);
    request.gjk_solver_type = fcl::GST_INDEP;
    request.enable_cached_gjk_guess = i % 16 == 0;
    askCollide(name + "_indep", a, X_WA, b, X_WB, request);
    askCollide(name + "_none", a, X_WA, b, X_WB, fcl::CollisionRequestd(0, false));
    a->cost_density = 0;  // not occupied
    askCollide(name + "_free", a, X_WA, b, X_WB, fcl::CollisionRequestd());
    a->cost_density = 1;
  }
}

/// Poses that k-IOS refuses: FCL's answer, whatever that is.
void askOddPoses() {
  const auto a = build<fcl::OBBRSSd>(torus(12, 8)), b = build<fcl::OBBRSSd>(torus(12, 8));
  std::mt19937 random(5);
  for (int i = 0; i < 60; ++i) {
    const Transform3d X_WA = randomPose(random, 0, 1);
    Transform3d X_WB = X_WA * randomPose(random, 2.4, 4);
    if (i % 3 == 1) X_WB.linear() *= 1.3;
    if (i % 3 == 2) X_WB.linear().col(0) *= -1;
    askCollide("odd_collide", a, X_WA, b, X_WB, fcl::CollisionRequestd());
    askDistance("odd_distance", a, X_WA, b, X_WB, fcl::DistanceRequestd(true));
  }
  Transform3d nowhere = Transform3d::Identity();
  nowhere.translation()[1] = std::nan("");
  askCollide("nan_collide", a, nowhere, b, Transform3d::Identity(), fcl::CollisionRequestd());
  askDistance("nan_distance", a, nowhere, b, Transform3d::Identity(), fcl::DistanceRequestd());
}

void askOthers() {
  const auto mesh = build<fcl::OBBRSSd>(torus(20, 14));
  const auto box = std::make_shared<fcl::Boxd>(0.5, 0.7, 0.9);
  const auto sphere = std::make_shared<fcl::Sphered>(0.4);
  const auto capsule = std::make_shared<fcl::Capsuled>(0.3, 0.8);
  const auto cylinder = std::make_shared<fcl::Cylinderd>(0.3, 0.8);
  auto cells = std::make_shared<octomap::OcTree>(0.2);
  std::mt19937 random(8);
  std::uniform_real_distribution<float> place(-1, 1);
  for (int i = 0; i < 60; ++i) {
    cells->updateNode(octomap::point3d(place(random), place(random), place(random)), true);
  }
  const auto octree = std::make_shared<fcl::OcTreed>(cells);
  for (const std::shared_ptr<fcl::CollisionGeometryd>& other :
       std::vector<std::shared_ptr<fcl::CollisionGeometryd>>{box, sphere, capsule, cylinder,
                                                             octree}) {
    const std::string name = "other_" + std::to_string(other->getNodeType());
    other->computeLocalAABB();
    for (int i = 0; i < 100; ++i) {
      // Where FCL's solvers, exact to 1e-6, see an overlap, results are whatever they leave.
      const bool apart = i % 2 == 0;
      const Transform3d X_WM = randomPose(random, 0, 2),
                        X_WO = X_WM * randomPose(random, apart ? 3.6 : 0.0, apart ? 6.0 : 1.5);
      askCollide(name + "_collide", mesh, X_WM, other, X_WO, fcl::CollisionRequestd());
      askCollide(name + "_swapped", other, X_WO, mesh, X_WM, fcl::CollisionRequestd());
      askCollide(name + "_contacts", mesh, X_WM, other, X_WO, fcl::CollisionRequestd(4, true));
      if (!apart) continue;
      const fcl::DistanceRequestd request(true);
      askDistance(name + "_distance", mesh, X_WM, other, X_WO, request, 0, 2e-5);
      askDistance(name + "_distance_swapped", other, X_WO, mesh, X_WM, request, 0, 2e-5);
      if (other == sphere) continue;  // FCL's points are in no frame
      fcl::DistanceResultd unasked;   // of points, which FCL gives nevertheless
      const fcl::CollisionGeometryd *const of_mesh = mesh.get(), *const of_other = other.get();
      fcl::distance(of_mesh, X_WM, of_other, X_WO, fcl::DistanceRequestd(), unasked);
      transcript->add(name + "_unasked_points",
                      (unasked.nearest_points[0] - unasked.nearest_points[1]).norm(), 2e-4);
    }
  }
  // FCL has no distance of OBB and a shape, and never gets one.
  const auto obb = build<fcl::OBBd>(torus(20, 14));
  for (int i = 0; i < 100; ++i) {
    const Transform3d X_WM = randomPose(random, 0, 2), X_WO = X_WM * randomPose(random, 3.6, 6);
    askDistance("obb_box", obb, X_WM, box, X_WO, fcl::DistanceRequestd(true));
    askDistance("obb_octree", octree, X_WO, obb, X_WM, fcl::DistanceRequestd(true), 0, 2e-5);
  }
}

/// Asks for the contact and the distance at so many poses.
void askNear(const std::string& name, const std::shared_ptr<fcl::CollisionGeometryd>& a,
             const std::shared_ptr<fcl::CollisionGeometryd>& b, std::mt19937& random, int times,
             double nearest, double farthest) {
  for (int i = 0; i < times; ++i) {
    const Transform3d X_WB = randomPose(random, nearest, farthest);
    askCollide(name, a, Transform3d::Identity(), b, X_WB, fcl::CollisionRequestd());
    askDistance(name, a, Transform3d::Identity(), b, X_WB, fcl::DistanceRequestd(true));
  }
}

/// Says what a program does to its models between queries.
template <typename BV>
void changeModels(const std::string& name) {
  const Soup soup = torus(18, 12);
  const auto a = build<BV>(soup), b = build<BV>(torus(16, 12));
  std::mt19937 random(11);
  const auto ask = [&](const char* after, int times) {
    askNear(name + after, a, b, random, times, 2.4, 3.5);
  };
  const auto scaled = [&](double factor) {
    std::vector<fcl::Vector3d> vertices = soup.vertices;
    for (auto& p : vertices) p *= factor;
    return vertices;
  };
  ask("_built", 60);
  for (int round = 0; round < 6; ++round) {
    a->beginReplaceModel();
    ask("_being_replaced", 2);
    a->replaceSubModel(scaled(1.05 + 0.01 * round));
    ask("_replaced_but_not_ended", 2);
    a->endReplaceModel(round % 2 == 0, false);
    ask("_replaced", 30);
    if (round % 3 == 2) {  // FCL replaces no updated model: it starts anew
      a->beginUpdateModel();
      a->updateSubModel(scaled(1.0));
      a->endUpdateModel(true, false);
      ask("_updated", 30);
      a->beginModel();
      a->beginModel();
      a->addSubModel(soup.vertices, soup.triangles);
      a->endModel();
      ask("_rebuilt", 30);
    }
  }
}

/// Vertices and triangles that are written without a word, within the volumes that FCL keeps: those
/// of an updated model hold it before, after and at any time between.
template <typename BV>
void writeInPlace(const std::string& name) {
  // Each triangle's centre is a vertex, too, that no triangle has yet.
  Soup soup = torus(18, 12), smaller = torus(18, 12, 0.8);
  const std::size_t num_corners = soup.vertices.size();
  for (Soup* const all : {&soup, &smaller}) {
    for (const fcl::Triangle& t : all->triangles) {
      all->vertices.push_back((all->vertices[t[0]] + all->vertices[t[1]] + all->vertices[t[2]]) /
                              3);
    }
  }
  const auto a = build<BV>(soup), b = build<BV>(torus(16, 12));
  a->beginUpdateModel();
  a->updateSubModel(smaller.vertices);
  a->endUpdateModel(true, false);
  std::mt19937 random(19);
  std::uniform_real_distribution<double> part(0, 1);
  const auto write = [&](int i, double t) {
    a->vertices[i] = (1 - t) * soup.vertices[i] + t * smaller.vertices[i];
  };
  const auto ask = [&](const char* after, int times) {
    askNear(name + after, a, b, random, times, 2.2, 3.0);
  };
  ask("_updated", 60);
  for (int round = 0; round < 60; ++round) {
    if (round % 3 == 0) {
      const double t = part(random);
      for (int i = 0; i < a->num_vertices; ++i) write(i, t);
    } else {  // a single vertex of all
      write(static_cast<int>(random() % soup.vertices.size()), part(random));
    }
    // Right after, and once the copy has caught up.
    ask("_written", round % 6 == 5 ? 60 : 2);
  }
  // A third of some triangles is left, in the volumes that hold the whole.
  for (int round = 0; round < 10; ++round) {
    for (int i = round; i < a->num_tris; i += 11) {
      fcl::Triangle& t = a->tri_indices[i];
      t = fcl::Triangle(t[0], t[1], num_corners + static_cast<std::size_t>(i));
    }
    ask("_triangles_written", round % 5 == 4 ? 40 : 3);
  }
}

/// Other models in the memory of those that went.
template <typename BV>
void reuseAddresses(const std::string& name) {
  using Model = fcl::BVHModel<BV>;
  alignas(Model) static unsigned char memory[2][sizeof(Model)];
  std::mt19937 random(13);
  for (int generation = 0; generation < 12; ++generation) {
    // As many triangles and vertices, or other numbers of them.
    const double size = 1 - 0.03 * generation;
    const int across = generation % 4 == 3 ? 13 : 12;
    const auto destroy = [](Model* model) { model->~Model(); };
    const std::shared_ptr<Model> a(new (memory[0]) Model, destroy);
    const std::shared_ptr<Model> b(new (memory[1]) Model, destroy);
    fill(*a, torus(16, across, size));
    fill(*b, torus(14, 12, 2 - size));
    askNear(name + "_reused", a, b, random, 25, 2.4, 3.5);
  }
}

/// A model that goes, and one that is copied to its place: nothing is fitted meanwhile.
void copyToAddresses() {
  using Model = fcl::BVHModel<fcl::OBBRSSd>;
  alignas(Model) static unsigned char memory[sizeof(Model)];
  const auto big = build<fcl::OBBRSSd>(torus(16, 12)),
             small = build<fcl::OBBRSSd>(torus(16, 12, 0.6));
  const auto b = build<fcl::OBBRSSd>(torus(14, 12));
  std::mt19937 random(23);
  for (int generation = 0; generation < 16; ++generation) {
    const auto destroy = [](Model* model) { model->~Model(); };
    const std::shared_ptr<Model> a(new (memory) Model(generation % 2 == 0 ? *big : *small),
                                   destroy);
    for (int i = 0; i < 25; ++i) {
      askDistance("copied", a, Transform3d::Identity(), b, randomPose(random, 2.4, 3.5),
                  fcl::DistanceRequestd(true));
    }
  }
}

/// FCL's manager with its default callbacks, a motion, and a result that several pairs share.
void askThroughFcl() {
  const auto model = build<fcl::OBBRSSd>(torus(16, 12));
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
  fcl::DynamicAABBTreeCollisionManagerd manager;
  std::mt19937 random(17);
  for (int i = 0; i < 12; ++i) {
    objects.push_back(std::make_unique<fcl::CollisionObjectd>(model, Transform3d::Identity()));
    manager.registerObject(objects.back().get());
  }
  manager.setup();
  for (int frame = 0; frame < 12; ++frame) {
    for (auto& object : objects) {
      object->setTransform(randomPose(random, 0, frame % 2 == 0 ? 6 : 30));
      object->computeAABB();
    }
    manager.update();
    fcl::DefaultCollisionData<double> collision;
    manager.collide(&collision, fcl::DefaultCollisionFunction<double>);
    transcript->add("manager_verdict", collision.result.isCollision());
    fcl::DefaultDistanceData<double> distance;
    manager.distance(&distance, fcl::DefaultDistanceFunction<double>);
    transcript->add("manager_distance", distance.result.min_distance, 1e-12);
  }
  fcl::ContinuousCollisionRequestd request(20, 1e-4, fcl::CCDM_TRANS, fcl::GST_LIBCCD,
                                           fcl::CCDC_NAIVE);
  for (int i = 0; i < 20; ++i) {
    const Transform3d from = randomPose(random, 3, 4), to = randomPose(random, 0, 3);
    fcl::ContinuousCollisionResultd result;
    const fcl::CollisionGeometryd* const geometry = model.get();
    fcl::continuousCollide(geometry, from, to, geometry, Transform3d::Identity(),
                           Transform3d::Identity(), request, result);
    transcript->add("motion", result.is_collide);
    transcript->add("motion_time", result.time_of_contact);
  }
}

/// Many threads ask about models that they share, as FCL's answers alone say.
void askByThreads() {
  const auto a = build<fcl::OBBRSSd>(torus(24, 16)), b = build<fcl::OBBRSSd>(torus(22, 16));
  constexpr int kThreads = 6, kQueries = 150;
  std::vector<std::vector<double>> answers(kThreads);
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      std::mt19937 random(static_cast<unsigned>(t));
      const auto own = build<fcl::OBBRSSd>(torus(10 + t, 9));
      for (int i = 0; i < kQueries; ++i) {
        const Transform3d X_WB = randomPose(random, 2.2, 3.5);
        fcl::DistanceResultd result;
        fcl::distance(a.get(), Transform3d::Identity(), b.get(), X_WB, fcl::DistanceRequestd(),
                      result);
        answers[t].push_back(result.min_distance);
        fcl::DistanceResultd other;
        fcl::distance(own.get(), Transform3d::Identity(), b.get(), X_WB,
                      fcl::DistanceRequestd(true), other);
        answers[t].push_back(other.min_distance);
        fcl::CollisionResultd verdict;
        fcl::collide(b.get(), X_WB, a.get(), Transform3d::Identity(), fcl::CollisionRequestd(),
                     verdict);
        answers[t].push_back(verdict.isCollision() ? 1 : 0);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& all : answers) {
    for (const double answer : all) transcript->add("threads", answer, 1e-12);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const struct {
    const char* name;
    void (*run)();
  } parts[] = {{"obbrss", [] { askMeshes<fcl::OBBRSSd>("obbrss"); }},
               {"obb", [] { askMeshes<fcl::OBBd>("obb"); }},
               {"rss", [] { askMeshes<fcl::RSSd>("rss"); }},
               {"kios", [] { askMeshes<fcl::kIOSd>("kios"); }},
               {"poses", askOddPoses},
               {"others", askOthers},
               {"changes",
                [] {
                  changeModels<fcl::OBBRSSd>("obbrss");
                  changeModels<fcl::RSSd>("rss");
                  changeModels<fcl::kIOSd>("kios");
                }},
               {"writes",
                [] {
                  writeInPlace<fcl::OBBRSSd>("obbrss");
                  writeInPlace<fcl::kIOSd>("kios");
                }},
               {"reuse",
                [] {
                  reuseAddresses<fcl::OBBRSSd>("obbrss");
                  reuseAddresses<fcl::RSSd>("rss");
                  copyToAddresses();
                }},
               {"fcl", askThroughFcl},
               {"threads", askByThreads}};
  Transcript answers(std::min(argc, 3), argv);
  transcript = &answers;
  for (const auto& part : parts) {
    const auto is = [&](const char* word) { return std::strcmp(word, part.name) == 0; };
    const bool named = argc > 3 && std::any_of(argv + 3, argv + argc, is);
    if (named == (argc > 3)) part.run();
  }
  return answers.end();
}
