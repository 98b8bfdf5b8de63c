// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// Compiled where Embree 3 is installed (Debian: libembree-dev).

#include <embree3/rtcore.h>

#include <memory>
#include <stdexcept>

#include "ray_caster.h"

namespace kios::bench {
namespace {

/// All hits: each is written down and refused, so that the ray goes on.
struct Collecting {
  RTCIntersectContext context;  // first, so that Embree's pointer is one to this
  std::vector<CastHit>* hits;

  static void collect(const RTCFilterFunctionNArguments* args) {
    auto* const self = reinterpret_cast<Collecting*>(args->context);
    const auto* const ray = reinterpret_cast<const RTCRay*>(args->ray);
    const auto* const hit = reinterpret_cast<const RTCHit*>(args->hit);
    self->hits->push_back({double{ray->tfar}, static_cast<int>(hit->primID)});
    args->valid[0] = 0;
  }
};

class EmbreeCaster {
 public:
  explicit EmbreeCaster(const scenes::Mesh& mesh) : device_(rtcNewDevice("threads=1")) {
    if (!device_) throw std::runtime_error("Embree: no device");
    scene_ = made(mesh, RTC_SCENE_FLAG_ROBUST);
    collecting_ = made(mesh, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                                        RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  }
  EmbreeCaster(const EmbreeCaster&) = delete;
  EmbreeCaster& operator=(const EmbreeCaster&) = delete;
  ~EmbreeCaster() {
    rtcReleaseScene(collecting_);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  void cast(RayQuery query, const Rayd& ray, std::vector<CastHit>& hits) const {
    hits.clear();
    Collecting collecting;
    rtcInitIntersectContext(&collecting.context);
    RTCRayHit cast = {made(ray), {}};
    cast.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    if (query == RayQuery::kAny) {
      rtcOccluded1(scene_, &collecting.context, &cast.ray);
      if (cast.ray.tfar < 0) hits.push_back({0, -1});
    } else if (query == RayQuery::kFirst) {
      collecting.context.flags =
          RTC_INTERSECT_CONTEXT_FLAG_COHERENT;  // the fastest for single rays
      rtcIntersect1(scene_, &collecting.context, &cast);
      if (cast.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
      hits.push_back({double{cast.ray.tfar}, static_cast<int>(cast.hit.primID)});
    } else {
      collecting.context.filter = &Collecting::collect;
      collecting.hits = &hits;
      rtcIntersect1(collecting_, &collecting.context, &cast);
    }
  }

 private:
  static RTCRay made(const Rayd& ray) {
    RTCRay made = {};
    made.org_x = static_cast<float>(ray.origin[0]);
    made.org_y = static_cast<float>(ray.origin[1]);
    made.org_z = static_cast<float>(ray.origin[2]);
    made.dir_x = static_cast<float>(ray.direction[0]);
    made.dir_y = static_cast<float>(ray.direction[1]);
    made.dir_z = static_cast<float>(ray.direction[2]);
    made.tnear = static_cast<float>(ray.t_min);
    made.tfar = static_cast<float>(ray.t_max);
    made.mask = ~0U;
    return made;
  }

  RTCScene made(const scenes::Mesh& mesh, RTCSceneFlags flags) const {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const v = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices.size()));
    auto* const ids = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), mesh.triangles.size()));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      for (int c = 0; c < 3; ++c) v[3 * i + c] = static_cast<float>(mesh.vertices[i][c]);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        ids[3 * i + c] = static_cast<unsigned>(mesh.triangles[i][c]);
      }
    }
    rtcCommitGeometry(geometry);
    const RTCScene scene = rtcNewScene(device_);
    rtcSetSceneFlags(scene, flags);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
  }

  RTCDevice device_;
  RTCScene scene_ = nullptr, collecting_ = nullptr;
};

}  // namespace

RayCaster embreeCaster(const scenes::Mesh& mesh) {
  return [caster = std::make_shared<const EmbreeCaster>(mesh)](RayQuery query, const Rayd& ray,
                                                               std::vector<CastHit>& hits) {
    caster->cast(query, ray, hits);
  };
}

}  // namespace kios::bench
