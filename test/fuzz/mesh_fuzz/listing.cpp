// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/mesh_fuzz/listing.h"

#include <ios>

namespace kios::fuzz {

void list(const Case& c, const Failure& failure, std::ostream& out) {
  const auto flags = out.flags();
  out << std::hexfloat << "#include <fcl_kios/fcl_kios.h>\n"
      << "using S = " << (c.in_float ? "float" : "double") << ";\n"
      << "int main() {\n";
  for (std::size_t m = 0; m < c.meshes.size(); ++m) {
    const char name = static_cast<char>('A' + m);
    out << "  auto " << name << " = kios::makeModel<S>({";
    for (const Vector3d& p : c.meshes[m].vertices) {
      out << "{S(" << p[0] << "), S(" << p[1] << "), S(" << p[2] << ")}, ";
    }
    out << "},\n    {";
    for (const fcl::Triangle& t : c.meshes[m].triangles) {
      out << "{" << t[0] << ", " << t[1] << ", " << t[2] << "}, ";
    }
    out << "});\n";
  }
  if (c.foreign) out << "  // a user's bv_fitter fits the models' nodes, which motions walk\n";
  for (std::size_t f = 0; f < c.frames.size(); ++f) {
    const std::string name = f == 0 ? "X" : "X" + std::to_string(f);
    out << "  fcl::Transform3<S> " << name << "[" << c.frames[f].size() << "];\n";
    for (std::size_t m = 0; m < c.frames[f].size(); ++m) {
      out << "  " << name << "[" << m << "]";
      const Transform3d& X = c.frames[f][m];
      if (X.matrix().isIdentity(0)) {
        out << ".setIdentity();\n";
        continue;
      }
      out << ".matrix() << ";
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 4; ++j) out << "S(" << X.matrix()(i, j) << "), ";
      }
      out << "0, 0, 0, 1;\n";
    }
  }
  out << "  fcl::DistanceResult<S> result;\n  fcl::CollisionResult<S> contacts;\n"
      << "  " << failure.call << ";  // " << failure.what << "\n}\n";
  out.flags(flags);
}

}  // namespace kios::fuzz
