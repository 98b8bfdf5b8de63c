// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// fcl::collide: the pairs of triangles that it names against all that intersect.

#include <set>

#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include "fcl_kios/overloads.h"
#include "fuzz/mesh_fuzz/pair.h"
#include "fuzz/mesh_fuzz/questions.h"

namespace kios::fuzz {
namespace {

template <typename S>
Verdict contacts(const Case& c) {
  using Ids = std::pair<int, int>;
  Random random(c.draw);
  const ModelPair<S> pair(c);
  const BruteForce<S> truth(c.meshes[0], pair.X, c.meshes[1], pair.Y);
  const std::set<Ids> hits(truth.hits.begin(), truth.hits.end());
  const std::size_t some = 1 + static_cast<std::size_t>(below(random, 5));
  for (const std::size_t limit : {std::size_t{1}, some, std::size_t{1} << 30}) {
    for (const bool with_points : {false, true}) {
      fcl::CollisionRequest<S> request(limit, with_points);
      fcl::CollisionResult<S> result;
      const std::size_t n =
          fcl::collide(pair.A.get(), pair.X, pair.B.get(), pair.Y, request, result);
      const std::string call = "fcl::CollisionRequest<S> request(" + std::to_string(limit) +
                               (with_points ? ", true" : ", false") +
                               "); fcl::collide(A.get(), X[0], B.get(), X[1], request, contacts)";
      std::set<Ids> found;
      std::vector<fcl::Contact<S>> all;
      result.getContacts(all);
      for (const auto& contact : all) {
        const Ids ids = {static_cast<int>(contact.b1), static_cast<int>(contact.b2)};
        found.insert(ids);
        if (hits.count(ids) == 0) {
          return failure(Words() << "triangles " << text(ids) << " don't intersect", call);
        }
        if (with_points &&
            !(contact.pos.allFinite() && std::abs(double{contact.normal.stableNorm()} - 1) < 1e-3 &&
              contact.penetration_depth >= 0 && std::isfinite(contact.penetration_depth))) {
          return failure(Words() << "contact of " << text(ids) << " at " << contact.pos[0] << ", "
                                 << contact.pos[1] << ", " << contact.pos[2] << ", normal "
                                 << contact.normal[0] << ", " << contact.normal[1] << ", "
                                 << contact.normal[2] << ", depth " << contact.penetration_depth,
                         call);
        }
      }
      if (n != all.size() || n > limit || (n == 0) != hits.empty() ||
          (n < limit && found.size() != hits.size()) ||
          (!with_points && found.size() != std::min(limit, hits.size()))) {
        Words words;
        words << n << " contacts of " << found.size() << " pairs, but " << hits.size()
              << " intersect";
        for (const Ids& ids : hits) {
          if (found.count(ids) == 0) {
            words << "; missed " << text(ids);
            break;
          }
        }
        return failure(words, call);
      }
    }
  }
  return std::nullopt;
}

}  // namespace

Verdict askContacts(const Case& c) { return c.in_float ? contacts<float>(c) : contacts<double>(c); }

}  // namespace kios::fuzz
