#include "campaign/site/surface_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/check.h"
#include "core/numbers.h"
#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::campaign {
namespace {

// The centred B-spline of degree 7 at u, over its value at 0: the autocorrelation of a cubic
// B-spline with independent coefficients, at a distance of u spacings along an axis, averaged over
// places. By truncated powers (de Boor 1978): sum_k (-1)^k C(8, k) (u + 4 - k)_+^7 / 7!.
double Correlation(double u) {
  constexpr std::array<double, 9> kBinomials{1, 8, 28, 56, 70, 56, 28, 8, 1};
  constexpr double kAtZero = 2416.0;  // of the same sum
  // From the nearer end, where fewer terms cancel.
  const double from_end = 4.0 - std::abs(u);
  if (from_end <= 0.0) return 0.0;
  double sum = 0.0;
  double sign = 1.0;
  for (std::size_t k = 0; k < kBinomials.size(); ++k, sign = -sign) {
    const double base = from_end - static_cast<double>(k);
    if (base <= 0.0) break;
    const double cube = base * base * base;
    sum += sign * kBinomials[k] * cube * cube * base;
  }
  return sum / kAtZero;
}

// The same at a distance of lag_m, of means over a width of the heights along the axis.
double MeanCorrelation(double lag_m, double spacing_m, double width_m) {
  if (width_m == 0.0) return Correlation(lag_m / spacing_m);
  constexpr int kPoints = 64;
  double sum = 0.0;
  double weights = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double share = (2.0 * i + 1.0) / kPoints - 1.0;  // of the width
    const double weight = 1.0 - std::abs(share);
    sum += weight * Correlation((lag_m + share * width_m) / spacing_m);
    weights += weight;
  }
  return sum / weights;
}

// Octaves j of an ensemble. Coarser ones add less than 2^-20 of S; finer ones, for H of at least
// 0.2, less than 2^-16.
constexpr int kFirstOctave = -10;
constexpr int kOctaves = 51;
using OctaveTerms = std::array<double, kOctaves>;

// S at a lag of each octave by itself with an RMS of 1, as means over squares of `width_m`;
// wavelength_m is that of the octave 0.
OctaveTerms IncrementsOfOctaves(double lag_m, double wavelength_m, double width_m) {
  OctaveTerms terms{};
  for (int i = 0; i < kOctaves; ++i) {
    const double spacing_m = 0.5 * wavelength_m * math::Exp2(-(kFirstOctave + i));
    const double at_zero = MeanCorrelation(0.0, spacing_m, width_m);
    terms[static_cast<std::size_t>(i)] =
        at_zero * (6.0 * at_zero - 8.0 * MeanCorrelation(lag_m, spacing_m, width_m) +
                   2.0 * MeanCorrelation(2.0 * lag_m, spacing_m, width_m));
  }
  return terms;
}

// S of all of them, where the octave 0 has an RMS of 1.
double SumOf(const OctaveTerms& terms, double hurst) {
  double sum = 0.0;
  for (int i = 0; i < kOctaves; ++i) {
    sum += math::Exp2(-2.0 * hurst * (kFirstOctave + i)) * terms[static_cast<std::size_t>(i)];
  }
  return sum;
}

constexpr double kLeastHurst = 0.05;  // of terrain.ground.hurst_exponent

// Returns the exponent H whose octaves let S grow by `growth` from one lag to another.
double HurstOf(double growth, const OctaveTerms& near, const OctaveTerms& far) {
  double low = kLeastHurst;
  double high = 1.0;
  constexpr int kHalvings = 12;
  for (int i = 0; i < kHalvings; ++i) {
    const double hurst = 0.5 * (low + high);
    (SumOf(far, hurst) / SumOf(near, hurst) < growth ? low : high) = hurst;
  }
  return 0.5 * (low + high);
}

// Lags at which S is held against that of octaves, in cells.
constexpr std::array<std::int64_t, 10> kLags{1, 2, 3, 4, 6, 8, 12, 16, 24, 32};

struct LagIncrements {
  double lag_cells = 0.0;
  double log_m2 = 0.0;
};

// Returns the least weighted sum of squares of what ln S is off from that of octaves of any H and
// RMS, as means over width_cells. Short lags, which know more of the width, weigh more.
double MisfitOf(const std::vector<LagIncrements>& measured, double width_cells) {
  std::vector<OctaveTerms> terms;
  terms.reserve(measured.size());
  for (const LagIncrements& at : measured) {
    terms.push_back(IncrementsOfOctaves(at.lag_cells, 1.0, width_cells));
  }
  constexpr int kSteps = 20;
  double least = core::kInfinity;
  for (int step = 0; step <= kSteps; ++step) {
    const double hurst = kLeastHurst + (1.0 - kLeastHurst) * step / kSteps;
    double weights = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const double weight = 1.0 / measured[i].lag_cells;
      const double off = measured[i].log_m2 - math::Log(SumOf(terms[i], hurst));
      weights += weight;
      sum += weight * off;
      squares += weight * off * off;
    }
    least = std::min(least, squares - sum * sum / weights);
  }
  return least;
}

