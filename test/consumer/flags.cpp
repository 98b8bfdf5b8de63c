// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// usage: flags [URDF SRDF]
// Prints how the types of the interface lie in memory and, where it is given a robot, answers that
// cross the library's boundary. Whatever flags this file is compiled with, the lines must be the
// same: flags.sh compares, and writes the list of types.
#include <fcl_kios/clearance.h>
#include <fcl_kios/fcl_kios.h>
#include <fcl_kios/paper.h>
#if __has_include(<fcl_kios/robot/robot.h>)
#include <fcl/geometry/shape/sphere.h>
#include <fcl_kios/robot/robot.h>
#define KIOS_ROBOT
#endif

#include <cstdio>
#include <string>

namespace {

template <typename T>
void print(const char* name) {
  std::printf("%s %zu %zu\n", name, sizeof(T), alignof(T));
}
#define PRINT(T) print<T>(#T)
#define PRINT_BOTH(T)   \
  print<T<double>>(#T); \
  print<T<float>>(#T)

std::shared_ptr<const kios::Modeld> cube() {
  std::vector<fcl::Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, ((i >> 2) & 1) - 0.5);
  }
  std::vector<fcl::Triangle> triangles;
  for (const auto& t :
       {"021", "123", "456", "576", "014", "154", "263", "367", "042", "246", "135", "375"}) {
    triangles.emplace_back(t[0] - '0', t[1] - '0', t[2] - '0');
  }
  return kios::makeModel<double>(corners, triangles);
}

void moveLinks() {
  kios::Linkage arm;
  kios::Joint joint;
  joint.type = kios::JointType::kRevolute;
  const fcl::Transform3d raised(Eigen::Translation3d(0, 0, 1));
  joint.X_PJ = raised;
  const fcl::Transform3d read = joint.X_PJ;
  const int upper = arm.addLink(-1, joint);
  joint.type = kios::JointType::kPrismatic;
  joint.X_PJ.translation() = fcl::Vector3d(1, 0, 0);
  joint.axis = fcl::Vector3d::UnitX();
  const int lower = arm.addLink(upper, joint);
  arm.addBody(lower, cube());
  arm.addBody(-1, cube(), fcl::Transform3d(Eigen::Translation3d(-3, 0, 1)));
  const fcl::Transform3d pose = arm.pose(0, Eigen::Vector2d(1.5, 0.25));
  std::printf("%.17g %.17g %.17g %.17g\n", read(2, 3), pose(0, 3), pose(1, 3), pose(2, 3));
  for (const double reach : {0.5, 2.5}) {
    const kios::MotionResult answer =
        kios::checkMotion(arm, Eigen::Vector2d(0, reach), Eigen::Vector2d(3.2, reach));
    std::printf("%d %.17g %d %d\n", static_cast<int>(answer.verdict), answer.to, answer.body_a,
                answer.body_b);
  }
  const kios::RangeResult range =
      kios::leastClearance(arm, Eigen::Vector2d(0, 0.5), Eigen::Vector2d(1, 0.5));
  std::printf("%.17g %.17g\n", range.upper, range.at.at(0));
}

// Answers that own memory, of objects that the caller owns.
void ask() {
  const std::vector<unsigned char> bytes = kios::save(*cube());
  const auto model = kios::load<double>(bytes.data(), bytes.size());
  const fcl::Transform3d here = fcl::Transform3d::Identity(), there(Eigen::Translation3d(2, 1, 3));
  const kios::DistanceBracketResultd d = kios::distanceBracket(*model, here, *model, there);
  std::printf("%.17g %.17g %.17g\n", d.distance, d.point_a[2], d.point_b[2]);
  kios::Rayd ray;
  ray.origin = fcl::Vector3d(-4, 0.25, 0.125);
  const auto hit = kios::firstHit(*model, here, ray);
  std::printf("%.17g %.17g %.17g\n", hit->t, hit->point[0], hit->weights[0]);
  std::printf("%zu\n", kios::allHits(*model, here, ray).size());

  kios::markSolid(*model);
  const fcl::Transform3d pressed(Eigen::Translation3d(0.75, 0.125, 0));
  const kios::NearestPoint nearest = kios::nearestPoint(*model, {0.25, 0.125, 2});
  std::printf("%.17g %.17g %.17g\n", nearest.distance, kios::signedDistance(*model, {0.25, 0, 0}),
              kios::WindingTree(*model).at({0.25, 0, 0}, 0));
  std::printf("%.17g\n", kios::penetration(*model, here, *model, pressed).translation[0]);
  kios::LocalDepthRequest shallow;
  shallow.threshold = 0.01;
  const kios::LocalDepthResult depth = kios::localDepth(*model, here, *model, pressed, shallow);
  std::printf("%.17g %.17g %d\n", depth.lower, depth.point[0], depth.surface_of);
  const std::vector<fcl::Vector3d> corners(model->vertices, model->vertices + model->num_vertices);
  const std::vector<fcl::Triangle> open(model->tri_indices + 1,
                                        model->tri_indices + model->num_tris);
  kios::RepairRequest options;
  options.max_hole_edges = 3;
  const kios::RepairResultd repaired = kios::repair(corners, open, options);
  std::printf("%s\n%zu\n", kios::summaryOf(repaired).c_str(), repaired.filled.size());
  std::printf("%s\n", kios::faultsOf(kios::inspectClosedness(corners, open)).c_str());
  std::printf("%.17g\n", kios::minimumClearance(kios::Coverd(*model, 2), kios::Coverd(*model, 2),
                                                kios::RelativePosed(here, there))
                             .value);

  fcl::CollisionObjectd a(model, here), b(model, there);
  fcl::CollisionRequestd contacts(/*num_max_contacts=*/8, /*enable_contact=*/true);
  fcl::CollisionResultd collision;
  b.setTransform(pressed);
  b.computeAABB();
  std::printf("%zu\n", fcl::collide(&a, &b, contacts, collision));
  fcl::DynamicAABBTreeCollisionManagerd manager;
  manager.registerObject(&a);
  manager.registerObject(&b);
  manager.setup();
  kios::ManagerQueryd query;
  query.findWithin(5);
  manager.distance(&query, kios::ManagerQueryd::callback);
  kios::SceneDistanced scene;
  scene.add(model, here);
  scene.add(model, there);
  scene.add(&b);
  std::printf("%zu %zu\n", query.pairs().size(), scene.clearances().size());
  std::vector<kios::ClashPart> parts(2);
  parts[0].geometry = parts[1].geometry = model;
  parts[0].name = "part";
  parts[1].geometry = kios::toDouble(
      *kios::makeModel<float>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {fcl::Triangle(0, 1, 2)}));
  parts[1].X_WP = pressed;
  for (const kios::ClashResult& clash : kios::findClashes(parts)) {
    std::printf("%zu %zu %.17g\n", clash.a, clash.b, clash.lower);
  }
  fcl::ContinuousCollisionRequestd moving;
  fcl::ContinuousCollisionResultd first;
  fcl::continuousCollide(model.get(), here, here, model.get(), there, pressed, moving, first);
  std::printf("%d %.17g\n", first.is_collide, first.time_of_contact);
}

