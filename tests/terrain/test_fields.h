// Terrain parameters that several tests start from.
#pragma once

#include <cstdint>

#include "terrain/terrain_params.h"

namespace rockyard::terrain {

// Moore's law on an open 12 x 4 m arena without margin and without clear zones: every drawn rock
// stays, anywhere on 48 m2.
inline TerrainParams PlainMoore(double k_per_m2) {
  TerrainParams params;
  params.rocks.k_per_m2 = k_per_m2;
  params.rocks.clear_radius_m = 0.0;
  params.rocks.overlap = OverlapRule::kAllow;
  params.arena.kind = ArenaKind::kOpen;
  params.arena.open_margin_m = 0.0;
  return params;
}

// Moore's law in an arena of the default size, with its clear zones.
inline TerrainParams MooreIn(ArenaKind arena, double k_per_m2, OverlapRule overlap,
                             LineRule line = LineRule::kMerge) {
  TerrainParams params;
  params.arena.kind = arena;
  params.rocks.k_per_m2 = k_per_m2;
  params.rocks.overlap = overlap;
  params.rocks.mirror_line = line;
  return params;
}

inline TerrainParams ExactCount(std::int64_t count, ArenaKind arena) {
  TerrainParams params;
  params.rocks.kind = RockFieldKind::kUniformCount;
  params.rocks.count = count;
  params.arena.kind = arena;
  return params;
}

inline constexpr double kNominalK = 0.00415;  // Matthies 1995 sec. 7
inline constexpr double kVikingLander2K = 0.013;

// A p-value below kAlpha fails a true law; wrong laws, the negative controls, fall below kRejects.
inline constexpr double kAlpha = 1e-3;
inline constexpr double kRejects = 1e-6;

}  // namespace rockyard::terrain
