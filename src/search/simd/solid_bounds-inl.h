// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// Bounds of distances from a solid, in lanes. solid_search.h derives the pads.
class SolidBounds {
 public:
  using Form = FloatSolid::Form;

  explicit SolidBounds(const FloatSolid& solid)
      : solid_(solid), box_(solid.box), normal_(vec(solid.normal)) {}

  /// Signed lower bounds of the distances of points, without a pad. Negative ones are as deep in
  /// the solid, if it tells_inside.
  HWY_INLINE V points(const V3& p) const {
    if (!isBounded()) return isPlane() ? hn::Abs(height(p)) : height(p);
    const V3 at = box_.along(p - box_.center);
    switch (solid_.form) {
      case Form::kCylinder:
        return product(hn::Sub(radial(at), set(solid_.radius)),
                       hn::Sub(hn::Abs(at.z), box_.half.z));
      case Form::kCone:
        return cone(at);
      case Form::kEllipsoid:
        return ellipsoid(at);
      default:
        return hn::Sub(box(at), set(solid_.margin));
    }
  }

  /// Heights over a half-space or a plane.
  V height(const V3& p) const { return hn::Sub(dot(normal_, p), set(solid_.offset)); }

  /// Lower bounds by S0, and for two axes the caps on the far side; the pad is subtracted.
  HWY_INLINE V spheres(const Block& block, size_t l) const {
    const Spheres s0 = spheresAt(block, kCentral, l);
    const V3& c = s0.center;
    V best = hn::Sub(points(c), s0.r);
    V3 way = normal_;
    if (isBounded()) {
      const V3 v = c - box_.center;
      way = v - box_.towards(box_.along(v));
    } else if (isPlane()) {
      way = height(c) * normal_;
    }
    for (const int middle : {int{kMiddle2}, int{kMiddle1}}) {
      const Spheres half = spheresAt(block, middle + 1, l);
      const Spheres cap = capOf(spheresAt(block, middle, l), half, dot(half.center, way));
      best = hn::Max(best, hn::Sub(points(cap.center), cap.r));
    }
    return hn::Sub(best, set(solid_.pad));
  }

  /// Lower bounds by boxes, at least `bounds`. In contact any positive one decides.
  HWY_INLINE V boxes(const BoxBlock& block, size_t l, bool contact, V bounds) const {
    const BoxLanes of_mesh(block, l);
    V lower;
    if (!isBounded()) {
      const V reach = dot(abs(of_mesh.along(normal_)), of_mesh.half);
      lower = hn::Sub(points(of_mesh.center), hn::Add(reach, set(solid_.box_pad)));
    } else {
      lower = contact && solid_.margin == 0 ? contactBounds(of_mesh, box_, solid_.box_pad)
                                            : distanceBounds(of_mesh, box_, solid_.box_pad);
    }
    // What isn't apart by boxes is at distance 0 of the core at least.
    const V apart = hn::Sub(lower, set(solid_.margin));
    return hn::IfThenElse(hn::Gt(lower, hn::Zero(d)), hn::Max(bounds, apart), bounds);
  }

  /// Raises the bounds of spheres, or of triangles, by the slabs that were added.
  V spheresOverSlabs(const Block& block, size_t l, const std::vector<FloatSlab>& slabs,
                     V bounds) const {
    const Spheres s0 = spheresAt(block, kCentral, l);
    V highest = set(-kInfinityFloat);
    for (const FloatSlab& slab : slabs) {
      highest = hn::Max(highest, hn::Sub(dot(vec(slab.n), s0.center), set(slab.offset)));
    }
    return hn::Max(bounds, hn::Sub(highest, hn::Add(s0.r, set(solid_.pad))));
  }
  V trianglesOverSlabs(const V3 (&p)[3], const std::vector<FloatSlab>& slabs, V bounds) const {
    V highest = set(-kInfinityFloat);
    for (const FloatSlab& slab : slabs) {
      const V3 n = vec(slab.n);
      const V low = hn::Min(hn::Min(dot(n, p[0]), dot(n, p[1])), dot(n, p[2]));
      highest = hn::Max(highest, hn::Sub(low, set(slab.offset)));
    }
    return hn::Max(bounds, hn::Sub(highest, set(solid_.pad)));
  }

  bool isBounded() const { return solid_.form < Form::kHalfspace; }
  /// points() is the distance, but for the pad.
  bool tellsDistance() const { return solid_.form != Form::kContained && !isEllipsoid(); }
  bool tellsInside() const { return solid_.tells_inside; }
  /// A triangle on both sides of the plane touches it.
  bool isPlane() const { return solid_.form == Form::kPlane; }

