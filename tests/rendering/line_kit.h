// What tests of rendered lines share.
#pragma once

#include <vector>

#include "rendering/rover_body.h"
#include "rendering/row_renderer.h"

namespace rockyard::rendering {

// A chassis on two wheels, within 20 cm of R's origin.
inline RoverBody SmallBody() {
  return {{{{-0.1, -0.1, 0.1}, {0.1, 0.1, 0.2}}},
          {{{0.0, 0.12, 0.05}, 0.05, 0.02}, {{0.0, -0.12, 0.05}, 0.05, 0.02}}};
}

// Light of one lamp on each pixel of a line, electrons per second.
inline std::vector<double> LampRates(const RenderedRow& row, int lamp) {
  std::vector<double> rates(row.sun_e_s.size());
  for (const RenderedRow::LampPixel& light : row.lamps) {
    if (light.lamp == lamp) rates[static_cast<std::size_t>(light.pixel)] += light.rate_e_s;
  }
  return rates;
}

}  // namespace rockyard::rendering
