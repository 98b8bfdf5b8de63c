// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "fcl_kios/model.h"
#include "library.h"
#include "ray_caster.h"
#include "scenario.h"
#include "scenes/cad_shapes.h"
#include "scenes/containment_oracle.h"
#include "scenes/random.h"
#include "scenes/shapes.h"

namespace kios::bench {
namespace {

using Vector = fcl::Vector3d;

Vector toFloats(const Vector& v) { return v.cast<float>().cast<double>(); }

/// Returns a camera that looks at the torus: line by line, two thirds of them hit.
std::vector<Rayd> cameraRays(int count) {
  const int side = std::max(2, static_cast<int>(std::sqrt(count)));
  const Vector eye(2.5, 1.5, 2), ahead = -eye.normalized();
  const Vector right = ahead.cross(Vector::UnitZ()).normalized(), up = right.cross(ahead);
  std::vector<Rayd> rays;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double u = (x + 0.5) / side - 0.5, v = (y + 0.5) / side - 0.5;
      Rayd& ray = rays.emplace_back();
      ray.origin = toFloats(eye);
      ray.direction = toFloats(ahead + 0.7 * u * right + 0.7 * v * up);
    }
  }
  return rays;
}

/// From anywhere around the torus to anywhere in its box.
std::vector<Rayd> randomRays(int count, std::uint64_t seed) {
  scenes::Random random(seed);
  std::vector<Rayd> rays(static_cast<std::size_t>(count));
  for (Rayd& ray : rays) {
    ray.origin = toFloats(random.inCube(-3, 3));
    ray.direction =
        toFloats(Vector(1.45, 1.45, 0.45).cwiseProduct(random.inCube(-1, 1)) - ray.origin);
  }
  return rays;
}

/// At vertices and at points of edges, from anywhere: where rays get lost between triangles.
std::vector<Rayd> edgeRays(int count, const scenes::Mesh& mesh, std::uint64_t seed) {
  scenes::Random random(seed);
  std::vector<Rayd> rays = randomRays(count, seed + 1);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(
        random.unit() * static_cast<double>(mesh.triangles.size()))];
    const Vector &p = mesh.vertices[t[0]], &q = mesh.vertices[t[1]];
    rays[i].direction = toFloats(p + (i % 2 == 0 ? 0 : random.unit()) * (q - p) - rays[i].origin);
  }
  return rays;
}

using OracleHit = scenes::RayOracle::Hit;

/// Adds its work.
RayCaster kiosCaster(const scenes::Mesh& mesh, SearchCounts& counts) {
  return [model = scenes::buildModel<kIOSd>(mesh), &counts](RayQuery query, const Rayd& ray,
                                                            std::vector<CastHit>& hits) {
    static const fcl::Transform3d here = fcl::Transform3d::Identity();
    hits.clear();
    if (query == RayQuery::kAny) {
      if (anyHit(*model, here, ray, &counts)) hits.push_back({0, -1});
    } else if (query == RayQuery::kFirst) {
      if (const auto hit = firstHit(*model, here, ray, &counts)) {
        hits.push_back({hit->t, hit->triangle});
      }
    } else {
      constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
      for (const auto& hit : allHits(*model, here, ray, kAll, &counts)) {
        hits.push_back({hit.t, hit.triangle});
      }
    }
  };
}

/// Whether hits, by triangle, are what a query asks for, and the error of the first one's length.
bool isRight(RayQuery query, const Rayd& ray, const std::vector<CastHit>& hits,
             const std::vector<OracleHit>& exact, double& worst) {
  if (query == RayQuery::kAll) {
    return std::equal(
        hits.begin(), hits.end(), exact.begin(), exact.end(),
        [](const CastHit& a, const OracleHit& b) { return a.triangle == b.triangle; });
  }
  if (query == RayQuery::kAny || hits.empty() || exact.empty())
    return hits.empty() == exact.empty();
  const auto nearest = std::min_element(
      exact.begin(), exact.end(), [](const OracleHit& a, const OracleHit& b) { return a.t < b.t; });
  // One of the triangles that are nearest as double tells.
  const long double last = nearest->t * (1 + 0x1p-52L);
  const bool right = std::any_of(exact.begin(), exact.end(), [&](const OracleHit& h) {
    return h.triangle == hits[0].triangle && h.t <= last;
  });
  const double error = std::abs(static_cast<double>(hits[0].t - nearest->t));
  if (right) worst = std::max(worst, error * ray.direction.norm());
  return right;
}

