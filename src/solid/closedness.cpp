// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/solid/closedness.h"

#include <locale>
#include <sstream>

#include "model/kios_model.h"
#include "model/prepared.h"
#include "solid/components.h"
#include "volume/instantiate.h"

namespace kios {

template <typename S>
Closedness<S> inspectClosedness(const Model<S>& model) {
  requireFinished(model);
  return Components<S>(viewOf(model)).closedness();
}

template <typename S>
Closedness<S> inspectClosedness(const std::vector<fcl::Vector3<S>>& vertices,
                                const std::vector<fcl::Triangle>& triangles) {
  return Components<S>({vertices.data(), vertices.size(), triangles.data(), triangles.size()})
      .closedness();
}

template <typename S>
std::string faultsOf(const Closedness<S>& c) {
  if (c.isSolid()) return {};
  if (c.edges == 0) return "it has no edges";
  std::ostringstream text;
  text.imbue(std::locale::classic());
  const char* separator = "";
  const auto add = [&](int n, const char* one, const char* many) {
    if (n == 0) return;
    text << separator << n << " " << (n == 1 ? one : many);
    separator = ", ";
  };
  add(c.open_edges, "open edge", "open edges");
  add(c.misoriented_edges, "misoriented edge", "misoriented edges");
  add(c.inside_out, "component inside out", "components inside out");
  if (c.inside_out > 0) text << " (with triangle " << c.first_inside_out << ")";
  separator = "; the first: ";
  for (const FaultyEdge<S>& edge : c.first) {
    if (edge.triangle < 0) break;
    text << separator << "triangle " << edge.triangle << ", (" << edge.from.transpose() << ") to ("
         << edge.to.transpose() << ")";
    separator = "; ";
  }
  return text.str();
}

template Closednessd inspectClosedness(const Modeld&);
template Closednessf inspectClosedness(const Modelf&);
template Closednessd inspectClosedness(const std::vector<fcl::Vector3d>&,
                                       const std::vector<fcl::Triangle>&);
template Closednessf inspectClosedness(const std::vector<fcl::Vector3f>&,
                                       const std::vector<fcl::Triangle>&);
KIOS_INSTANTIATE_FUNCTION(faultsOf);

}  // namespace kios
