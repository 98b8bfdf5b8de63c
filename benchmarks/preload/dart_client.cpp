// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// usage: preload_dart write|check|time FILE [MESH...]
// Three robots of seven links, collision and distance of each pair by Debian's own libdart, which
// knows FCL alone. Links are made here, or read from the named mesh files. `time` prints the least
// time of a group's distance query, in nanoseconds, and what the distances add up to.
#include <chrono>
#include <cstdio>
#include <fstream>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <assimp/scene.h>
#include <dart/collision/fcl/fcl.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include "preload/transcript.h"

namespace {

using dart::collision::CollisionGroupPtr;
using dart::dynamics::SkeletonPtr;
using Shapes = std::vector<std::shared_ptr<dart::dynamics::MeshShape>>;

/// A closed tube of rings, bent and bumpy, about 0.3 long, as an STL file of 2,400 to 4,800
/// triangles.
void writeLink(const std::string& file, int link) {
  const int rings = 40 + 5 * link, segments = 30;
  const double pi = std::acos(-1);
  const auto point = [&](int i, int j) {
    const double t = static_cast<double>(i) / rings, phi = 2 * pi * j / segments;
    const double end = 4 * t * (1 - t);
    const double r = (0.05 + 0.008 * std::sin(9 * t + link) * std::cos(3 * phi)) * std::sqrt(end);
    return Eigen::Vector3d(r * std::cos(phi) + 0.03 * end, r * std::sin(phi), 0.3 * t);
  };
  std::ofstream out(file);
  out.precision(9);
  out << "solid link\n";
  const auto triangle = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const Eigen::Vector3d& p : {a, b, c}) out << "vertex " << p.transpose() << '\n';
    out << "endloop\nendfacet\n";
  };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < segments; ++j) {
      if (i > 0) triangle(point(i, j), point(i, j + 1), point(i + 1, j + 1));
      if (i + 1 < rings) triangle(point(i, j), point(i + 1, j + 1), point(i + 1, j));
    }
  }
  out << "endsolid link\n";
}

Shapes loadLinks(const std::vector<std::string>& files) {
  Shapes shapes;
  for (const std::string& file : files) {
    const aiScene* const scene = dart::dynamics::MeshShape::loadMesh(file);
    if (!scene) throw std::runtime_error("can't be read: " + file);
    shapes.push_back(std::make_shared<dart::dynamics::MeshShape>(Eigen::Vector3d::Ones(), scene));
  }
  return shapes;
}

SkeletonPtr makeRobot(const Shapes& links, const Eigen::Vector3d& base) {
  const SkeletonPtr robot = dart::dynamics::Skeleton::create();
  dart::dynamics::BodyNode* parent = nullptr;
  double length = 0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    dart::dynamics::RevoluteJoint::Properties joint;
    joint.mAxis = i % 2 == 0 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
    joint.mT_ParentBodyToJoint.translation() = parent ? Eigen::Vector3d(0, 0, 1.05 * length) : base;
    joint.mName = "joint" + std::to_string(i);
    dart::dynamics::BodyNode::AspectProperties body("link" + std::to_string(i));
    auto made =
        robot->createJointAndBodyNodePair<dart::dynamics::RevoluteJoint>(parent, joint, body);
    parent = made.second;
    parent->createShapeNodeWith<dart::dynamics::CollisionAspect>(links[i]);
    length = links[i]->getBoundingBox().computeFullExtents()[2];
  }
  return robot;
}

