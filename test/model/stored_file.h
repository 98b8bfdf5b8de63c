// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "fcl_kios/storage.h"
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
    const XXH128_hash_t hash =
        stored::hashOf(repaired, bytes.data() + sizeof(repaired), bytes.size() - sizeof(repaired));
    repaired.hash_low = hash.low64;
    repaired.hash_high = hash.high64;
    put(0, repaired);
  }

  /// As versions 1 and 2 wrote it: their nodes had eight bytes more, and in version 2 a prepared
  /// tree came last.
  void toVersion(std::uint32_t version) {
    const StoredFile from = *this;
    header.version = version;
    at = stored::Layout::of(header, S());
    bytes.assign(at.end + (version == 2 ? 4000 : 0), 7);
    header.size = bytes.size();
    if (version == 2) header.older0 = header.older[0] = header.older[1] = 5;
    put(0, header);
    const auto copy = [&](std::uint64_t to, std::uint64_t begin, std::uint64_t end) {
      std::copy_n(from.bytes.begin() + static_cast<std::ptrdiff_t>(begin), end - begin,
                  bytes.begin() + static_cast<std::ptrdiff_t>(to));
    };
    copy(at.vertices, from.at.vertices, from.at.end);
    repairHash();
    readHeader();
  }

  std::shared_ptr<Model<S>> load() const { return kios::load<S>(bytes.data(), bytes.size()); }
};

}  // namespace kios::testing
