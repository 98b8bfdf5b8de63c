// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "preload/copy_cache.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "fcl_kios/model.h"
#include "tree/fingerprint.h"

namespace kios::preload {
namespace {

using engine::Fingerprint;
using engine::fingerprint;

/// Returns bytes that copies may take: FCL_KIOS_PRELOAD_MIB, else 1 GiB.
std::size_t limitOfEnvironment() {
  constexpr long long kDefault = 1024, kMost = 1LL << 40;
  const char* const text = std::getenv("FCL_KIOS_PRELOAD_MIB");
  long long mib = text ? std::atoll(text) : kDefault;
  if (mib < 1 || mib > kMost) {
    std::fprintf(stderr,
                 "fcl_kios_preload: FCL_KIOS_PRELOAD_MIB is \"%s\", but must be a number of MiB "
                 "from 1 on: it is taken as %lld.\n",
                 text, kDefault);
    mib = kDefault;
  }
  return static_cast<std::size_t>(mib) << 20;
}

Fingerprint fingerprintOf(const Mesh& mesh) {
  return fingerprint(mesh.vertices, mesh.vertexBytes(), mesh.triangles, mesh.triangleBytes());
}

/// Returns what a copy costs to make, in nanoseconds.
double priceOf(const Mesh& mesh) { return 5e3 + 950.0 * static_cast<double>(mesh.num_triangles); }

/// This part of FCL's time, by the prices of its tests, may be spent on copies. They cost 0.3 of it
/// at most: the prices are a slow machine's, on others FCL takes less.
constexpr double kShare = 0.22;

/// Holds a copy and what it was made of. Constant, but for the count of fits.
struct Content {
  Mesh mesh;
  Fingerprint print;
  std::shared_ptr<const Modeld> copy;
  std::size_t bytes = 0;
  std::atomic<std::uint64_t> fits_at_last_comparison{0};
};

/// Returns nullptr for a mesh that k-IOS refuses.
std::unique_ptr<Content> makeContent(const Mesh& mesh, std::uint64_t fits) {
  try {
    const std::vector<fcl::Vector3d> vertices(mesh.vertices, mesh.vertices + mesh.num_vertices);
    const std::vector<fcl::Triangle> triangles(mesh.triangles, mesh.triangles + mesh.num_triangles);
    auto content = std::make_unique<Content>();
    content->mesh = mesh;
    content->fits_at_last_comparison.store(fits, std::memory_order_relaxed);
    const auto copy = makeModel(vertices, triangles);
    const Mesh copied = {copy.get(), copy->vertices, copy->tri_indices, mesh.num_vertices,
                         mesh.num_triangles};
    content->print = fingerprintOf(copied);
    // The content that is proven later by its fingerprint is, byte by byte, the copy's.
    if (std::memcmp(copied.vertices, mesh.vertices, mesh.vertexBytes()) != 0 ||
        std::memcmp(copied.triangles, mesh.triangles, mesh.triangleBytes()) != 0) {
      return nullptr;
    }
    content->bytes = mesh.bytes() + preparedBytes(*copy) +
                     mesh.num_triangles * (2 * sizeof(fcl::BVNode<kIOSd>) + sizeof(unsigned int));
    content->copy = copy;
    return content;
  } catch (const std::exception&) {
    return nullptr;
  }
}

constexpr std::uint32_t kClosed = 1U << 31;
constexpr std::size_t kSets = 512, kWays = 8;

}  // namespace

/// Holds the place of one model.
struct alignas(64) CopyCache::Cell {
  std::atomic<std::uint32_t> holders{0};  ///< kClosed is added while the next two change
  std::unique_ptr<Content> content;
  std::uint32_t serial = 0;

  std::atomic<bool> stale{false}, making{false};
  std::atomic<double> paid{0};
  std::atomic<std::uint32_t> uses{0};   ///< of this copy
  std::atomic<std::uint32_t> price{1};  ///< factor; grows for models that change often
  std::atomic<std::uint32_t> used_at{0};

  bool tryHold() {
    if (holders.fetch_add(1, std::memory_order_acquire) < kClosed) return true;
    holders.fetch_sub(1, std::memory_order_release);
    return false;
  }
  void release() { holders.fetch_sub(1, std::memory_order_release); }

  /// Waits for those who hold it; others go without meanwhile.
  void close() {
    holders.fetch_or(kClosed, std::memory_order_acquire);
    while (holders.load(std::memory_order_acquire) != kClosed) std::this_thread::yield();
  }
  bool tryClose() {
    std::uint32_t nobody = 0;
    return holders.compare_exchange_strong(nobody, kClosed, std::memory_order_acquire);
  }
  void open() { holders.fetch_and(~kClosed, std::memory_order_release); }
};

/// Models by their addresses, in sets of a few places.
struct CopyCache::Table {
  struct Set {
    std::atomic<const Geometry*> models[kWays] = {};
    Cell cells[kWays];
  };
  Set sets[kSets];
  std::mutex changing;
  std::atomic<int> makers{0};  ///< threads in make(): they lock more than `changing`
  std::atomic<bool> forking{false};
  std::atomic<std::uint32_t> clock{1};  ///< of queries that FCL answered for want of a copy
  std::uint32_t num_serials = 0;
  std::size_t bytes = 0, count = 0;

