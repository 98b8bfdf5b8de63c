// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <fcl/geometry/collision_geometry.h>
#include <fcl/narrowphase/collision_object.h>
#include "fcl_kios/scene.h"
#include "scene/body.h"
#include "search/mesh_pair.h"

namespace kios::scene {

/// What a body has in it: all that depends on the scene's scalar.
class Content {
 public:
  virtual ~Content() = default;
  /// Measures the geometry anew, which has changed.
  virtual void renew(Body& body) = 0;
  /// Brings the body up to date with its fcl::CollisionObject, and with its mesh or shape if that
  /// has changed. Throws std::invalid_argument as makeBody() does.
  virtual void refresh(Body& body) = 0;
  virtual bool isFollowed() const = 0;

  /// A distance rounded to the scalar, as answers are.
  virtual double rounded(double distance) const = 0;
  /// The pair of two meshes, in the frame that the poses as given make.
  virtual MeshPair pairOf(const Body& a, const Body& b) const = 0;
  /// Tells whether two meshes are solids and one, whose surface is apart from the other's, lies in
  /// it.
  virtual bool contained(const Content& other, const MeshPair& pair,
                         SearchCounts& counts) const = 0;
  /// The narrow phase of bodies that are not both meshes: an answer but for the ids.
  virtual ScenePaird ask(const Body& a, const Body& b, bool nearest_points) const = 0;
};

/// The body of a geometry at a pose. Throws std::invalid_argument if the geometry is null or a mesh
/// that is not finished, or the pose is not rigid.
template <typename S>
Body makeBody(std::shared_ptr<const fcl::CollisionGeometry<S>> geometry,
              const fcl::Transform3<S>& X_W);
/// That of an object, which is followed from then on.
template <typename S>
Body makeBody(const fcl::CollisionObject<S>& object);

/// Moves the body. Throws std::invalid_argument if the pose is not rigid; the body then is as it
/// was.
template <typename S>
void move(Body& body, const fcl::Transform3<S>& X_W);

}  // namespace kios::scene
