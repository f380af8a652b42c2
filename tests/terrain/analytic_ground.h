// Grounds that are known in closed form, sampled to elevation models.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "terrain/ground.h"

namespace rockyard::terrain {

using HeightAt = std::function<double(double, double)>;

// A model of 12 m x 8 m from (-5, -4) on; the cell must divide a metre.
inline ElevationParams Sampled(const HeightAt& height, double cell_m) {
  ElevationParams params;
  params.cell_m = cell_m;
  params.columns = std::lround(12.0 / cell_m) + 1;
  params.origin_column = std::lround(5.0 / cell_m);
  params.origin_row = std::lround(4.0 / cell_m);
  const std::int64_t rows = std::lround(8.0 / cell_m) + 1;
  for (std::int64_t row = 0; row < rows; ++row) {
    for (std::int64_t column = 0; column < params.columns; ++column) {
      params.heights_m.push_back(height(static_cast<double>(column - params.origin_column) * cell_m,
                                        static_cast<double>(row - params.origin_row) * cell_m));
    }
  }
  return params;
}

inline Ground GroundOn(const ElevationParams& model, const SoilParams& soil = {}) {
  GroundParams params;
  params.elevation = model;
  params.soil = soil;
  return Ground(params, {});
}

// Hills of 4 m and 3 m, 0.15 m high: slopes up to 0.4.
inline double Hills(double x_m, double y_m) {
  return 0.15 * std::sin(2.0 * std::numbers::pi * x_m / 4.0) *
         std::cos(2.0 * std::numbers::pi * y_m / 3.0);
}

// A ground with the largest sum of its fourth derivatives along x and along y, 1/m3, at places with
// x > -1.5 m.
struct AnalyticGround {
  std::string name;
  HeightAt height;
  double fourth_per_m3;

  // Returns the bound of the height's error away from the edges, m (elevation_model.h).
  double Bound_m(double cell_m) const {
    return 5.0 / 384.0 * std::pow(cell_m, 4.0) * fourth_per_m3 + 1e-12;
  }
};

// The cone's apex, where it has no derivative, lies 3.5 m behind those places. Along a line that
// passes the apex at a distance r the fourth derivative of the distance is no more than 3 / r^3.
inline std::vector<AnalyticGround> AnalyticGrounds() {
  const double kx = 2.0 * std::numbers::pi / 4.0;
  const double ky = 2.0 * std::numbers::pi / 3.0;
  return {{"plane", [](double x, double y) { return 0.15 * x - 0.1 * y; }, 0.0},
          {"cone", [](double x, double y) { return 0.25 * std::hypot(x + 5.0, y); },
           0.25 * 2.0 * 3.0 / std::pow(3.5, 3.0)},
          {"hills", Hills, 0.15 * (std::pow(kx, 4.0) + std::pow(ky, 4.0))}};
}

}  // namespace rockyard::terrain