  static std::size_t setOf(const Geometry* model) {
    return (reinterpret_cast<std::uintptr_t>(model) * 0x9E3779B97F4A7C15U) >> 50 & (kSets - 1);
  }

  /// The cell of a model; it may become another's unless it is held, or `changing` locked.
  Cell* find(const Geometry* model) {
    Set& set = sets[setOf(model)];
    for (std::size_t i = 0; i < kWays; ++i) {
      if (set.models[i].load(std::memory_order_acquire) == model) return &set.cells[i];
    }
    return nullptr;
  }

  // The following want `changing` locked.

  /// Gives a model a place: an empty one, else that which was not used for longest. nullptr if
  /// somebody holds that: the caller may, so it must not be waited for.
  Cell* insert(const Geometry* model) {
    Set& set = sets[setOf(model)];
    std::size_t best = 0;
    for (std::size_t i = 0; i < kWays; ++i) {
      if (!set.models[i].load(std::memory_order_relaxed)) {
        best = i;
        break;
      }
      if (age(set.cells[i]) > age(set.cells[best])) best = i;
    }
    Cell& cell = set.cells[best];
    if (!cell.tryClose()) return nullptr;
    fill(cell, nullptr);
    set.models[best].store(model, std::memory_order_release);
    cell.serial = ++num_serials;
    cell.paid.store(0, std::memory_order_relaxed);
    cell.price.store(1, std::memory_order_relaxed);
    cell.used_at.store(clock.load(std::memory_order_relaxed), std::memory_order_relaxed);
    cell.open();
    return &cell;
  }

  std::uint32_t age(const Cell& cell) const {
    return clock.load(std::memory_order_relaxed) - cell.used_at.load(std::memory_order_relaxed);
  }

  /// Fills a closed cell.
  void fill(Cell& cell, std::unique_ptr<Content> content) {
    if (cell.content) bytes -= cell.content->bytes, --count;
    if (content) bytes += content->bytes, ++count;
    cell.content = std::move(content);
    cell.stale.store(false, std::memory_order_relaxed);
    cell.uses.store(0, std::memory_order_relaxed);
  }

  void exchange(Cell& cell, std::unique_ptr<Content> content) {
    cell.close();
    fill(cell, std::move(content));
    cell.open();
  }

