// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "fcl_kios/model.h"

// Stores built models as bytes, for a file or another process, so that loading one needn't divide
// and fit its mesh.

namespace kios {

/// Returns the model's vertices, triangles and tree of volumes, its cost density and thresholds.
/// The bytes are the same on every machine, and equal meshes have equal bytes. Marks as solids,
/// previous vertices, user data and fits other than the tuned one aren't stored: a model whose tree
/// isn't what endModel() gives its mesh is stored with that tree. About 265 bytes a triangle where
/// triangles share their vertices, floats 220. Throws as validate().
template <typename S>
std::vector<unsigned char> save(const Model<S>& model);

/// Makes a finished model of what save() returned; of an mmap()ed file as well. Queries answer bit
/// by bit as if it had been built here. Bytes of 0.2 and older are read for their mesh, which is
/// built anew. The bytes are checked before they are used: their version, sizes and hash, then
/// indices, vertices and the shape of the tree. They are not needed afterwards. Throws
/// std::invalid_argument, saying what is wrong, for bytes that are cut off or altered, hold the
/// other scalar, or were written by a newer version of the library, and std::bad_alloc if memory
/// runs out. Whoever computes the hash anew can store volumes that don't contain their mesh, and
/// models of equal content, which share them, answer by them too: take models from those whom you
/// would take programs from.
template <typename S = double>
std::shared_ptr<Model<S>> load(const void* bytes, std::size_t size);

}  // namespace kios
