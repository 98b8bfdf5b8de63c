// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/content_hash.h"

#include <random>

#define XXH_INLINE_ALL  // the library links nothing for it
#include <xxhash.h>

namespace kios::engine {
namespace {

std::uint64_t seed() {
  static const std::uint64_t drawn = [] {
    std::random_device device;
    return std::uint64_t{device()} << 32 | device();
  }();
  return drawn;
}

}  // namespace

template <typename S>
ContentHash contentHash(const MeshView<S>& mesh) {
  static_assert(sizeof(fcl::Vector3<S>) == 3 * sizeof(S));
  const struct {
    XXH128_hash_t vertices, triangles;
    std::uint64_t num_vertices, num_triangles, scalar;
  } parts = {
      XXH3_128bits_withSeed(mesh.vertices, mesh.num_vertices * sizeof(*mesh.vertices), seed()),
      XXH3_128bits_withSeed(mesh.triangles, mesh.num_triangles * sizeof(*mesh.triangles), ~seed()),
      mesh.num_vertices, mesh.num_triangles, sizeof(S)};
  static_assert(sizeof(parts) == 56, "no padding, whose bytes are any");
  const XXH128_hash_t all = XXH3_128bits_withSeed(&parts, sizeof(parts), seed());
  return {all.low64, all.high64};
}

template ContentHash contentHash(const MeshView<double>&);
template ContentHash contentHash(const MeshView<float>&);

}  // namespace kios::engine
