// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

// Bounds of single triangles, which stand for a node where a leaf is split. Notation and model of
// error are those of float_frame.h: u = 2^-24, S the sum of the lengths.

HWY_INLINE V3 cross(const V3& a, const V3& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
          hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE V3 unit(const V3& v) { return hn::Div(set(1), hn::Sqrt(dot(v, v))) * v; }
template <class Mask>
HWY_INLINE V3 select(Mask mask, const V3& yes, const V3& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

struct Axes {
  V3 along, across, normal;
};

/// Axes by a direction that is finite and not 0, for triangles that are all but segments.
HWY_INLINE Axes axesAlong(const V3& direction) {
  const V zero = hn::Zero(d), one = set(1);
  const V3 along = unit(direction), size = abs(along);
  const auto by_x = hn::And(hn::Le(size.x, size.y), hn::Le(size.x, size.z));
  const auto by_y = hn::Le(size.y, size.z);
  const V3 least =
      select(by_x, {one, zero, zero}, select(by_y, {zero, one, zero}, {zero, zero, one}));
  const V3 across = unit(cross(along, least));
  return {along, across, unit(cross(along, across))};
}

/// Boxes around the triangles of a leaf, one a lane: along the longest edge and the normal of each,
/// or, where a triangle is too thin for a normal, along its longest edge alone.
///
/// Each axis is within 8 u of an orthonormal frame's:
/// - the stored normal and edge plane are so within u; their product, 1.5 u from rounding of terms
///   whose absolute values have a norm below 1.3, within 5 u;
/// - unit() is off by u in direction and 4.5 u in length (square 3 u, root, quotient, product); the
///   product with an axis of coordinates is exact, and its direction at right angles.
/// The halves are measured from the centre as stored, along the axes as stored, by 5 roundings of
/// terms that add up to at most 1.8 times the sum of the halves; they grow by 32 u of that sum.
[[gnu::hot]] inline HWY_NOINLINE void boxTriangles(const LeafView& leaf, BoxBlock& out) {
  const CornerLanes corners(leaf.leaf);
  const V zero = hn::Zero(d);
  for (size_t l = 0; l < kLanes; l += step()) {
    V3 p[3];
    for (int k = 0; k < 3; ++k) p[k] = corners.pointOf(leaf.vertices, k, l);
    const auto row = [&](int i) { return rowsAt(leaf.faces + i, l); };
    const V3 e0 = p[1] - p[0], e1 = p[2] - p[1], e2 = p[0] - p[2];
    const V square0 = dot(e0, e0), square1 = dot(e1, e1), square2 = dot(e2, e2);
    const auto second = hn::Gt(square1, square0);
    const auto third = hn::Gt(square2, hn::Max(square0, square1));
    const auto byLongest = [&](const V3& of0, const V3& of1, const V3& of2) {
      return select(third, of2, select(second, of1, of0));
    };
    const V3 normal = row(kFacePlane);
    const V3 across = byLongest(row(kEdgePlanes), row(kEdgePlanes + 4), row(kEdgePlanes + 8));
    Axes axes = {cross(normal, across), across, normal};
    const auto thin = hn::Lt(dot(normal, normal), set(0.5F));
    if (!hn::AllFalse(d, thin)) {
      const V3 longest = byLongest(e0, e1, e2);
      const auto point = hn::Lt(dot(longest, longest), set(0x1p-80F));
      const Axes by_edge = axesAlong(select(point, {set(1), zero, zero}, longest));
      axes = {select(thin, by_edge.along, axes.along), select(thin, by_edge.across, axes.across),
              select(thin, by_edge.normal, axes.normal)};
    }
    const V3 axis[3] = {axes.along, axes.across, axes.normal};
    V3 center = p[0];
    for (const V3& e : axis) {
      const V t1 = dot(e, e0), t2 = hn::Neg(dot(e, e2));
      const V low = hn::Min(zero, hn::Min(t1, t2)), high = hn::Max(zero, hn::Max(t1, t2));
      center = center + hn::Mul(set(0.5F), hn::Add(low, high)) * e;
    }
    V half[3];
    for (int i = 0; i < 3; ++i) {
      const auto height = [&](int k) { return hn::Abs(dot(axis[i], p[k] - center)); };
      half[i] = hn::Max(hn::Max(height(0), height(1)), height(2));
      storeAt(axis[i], l, out.x[i], out.y[i], out.z[i]);
    }
    storeAt(center, l, out.x[kCenter], out.y[kCenter], out.z[kCenter]);
    const V more = hn::Mul(set(0x1p-19F), hn::Add(hn::Add(half[0], half[1]), half[2]));
    for (int i = 0; i < 3; ++i) hn::Store(hn::Add(half[i], more), d, out.half[i].v + l);
  }
}

/// The pad of bounds by a triangle's box, twice that of nodes' boxes: 256 u S, and twice that along
/// products of axes.
///
/// The counts of float_frame.h, with axes that are off by 8 u in place of 1 u, and g = 8 sqrt(3) *
/// 2 u < 28 u for the Gram matrix of the three:
/// - dual axes: g |h| <= 49 u r in place of 6 u r; a moved axis as a direction, off by 19 u in
/// place
///   of 12 u; the root of a sum of squares, g / 2; the box's moved axes, 12 u more of |h'|. That is
///   at most 49 + 7 + 14 + 21 = 91 u more of any length: 54, 90 and 25 u become at most 181 u;
/// - products of axes: a dot of w with an own axis takes two elements of the Gram matrix, off by 16
///   u each in place of 2 u: 28 u of h_i, 84 u r more; C is off by 7 u more an entry, and so four
///   factors of minors and one element, 35 u of 2.5 r', 88 u more; dual and moved axes as above.
///   48, 180 and 22 u become at most 340 u.
HWY_INLINE float trianglePad(const FloatFrame& frames) { return 2 * frames.box_pad; }

/// The boxes of the triangles of the leaves that were asked for last.
class BoxedTriangles {
 public:
  BoxedTriangles() { std::fill_n(leaves_, kKept, ~0U); }

  const BoxBlock& of(const Tree& tree, uint32_t leaf) {
    const uint32_t at = leaf % kKept;
    if (leaves_[at] != leaf) {
      leaves_[at] = leaf;
      boxTriangles(LeafView(tree, tree.leaves[leaf]), boxes_[at]);
    }
    return boxes_[at];
  }

  /// The box of one triangle.
  void of(const Tree& tree, uint32_t leaf, uint32_t lane, Box& out) {
    const BoxBlock& block = of(tree, leaf);
    for (int i = 0; i < kBoxColumns; ++i) {
      out.x[i] = block.x[i].v[lane];
      out.y[i] = block.y[i].v[lane];
      out.z[i] = block.z[i].v[lane];
    }
    for (int i = 0; i < 3; ++i) out.half[i] = block.half[i].v[lane];
    out.half[3] = 0;
  }

 private:
  static constexpr uint32_t kKept = 8;
  uint32_t leaves_[kKept];
  BoxBlock boxes_[kKept];
};

/// One triangle of a leaf in another frame, as a leaf's face.
struct MovedFace {
  HWY_INLINE MovedFace(const LeafView& leaf, uint32_t lane, const FloatPose& X) {
    for (int i = 0; i < kFaceRows; i += 4) {
      const Lanes* const from = leaf.faces + i;
      const Vec3 n = rotated(X, {from[0].v[lane], from[1].v[lane], from[2].v[lane]});
      const V offset = set(from[3].v[lane] - dot(n, vec3(X.t)));
      storeAt(inAllLanes(n), 0, rows[i], rows[i + 1], rows[i + 2]);
      hn::Store(offset, d, rows[i + 3].v);
    }
  }
  Faces faces() const { return {rows, 0}; }

  Lanes rows[kFaceRows];
};

/// The pad of Faces::distances() of a centre less a radius: 64 u S of rounding.
///
/// A height above the face, or beyond an edge, is off by 16 u S at most:
/// - where the point is moved, 9 u S for it, 5 u S for products and sums, 2 u S for the stored
///   plane and vertices (float_frame.h);
/// - where the planes are, 7 u of the lengths that a normal is multiplied with (4 u a coordinate),
///   3 u for either product, 2 u S for sums, 2 u S stored: 14 u S.
/// The root of the sum of two squares is off by sqrt(2) as much, 23 u S; planes at right angles but
/// for 2 u, 2 u S; squares, sum and root, 2 u S; less the radius and the pad, 2 u S. 29 u S in all.
///
/// A rotation that is one but for E, |E| <= 2 stretch, takes a normal to R n, where the plane's
/// is R^-T n: 2 stretch S off, times sqrt(2); bounds in the other frame scale by 1 + stretch. That
/// is 3.9 stretch S, of the 4 that two pads hold.
HWY_INLINE float prismPad(const FloatFrame& frames) { return 2 * frames.pad; }

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