/// Robots of one kind, as near each other as their links are long.
struct Cell {
  explicit Cell(const Shapes& links) : detector(dart::collision::FCLCollisionDetector::create()) {
    detector->setPrimitiveShapeType(dart::collision::FCLCollisionDetector::MESH);
    double reach = 0;
    for (const auto& link : links) reach += link->getBoundingBox().computeFullExtents().norm();
    for (int i = 0; i < 3; ++i) {
      const double angle = 2.1 * i;
      robots.push_back(
          makeRobot(links, 0.15 * reach * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0)));
      groups.push_back(detector->createCollisionGroup(robots.back().get()));
    }
  }

  void move(std::mt19937& random) {
    std::uniform_real_distribution<double> angle(-1.2, 1.2);
    for (const SkeletonPtr& robot : robots) {
      for (std::size_t i = 0; i < robot->getNumDofs(); ++i) robot->setPosition(i, angle(random));
    }
  }

  std::shared_ptr<dart::collision::FCLCollisionDetector> detector;
  std::vector<SkeletonPtr> robots;
  std::vector<CollisionGroupPtr> groups;
};

constexpr int kPairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};

/// Returns verdicts, contacts and distances of all pairs of robots in some configurations.
std::vector<double> answer(Cell& cell, int frames, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<double> answers;
  for (int frame = 0; frame < frames; ++frame) {
    cell.move(random);
    for (const auto& pair : kPairs) {
      auto* const a = cell.groups[pair[0]].get();
      auto* const b = cell.groups[pair[1]].get();
      dart::collision::CollisionOption collision(false, 1);
      answers.push_back(cell.detector->collide(a, b, collision) ? 1 : 0);
      collision = dart::collision::CollisionOption(true, 50);
      dart::collision::CollisionResult contacts;
      cell.detector->collide(a, b, collision, &contacts);
      answers.push_back(static_cast<double>(contacts.getNumContacts()));
      for (const auto& contact : contacts.getContacts()) {
        answers.push_back(contact.point.norm());
        answers.push_back(contact.penetrationDepth);
      }
      dart::collision::DistanceOption option(true, -1);
      dart::collision::DistanceResult distance;
      answers.push_back(cell.detector->distance(a, b, option, &distance));
      answers.push_back(distance.minDistance);
    }
  }
  return answers;
}

int timeDistances(const Shapes& links) {
  Cell cell(links);
  double best = std::numeric_limits<double>::infinity(), sum = 0;
  constexpr int kFrames = 12, kRepeats = 6;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {  // copies are made in the first
    std::mt19937 random(1);
    std::chrono::duration<double, std::nano> taken{0};
    sum = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
      cell.move(random);
      const auto start = std::chrono::steady_clock::now();
      for (const auto& pair : kPairs) {
        sum += cell.detector->distance(cell.groups[pair[0]].get(), cell.groups[pair[1]].get(),
                                       dart::collision::DistanceOption(true, 0));
      }
      taken += std::chrono::steady_clock::now() - start;
    }
    best = std::min(best, taken.count() / (3 * kFrames));
  }
  std::printf("%.1f %.17g\n", best, sum);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  std::vector<std::string> files(argv + 3, argv + argc);
  const bool generated = files.empty();
  for (int link = 0; generated && link < 7; ++link) {
    files.push_back(std::string(argv[2]) + "." + std::to_string(link) + ".stl");
    writeLink(files.back(), link);
  }
  const Shapes links = loadLinks(files);
  for (const std::string& file : generated ? files : std::vector<std::string>()) {
    std::remove(file.c_str());
  }
  if (std::string(argv[1]) == "time") return timeDistances(links);

  Transcript transcript(3, argv);
  // Each thread has robots of its own over the same shapes. They are made and destroyed here: a
  // shape of DART's keeps a list of its users, which nothing locks.
  constexpr unsigned kThreads = 3;
  std::vector<std::unique_ptr<Cell>> cells;
  for (unsigned t = 0; t < kThreads; ++t) cells.push_back(std::make_unique<Cell>(links));
  std::vector<std::vector<double>> answers(kThreads);
  std::vector<std::thread> threads;
  for (unsigned t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] { answers[t] = answer(*cells[t], 12, t); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& all : answers) {
    for (const double value : all) transcript.add("dart", value, 1e-12);
  }
  return transcript.end();
}
