// Rock fields that the quasi-static rover is measured in.
#pragma once

#include <numbers>

#include "rover/rover_drive.h"
#include "terrain/rock.h"

namespace rockyard::rover {

// Rocks of N(>=D) = k D^-2.66 per m2 from 0.1 m to max_m, half buried, at low-discrepancy places:
// fixed fields, numbered from 0, of any profile.
inline terrain::Terrain ScatteredRocks(double k, double max_m, int number,
                                       double pointedness = 0.0) {
  constexpr double kExponent = 2.66;
  constexpr double kSmallest_m = 0.1;
  constexpr double kArea_m2 = 14.0 * 6.0;
  const auto scatter = [](int index, double stride) {
    return std::fmod(0.5 + stride * index, 1.0);
  };
  const int count = static_cast<int>(k * std::pow(kSmallest_m, -kExponent) * kArea_m2);
  std::vector<terrain::Rock> rocks;
  for (int i = 1000 * (number + 1); i < 1000 * (number + 1) + count; ++i) {
    const double x = -2.0 + 14.0 * scatter(i, 0.7548776662466927);
    const double y = -3.0 + 6.0 * scatter(i, 0.5698402909980532);
    const double tail = 1.0 - scatter(i, 0.6180339887498949) * (1.0 - std::pow(10.0, -kExponent));
    const double a = 0.5 * kSmallest_m * std::pow(tail, -1.0 / kExponent);
    if (2.0 * a > max_m || std::hypot(x, y) < 0.6 + a) continue;
    rocks.push_back(terrain::ShapeRock(
        {.diameter_m = 2.0 * a, .width_ratio = 0.85, .half_height_m = 0.7 * a, .height_m = 0.7 * a},
        pointedness));
    rocks.back().center_W.head<2>() << x, y;
    rocks.back().yaw_rad = 2.0 * std::numbers::pi * scatter(i, 0.3247179572447461);
  }
  return FlatTerrain(std::move(rocks));
}

}  // namespace rockyard::rover
