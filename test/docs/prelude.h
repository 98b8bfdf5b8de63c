// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Names that the code in the documentation may use without declaring them.
#pragma once

#include <fcl_kios/fcl_kios.h>

#include <iostream>
#include <memory>
#include <vector>

inline std::shared_ptr<kios::Modeld> model, other;
inline std::vector<fcl::Vector3d> vertices;
inline std::vector<fcl::Triangle> triangles;
inline fcl::Transform3d X_W, X_W2, X_W3;
inline fcl::CollisionObjectd collision_object(std::make_shared<fcl::Sphered>(1));
inline bool allowed(int a, int b) { return a < b; }
