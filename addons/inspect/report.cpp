// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report.h"

#include <cstdarg>
#include <cstdio>

#include "fcl_kios/model.h"

namespace kios::inspect {
namespace {

/// Appends to a string as printf does.
__attribute__((format(printf, 2, 3))) void print(std::string& out, const char* format, ...) {
  char line[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  out += line;
}

Json toJson(const fcl::Vector3d& v) { return {v[0], v[1], v[2]}; }

std::string seconds(double s) {
  std::string text;
  if (s < 1e-3) {
    print(text, "%.1f us", 1e6 * s);
  } else if (s < 1) {
    print(text, "%.1f ms", 1e3 * s);
  } else {
    print(text, "%.1f s", s);
  }
  return text;
}

std::string bytes(std::size_t n) {
  std::string text;
  if (n < 10000) {
    print(text, "%zu B", n);
  } else if (n < 10000000) {
    print(text, "%.0f kB", static_cast<double>(n) / 1e3);
  } else {
    print(text, "%.0f MB", static_cast<double>(n) / 1e6);
  }
  return text;
}

std::string surface(const Closedness& surface) {
  if (surface.edges == 0) return "not a surface";
  std::string text;
  if (surface.closed) {
    text = "closed";
    if (surface.components > 1) print(text, ", %d components", surface.components);
  } else {
    print(text, "open, %d open %s", surface.open_edges, surface.open_edges == 1 ? "edge" : "edges");
  }
  return text;
}

Json toJson(const RepairResultd& r) {
  return {{"weld", r.weld},
          {"welded_vertices", r.welded_vertices},
          {"moved_vertices", r.moved_vertices},
          {"farthest_weld", r.farthest_weld},
          {"degenerate_triangles", r.degenerate_triangles},
          {"double_triangles", r.double_triangles},
          {"flipped_triangles", r.flipped_triangles},
          {"filled_holes", r.filled.size()},
          {"filled_triangles", r.filled_triangles},
          {"open_holes", r.open.size()}};
}

}  // namespace

Json toJson(const Inspection& i) {
  Json levels = Json::array();
  for (const LevelTightness& level : i.levels) {
    levels.push_back({{"level", level.level},
                      {"volumes", level.volumes},
                      {"leaves", level.leaves},
                      {"k", {{"1", level.k[0]}, {"3", level.k[1]}, {"5", level.k[2]}}},
                      {"measured", level.measured},
                      {"content_size", level.slack.size},
                      {"slack_mean", level.slack.mean},
                      {"slack_max", level.slack.max},
                      {"slack_mean_s0", level.slack.mean_s0}});
  }
  return {{"file", i.file},
          {"parts", i.mesh.parts},
          {"triangles", i.mesh.triangles.size()},
          {"solid", i.defects.surface.isSolid()},
          {"surface", surface(i.defects.surface)},
          {"vertices", i.mesh.vertices.size()},
          {"distinct_vertices", i.defects.distinct_vertices},
          {"box", {{"lower", toJson(i.box.min())}, {"upper", toJson(i.box.max())}}},
          {"defects",
           {{"zero_area", i.defects.zero_area},
            {"slivers", i.defects.slivers},
            {"duplicates", i.defects.duplicates},
            {"unreferenced_vertices", i.defects.unreferenced},
            {"open_edges", i.defects.surface.open_edges},
            {"misoriented_edges", i.defects.surface.misoriented_edges},
            {"inside_out_components", i.defects.surface.inside_out},
            {"branching_edges", i.defects.surface.branching_edges},
            {"points_and_lines", i.mesh.other_faces}}},
          {"self_intersections",
           {{"crosses", i.count(Meeting::kCross)},
            {"overlaps", i.count(Meeting::kOverlap)},
            {"touches", i.count(Meeting::kTouch)},
            {"complete", i.self_intersections.size() < kMostSelfIntersections}}},
          {"warnings", i.warnings()},
          {"repaired", i.repaired ? toJson(*i.repaired) : Json(nullptr)},
          {"nodes", i.nodes()},
          {"depth", i.tree->depth()},
          {"k", {{"1", i.k[0]}, {"3", i.k[1]}, {"5", i.k[2]}}},
          {"model_bytes", i.model_bytes},
          {"prepared_bytes", i.prepared_bytes},
          {"read_seconds", i.read_seconds},
          {"build_seconds", i.build_seconds},
          {"levels", levels}};
}

Json toJson(const PairQuery& q) {
  const auto pose = [](const fcl::Transform3d& X) -> Json {
    const fcl::Quaterniond r(X.linear());
    return {{"translation", toJson(fcl::Vector3d(X.translation()))},
            {"quaternion_wxyz", {r.w(), r.x(), r.y(), r.z()}}};
  };
  return {{"pose_a", pose(q.X_WA)},
          {"pose_b", pose(q.X_WB)},
          {"distance", q.answer.distance},
          {"lower_bound", q.answer.lower_bound},
          {"upper_bound", q.answer.upper_bound},
          {"point_a", toJson(q.answer.point_a)},
          {"point_b", toJson(q.answer.point_b)},
          {"triangle_a", q.answer.triangle_a},
          {"triangle_b", q.answer.triangle_b},
          {"repeats", q.repeats},
          {"median_us", 1e6 * q.median_seconds},
          {"min_us", 1e6 * q.min_seconds},
          {"simd_target", simdTarget()}};
}

std::string toText(const Inspection& i) {
  const fcl::Vector3d sizes = i.box.sizes();
  const double n = static_cast<double>(i.mesh.triangles.size());
  std::string out;
  out += i.file + "\n";
  if (i.repaired) out += "  repaired   " + summaryOf(*i.repaired) + "\n";
  print(out, "  triangles  %zu in %d %s, %s\n", i.mesh.triangles.size(), i.mesh.parts,
        i.mesh.parts == 1 ? "mesh" : "meshes", surface(i.defects.surface).c_str());
  print(out, "  vertices   %zu distinct of %zu as read\n", i.defects.distinct_vertices,
        i.mesh.vertices.size());
  print(out, "  box        %g x %g x %g, from (%g, %g, %g)\n", sizes[0], sizes[1], sizes[2],
        i.box.min()[0], i.box.min()[1], i.box.min()[2]);
  print(out, "  nodes      %d in %d levels; k = 1: %zu, 3: %zu, 5: %zu\n", i.nodes(),
        i.tree->depth() + 1, i.k[0], i.k[1], i.k[2]);
  print(out, "  memory     model %s, prepared tree %s: %.0f B a triangle\n",
        bytes(i.model_bytes).c_str(), bytes(i.prepared_bytes).c_str(),
        static_cast<double>(i.model_bytes + i.prepared_bytes) / n);
  print(out, "  time       read %s, build %s\n", seconds(i.read_seconds).c_str(),
        seconds(i.build_seconds).c_str());
  for (const std::string& warning : i.warnings()) {
    out += "  warning    " + warning + "\n";
  }
  if (i.levels.empty()) return out;
  out += "\n  level  volumes   leaves    k=1    k=3    k=5       size   slack    max   S0 alone\n";
  for (const LevelTightness& level : i.levels) {
    print(out, "  %5d  %7zu  %7zu %6zu %6zu %6zu  %9.3g  %5.1f%%  %4.0f%%     %5.1f%%\n",
          level.level, level.volumes, level.leaves, level.k[0], level.k[1], level.k[2],
          level.slack.size, 100 * level.slack.mean, 100 * level.slack.max,
          100 * level.slack.mean_s0);
  }
  out +=
      "  size: mean size of the contents; slack: how far volumes reach beyond them, in parts of "
      "it\n";
  return out;
}

std::string toText(const PairQuery& q) {
  const DistanceBracketResult<double>& a = q.answer;
  std::string out;
  print(out, "distance     %.17g%s\n", a.distance,
        a.distance == 0 ? " (the meshes touch or intersect)" : "");
  const auto witness = [&](const char* name, const fcl::Vector3d& p, int triangle) {
    print(out, "  %s   (%.9g, %.9g, %.9g) on triangle %d\n", name, p[0], p[1], p[2], triangle);
  };
  witness("point on A", a.point_a, a.triangle_a);
  witness("point on B", a.point_b, a.triangle_b);
  print(out, "  time         %s, median of %d (least %s), %s\n", seconds(q.median_seconds).c_str(),
        q.repeats, seconds(q.min_seconds).c_str(), simdTarget());
  return out;
}

}  // namespace kios::inspect
