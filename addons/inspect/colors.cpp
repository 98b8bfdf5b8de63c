// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "colors.h"

#include <algorithm>
#include <cmath>

namespace kios::inspect {

// OKLCH, in which equal steps look equal; B. Ottosson, "A perceptual color space for image
// processing", 2020.
Color colorOf(const VolumeTree& tree, int node, std::size_t place) {
  constexpr double kTurn = 6.283185307179586, kChroma = 0.125;
  const double lightness = place % 2 == 0 ? 0.74 : 0.64;
  const double hue = kTurn * (0.5 * (tree.first(node) + tree.last(node)) /
                                  static_cast<double>(tree.triangles().size()) +
                              0.2);
  const double a = kChroma * std::cos(hue), b = kChroma * std::sin(hue);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  const double rgb[3] = {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                         -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                         -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
  Color color;
  for (int i = 0; i < 3; ++i) {
    const double linear = std::clamp(rgb[i], 0.0, 1.0);
    const double encoded =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    color[i] = static_cast<std::uint8_t>(std::lround(255 * encoded));
  }
  return color;
}

Color meshColor(int which) { return which == 0 ? Color{214, 218, 224} : Color{226, 196, 150}; }

}  // namespace kios::inspect
