// What the heights of a site tell of it: relief, slopes, how fine the model is, and which roughness
// goes on below. Figures of a site are printed by it, sites are picked by slopes, and scenarios of
// sites get their roughness from it.
#pragma once

#include <optional>

#include "campaign/site/height_grid.h"

namespace rockyard::campaign {

struct SlopeFigures {
  double median_deg = 0.0;
  double high_deg = 0.0;  // 90 % are less
};

// Returns the slopes at the inner nodes, by differences of the neighbours on either side. Requires
// 3 x 3 nodes without NaN.
SlopeFigures SlopesOf(const HeightGrid& grid);

// Returns S(k), the typical (z(x + k) - 2 z(x) + z(x - k))^2 over both axes, m2: the structure
// function of second increments at a lag of k cells. It is their median over 0.455, that of the
// square of a standard normal: their mean where heights are normal, while a few cliffs do not make
// it. No plane adds to it. 0 where the grid is smaller than 2 k + 1 along both axes.
double SecondIncrements(const HeightGrid& grid, std::int64_t lag_cells);

struct Resolution {
  double effective_m = 0.0;
  bool at_least = false;  // the grid is too small or too smooth to tell
};

// Estimates the width over which the heights are smoothed: S of a surface that is rough at all
// scales grows as lag^(2 H), of means over a width w as lag^4 below w / 2. Of the widths 0 (points,
// which gives a cell), 1.19, 1.41, 1.68, 2, ... cells the one whose S (see RoughnessBelow), for
// some H and RMS, is least off from that of the grid at lags of 1 to 32 cells, an eighth of a side
// at most, in squares of the logarithm, weighted by 1 / lag. A bound (at_least) where the grid is
// too small or the widest width fits best. Cost: about 50 ms.
Resolution EstimateResolution(const HeightGrid& grid);

// A fractal below the resolution of a model, as terrain.ground has it.
struct SubRoughness {
  double rms_m = 0.0;
  double hurst = 0.0;
  double wavelength_m = 0.0;  // cell times a power of two
};

// Returns the roughness that goes on where a model of that effective resolution ends. Terrain's
// octaves (relief.h) of RMS s 2^(-j H) for all whole j, as means over squares of the effective
// resolution, have
//   S(r) = s^2 sum_j 2^(-2 j H) a_j(0) (6 a_j(0) - 8 a_j(r) + 2 a_j(2 r)),
// a_j the autocorrelation along an axis of cubic B-splines of spacing h_j = L 2^(-j) / 2, which is
// a spline of degree 7, averaged by the triangle of the means. H follows from the growth of S
// between lags of two and eight effective resolutions, s from the former. The octaves from L, the
// effective resolution, downwards are what is returned. Heights of a model that resolves its cells
// count as points. Nothing where the grid is too small, level, or finer than a wheel notices (L
// below 0.2 m).
std::optional<SubRoughness> RoughnessBelow(const HeightGrid& grid, double effective_m);

}  // namespace rockyard::campaign