 private:
  static V3 vec(const float* v) { return inAllLanes(vec3(v)); }
  static V radial(const V3& at) {
    return hn::Sqrt(hn::Add(hn::Mul(at.x, at.x), hn::Mul(at.y, at.y)));
  }
  bool isEllipsoid() const { return solid_.form == Form::kEllipsoid; }

  V box(const V3& at) const {
    const V3 q = abs(at) - box_.half;
    const V inside = hn::Min(hn::Max(hn::Max(q.x, q.y), q.z), hn::Zero(d));
    return hn::Add(inside, hn::Sqrt(square(positive(q.x), positive(q.y), positive(q.z))));
  }

  /// The signed distance from a product of two sets, by those from both.
  static V product(V u, V v) {
    const V a = positive(u), b = positive(v);
    return hn::Add(hn::Min(hn::Max(u, v), hn::Zero(d)),
                   hn::Sqrt(hn::Add(hn::Mul(a, a), hn::Mul(b, b))));
  }

  /// As conePoint() in shape/solid.cpp. Inside, base and side are nearest; only segments and disks
  /// need the apex's height and the radius to tell what is inside.
  V cone(const V3& at) const {
    const V n_rho = set(solid_.slant_radial), n_z = set(solid_.slant_axial);
    const V out = hn::Sub(radial(at), set(solid_.radius)), up = hn::Add(at.z, box_.half.z);
    const V base = hn::Neg(up);
    const V slant = hn::Add(hn::Mul(n_rho, out), hn::Mul(n_z, up));
    const V along =
        hn::Min(positive(hn::Sub(hn::Mul(n_rho, up), hn::Mul(n_z, out))), set(solid_.slant_length));
    const V side_rho = hn::Add(out, hn::Mul(n_z, along)),
            side_z = hn::Sub(up, hn::Mul(n_rho, along));
    const V rim = positive(out);
    const V to_side = hn::Add(hn::Mul(side_rho, side_rho), hn::Mul(side_z, side_z));
    const V to_base = hn::Add(hn::Mul(rim, rim), hn::Mul(base, base));
    const V inside = hn::Max(hn::Max(base, slant), hn::Max(out, hn::Sub(at.z, box_.half.z)));
    return hn::IfThenElse(hn::Le(inside, hn::Zero(d)), inside, hn::Sqrt(hn::Min(to_side, to_base)));
  }

  /// Outside by the slab across the normal x_i / (e_i^2 + t), which any t makes a bound: see
  /// ellipsoidBound() in shape/solid.cpp. Inside, |x / e| - 1 times the least radius.
  V ellipsoid(const V3& at) const {
    const V3 &e = box_.half, e2 = {hn::Mul(e.x, e.x), hn::Mul(e.y, e.y), hn::Mul(e.z, e.z)};
    const V3 scaled = {hn::Mul(e.x, at.x), hn::Mul(e.y, at.y), hn::Mul(e.z, at.z)};
    const V largest = hn::Max(hn::Max(e.x, e.y), e.z), least = hn::Min(hn::Min(e.x, e.y), e.z);
    const V square_of_largest = hn::Mul(largest, largest);
    V t = positive(hn::Sub(hn::Sqrt(dot(scaled, scaled)), square_of_largest));
    // A flat one's squares would be divided by 0.
    t = hn::Add(t, hn::Add(hn::Mul(set(0x1p-20F), square_of_largest), set(0x1p-100F)));
    const V3 n = {hn::Div(at.x, hn::Add(e2.x, t)), hn::Div(at.y, hn::Add(e2.y, t)),
                  hn::Div(at.z, hn::Add(e2.z, t))};
    const V3 en = {hn::Mul(e.x, n.x), hn::Mul(e.y, n.y), hn::Mul(e.z, n.z)};
    const V length2 = dot(n, n), least2 = set(0x1p-100F);
    const auto usable = hn::And(hn::Ge(length2, least2), hn::Le(length2, set(0x1p100F)));
    const V slab =
        hn::Div(hn::Sub(dot(n, at), hn::Sqrt(dot(en, en))), hn::Sqrt(hn::Max(length2, least2)));
    V best = hn::Max(box(at), hn::IfThenElse(usable, slab, hn::Neg(largest)));
    if (solid_.tells_inside) {
      const V3 unit = {hn::Div(at.x, e.x), hn::Div(at.y, e.y), hn::Div(at.z, e.z)};
      const V off = hn::Sub(hn::Sqrt(dot(unit, unit)), set(1));
      best = hn::IfThenElse(hn::Gt(best, hn::Zero(d)), best,
                            hn::Min(hn::Mul(off, least), hn::Zero(d)));
    }
    return best;
  }

  const FloatSolid& solid_;
  const BoxLanes box_;
  const V3 normal_;
};

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
