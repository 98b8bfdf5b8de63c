// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "fcl_kios/model/prepare.h"
#include "ray_caster.h"
#include "scenario.h"
#include "scenes/cad_shapes.h"
#include "scenes/random.h"
#include "scenes/ray_oracle.h"
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
  const auto in = [&](double x, double y, double z) -> Vector {
    const double a = random.uniform(-x, x), b = random.uniform(-y, y);
    return {a, b, random.uniform(-z, z)};
  };
  std::vector<Rayd> rays(static_cast<std::size_t>(count));
  for (Rayd& ray : rays) {
    ray.origin = toFloats(in(3, 3, 3));
    ray.direction = toFloats(in(1.45, 1.45, 0.45) - ray.origin);
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

struct OracleHit {
  long double t;
  int triangle;
};

/// All hits in exact arithmetic. Triangles that are farther from the line than they are large,
/// by a margin, are left out in double.
class Oracle {
 public:
  explicit Oracle(const scenes::Mesh& mesh) : mesh_(mesh) {
    for (const fcl::Triangle& t : mesh.triangles) {
      const Vector &p = mesh.vertices[t[0]], &q = mesh.vertices[t[1]], &r = mesh.vertices[t[2]];
      reach_.push_back(std::max((q - p).norm(), (r - p).norm()) + 1e-9);
    }
  }

  std::vector<OracleHit> all(const Rayd& ray) const {
    const scenes::RationalRay exact = {ray.origin, ray.direction, ray.t_min,
                                       std::numeric_limits<double>::max()};
    const Vector unit = ray.direction.normalized();
    std::vector<OracleHit> hits;
    for (std::size_t i = 0; i < reach_.size(); ++i) {
      const fcl::Triangle& t = mesh_.triangles[i];
      if ((mesh_.vertices[t[0]] - ray.origin).cross(unit).norm() > reach_[i]) continue;
      const auto hit = scenes::rationalRayHit(
          exact, {mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]});
      if (hit) hits.push_back({hit->t, static_cast<int>(i)});
    }
    return hits;
  }

 private:
  const scenes::Mesh& mesh_;
  std::vector<double> reach_;
};

/// Counts of a caster's wrong answers, by query.
struct Verdicts {
  std::size_t first = 0, any = 0, all = 0;
  double error = 0;  // of lengths, where the right triangle was hit
};

Verdicts judge(RayCaster& caster, const std::vector<Rayd>& rays,
               const std::vector<std::vector<OracleHit>>& exact) {
  Verdicts wrong;
  const std::size_t step = rays.size() / exact.size();
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const Rayd& ray = rays[i * step];
    const auto nearest =
        std::min_element(exact[i].begin(), exact[i].end(),
                         [](const OracleHit& a, const OracleHit& b) { return a.t < b.t; });
    const bool hit = nearest != exact[i].end();
    const auto first = caster.first(ray);
    bool right = first.has_value() == hit;
    if (first && hit) {  // one of the triangles that are nearest as double tells
      const long double last = nearest->t * (1 + 0x1p-52L);
      right = std::any_of(exact[i].begin(), exact[i].end(), [&](const OracleHit& h) {
        return h.triangle == first->triangle && h.t <= last;
      });
      const double error = std::abs(static_cast<double>(first->t - nearest->t));
      if (right) wrong.error = std::max(wrong.error, error * ray.direction.norm());
    }
    wrong.first += right ? 0 : 1;
    wrong.any += caster.any(ray) == hit ? 0 : 1;
    std::vector<CastHit> all;
    caster.all(ray, all);
    std::sort(all.begin(), all.end(),
              [](const CastHit& a, const CastHit& b) { return a.triangle < b.triangle; });
    const bool same =
        std::equal(all.begin(), all.end(), exact[i].begin(), exact[i].end(),
                   [](const CastHit& a, const OracleHit& b) { return a.triangle == b.triangle; });
    wrong.all += same ? 0 : 1;
  }
  return wrong;
}

