// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// usage: flags [layout]
// Prints how the types of the interface lie in memory and, without "layout", answers that cross the
// library's boundary. Whatever flags this file is compiled with, the lines must be the same:
// flags.sh compares, and finds types that are missing here.
#include <fcl_kios/fcl_kios.h>

#include <cstdio>
#include <cstring>

namespace {

template <typename T>
void print(const char* name) {
  std::printf("%s %zu %zu\n", name, sizeof(T), alignof(T));
}
#define PRINT(T) print<kios::T>(#T)
#define PRINT_BOTH(T)         \
  print<kios::T<double>>(#T); \
  print<kios::T<float>>(#T)

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

void move() {
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
    const kios::MotionAnswer answer =
        kios::checkMotion(arm, Eigen::Vector2d(0, reach), Eigen::Vector2d(3.2, reach));
    std::printf("%d %.17g %d %d\n", static_cast<int>(answer.verdict), answer.to, answer.body_a,
                answer.body_b);
  }
  const auto model = cube();
  const fcl::Transform3d here = fcl::Transform3d::Identity(), there(Eigen::Translation3d(2, 1, 3));
  const kios::DistanceAnswerd d = kios::distance(*model, here, *model, there);
  std::printf("%.17g %.17g %.17g\n", d.distance, d.point_a[2], d.point_b[2]);
  kios::Rayd ray;
  ray.origin = fcl::Vector3d(-4, 0.25, 0.125);
  const auto hit = kios::firstHit(*model, here, ray);
  std::printf("%.17g %.17g %.17g\n", hit->t, hit->point[0], hit->weights[0]);
}

}  // namespace

int main(int argc, char** argv) {
  PRINT_BOTH(kIOS);
  PRINT_BOTH(RelativePose);
  PRINT(detail::PoseBounds);
  PRINT_BOTH(Cover);
  PRINT_BOTH(ManagerQuery);
  PRINT(ManagerQueryd::Pair);
  PRINT_BOTH(SceneDistance);
  PRINT_BOTH(ScenePair);
  PRINT(SceneCounts);
  PRINT(SceneRequest);
  PRINT(SearchCounts);
  PRINT(Linkage);
  PRINT(Joint);
  PRINT(MotionAnswer);
  PRINT(MotionCounts);
  PRINT(MotionRequest);
  PRINT(ContinuousCounts);
  PRINT(Hole);
  PRINT(RepairOptions);
  PRINT_BOTH(Repaired);
  PRINT(Clearance);
  PRINT(ExactDistance);
  PRINT(FitOptions);
  PRINT(WarmStart);
  PRINT_BOTH(DistanceOptions);
  PRINT_BOTH(DistanceAnswer);
  PRINT_BOTH(Closedness);
  PRINT_BOTH(FaultyEdge);
  PRINT(Penetration);
  PRINT(PenetrationOptions);
  PRINT_BOTH(Ray);
  PRINT_BOTH(RayHit);
  PRINT_BOTH(RayInterval);
  PRINT_BOTH(TriangleDistance);
  PRINT_BOTH(TriangleVertices);
  const kios::Joint joint;
  const auto* const start = reinterpret_cast<const char*>(&joint);
  std::printf("Joint: %td %td\n", reinterpret_cast<const char*>(&joint.X_PJ) - start,
              reinterpret_cast<const char*>(&joint.axis) - start);
  if (argc < 2 || std::strcmp(argv[1], "layout") != 0) move();
  return 0;
}
