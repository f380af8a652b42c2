// Catalogues of rocks whose law is known, drawn without the code under test.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "campaign/site/rock_fit.h"
#include "core/random.h"

namespace rockyard::campaign {

// Diameters of Moore's law, by its inverse.
inline std::vector<double> MooreCatalogue(double k, const RockWindow& window,
                                          core::RandomStream stream) {
  const double most = std::pow(window.min_m, -2.66);
  const double least = std::pow(window.max_m, -2.66);
  std::vector<double> diameters_m;
  for (auto left = core::SamplePoisson(stream, window.area_m2 * k * (most - least)); left > 0;
       --left) {
    diameters_m.push_back(std::pow(most - stream.Uniform() * (most - least), -1.0 / 2.66));
  }
  return diameters_m;
}

// Diameters of Golombek and Rapp's law, by thinning a field of density 4 k q / (pi D^2), whose
// number is its integral.
inline std::vector<double> GolombekCatalogue(double cover, const RockWindow& window,
                                             core::RandomStream stream) {
  const double q = 1.79 + 0.152 / cover;
  const double most = 1.0 / window.min_m;
  const double least = 1.0 / window.max_m;
  const double mean = window.area_m2 * 4.0 / std::numbers::pi * cover * q * (most - least);
  std::vector<double> diameters_m;
  for (auto left = core::SamplePoisson(stream, mean); left > 0; --left) {
    const double diameter_m = 1.0 / (most - stream.Uniform() * (most - least));
    if (stream.Uniform() < std::exp(-q * diameter_m)) diameters_m.push_back(diameter_m);
  }
  return diameters_m;
}

}  // namespace rockyard::campaign
