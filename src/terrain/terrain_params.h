// Parameters of a terrain (scenario group terrain): ground with ditches and pits, rocks, and arena.
// Fields are built by them; the trial, its referee and drawings ask for the arena. A scenario that
// leaves them out has the defaults, which decide its records and baselines; bounds only refuse
// files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/fields.h"
#include "terrain/elevation_params.h"
#include "terrain/rock_params.h"
#include "terrain/soil_params.h"

namespace rockyard::terrain {

// A ditch or a pit: all that lies nearer than half_width_m to a segment of a line. A pit is a
// segment of no length.
struct Depression {
  double x_m = 0.0;  // middle of the segment, in the world frame
  double y_m = 0.0;
  double direction_rad = 0.0;  // of the segment, from +x towards +y
  double half_length_m = 0.0;  // of the segment; infinite for a ditch without an end
  double half_width_m = 0.0;   // at the top
  double flank_m = 0.0;        // horizontal width of the flank, at most half_width_m
  double depth_m = 0.0;        // below the ground around it

  // Returns the distance of a point from the segment, m.
  double Distance_m(double x_m, double y_m) const;
};

// Straight trenches with round ends. Each list has one entry for every ditch; flank_m may be empty.
// length_m includes the round ends; 0 stands for a ditch without an end.
struct DitchesParams {
  std::vector<double> x_m;  // middles
  std::vector<double> y_m;
  std::vector<double> direction_deg;
  std::vector<double> length_m;
  std::vector<double> width_m;
  std::vector<double> depth_m;
  std::vector<double> flank_m;

  // Returns whether all lists are as long as they have to be.
  bool IsSound() const;
  void Visit(core::FieldVisitor& v);
};

// Round holes. Each list has one entry for every pit; flank_m may be empty.
struct PitsParams {
  std::vector<double> x_m;  // centres
  std::vector<double> y_m;
  std::vector<double> diameter_m;
  std::vector<double> depth_m;
  std::vector<double> flank_m;

  // Returns whether all lists are as long as they have to be.
  bool IsSound() const;
  void Visit(core::FieldVisitor& v);
};

// Returns the ditches, then the pits, in the order of their lists. Both must be sound.
std::vector<Depression> ListDepressions(const DitchesParams& ditches, const PitsParams& pits);

enum class ArenaKind {
  kOpen,             // the rock field goes on beyond the arena
  kWalled,           // vertical walls at the arena's edges
  kVirtualUnfolded,  // layout mirrored about the mirror lines again and again; nothing at the lines
  kVirtualReflected,  // layout mirrored once, up to the edges; the trial reflects the rover
};

// The arena is the rectangle x_min_m <= x <= x_min_m + length_m, |y| <= width_m / 2.
struct ArenaParams {
  ArenaKind kind = ArenaKind::kVirtualReflected;
  double x_min_m = -2.0;
  double length_m = 12.0;
  double width_m = 4.0;
  double mirror_margin_m = 0.9;
  double open_margin_m = 4.0;
  std::int64_t unfolded_strips = 2;

  bool IsVirtual() const {
    return kind == ArenaKind::kVirtualUnfolded || kind == ArenaKind::kVirtualReflected;
  }
  // Returns h: the mirror lines of the virtual arenas are y = +-h.
  double MirrorLine() const { return 0.5 * width_m - mirror_margin_m; }
  // Returns whether a point of a course may lie there: in the arena and, where it is virtual,
  // between the mirror lines.
  bool HoldsCoursePoint(double x_m, double y_m) const {
    const double half_width_m = IsVirtual() ? MirrorLine() : 0.5 * width_m;
    return x_m >= x_min_m && x_m <= x_min_m + length_m && y_m >= -half_width_m &&
           y_m <= half_width_m;
  }

  void Visit(core::FieldVisitor& v);
};

// The plane, what it carries, elevation model, roughness, ditches and pits, and its soil.
struct GroundParams {
  double slope_rad = 0.0;
  double slope_direction_rad = 0.0;
  ElevationParams elevation{};
  double roughness_rms_m = 0.0;
  double hurst_exponent = 0.8;
  double roughness_wavelength_m = 2.0;
  DitchesParams ditches{};
  PitsParams pits{};
  SoilParams soil{};

  bool HasDepressions() const { return !ditches.x_m.empty() || !pits.x_m.empty(); }
  // Returns whether the ground is level everywhere.
  bool IsLevel() const {
    return slope_rad == 0.0 && !elevation.IsGiven() && roughness_rms_m == 0.0 && !HasDepressions();
  }

  void Visit(core::FieldVisitor& v);
};

// The `terrain` group of a scenario.
struct TerrainParams {
  GroundParams ground{};
  RockFieldParams rocks{};
  ArenaParams arena{};

  // Returns the area over which the rocks are laid out at random, before mirroring, m2. Must be
  // that of LayoutBounds (arena.h): expected counts and drawn fields agree by it.
  double LayoutArea() const;
  // Returns the expected number of rocks with all mirror images.
  double ExpectedRocks() const;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::terrain

template <>
struct rockyard::core::EnumNames<rockyard::terrain::ArenaKind> {
  static constexpr std::array<std::string_view, 4> kNames{"open", "walled", "virtual_unfolded",
                                                          "virtual_reflected"};
};