// Must agree with OctaveCount of relief.cc: wavelengths L, L / 2, ... down to 0.1 m.
int OctavesBelow(double wavelength_m) {
  constexpr double kFinest_m = 0.1;
  return std::max(1, static_cast<int>(std::floor(math::Log2(wavelength_m / kFinest_m))) + 1);
}

double QuantileOf(std::vector<double>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

SlopeFigures SlopesOf(const HeightGrid& grid) {
  EXPECT(grid.rows >= 3 && grid.columns >= 3);
  std::vector<double> rises;
  rises.reserve(grid.heights_m.size());
  for (std::int64_t r = 1; r + 1 < grid.rows; ++r) {
    for (std::int64_t c = 1; c + 1 < grid.columns; ++c) {
      rises.push_back(math::Hypot(grid.At(c + 1, r) - grid.At(c - 1, r),
                                  grid.At(c, r + 1) - grid.At(c, r - 1)) /
                      (2.0 * grid.cell_m));
    }
  }
  constexpr double kHigh = 0.9;
  SlopeFigures figures;
  figures.median_deg = math::RadToDeg(math::Atan(QuantileOf(rises, 0.5)));
  figures.high_deg = math::RadToDeg(math::Atan(QuantileOf(rises, kHigh)));
  return figures;
}

double SecondIncrements(const HeightGrid& grid, std::int64_t lag_cells) {
  std::vector<double> squares;
  squares.reserve(2 * grid.heights_m.size());
  const auto add = [&](double before, double here, double after) {
    const double bend = before - 2.0 * here + after;
    squares.push_back(bend * bend);
  };
  for (std::int64_t r = 0; r < grid.rows; ++r) {
    for (std::int64_t c = lag_cells; c + lag_cells < grid.columns; ++c) {
      add(grid.At(c - lag_cells, r), grid.At(c, r), grid.At(c + lag_cells, r));
    }
  }
  for (std::int64_t r = lag_cells; r + lag_cells < grid.rows; ++r) {
    for (std::int64_t c = 0; c < grid.columns; ++c) {
      add(grid.At(c, r - lag_cells), grid.At(c, r), grid.At(c, r + lag_cells));
    }
  }
  constexpr double kMedianOfNormalSquared = 0.45493642;
  return squares.empty() ? 0.0 : QuantileOf(squares, 0.5) / kMedianOfNormalSquared;
}

Resolution EstimateResolution(const HeightGrid& grid) {
  constexpr std::int64_t kLagsAcross = 8;  // longer lags are few and know little
  std::vector<LagIncrements> measured;
  for (const std::int64_t lag : kLags) {
    if (lag * kLagsAcross > std::max(grid.rows, grid.columns)) break;
    const double increments_m2 = SecondIncrements(grid, lag);
    if (increments_m2 <= 0.0) break;
    measured.push_back({static_cast<double>(lag), math::Log(increments_m2)});
  }
  constexpr std::size_t kFewestLags = 4;
  if (measured.size() < kFewestLags) return {grid.cell_m, true};
  Resolution best{grid.cell_m, false};
  double least = MisfitOf(measured, 0.0);
  constexpr double kRatio = 1.189207115002721;  // fourth root of 2
  const double widest = 2.0 * measured.back().lag_cells;
  for (double width = kRatio; width <= widest; width *= kRatio) {
    const double misfit = MisfitOf(measured, width);
    if (misfit >= least) continue;
    least = misfit;
    best = {width * grid.cell_m, width * kRatio > widest};
  }
  return best;
}

std::optional<SubRoughness> RoughnessBelow(const HeightGrid& grid, double effective_m) {
  const double cells = std::max(1.0, effective_m / grid.cell_m);
  const double width_m = cells > 1.0 ? effective_m : 0.0;
  SubRoughness roughness;
  roughness.wavelength_m = grid.cell_m * math::Exp2(std::round(math::Log2(cells)));
  constexpr double kShortest_m = 0.2;  // of terrain.ground.roughness_wavelength_m
  if (roughness.wavelength_m < kShortest_m) return std::nullopt;
  const auto near = static_cast<std::int64_t>(std::lround(2.0 * cells));
  const double near_m2 = SecondIncrements(grid, near);
  const double middle_m2 = SecondIncrements(grid, 2 * near);
  const double far_m2 = SecondIncrements(grid, 4 * near);
  if (near_m2 <= 0.0 || middle_m2 <= 0.0) return std::nullopt;
  const auto terms = [&](std::int64_t lag) {
    return IncrementsOfOctaves(static_cast<double>(lag) * grid.cell_m, roughness.wavelength_m,
                               width_m);
  };
  const OctaveTerms near_terms = terms(near);
  roughness.hurst = far_m2 > 0.0 ? HurstOf(far_m2 / near_m2, near_terms, terms(4 * near))
                                 : HurstOf(middle_m2 / near_m2, near_terms, terms(2 * near));
  const double octave_m2 = near_m2 / SumOf(near_terms, roughness.hurst);
  double octaves = 0.0;
  for (int j = 0; j < OctavesBelow(roughness.wavelength_m); ++j) {
    octaves += math::Exp2(-2.0 * roughness.hurst * j);
  }
  roughness.rms_m = std::sqrt(octave_m2 * octaves);
  return roughness;
}

}  // namespace rockyard::campaign
