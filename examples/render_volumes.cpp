// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Draws a mesh inside the k-IOS of three levels of its tree, by the library's own rays, as a PPM
// image: usage: render_volumes FILE.ppm
#include <fcl_kios/fcl_kios.h>

#include <fstream>
#include <iostream>
#include <optional>
#include <vector>

#include "shapes.h"

namespace {

using Vector = fcl::Vector3d;

constexpr int kSide = 300;  // pixels of a panel

/// The volumes of a level contain the mesh: the nodes of that depth, and the leaves above it.
void volumesOf(const kios::Modeld& model, int node, int levels, std::vector<kios::kIOSd>& out) {
  const auto& at = model.getBV(node);
  if (levels == 0 || at.isLeaf()) {
    out.push_back(at.bv);
    return;
  }
  volumesOf(model, at.leftChild(), levels - 1, out);
  volumesOf(model, at.rightChild(), levels - 1, out);
}

/// The outward normal of a k-IOS at the point p of its surface: that of the sphere p lies on.
Vector normalAt(const kios::kIOSd& bv, const Vector& p) {
  int on = 0;
  double best = -1;
  for (int i = 0; i < bv.k(); ++i) {
    const double part = (p - bv.sphereCenter(i)).norm() / bv.sphereRadius(i);
    if (part > best) {
      best = part;
      on = i;
    }
  }
  return (p - bv.sphereCenter(on)).normalized();
}

double brightness(const Vector& normal, const Vector& direction) {
  const Vector light = Vector(-0.3, -0.5, 1).normalized();
  const Vector facing = normal.dot(direction) > 0 ? Vector(-normal) : normal;
  return 0.35 + 0.65 * std::max(0.0, facing.dot(light));
}

Vector colourOf(const kios::Modeld& model, const std::vector<kios::kIOSd>& volumes,
                const kios::Rayd& ray) {
  Vector colour = Vector::Constant(1);
  if (const auto hit = kios::firstHit(model, fcl::Transform3d::Identity(), ray)) {
    const fcl::Triangle& t = model.tri_indices[hit->triangle];
    const Vector &p = model.vertices[t[0]], &q = model.vertices[t[1]], &r = model.vertices[t[2]];
    colour =
        Vector(0.85, 0.55, 0.25) * brightness((q - p).cross(r - p).normalized(), ray.direction);
  }
  const kios::kIOSd* first = nullptr;
  double enter = ray.t_max;
  for (const kios::kIOSd& bv : volumes) {
    const auto part = kios::rayInterval(bv, ray);
    if (part && part->enter < enter) {
      enter = part->enter;
      first = &bv;
    }
  }
  if (first == nullptr) return colour;
  const Vector normal = normalAt(*first, ray.origin + enter * ray.direction);
  const Vector glass = Vector(0.25, 0.5, 0.85) * brightness(normal, ray.direction);
  const double edge = 1 - std::abs(normal.dot(ray.direction));
  return (0.45 - 0.4 * edge) * colour + (0.55 + 0.4 * edge) * glass;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: render_volumes FILE.ppm\n";
    return 2;
  }
  const auto mesh = shapes::bumpyTorus(1.0, 0.35, 90, 36);
  const auto model = kios::makeModel(mesh.vertices, mesh.triangles);
  const Vector ahead = Vector(-0.55, 0.75, -0.85).normalized();
  const Vector right = ahead.cross(Vector::UnitZ()).normalized(), up = right.cross(ahead);

  const std::vector<int> levels = {0, 4, 8};
  const int width = kSide * static_cast<int>(levels.size());
  std::vector<unsigned char> pixels;
  std::vector<std::vector<kios::kIOSd>> volumes(levels.size());
  for (std::size_t i = 0; i < levels.size(); ++i) volumesOf(*model, 0, levels[i], volumes[i]);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < width; ++x) {
      const double u = (x % kSide + 0.5) / kSide - 0.5, v = 0.5 - (y + 0.5) / kSide;
      kios::Rayd ray;
      ray.origin = 3.1 * (u * right + v * up) - 10 * ahead;
      ray.direction = ahead;
      const Vector colour = colourOf(*model, volumes[static_cast<std::size_t>(x / kSide)], ray);
      for (const double part : colour) {
        pixels.push_back(static_cast<unsigned char>(255 * std::min(1.0, std::max(0.0, part))));
      }
    }
  }
  std::ofstream file(argv[1], std::ios::binary);
  file << "P6\n" << width << ' ' << kSide << "\n255\n";
  file.write(reinterpret_cast<const char*>(pixels.data()),
             static_cast<std::streamsize>(pixels.size()));
  for (const auto& level : volumes) std::cout << level.size() << " volumes\n";
  return file ? 0 : 1;
}
