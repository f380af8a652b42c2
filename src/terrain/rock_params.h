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

// Which law of Mars lays rocks beside listed ones.
enum class RestOfRocks { kNone, kMoore, kGolombek };

// Rocks of a field of kind listed, the same in every trial. Each list has one entry for every rock;
// the last three may be empty. The rocks share the pointedness of the field; overlap, clear zones
// and shape ratios do not apply to them.
struct ListedRocksParams {
  std::vector<double> x_m;  // centres, in the world frame
  std::vector<double> y_m;
  std::vector<double> diameter_m;      // longest horizontal axis
  std::vector<double> height_m;        // above the ground
  std::vector<double> buried_share{};  // of the full height; empty: burial_mean of the field
  std::vector<double> width_ratio{};   // shorter over longer horizontal axis; empty: round
  std::vector<double> yaw_deg{};       // of the longest axis, from +x towards +y; empty: 0
  RestOfRocks rest = RestOfRocks::kNone;

  // Returns whether all lists are as long as they have to be.
  bool IsSound() const;
  void Visit(core::FieldVisitor& v);
};

// Exponent of Moore's law N(>=D) = k D^-2.66 per m2 (Matthies 1995 eq. 4, after Moore and Jakosky
// 1989).
inline constexpr double kMooreExponent = 2.66;

// Returns the number per m2 of rocks with diameters of at least diameter_m: Matthies 1995 eq. (4).
// k is the number per m2 at 1 m (its unit is m^0.66). The number is zero for an infinite diameter.
double MooreNumberPerM2(double k_per_m2, double diameter_m);

// Returns the decay q of the law below, 1/m: 1.79 + 0.152 / cover.
double GolombekDecayPerM(double cover);
// Returns the number of rocks per m2 and m of diameter by Golombek and Rapp's law: rocks of
// diameter_m and more cover the share F(D) = k exp(-q D) of the ground, k the cover of all rocks
// (Golombek and Rapp 1997, JGR 102(E2); Golombek et al. 2003, JGR 108(E12) 8086). With round rocks
// n(D) = -F'(D) / (pi D^2 / 4). It grows with the cover at every diameter.
double GolombekDensity(double cover, double diameter_m);
// Returns the number per m2 of rocks with diameters of at least diameter_m by that law: the
// integral of n, (4 / pi) k q E2(q D) / D, E2(x) = exp(-x) - x E1(x). It has no bound as D goes to
// 0.
double GolombekNumberPerM2(double cover, double diameter_m);

// Where rocks come from.
enum class RockFieldKind {
  kNone,
  kMoore,         // Poisson counts, diameters from Moore's law between two explicit bounds
  kUniformCount,  // an exact count, diameters uniform between two bounds
  kListed,        // those of a list, the same in every trial
  kGolombek,      // Poisson counts, diameters from Golombek and Rapp's law between two bounds
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
  double cover = 0.069;
  double cover_reference = 0.4;
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
  double clusters_per_m2 = 0.0;
  double cluster_radius_m = 1.0;
  ListedRocksParams listed{};
  double clear_radius_m = 0.5;
  RockMobility mobility = RockMobility::kFixed;
  RockHoldingParams holding{};

  // Returns where the random rocks come from: for listed rocks the law that lays the rest, or
  // kNone.
  RockFieldKind RandomKind() const;
  // Returns whether counts and diameters of the random rocks follow a law of Mars: Poisson counts,
  // thinned from a reference field.
  bool FollowsLaw() const {
    const RockFieldKind random = RandomKind();
    return random == RockFieldKind::kMoore || random == RockFieldKind::kGolombek;
  }
  // Returns the expected number of random rocks per m2 of the layout area, before clear zones and
  // overlap.
  double RocksPerM2() const;
  // Returns that number for the reference field, which is thinned down to k or cover; for exact
  // counts it is RocksPerM2.
  double ReferenceRocksPerM2() const;

  // Returns the share of the layout area under random rocks that follow a law, overlap not counted;
  // 0 for others.
  double LawCover() const;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::terrain

template <>
struct rockyard::core::EnumNames<rockyard::terrain::RockFieldKind> {
  static constexpr std::array<std::string_view, 5> kNames{"none", "moore", "uniform_count",
                                                          "listed", "golombek"};
};
template <>
struct rockyard::core::EnumNames<rockyard::terrain::RestOfRocks> {
  static constexpr std::array<std::string_view, 3> kNames{"none", "moore", "golombek"};
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
