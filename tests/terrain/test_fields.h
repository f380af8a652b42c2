// Terrain parameters that several tests start from.
#pragma once

#include <numbers>

#include "terrain/rock_size_law.h"
#include "terrain/terrain_params.h"

namespace rockyard::terrain {

// Moore's law on an open 12 x 4 m arena without margin and without clear zones: every drawn rock
// stays, anywhere on 48 m2.
inline TerrainParams PlainMoore(double k_per_m2) {
  return TerrainParams{
      .rocks = {.k_per_m2 = k_per_m2, .overlap = OverlapRule::kAllow, .clear_radius_m = 0.0},
      .arena = {.kind = ArenaKind::kOpen, .open_margin_m = 0.0}};
}

// Golombek and Rapp's law on the same arena.
inline TerrainParams PlainGolombek(double cover) {
  TerrainParams params = PlainMoore(0.0);
  params.rocks.kind = RockFieldKind::kGolombek;
  params.rocks.cover = cover;
  return params;
}

// Moore's law in an arena of the default size, with its clear zones.
inline TerrainParams MooreIn(ArenaKind arena, double k_per_m2, OverlapRule overlap,
                             LineRule line = LineRule::kMerge) {
  return TerrainParams{.rocks = {.k_per_m2 = k_per_m2, .overlap = overlap, .mirror_line = line},
                       .arena = {.kind = arena}};
}

inline TerrainParams ExactCount(std::int64_t count, ArenaKind arena) {
  return TerrainParams{.rocks = {.kind = RockFieldKind::kUniformCount, .count = count},
                       .arena = {.kind = arena}};
}

// The share of the ground that round rocks of Moore's law with diameters from low_m to high_m
// cover, overlap not counted: the integral of (pi D^2 / 4) (-dN/dD), Matthies 1995 eq. (4). high_m
// may be infinite; then k = 0.013 and 0.00415 from 0.1 m give the published 19 % and 6 %.
inline double MooreCoveredFraction(double k_per_m2, double low_m, double high_m) {
  const double per_m2 = MooreNumberPerM2(k_per_m2, low_m) - MooreNumberPerM2(k_per_m2, high_m);
  return 0.25 * std::numbers::pi * per_m2 * MooreSizeLaw(low_m, high_m).MeanPower(2.0);
}

inline constexpr double kVikingLander1Cover = 0.069;  // Golombek and Rapp 1997
inline constexpr double kVikingLander2Cover = 0.176;
inline constexpr double kNominalK = 0.00415;  // Matthies 1995 sec. 7
inline constexpr double kVikingLander2K = 0.013;

// A p-value below kAlpha fails a true law; wrong laws, the negative controls, fall below kRejects.
inline constexpr double kAlpha = 1e-3;
inline constexpr double kRejects = 1e-6;

}  // namespace rockyard::terrain