/// The oracle's hits of some rays, evenly chosen.
struct Judged {
  std::size_t step;
  std::vector<std::vector<OracleHit>> exact;
};

Judged judge(const std::vector<Rayd>& rays, const scenes::Mesh& mesh, const Options& options) {
  const auto affordable =
      static_cast<std::size_t>(std::max(20, 20000000 / static_cast<int>(mesh.triangles.size())));
  std::size_t count = std::min(rays.size(), affordable);
  if (options.oracle_frames > 0) {
    count = std::min(count, static_cast<std::size_t>(options.oracle_frames));
  }
  const scenes::RayOracle oracle(mesh);
  Judged judged{rays.size() / count, {}};
  for (std::size_t i = 0; i < count; ++i) {
    const Rayd& ray = rays[i * judged.step];
    judged.exact.push_back(
        oracle.hits({ray.origin, ray.direction, ray.t_min, std::numeric_limits<double>::max()}));
  }
  return judged;
}

/// A row for each query and caster.
std::vector<Row> contest(const std::string& name, const std::vector<Rayd>& rays,
                         const scenes::Mesh& mesh, const Options& options) {
  SearchCounts work;
  std::vector<std::pair<const char*, RayCaster>> casters = {{kOurs, kiosCaster(mesh, work)}};
#ifdef KIOS_HAVE_EMBREE
  casters.emplace_back("embree", embreeCaster(mesh));
#endif
  const Judged judged = judge(rays, mesh, options);
  std::vector<CastHit> hits;
  std::vector<Row> rows;
  for (const auto& [query, words] :
       {std::pair(RayQuery::kFirst, "first"), std::pair(RayQuery::kAny, "any"),
        std::pair(RayQuery::kAll, "all")}) {
    std::vector<Competitor> competitors;
    for (const auto& [bv, caster] : casters) {
      competitors.push_back({bv, each([&, query = query, &caster = caster](std::size_t i) {
                               caster(query, rays[i], hits);
                             })});
    }
    Race{rays.size(), options.repeats, Race::kAll, Race::kAll, true}.run(competitors);
    const Row base = baseRow(name, words, rays.size(), {mesh});
    for (std::size_t c = 0; c < casters.size(); ++c) {
      Row& row = rows.emplace_back(base.of(competitors[c]));
      double worst = 0;
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < judged.exact.size(); ++i) {
        const Rayd& ray = rays[i * judged.step];
        casters[c].second(query, ray, hits);
        std::sort(hits.begin(), hits.end(),
                  [](const CastHit& a, const CastHit& b) { return a.triangle < b.triangle; });
        wrong += isRight(query, ray, hits, judged.exact[i], worst) ? 0 : 1;
      }
      row.errors.wrong = wrong;
      if (query == RayQuery::kFirst) row.errors.max_abs = worst;
      if (row.bv != kOurs) continue;
      work = {};
      competitors[c].answer(0, rays.size());
      const auto count = static_cast<double>(rays.size());
      row.tests = {static_cast<double>(work.volume_tests) / count,
                   static_cast<double>(work.exact) / count};
    }
  }
  return rows;
}

void castAt(const std::string& name, scenes::Mesh mesh, const Options& options, Report& report) {
  const int count = options.frames > 0 ? options.frames : (options.quick ? 100 : 4096);
  for (Vector& p : mesh.vertices) p = toFloats(p);
  std::vector<Row> rows;
  append(contest(name + "/camera", cameraRays(count), mesh, options), rows);
  append(contest(name + "/random", randomRays(count, options.seed), mesh, options), rows);
  append(contest(name + "/edges", edgeRays(count, mesh, options.seed), mesh, options), rows);
  report.add(rows);
}

}  // namespace

void runRays(const Options& options, Report& report) {
  for (const int size : allowed(options, {1000, 20000, 80000, 320000, 1000000})) {
    castAt("rays/" + std::to_string(size), scenes::bumpyTorus(size), options, report);
  }
  // 1,600 triangles, 600 times as long as wide, enlarged to the torus's size.
  scenes::Mesh strips = scenes::stripCylinder(400, 0.6, 0.001);
  for (Vector& p : strips.vertices) p *= 4;
  castAt("rays/strips", std::move(strips), options, report);
}

}  // namespace kios::bench
