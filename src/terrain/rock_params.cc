#include "terrain/rock_params.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>

namespace rockyard::terrain {
namespace {

using core::Origin;

// Most rocks of a list; about 10 MB of JSON.
constexpr std::size_t kMostRocks = 100000;

void RequireLength(std::string_view name, const std::vector<double>& list, std::size_t rocks,
                   core::FieldVisitor& v) {
  v.Require(
      name, list.size() == rocks,
      "has " + std::to_string(list.size()) + " entries where x_m has " + std::to_string(rocks),
      "give every rock one entry of each list");
}

// Share of the count area that exact counts may cover: well below the 54.7 % at which random
// sequential placement of equal discs jams, so that every rock finds a place.
constexpr double kLargestCountCover = 0.25;

void VisitMoore(RockFieldParams& p, core::FieldVisitor& v) {
  v.Real("k_per_m2", p.k_per_m2,
         {.doc = "moore: number of rocks per m2 with diameters of at least 1 m",
          .min = 0.0,
          .max = 0.1,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 7: 0.00415 nominal, 0.013 Viking Lander 2"});
  v.Real("k_reference_per_m2", p.k_reference_per_m2,
         {.doc = "moore: k of the marked field that is thinned down to k_per_m2; fields that share "
                 "it nest",
          .min = 1e-6,
          .max = 0.1,
          .origin = Origin::kSetting});
  v.Require("k_per_m2", p.k_per_m2 <= p.k_reference_per_m2, "is larger than k_reference_per_m2",
            "raise k_reference_per_m2 to at least k_per_m2 in every field of the comparison");
  v.Real("min_diameter_m", p.min_diameter_m,
         {.doc = "moore: smallest rock; the law overestimates rocks below 14 cm",
          .min = 0.02,
          .max = 2.0,
          .origin = Origin::kAssumed,
          .source = "Matthies 1995 sec. 7 quotes coverage from 0.1 m",
          .study_low = 0.05,
          .study_high = 0.14});
  v.Real("max_diameter_m", p.max_diameter_m,
         {.doc = "moore: largest rock",
          .min = 0.03,
          .max = 5.0,
          .origin = Origin::kAssumed,
          .source = "largest rock near Viking Lander 2, Matthies 1995 fig. 14",
          .study_low = 0.5,
          .study_high = 1.5});
  v.Require("max_diameter_m", p.max_diameter_m > p.min_diameter_m,
            "is not larger than min_diameter_m", "use a larger max_diameter_m");
}

void VisitUniform(RockFieldParams& p, core::FieldVisitor& v) {
  v.Integer("count", p.count,
            {.doc = "uniform_count: rocks in the count area",
             .min = 0,
             .max = 10000,
             .origin = Origin::kPublished,
             .source = "Matthies 1995 sec. 7: 5, 10 or 15"});
  v.Real("uniform_min_diameter_m", p.uniform_min_diameter_m,
         {.doc = "uniform_count: smallest rock",
          .min = 0.02,
          .max = 2.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 7"});
  v.Real("uniform_max_diameter_m", p.uniform_max_diameter_m,
         {.doc = "uniform_count: largest rock",
          .min = 0.02,
          .max = 2.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 7"});
  v.Require("uniform_max_diameter_m", p.uniform_max_diameter_m >= p.uniform_min_diameter_m,
            "is smaller than uniform_min_diameter_m", "use uniform_min_diameter_m or more");
  v.Real("count_area_x_m", p.count_area_x_m,
         {.doc = "uniform_count: where the count area begins along the course",
          .min = -1000.0,
          .max = 1000.0,
          .origin = Origin::kAssumed,
          .source = "centres the published 8 m on the 7.6 m course",
          .study_low = -0.4,
          .study_high = 0.0});
  v.Real("count_area_length_m", p.count_area_length_m,
         {.doc = "uniform_count: length of the count area along the course",
          .min = 0.5,
          .max = 1000.0,
          .origin = Origin::kAssumed,
          .source = "17.6 m2 (Matthies 1995 sec. 7) over the strip's width of 2.2 m"});
  v.Real("count_area_width_m", p.count_area_width_m,
         {.doc = "uniform_count: width of the count area, centred on y = 0",
          .min = 0.5,
          .max = 1000.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 7: central 2.2 m"});
  const double largest_m2 =
      0.25 * std::numbers::pi * p.uniform_max_diameter_m * p.uniform_max_diameter_m;
  v.Require("count",
            p.kind != RockFieldKind::kUniformCount ||
                static_cast<double>(p.count) * largest_m2 <=
                    kLargestCountCover * p.count_area_length_m * p.count_area_width_m,
            "would cover more than a quarter of the count area, so that some rocks might find no "
            "place without overlap",
            "use fewer or smaller rocks, or a larger count area");
}

void VisitShape(RockFieldParams& p, core::FieldVisitor& v) {
  v.Real("min_width_ratio", p.min_width_ratio,
         {.doc = "smallest ratio of the shorter to the longer horizontal axis",
          .min = 0.2,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "rocks from nearly round to clearly oblong",
          .study_low = 0.5,
          .study_high = 1.0});
  v.Real("max_width_ratio", p.max_width_ratio,
         {.doc = "largest ratio of the shorter to the longer horizontal axis",
          .min = 0.2,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "the diameter is the longest axis by definition",
          .study_low = 1.0,
          .study_high = 1.0});
  v.Require("max_width_ratio", p.max_width_ratio >= p.min_width_ratio,
            "is smaller than min_width_ratio", "use min_width_ratio or more");
  v.Real("min_height_ratio", p.min_height_ratio,
         {.doc = "smallest ratio of the full height, buried part included, to the diameter",
          .min = 0.1,
          .max = 3.0,
          .origin = Origin::kAssumed,
          .source = "with a third buried, 15 cm of height go with 23 cm of diameter (Matthies 1995 "
                    "sec. 7) only if rocks are as high as wide: a heuristic about Mars that turns "
                    "clearance into diameter, nothing about the rocks of the arena",
          .study_low = 0.4,
          .study_high = 0.9});
  v.Real("max_height_ratio", p.max_height_ratio,
         {.doc = "largest ratio of the full height, buried part included, to the diameter",
          .min = 0.1,
          .max = 3.0,
          .origin = Origin::kAssumed,
          .source = "see min_height_ratio",
          .study_low = 0.9,
          .study_high = 1.3});
  v.Require("max_height_ratio", p.max_height_ratio >= p.min_height_ratio,
            "is smaller than min_height_ratio", "use min_height_ratio or more");
  v.Real("burial_mean", p.burial_mean,
         {.doc = "mean buried fraction of the full height",
          .min = 0.0,
          .max = 0.8,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 7: on average rocks are 1/3 buried"});
  v.Real("burial_spread", p.burial_spread,
         {.doc = "half-width of the uniform distribution of the buried fraction",
          .min = 0.0,
          .max = 0.4,
          .origin = Origin::kAssumed,
          .source = "the published third is an average; its spread is not given",
          .study_low = 0.0,
          .study_high = 0.3});
  v.Require("burial_spread",
            p.burial_mean - p.burial_spread >= 0.0 && p.burial_mean + p.burial_spread <= 0.95,
            "takes the buried fraction out of 0 to 0.95", "use a smaller burial_spread");
  v.Real("pointedness", p.pointedness,
         {.doc = "profile at the same height and outline: 0 ellipsoids, about 0.6 paraboloids, "
                 "towards 1 cones; 0.87 lets the light stripe sensor see half of the rocks of 7 to "
                 "7.5 cm",
          .min = 0.0,
          .max = 0.99,
          .origin = Origin::kCalibrated,
          .source = "Matthies 1995 sec. 6: rocks typically seen are 7 to 8 cm or more high; "
                    "calibrate_profile.py"});
  // Deeper ellipsoids are narrower on the ground than their outline, which caps keep there.
  v.Require("burial_spread", p.pointedness == 0.0 || p.burial_mean + p.burial_spread <= 0.5,
            "buries more than half of some rocks, of which pointed ones have no shape",
            "use burial_mean plus burial_spread of at most 0.5, or a pointedness of 0");
}

}  // namespace

void RockHoldingParams::Visit(core::FieldVisitor& v) {
  v.Real("rock_density_kg_m3", rock_density_kg_m3,
         {.doc = "movable: density of the rocks",
          .min = 100.0,
          .max = 10000.0,
          .origin = Origin::kAssumed,
          .source = "solid andesite or basalt; vesicular rocks are lighter",
          .study_low = 2300.0,
          .study_high = 3000.0});
  v.Real("soil_density_kg_m3", soil_density_kg_m3,
         {.doc = "movable: density of the soil that a rock pushes ahead",
          .min = 100.0,
          .max = 4000.0,
          .origin = Origin::kAssumed,
          .source = "dry sand, loose to dense",
          .study_low = 1400.0,
          .study_high = 1800.0});
  v.Angle("soil_friction_angle_deg", soil_friction_angle_rad,
          {.doc = "movable: angle of internal friction of that soil, without cohesion",
           .min = 0.0,
           .max = 60.0,
           .origin = Origin::kAssumed,
           .source = "dry sand, loose to dense",
           .study_low = 30.0,
           .study_high = 40.0});
  v.Real("rock_soil_friction", rock_soil_friction,
         {.doc = "movable: friction between a rock and the soil under it",
          .min = 0.0,
          .max = 2.0,
          .origin = Origin::kAssumed,
          .source = "rough rock on sand, somewhat below the soil's own friction of 0.7",
          .study_low = 0.4,
          .study_high = 0.8});
}

void ListedRocksParams::Visit(core::FieldVisitor& v) {
  v.Reals("x_m", x_m,
          {.doc = "listed: x of every centre",
           .min = -1000.0,
           .max = 1000.0,
           .origin = Origin::kSetting,
           .max_entries = kMostRocks});
  v.Reals("y_m", y_m,
          {.doc = "listed: y of every centre",
           .min = -1000.0,
           .max = 1000.0,
           .origin = Origin::kSetting,
           .max_entries = kMostRocks});
  v.Reals("diameter_m", diameter_m,
          {.doc = "listed: diameter of every rock",
           .min = 0.02,
           .max = 5.0,
           .origin = Origin::kSetting,
           .max_entries = kMostRocks});
  v.Reals("height_m", height_m,
          {.doc = "listed: height of every rock above the ground",
           .min = 0.01,
           .max = 5.0,
           .origin = Origin::kSetting,
           .max_entries = kMostRocks});
  RequireLength("y_m", y_m, x_m.size(), v);
  RequireLength("diameter_m", diameter_m, x_m.size(), v);
  RequireLength("height_m", height_m, x_m.size(), v);
}

double MooreNumberPerM2(double k_per_m2, double diameter_m) {
  return k_per_m2 * std::pow(diameter_m, -kMooreExponent);
}

double RockFieldParams::RocksPerM2() const {
  switch (kind) {
    case RockFieldKind::kNone:
    case RockFieldKind::kListed:
      return 0.0;
    case RockFieldKind::kMoore:
      return MooreNumberPerM2(k_per_m2, min_diameter_m) -
             MooreNumberPerM2(k_per_m2, max_diameter_m);
    case RockFieldKind::kUniformCount:
      return static_cast<double>(count) / (count_area_length_m * count_area_width_m);
  }
  return 0.0;
}

double RockFieldParams::ReferenceRocksPerM2() const {
  if (kind != RockFieldKind::kMoore) return RocksPerM2();
  return MooreNumberPerM2(k_reference_per_m2, min_diameter_m) -
         MooreNumberPerM2(k_reference_per_m2, max_diameter_m);
}

void RockFieldParams::Visit(core::FieldVisitor& v) {
  v.Choice("kind", kind,
           {.doc = "none, moore: random sizes and counts, uniform_count: an exact count of similar "
                   "rocks, listed: those of the group of that name",
            .origin = Origin::kSetting});
  VisitMoore(*this, v);
  VisitUniform(*this, v);
  VisitShape(*this, v);
  v.Group("listed", listed, "rocks one by one, for kind listed");
  v.Choice("overlap", overlap,
           {.doc = "what happens to a rock that overlaps one placed before it",
            .origin = Origin::kAssumed,
            .source = "rocks do not interpenetrate; relocate keeps the counts of the law"});
  v.Require("overlap", kind != RockFieldKind::kUniformCount || overlap != OverlapRule::kReject,
            "leaves rocks out, which contradicts the exact count of uniform_count",
            "use relocate or allow");
  v.Choice("mirror_line", mirror_line,
           {.doc = "virtual arenas: what happens to a rock that crosses a mirror line: merge makes "
                   "it one with its image, keep_off treats it as overlapping one placed before it",
            .origin = Origin::kPublished,
            .source = "Matthies 1995 sec. 7: random across the central 2.2 m of the course width, "
                      "and mirror-image periodic beyond that"});
  v.Real("clear_radius_m", clear_radius_m,
         {.doc = "no rock reaches nearer than this to the start or the goal",
          .min = 0.0,
          .max = 5.0,
          .origin = Origin::kAssumed,
          .source = "half the rover's diagonal is 0.40 m",
          .study_low = 0.42,
          .study_high = 0.8});
  v.Choice("mobility", mobility,
           {.doc = "whether the rover can push rocks away",
            .origin = Origin::kAssumed,
            .source = "rocks large enough to matter, a third buried, hold; the paper mentions none "
                      "that moved"});
  v.Group("holding", holding, "what holds a movable rock; no effect on fixed ones");
}

}  // namespace rockyard::terrain