#ifdef KIOS_ROBOT
void askRobot(const std::string& urdf, const std::string& srdf) {
  kios::Robot robot = kios::loadRobot(urdf, srdf);
  robot.addObstacle("wall", cube(), fcl::Transform3d(Eigen::Translation3d(3, 0, 0)));
  robot.attach("tool", "hand", std::make_shared<fcl::Sphered>(0.125),
               fcl::Transform3d(Eigen::Translation3d(0.5, 0, 0)));
  const Eigen::VectorXd q = robot.state("bent"), zero = Eigen::VectorXd::Zero(robot.coordinates());
  const kios::RobotClearance nearest = robot.clearance(q);
  std::printf("%s %s %.17g", nearest.a.c_str(), nearest.b.c_str(), nearest.clearance);
  for (int i = 0; i < nearest.gradient.size(); ++i) std::printf(" %.17g", nearest.gradient[i]);
  std::printf("\n%zu %zu %zu %d\n", robot.clearances(q, 100).size(), robot.elements().size(),
              robot.states().size(), robot.contact(q).has_value());
  std::printf("%.17g\n", robot.pose("hand", q)(0, 3));
  Eigen::MatrixXd many(robot.coordinates(), 8);
  for (int i = 0; i < many.cols(); ++i) many.col(i) = 0.25 * i * q;
  for (const char meets : robot.contacts(many)) std::printf("%d ", meets);
  for (const auto& one : robot.clearances(many)) std::printf("%.17g ", one.gradient[0]);
  for (const auto& one : robot.checkMotions(many, many)) std::printf("%s ", one.a.c_str());
  std::printf("%d\n", static_cast<int>(robot.checkMotion(zero, q).verdict));
  const kios::RobotRange range = robot.leastClearance(zero, q);
  std::printf("%s %s %.17g\n", range.a.c_str(), range.b.c_str(), range.upper);
  for (const kios::LinkPair& pair : robot.linkPairs()) {
    std::printf("%s %s %d %td\n", pair.a.c_str(), pair.b.c_str(), static_cast<int>(pair.verdict),
                pair.q.size());
  }
  std::printf("%s\n", kios::toSrdf(robot.linkPairs(), robot.name()).c_str());
}
#endif

}  // namespace

int main(int argc, char** argv) {
  {
    using namespace kios;
    using detail::PoseBounds;
#include "types.inc"
    PRINT(ManagerQueryd::Pair);
    PRINT_BOTH(TriangleVertices);
  }
  const kios::Joint joint;
  const auto* const start = reinterpret_cast<const char*>(&joint);
  std::printf("Joint: %td %td\n", reinterpret_cast<const char*>(&joint.X_PJ) - start,
              reinterpret_cast<const char*>(&joint.axis) - start);
  if (argc < 3) return 0;
  moveLinks();
  ask();
#ifdef KIOS_ROBOT
  askRobot(argv[1], argv[2]);
#endif
  return 0;
}
