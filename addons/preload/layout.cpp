// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "preload/implementation.h"

#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <type_traits>

#include <dlfcn.h>
#include <elf.h>
#include <link.h>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>

namespace kios::preload {
namespace {

// All types of which queries read members or call virtual functions.
constexpr const char* kTables[] = {"_ZTVN3fcl8BVHModelINS_3OBBIdEEEE",
                                   "_ZTVN3fcl8BVHModelINS_3RSSIdEEEE",
                                   "_ZTVN3fcl8BVHModelINS_4kIOSIdEEEE",
                                   "_ZTVN3fcl8BVHModelINS_6OBBRSSIdEEEE",
                                   "_ZTVN3fcl3BoxIdEE",
                                   "_ZTVN3fcl6SphereIdEE",
                                   "_ZTVN3fcl9EllipsoidIdEE",
                                   "_ZTVN3fcl7CapsuleIdEE",
                                   "_ZTVN3fcl4ConeIdEE",
                                   "_ZTVN3fcl8CylinderIdEE",
                                   "_ZTVN3fcl6ConvexIdEE",
                                   "_ZTVN3fcl9HalfspaceIdEE",
                                   "_ZTVN3fcl5PlaneIdEE",
                                   "_ZTVN3fcl9TrianglePIdEE",
                                   "_ZTVN3fcl6OcTreeIdEE",
                                   "_ZTVN3fcl17CollisionGeometryIdEE"};

// Constructors, each by the arguments of its declaration.
constexpr const char* kBox = "_ZN3fcl3BoxIdEC1Eddd";
constexpr const char* kSphere = "_ZN3fcl6SphereIdEC1Ed";
constexpr const char* kCollisionRequest =
    "_ZN3fcl16CollisionRequestIdEC1EmbmbbNS_13GJKSolverTypeEd";
constexpr const char* kCollisionResult = "_ZN3fcl15CollisionResultIdEC1Ev";
constexpr const char* kDistanceRequest = "_ZN3fcl15DistanceRequestIdEC1EbbdddNS_13GJKSolverTypeE";
constexpr const char* kDistanceResult = "_ZN3fcl14DistanceResultIdEC1Ed";
constexpr const char* kObject =
    "_ZN3fcl15CollisionObjectIdEC1ERKSt10shared_ptrINS_17CollisionGeometryIdEEERKN5Eigen9"
    "TransformIdLi3ELi1ELi0EEE";
constexpr const char* kModelCopy = "_ZN3fcl8BVHModelINS_6OBBRSSIdEEEC1ERKS3_";

using Model = fcl::BVHModel<fcl::OBBRSSd>;

/// Memory for an object, with room for a larger one. What nobody writes is the same in all.
template <typename T>
struct Place {
  Place() { std::memset(bytes, 0xA5, sizeof(bytes)); }

  /// Whether both have the same bytes, but for what points into the places themselves.
  bool equals(const Place& other, std::size_t from = 0) const {
    for (std::size_t i = from; i + sizeof(std::uintptr_t) <= sizeof(bytes);
         i += sizeof(std::uintptr_t)) {
      const std::uintptr_t mine = word(i), theirs = other.word(i);
      if (mine != theirs && mine - address() != theirs - other.address()) return false;
    }
    return true;
  }
  T* get() { return reinterpret_cast<T*>(bytes); }

  alignas(64) unsigned char bytes[(sizeof(T) / 64 + 2) * 64];

 private:
  std::uintptr_t word(std::size_t i) const {
    std::uintptr_t value;
    std::memcpy(&value, bytes + i, sizeof(value));
    return value;
  }
  std::uintptr_t address() const { return reinterpret_cast<std::uintptr_t>(bytes); }
};

void* libraryOf(const void* definition) {
  Dl_info info;
  return dladdr(definition, &info) && info.dli_fname
             ? dlopen(info.dli_fname, RTLD_LAZY | RTLD_NOLOAD)
             : nullptr;
}

std::size_t sizeOf(void* library, const char* name) {
  void* const found = dlsym(library, name);
  Dl_info info;
  void* symbol = nullptr;
  if (!found || !dladdr1(found, &info, &symbol, RTLD_DL_SYMENT) || !symbol) return 0;
  return static_cast<const ElfW(Sym)*>(symbol)->st_size;
}

/// Objects that a library's constructors make beside those of the headers.
class Constructors {
 public:
  explicit Constructors(void* library) : library_(library) {}

  /// Whether a constructor makes, of these arguments, what the headers' makes. Objects with a table
  /// of virtual functions differ in that.
  template <typename T, typename... Args>
  bool makes(const char* name, Args... args) const {
    const auto theirs = find<void (*)(void*, Args...)>(name);
    if (!theirs) return false;
    Place<T> by_them, by_us;
    theirs(by_them.bytes, args...);
    new (by_us.bytes) T(args...);
    const bool equal = by_them.equals(by_us, std::is_polymorphic<T>::value ? sizeof(void*) : 0);
    by_us.get()->~T();  // nothing that it or theirs holds is allocated
    return equal;
  }

