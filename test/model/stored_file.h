// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstring>
#include <utility>
#include <vector>

#include "fcl_kios/model/storage.h"
#include "model/stored_format.h"

namespace kios::testing {

/// Bytes of a stored model, with its parts to be written.
template <typename S = double>
struct StoredFile {
  using Bytes = std::vector<unsigned char>;
  Bytes bytes;
  stored::Header header;
  stored::Layout at;

  explicit StoredFile(Bytes of) : bytes(std::move(of)) { readHeader(); }

  void readHeader() {
    std::memcpy(&header, bytes.data(), sizeof(header));
    at = stored::Layout::of(header, S());
  }
  template <typename T>
  T get(std::uint64_t place) const {
    T value;
    std::memcpy(static_cast<void*>(&value), &bytes.at(place), sizeof(value));
    return value;
  }
  template <typename T>
  void put(std::uint64_t place, const T& value) {
    std::memcpy(&bytes.at(place), static_cast<const void*>(&value), sizeof(value));
  }
  std::uint64_t node(std::uint64_t i) const { return at.nodes + i * sizeof(stored::Node<S>); }

  void repairHash() {
    auto repaired = get<stored::Header>(0);
    stored::Hash hash(repaired);
    hash.add(bytes.data() + sizeof(repaired), bytes.size() - sizeof(repaired));
    hash.writeTo(repaired);
    put(0, repaired);
  }

  /// As versions wrote it that stored no prepared tree.
  void toVersion1() {
    bytes.resize(at.prepared);
    header.version = 1;
    header.size = bytes.size();
    header.num_leaves = header.num_blocks = header.num_lanes = header.num_features = 0;
    header.parts = 0;
    put(0, header);
    repairHash();
    readHeader();
  }

  std::shared_ptr<Model<S>> load() const { return kios::load<S>(bytes.data(), bytes.size()); }
};

}  // namespace kios::testing