  /// Drops what was not used for longest until so many bytes are left; false if that can't be.
  bool makeRoom(std::size_t wanted, std::size_t limit) {
    if (wanted > limit) return false;
    while (bytes + wanted > limit) {
      Cell* oldest = nullptr;
      for (Set& set : sets) {
        for (Cell& cell : set.cells) {
          if (!cell.content) continue;
          if (!oldest || age(cell) > age(*oldest)) oldest = &cell;
        }
      }
      if (!oldest) return false;
      exchange(*oldest, nullptr);
    }
    return true;
  }
};

CopyCache::ModelLease::ModelLease(ModelLease&& o) noexcept
    : cache_(o.cache_), cell_(std::exchange(o.cell_, nullptr)), mesh_(o.mesh_) {}

CopyCache::ModelLease::~ModelLease() {
  if (cell_) cell_->release();
}

bool CopyCache::ModelLease::hasCopy() const {
  return cell_ && cell_->content && !cell_->stale.load(std::memory_order_relaxed);
}

bool CopyCache::ModelLease::trusted() const {
  if (cache_->mode_ != Mode::kTrust) return false;
  const Content& content = *cell_->content;
  return content.mesh == mesh_ &&
         content.fits_at_last_comparison.load(std::memory_order_relaxed) ==
             cache_->fits_.count.load(std::memory_order_acquire) &&
         cache_->fits_.seen(mesh_.vertices);
}

std::size_t CopyCache::ModelLease::bytesToCompare() const {
  return hasCopy() && trusted() ? 0 : mesh_.bytes();
}

bool CopyCache::ModelLease::isCurrent() const {
  if (trusted()) {
    cell_->uses.fetch_add(1, std::memory_order_relaxed);
    return true;
  }
  Content& content = *cell_->content;
  const std::uint64_t fits = cache_->fits_.count.load(std::memory_order_acquire);
  const bool equal = content.mesh.num_vertices == mesh_.num_vertices &&
                     content.mesh.num_triangles == mesh_.num_triangles &&
                     content.print == fingerprintOf(mesh_);
  if (equal) {
    if (content.mesh == mesh_) {
      content.fits_at_last_comparison.store(fits, std::memory_order_relaxed);
    }
    cell_->uses.fetch_add(1, std::memory_order_relaxed);
    return true;
  }
  if (!cell_->stale.exchange(true, std::memory_order_relaxed)) {
    // A model that changes all the time shall not cost a copy for every few queries.
    constexpr std::uint32_t kOften = 256, kMost = 1024;
    const std::uint32_t price = cell_->price.load(std::memory_order_relaxed);
    const bool often = cell_->uses.load(std::memory_order_relaxed) < kOften;
    cell_->price.store(often ? std::min(2 * price, kMost) : 1, std::memory_order_relaxed);
    cell_->paid.store(0, std::memory_order_relaxed);
  }
  return false;
}

const Modeld& CopyCache::ModelLease::copy() const { return *cell_->content->copy; }
std::uint32_t CopyCache::ModelLease::serial() const { return cell_->serial; }

CopyCache::CopyCache(const Start& start)
    : mode_(start.mode),
      fits_(*start.fits),
      limit_(limitOfEnvironment()),
      table_(std::make_unique<Table>()) {
  fingerprint(nullptr, 0, nullptr, 0);  // its keys, of which a fork sees all or none
}
CopyCache::~CopyCache() = default;

CopyCache::ModelLease CopyCache::lease(const Mesh& mesh) {
  Cell* cell = table_->find(mesh.model);
  if (!cell) {
    const std::unique_lock<std::mutex> lock(table_->changing, std::try_to_lock);
    if (!lock) return {};
    cell = table_->find(mesh.model);
    if (!cell) cell = table_->insert(mesh.model);
  }
  if (!cell || !cell->tryHold()) return {};
  ModelLease lease;
  lease.cache_ = this;
  lease.cell_ = cell;
  lease.mesh_ = mesh;
  if (table_->find(mesh.model) != cell) return {};  // another's by now
  const std::uint32_t now = table_->clock.load(std::memory_order_relaxed);
  if (cell->used_at.load(std::memory_order_relaxed) != now) {
    cell->used_at.store(now, std::memory_order_relaxed);
  }
  return lease;
}

void CopyCache::pay(const Mesh& mesh, double nanoseconds) {
  table_->clock.fetch_add(1, std::memory_order_relaxed);
  Cell* const cell = table_->find(mesh.model);
  if (!cell) return;
  const double paid = cell->paid.load(std::memory_order_relaxed) + nanoseconds;
  cell->paid.store(paid, std::memory_order_relaxed);  // one of two at once may be lost
  const double price = priceOf(mesh) * cell->price.load(std::memory_order_relaxed);
  if (kShare * paid >= price) make(mesh);
}

void CopyCache::make(const Mesh& mesh) {
  struct Maker {
    explicit Maker(std::atomic<int>& all) : makers(all) { ++makers; }
    ~Maker() { --makers; }
    std::atomic<int>& makers;
  } const maker(table_->makers);
  if (table_->forking) return;  // another query will
  Cell* const asked = table_->find(mesh.model);
  if (!asked || asked->making.exchange(true, std::memory_order_acquire)) return;
  std::unique_ptr<Content> made = makeContent(mesh, fits_.count.load(std::memory_order_acquire));
  {
    const std::lock_guard<std::mutex> lock(table_->changing);
    Cell* const cell = table_->find(mesh.model);
    if (cell) {
      table_->exchange(*cell, nullptr);
      if (made && table_->makeRoom(made->bytes, limit_)) {
        table_->exchange(*cell, std::move(made));
        cell->paid.store(0, std::memory_order_relaxed);
      } else {
        constexpr double kPatience = 16;  // times its price, before it is tried again
        cell->paid.store(-kPatience * priceOf(mesh), std::memory_order_relaxed);
      }
    }
  }
  asked->making.store(false, std::memory_order_release);
}

void CopyCache::beforeFork() {
  table_->forking = true;
  while (table_->makers > 0) std::this_thread::yield();
  table_->changing.lock();  // so that no cell is closed
}

void CopyCache::afterFork() {
  table_->changing.unlock();
  table_->forking = false;
}

void CopyCache::afterForkInChild() {
  for (Table::Set& set : table_->sets) {
    for (Cell& cell : set.cells) cell.holders.store(0, std::memory_order_relaxed);
  }
  afterFork();
}

std::size_t CopyCache::count() const {
  const std::lock_guard<std::mutex> lock(table_->changing);
  return table_->count;
}

std::size_t CopyCache::bytes() const {
  const std::lock_guard<std::mutex> lock(table_->changing);
  return table_->bytes;
}

}  // namespace kios::preload