/// Returns the three queries of all casters. One row a query and caster.
std::vector<Row> contest(const std::string& name,
                         const std::vector<std::unique_ptr<RayCaster>>& casters,
                         const std::vector<Rayd>& rays, const scenes::Mesh& mesh,
                         const Oracle& oracle, const Options& options) {
  std::vector<CastHit> hits;
  std::size_t found = 0;  // so that no query is optimised away
  const std::pair<const char*, std::function<void(RayCaster&, const Rayd&)>> queries[] = {
      {"first", [&](RayCaster& c, const Rayd& r) { found += c.first(r) ? 1 : 0; }},
      {"any", [&](RayCaster& c, const Rayd& r) { found += c.any(r) ? 1 : 0; }},
      {"all", [&](RayCaster& c, const Rayd& r) {
         c.all(r, hits);
         found += hits.size();
       }}};
  const auto most =
      static_cast<std::size_t>(std::max(20, 20000000 / static_cast<int>(mesh.triangles.size())));
  const std::size_t judged = std::min(
      {rays.size(), most,
       options.oracle_frames > 0 ? static_cast<std::size_t>(options.oracle_frames) : rays.size()});
  std::vector<std::vector<OracleHit>> exact;
  for (std::size_t i = 0; i < judged; ++i)
    exact.push_back(oracle.all(rays[i * (rays.size() / judged)]));
  std::vector<Verdicts> wrong;
  for (const auto& caster : casters) wrong.push_back(judge(*caster, rays, exact));

  Row base;
  base.scenario = name;
  base.triangles = mesh.triangles.size();
  base.frames = rays.size();
  base.seed = options.seed;
  base.extent = scenes::extent(mesh);
  std::vector<Row> rows;
  for (const auto& [query, cast] : queries) {
    std::vector<Competitor> competitors;
    for (const auto& caster : casters) {
      competitors.push_back({caster->name(), [&](std::size_t begin, std::size_t end) {
                               for (std::size_t i = begin; i < end; ++i) cast(*caster, rays[i]);
                             }});
    }
    Race{rays.size(), options.repeats, Race::kAll, Race::kAll, true}.run(competitors);
    base.query = query;
    for (std::size_t c = 0; c < casters.size(); ++c) {
      Row& row = rows.emplace_back(base.of(competitors[c]));
      if (row.bv == "kios") row.simd_target = simdTarget();
      if (const auto before = casters[c]->counts()) {
        competitors[c].answer(0, rays.size());
        const auto after = casters[c]->counts();
        const auto per_ray = [&](long long n) { return static_cast<double>(n) / rays.size(); };
        row.tests = {per_ray(after->volume_tests - before->volume_tests),
                     per_ray(after->exact - before->exact)};
      }
      const auto& [first, any, all, error] = wrong[c];
      row.errors.wrong = row.query == "first" ? first : row.query == "any" ? any : all;
      if (row.query == "first") row.errors.max_abs = error;
    }
  }
  if (found == 0) std::printf("no ray hits\n");
  return rows;
}

void castAt(const std::string& name, scenes::Mesh mesh, const Options& options, Report& report) {
  const int count = options.frames > 0 ? options.frames : (options.quick ? 100 : 4096);
  for (Vector& p : mesh.vertices) p = toFloats(p);
  std::vector<std::unique_ptr<RayCaster>> casters;
  casters.push_back(makeKiosCaster(mesh));
  if (auto embree = makeEmbreeCaster(mesh)) casters.push_back(std::move(embree));
  const Oracle oracle(mesh);
  std::vector<Row> rows;
  const auto add = [&](const char* kind, const std::vector<Rayd>& rays) {
    append(contest(name + "/" + kind, casters, rays, mesh, oracle, options), rows);
  };
  add("camera", cameraRays(count));
  add("random", randomRays(count, options.seed));
  add("edges", edgeRays(count, mesh, options.seed));
  report.add(rows);
}

}  // namespace

void runRays(const Options& options, Report& report) {
  for (const int size : {1000, 20000, 80000, 320000, 1000000}) {
    if (size > (options.quick ? 1000 : options.max_triangles)) break;
    castAt("rays/" + std::to_string(size), scenes::bumpyTorus(size), options, report);
  }
  // 1,600 triangles, 600 times as long as wide, enlarged to the torus's size.
  scenes::Mesh strips = scenes::stripCylinder(400, 0.6, 0.001);
  for (Vector& p : strips.vertices) p *= 4;
  castAt("rays/strips", std::move(strips), options, report);
}

}  // namespace kios::bench