  bool makesObjects() const {
    using Pose = fcl::Transform3d;
    using Shared = std::shared_ptr<fcl::CollisionGeometryd>;
    const auto theirs = find<void (*)(void*, const Shared&, const Pose&)>(kObject);
    if (!theirs) return false;
    const Shared box = std::make_shared<fcl::Boxd>(1, 2, 3);
    Pose X = Pose::Identity();
    X.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    X.translation() << 4, 5, 6;
    Place<fcl::CollisionObjectd> by_them, by_us;
    theirs(by_them.bytes, box, X);
    new (by_us.bytes) fcl::CollisionObjectd(box, X);
    const bool equal = by_them.equals(by_us) && by_us.get()->getTransform().isApprox(X);
    by_us.get()->~CollisionObject();
    if (equal) by_them.get()->~CollisionObject();
    return equal;
  }

  /// A copy of a model, made by them and read by us.
  bool copiesModels() const {
    const auto theirs = find<void (*)(void*, const Model&)>(kModelCopy);
    if (!theirs) return false;
    Model model;
    model.beginModel();
    model.addTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    model.addTriangle({0, 0, 1}, {1, 0, 1}, {0, 1, 3});
    model.addTriangle({5, 0, 1}, {6, 0, 1}, {5, 1, 3});
    model.endModel();
    model.computeLocalAABB();
    Place<Model> place;
    const Place<Model> blank;
    theirs(place.bytes, model);
    const Model& copy = *place.get();
    const bool equal =
        std::memcmp(place.bytes + sizeof(Model), blank.bytes + sizeof(Model),
                    sizeof(place.bytes) - sizeof(Model)) == 0 &&
        copy.num_tris == model.num_tris && copy.num_vertices == model.num_vertices &&
        copy.build_state == model.build_state && copy.getNumBVs() == model.getNumBVs() &&
        copy.vertices != model.vertices && copy.tri_indices != model.tri_indices &&
        std::memcmp(static_cast<const void*>(copy.vertices),
                    static_cast<const void*>(model.vertices),
                    static_cast<std::size_t>(model.num_vertices) * sizeof(*model.vertices)) == 0 &&
        std::memcmp(static_cast<const void*>(copy.tri_indices),
                    static_cast<const void*>(model.tri_indices),
                    static_cast<std::size_t>(model.num_tris) * sizeof(*model.tri_indices)) == 0 &&
        copy.getNodeType() == fcl::BV_OBBRSS && copy.getObjectType() == fcl::OT_BVH &&
        copy.aabb_radius == model.aabb_radius && copy.aabb_center == model.aabb_center &&
        hasSameNodes(copy, model);
    if (equal) place.get()->~BVHModel();
    return equal;
  }

 private:
  template <typename Function>
  Function find(const char* name) const {
    return reinterpret_cast<Function>(dlsym(library_, name));
  }

  static bool hasSameNodes(const Model& a, const Model& b) {
    for (int i = 0; i < b.getNumBVs(); ++i) {
      const auto &p = a.getBV(i), &q = b.getBV(i);
      if (p.first_child != q.first_child || p.num_primitives != q.num_primitives ||
          p.bv.obb.To != q.bv.obb.To || p.bv.obb.extent != q.bv.obb.extent ||
          p.bv.rss.To != q.bv.rss.To || p.bv.rss.r != q.bv.rss.r) {
        return false;
      }
    }
    return true;
  }

  void* const library_;
};

const char* differenceOf(void* theirs, void* ours) {
  for (const char* const table : kTables) {
    const std::size_t size = sizeOf(theirs, table);
    if (size == 0 || size != sizeOf(ours, table)) return "virtual functions";
  }
  const Constructors make(theirs);
  if (!make.makes<CollisionRequest>(kCollisionRequest, std::size_t{3}, true, std::size_t{5}, true,
                                    false, fcl::GST_INDEP, 0.25) ||
      !make.makes<CollisionResult>(kCollisionResult)) {
    return "CollisionRequest or CollisionResult";
  }
  if (!make.makes<DistanceRequest>(kDistanceRequest, true, false, 0.25, 0.5, 0.125,
                                   fcl::GST_INDEP) ||
      !make.makes<DistanceResult>(kDistanceResult, 7.0)) {
    return "DistanceRequest or DistanceResult";
  }
  if (!make.makes<fcl::Boxd>(kBox, 1.0, 2.0, 3.0) || !make.makes<fcl::Sphered>(kSphere, 0.5)) {
    return "shapes";
  }
  if (!make.makesObjects()) return "CollisionObject";
  return make.copiesModels() ? nullptr : "BVHModel";
}

}  // namespace

const char* differenceOf(const Calls& fcl) {
  void* const ours = dlopen("libfcl.so.0.7", RTLD_LAZY | RTLD_NOLOAD);
  void* const theirs = libraryOf(reinterpret_cast<const void*>(fcl.collide));
  if (!ours || !theirs) return "its place";
  if (ours == theirs) return nullptr;
  try {
    return differenceOf(theirs, ours);
  } catch (const std::exception&) {
    return "what its constructors do";
  }
}

}  // namespace kios::preload
