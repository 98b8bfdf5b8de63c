// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "model/lent_volumes.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <new>
#include <shared_mutex>
#include <unordered_map>
#include <utility>
#include <vector>

namespace kios {
namespace {

using engine::ContentHash;

struct Loan {
  Loan(const ContentHash& c, const void* n, const void* p) : content(c), nodes(n), primitives(p) {}

  const ContentHash content;
  const void *const nodes, *const primitives;
  std::size_t place = 0;      ///< among those of equal content; guarded by the ledger's mutex
  std::shared_mutex reading;  ///< held while nodes and primitives are copied
  bool withdrawn = false;     ///< guarded by `reading`
};

struct Ledger {
  std::unordered_map<const void*, std::shared_ptr<Loan>> by_nodes;
  std::unordered_map<ContentHash, std::vector<Loan*>, engine::HashOfContent> by_content;
};

// Neither has a destructor, and the ledger is there only while something is lent: models may live
// longer than the library's static objects.
std::mutex mutex;
Ledger* ledger = nullptr;

std::shared_ptr<Loan> find(const ContentHash& content) {
  const std::lock_guard<std::mutex> lock(mutex);
  if (!ledger) return nullptr;
  const auto found = ledger->by_content.find(content);
  return found == ledger->by_content.end() ? nullptr
                                           : ledger->by_nodes.at(found->second.back()->nodes);
}

/// The mutex must be locked.
void closeIfEmpty() {
  if (ledger->by_nodes.empty()) delete std::exchange(ledger, nullptr);
}

/// The mutex must be locked. Enters nothing where there is no memory.
void enter(const ContentHash& content, const void* nodes, const void* primitives) {
  try {
    if (!ledger) ledger = new Ledger;
    const auto loan = std::make_shared<Loan>(content, nodes, primitives);
    if (!ledger->by_nodes.emplace(nodes, loan).second) return;  // these are lent already
    std::vector<Loan*>& equal = ledger->by_content[content];
    loan->place = equal.size();
    equal.push_back(loan.get());
  } catch (const std::bad_alloc&) {
    if (!ledger) return;
    ledger->by_nodes.erase(nodes);
    const auto equal = ledger->by_content.find(content);
    if (equal != ledger->by_content.end() && equal->second.empty()) {
      ledger->by_content.erase(equal);
    }
    closeIfEmpty();
  }
}

/// The mutex must be locked.
std::shared_ptr<Loan> strike(const void* nodes) {
  const auto found = ledger->by_nodes.find(nodes);
  if (found == ledger->by_nodes.end()) return nullptr;
  std::shared_ptr<Loan> loan = std::move(found->second);
  ledger->by_nodes.erase(found);
  const auto equal = ledger->by_content.find(loan->content);
  std::vector<Loan*>& loans = equal->second;
  loans[loan->place] = loans.back();
  loans[loan->place]->place = loan->place;
  loans.pop_back();
  if (loans.empty()) ledger->by_content.erase(equal);
  closeIfEmpty();
  return loan;
}

}  // namespace

template <typename S>
bool copyLentVolumes(const ContentHash& content, std::size_t n, const TreeArrays<S>& to) {
  const std::shared_ptr<Loan> loan = find(content);
  if (!loan) return false;
  const std::shared_lock<std::shared_mutex> lock(loan->reading);
  if (loan->withdrawn) return false;
  std::copy_n(static_cast<const fcl::BVNode<kIOS<S>>*>(loan->nodes), 2 * n - 1, to.nodes);
  std::copy_n(static_cast<const unsigned int*>(loan->primitives), n, to.primitives);
  return true;
}

void lendVolumes(const ContentHash& content, const void* nodes, const void* primitives) {
  const std::lock_guard<std::mutex> lock(mutex);
  enter(content, nodes, primitives);
}

void lendCopy(const void* nodes, const void* copied_nodes, const void* copied_primitives) {
  const std::lock_guard<std::mutex> lock(mutex);
  if (!ledger) return;
  const auto found = ledger->by_nodes.find(nodes);
  if (found == ledger->by_nodes.end()) return;
  enter(ContentHash(found->second->content), copied_nodes, copied_primitives);
}

void withdrawVolumes(const void* nodes) {
  std::shared_ptr<Loan> loan;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (!nodes || !ledger) return;
    loan = strike(nodes);
  }
  if (!loan) return;
  const std::unique_lock<std::shared_mutex> lock(loan->reading);
  loan->withdrawn = true;
}

template bool copyLentVolumes(const ContentHash&, std::size_t, const TreeArrays<double>&);
template bool copyLentVolumes(const ContentHash&, std::size_t, const TreeArrays<float>&);

}  // namespace kios
