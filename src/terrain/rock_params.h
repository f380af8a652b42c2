// Parameters of a rock field (scenario group terrain.rocks): how many rocks, how large, where, of
// which shape. The layout of fields reads them, audits and closed forms of fields, and the rovers
// that push rocks. Defaults decide records and baselines, k_reference_per_m2 among them: another
// value changes no density, but makes another field of the same seed. Bounds only refuse files.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::terrain {

// What holds a movable rock in the soil (HoldingForce in rock.h).
struct RockHoldingParams {
  double rock_density_kg_m3 = 2700.0;
  double soil_density_kg_m3 = 1600.0;
  double soil_friction_angle_rad = math::DegToRad(35.0);
  double rock_soil_friction = 0.6;

  void Visit(core::FieldVisitor& v);
};

// Rocks of a field of kind listed. Each list has one entry for every rock. The rocks are round, the
// same in every trial, and share burial_mean and pointedness of the field; overlap, clear zones and
// shape ratios do not apply to them.
struct ListedRocksParams {
  std::vector<double> x_m;  // centres, in the world frame
  std::vector<double> y_m;
  std::vector<double> diameter_m;
  std::vector<double> height_m;  // above the ground

  // Returns whether all lists are as long as each other.
  bool IsSound() const {
    return y_m.size() == x_m.size() && diameter_m.size() == x_m.size() &&
           height_m.size() == x_m.size();
  }
  void Visit(core::FieldVisitor& v);
};

// Exponent of Moore's law N(>=D) = k D^-2.66 per m2 (Matthies 1995 eq. 4, after Moore and Jakosky
// 1989).
inline constexpr double kMooreExponent = 2.66;

// Returns the number per m2 of rocks with diameters of at least diameter_m: Matthies 1995 eq. (4).
// k is the number per m2 at 1 m (its unit is m^0.66). The number is zero for an infinite diameter.
double MooreNumberPerM2(double k_per_m2, double diameter_m);

// Where rocks come from.
enum class RockFieldKind {
  kNone,
  kMoore,         // Poisson counts, diameters from Moore's law between two explicit bounds
  kUniformCount,  // an exact count, diameters uniform between two bounds
  kListed,        // those of a list, the same in every trial
};

// What happens to a rock that overlaps an earlier one.
enum class OverlapRule {
  kAllow,     // rocks may interpenetrate: the counts follow the law, the union covers less
  kReject,    // a rock that overlaps an earlier one is left out: counts fall below the law
  kRelocate,  // such a rock is placed again: counts follow the law, positions repel each other
};

// What happens to a rock that crosses a mirror line of a virtual arena.
enum class LineRule {
  kMerge,    // the rock is one with its image: centres are as dense at the lines as anywhere
  kKeepOff,  // it counts as an overlap (OverlapRule): the corridor between the lines gets more
             // rocks
};

// Whether the rover can push rocks.
enum class RockMobility { kFixed, kMovable };

struct RockFieldParams {
  RockFieldKind kind = RockFieldKind::kMoore;

  double k_per_m2 = 0.00415;
  double k_reference_per_m2 = 0.02;
  double min_diameter_m = 0.1;
  double max_diameter_m = 1.0;

  std::int64_t count = 5;
  double uniform_min_diameter_m = 0.25;
  double uniform_max_diameter_m = 0.35;
  double count_area_x_m = -0.2;
  double count_area_length_m = 8.0;
  double count_area_width_m = 2.2;

  double min_width_ratio = 0.7;
  double max_width_ratio = 1.0;
  double min_height_ratio = 0.8;
  double max_height_ratio = 1.2;
  double burial_mean = 1.0 / 3.0;
  double burial_spread = 0.1;
  double pointedness = 0.0;

  OverlapRule overlap = OverlapRule::kRelocate;
  LineRule mirror_line = LineRule::kMerge;
  ListedRocksParams listed{};
  double clear_radius_m = 0.5;
  RockMobility mobility = RockMobility::kFixed;
  RockHoldingParams holding{};

  // Returns the expected number of rocks per m2 of the layout area, before clear zones and overlap;
  // 0 for listed rocks, which follow no law.
  double RocksPerM2() const;
  // Returns that number for the reference field, which is thinned down to k; for exact counts it is
  // RocksPerM2.
  double ReferenceRocksPerM2() const;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::terrain

template <>
struct rockyard::core::EnumNames<rockyard::terrain::RockFieldKind> {
  static constexpr std::array<std::string_view, 4> kNames{"none", "moore", "uniform_count",
                                                          "listed"};
};
template <>
struct rockyard::core::EnumNames<rockyard::terrain::OverlapRule> {
  static constexpr std::array<std::string_view, 3> kNames{"allow", "reject", "relocate"};
};
template <>
struct rockyard::core::EnumNames<rockyard::terrain::LineRule> {
  static constexpr std::array<std::string_view, 2> kNames{"merge", "keep_off"};
};
template <>
struct rockyard::core::EnumNames<rockyard::terrain::RockMobility> {
  static constexpr std::array<std::string_view, 2> kNames{"fixed", "movable"};
};
