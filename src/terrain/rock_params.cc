#include "terrain/rock_params.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>

namespace rockyard::terrain {
namespace {

using core::Assumed;
using core::Calibrated;
using core::Published;
using core::Setting;

// Largest number of rocks in a list: about 10 MB of JSON.
constexpr std::size_t kMostRocks = 100000;

core::FieldInfo ListOfRocks(std::string_view doc, core::Bounds bounds) {
  core::FieldInfo info = Setting(doc, bounds);
  info.max_entries = kMostRocks;
  return info;
}

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

void VisitLaws(RockFieldParams& p, core::FieldVisitor& v) {
  v.Real("k_per_m2", p.k_per_m2,
         Published("moore: number of rocks per m2 with diameters of at least 1 m",
                   "Matthies 1995 sec. 7: 0.00415 nominal, 0.013 Viking Lander 2", {0.0, 0.1}));
  v.Real("k_reference_per_m2", p.k_reference_per_m2,
         Setting("moore: k of the marked field that is thinned down to k_per_m2; fields that share "
                 "it nest",
                 {1e-6, 0.1}));
  v.Require("k_per_m2", p.k_per_m2 <= p.k_reference_per_m2, "is larger than k_reference_per_m2",
            "raise k_reference_per_m2 to at least k_per_m2 in every field of the comparison");
  v.Real("cover", p.cover,
         Published("golombek: share of the ground under rocks of all sizes, k of the law",
                   "0.069 Viking Lander 1 and 0.176 Viking Lander 2 (Golombek and Rapp 1997, as "
                   "others quote it), 0.19 Mars Pathfinder (Golombek et al. 2003), 0.01 to 0.04 "
                   "InSight (Golombek et al. 2020)",
                   {0.001, 0.5}));
  v.Real("cover_reference", p.cover_reference,
         Setting("golombek: cover of the marked field that is thinned down to cover; fields that "
                 "share it nest",
                 {0.001, 0.5}));
  v.Require("cover", p.cover <= p.cover_reference, "is larger than cover_reference",
            "raise cover_reference to at least cover in every field of the comparison");
  v.Real("min_diameter_m", p.min_diameter_m,
         Assumed("moore, golombek: smallest rock; Moore's law overestimates rocks below 14 cm",
                 "Matthies 1995 sec. 7 quotes coverage from 0.1 m", {0.02, 2.0}, {0.05, 0.14}));
  v.Real(
      "max_diameter_m", p.max_diameter_m,
      Assumed("moore, golombek: largest rock",
              "largest rock near Viking Lander 2, Matthies 1995 fig. 14", {0.03, 5.0}, {0.5, 1.5}));
  v.Require("max_diameter_m", p.max_diameter_m > p.min_diameter_m,
            "is not larger than min_diameter_m", "use a larger max_diameter_m");
}

void VisitUniform(RockFieldParams& p, core::FieldVisitor& v) {
  v.Integer("count", p.count,
            Published("uniform_count: rocks in the count area", "Matthies 1995 sec. 7: 5, 10 or 15",
                      {0, 10000}));
  v.Real("uniform_min_diameter_m", p.uniform_min_diameter_m,
         Published("uniform_count: smallest rock", "Matthies 1995 sec. 7", {0.02, 2.0}));
  v.Real("uniform_max_diameter_m", p.uniform_max_diameter_m,
         Published("uniform_count: largest rock", "Matthies 1995 sec. 7", {0.02, 2.0}));
  v.Require("uniform_max_diameter_m", p.uniform_max_diameter_m >= p.uniform_min_diameter_m,
            "is smaller than uniform_min_diameter_m", "use uniform_min_diameter_m or more");
  v.Real("count_area_x_m", p.count_area_x_m,
         Assumed("uniform_count: where the count area begins along the course",
                 "centres the published 8 m on the 7.6 m course", {-1000.0, 1000.0}, {-0.4, 0.0}));
  v.Real("count_area_length_m", p.count_area_length_m,
         Assumed("uniform_count: length of the count area along the course",
                 "17.6 m2 (Matthies 1995 sec. 7) over the strip's width of 2.2 m", {0.5, 1000.0}));
  v.Real("count_area_width_m", p.count_area_width_m,
         Published("uniform_count: width of the count area, centred on y = 0",
                   "Matthies 1995 sec. 7: central 2.2 m", {0.5, 1000.0}));
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

// What listed rocks ask of the rest of the field.
void RequireListed(const RockFieldParams& p, core::FieldVisitor& v) {
  if (p.kind != RockFieldKind::kListed) return;
  const std::vector<double>& buried = p.listed.buried_share;
  v.Require("listed.buried_share",
            p.pointedness == 0.0 || std::all_of(buried.begin(), buried.end(),
                                                [](double share) { return share <= 0.5; }),
            "buries more than half of some rocks, of which pointed ones have no shape",
            "use shares of at most 0.5, or a pointedness of 0");
  if (p.listed.rest == RestOfRocks::kNone || p.listed.diameter_m.empty()) return;
  const double smallest_m =
      *std::min_element(p.listed.diameter_m.begin(), p.listed.diameter_m.end());
  v.Require("max_diameter_m", p.max_diameter_m <= smallest_m,
            "lets listed.rest lay rocks as large as listed ones, which would count them twice",
            fmt::format("use at most {:g}, the smallest of listed.diameter_m", smallest_m));
}

void VisitShape(RockFieldParams& p, core::FieldVisitor& v) {
  v.Real("min_width_ratio", p.min_width_ratio,
         Assumed("smallest ratio of the shorter to the longer horizontal axis",
                 "rocks from nearly round to clearly oblong", {0.2, 1.0}, {0.5, 1.0}));
  v.Real("max_width_ratio", p.max_width_ratio,
         Assumed("largest ratio of the shorter to the longer horizontal axis",
                 "the diameter is the longest axis by definition", {0.2, 1.0}, {1.0, 1.0}));
  v.Require("max_width_ratio", p.max_width_ratio >= p.min_width_ratio,
            "is smaller than min_width_ratio", "use min_width_ratio or more");
  v.Real("min_height_ratio", p.min_height_ratio,
         Assumed("smallest ratio of the full height, buried part included, to the diameter",
                 "with a third buried, 15 cm of height go with 23 cm of diameter (Matthies 1995 "
                 "sec. 7) only if rocks are as high as wide: a heuristic about Mars that turns "
                 "clearance into diameter, nothing about the rocks of the arena",
                 {0.1, 3.0}, {0.4, 0.9}));
  v.Real("max_height_ratio", p.max_height_ratio,
         Assumed("largest ratio of the full height, buried part included, to the diameter",
                 "see min_height_ratio", {0.1, 3.0}, {0.9, 1.3}));
  v.Require("max_height_ratio", p.max_height_ratio >= p.min_height_ratio,
            "is smaller than min_height_ratio", "use min_height_ratio or more");
  v.Real("burial_mean", p.burial_mean,
         Published("mean buried fraction of the full height",
                   "Matthies 1995 sec. 7: on average rocks are 1/3 buried", {0.0, 0.8}));
  v.Real("burial_spread", p.burial_spread,
         Assumed("half-width of the uniform distribution of the buried fraction",
                 "the published third is an average; its spread is not given", {0.0, 0.4},
                 {0.0, 0.3}));
  v.Require("burial_spread",
            p.burial_mean - p.burial_spread >= 0.0 && p.burial_mean + p.burial_spread <= 0.95,
            "takes the buried fraction out of 0 to 0.95", "use a smaller burial_spread");
  v.Real("pointedness", p.pointedness,
         Calibrated(
             "profile at the same height and outline: 0 ellipsoids, about 0.6 paraboloids, towards "
             "1 cones; 0.87 lets the light stripe sensor see half of the rocks of 7 to 7.5 cm",
             "Matthies 1995 sec. 6: rocks typically seen are 7 to 8 cm or more high; "
             "calibrate_profile.py",
             {0.0, 0.99}));
  // Deeper ellipsoids are narrower on the ground than their outline, which caps keep there.
  v.Require("burial_spread", p.pointedness == 0.0 || p.burial_mean + p.burial_spread <= 0.5,
            "buries more than half of some rocks, of which pointed ones have no shape",
            "use burial_mean plus burial_spread of at most 0.5, or a pointedness of 0");
}

}  // namespace

void RockHoldingParams::Visit(core::FieldVisitor& v) {
  v.Real("rock_density_kg_m3", rock_density_kg_m3,
         Assumed("movable: density of the rocks",
                 "solid andesite or basalt; vesicular rocks are lighter", {100.0, 10000.0},
                 {2300.0, 3000.0}));
  v.Real("soil_density_kg_m3", soil_density_kg_m3,
         Assumed("movable: density of the soil that a rock pushes ahead",
                 "dry sand, loose to dense", {100.0, 4000.0}, {1400.0, 1800.0}));
  v.Angle("soil_friction_angle_deg", soil_friction_angle_rad,
          Assumed("movable: angle of internal friction of that soil, without cohesion",
                  "dry sand, loose to dense", {0.0, 60.0}, {30.0, 40.0}));
  v.Real("rock_soil_friction", rock_soil_friction,
         Assumed("movable: friction between a rock and the soil under it",
                 "rough rock on sand, somewhat below the soil's own friction of 0.7", {0.0, 2.0},
                 {0.4, 0.8}));
}

void ListedRocksParams::Visit(core::FieldVisitor& v) {
  v.Reals("x_m", x_m, ListOfRocks("listed: x of every centre", {-1000.0, 1000.0}));
  v.Reals("y_m", y_m, ListOfRocks("listed: y of every centre", {-1000.0, 1000.0}));
  v.Reals("diameter_m", diameter_m, ListOfRocks("listed: diameter of every rock", {0.02, 5.0}));
  v.Reals("height_m", height_m,
          ListOfRocks("listed: height of every rock above the ground", {0.01, 5.0}));
  v.Reals("buried_share", buried_share,
          ListOfRocks("listed: share of every rock's full height that is buried; an empty list: "
                      "burial_mean",
                      {0.0, 0.95}));
  v.Reals("width_ratio", width_ratio,
          ListOfRocks("listed: shorter over longer horizontal axis of every rock; an empty list: "
                      "round rocks",
                      {0.1, 1.0}));
  v.Reals("yaw_deg", yaw_deg,
          ListOfRocks("listed: direction of every longer axis, from +x towards +y; an empty list: "
                      "0",
                      {-360.0, 360.0}));
  v.Choice("rest", rest,
           Setting("listed: the law whose rocks, from min_diameter_m to max_diameter_m, lie beside "
                   "the listed ones, which are the larger ones"));
  RequireLength("y_m", y_m, x_m.size(), v);
  RequireLength("diameter_m", diameter_m, x_m.size(), v);
  RequireLength("height_m", height_m, x_m.size(), v);
  if (!buried_share.empty()) RequireLength("buried_share", buried_share, x_m.size(), v);
  if (!width_ratio.empty()) RequireLength("width_ratio", width_ratio, x_m.size(), v);
  if (!yaw_deg.empty()) RequireLength("yaw_deg", yaw_deg, x_m.size(), v);
}

bool ListedRocksParams::IsSound() const {
  const auto fits = [this](const std::vector<double>& list, bool may_be_empty) {
    return list.size() == x_m.size() || (may_be_empty && list.empty());
  };
  return fits(y_m, false) && fits(diameter_m, false) && fits(height_m, false) &&
         fits(buried_share, true) && fits(width_ratio, true) && fits(yaw_deg, true);
}

void RockFieldParams::Visit(core::FieldVisitor& v) {
  v.Choice("kind", kind,
           Setting("none, moore and golombek: random counts and sizes by a law of Mars, "
                   "uniform_count: an exact count of similar rocks, listed: those of the group of "
                   "that name"));
  VisitLaws(*this, v);
  VisitUniform(*this, v);
  VisitShape(*this, v);
  v.Group("listed", listed, "rocks one by one, for kind listed");
  RequireListed(*this, v);
  v.Choice("overlap", overlap,
           Assumed("what happens to a rock that overlaps one placed before it",
                   "rocks do not interpenetrate; relocate keeps the counts of the law"));
  v.Require("overlap", kind != RockFieldKind::kUniformCount || overlap != OverlapRule::kReject,
            "leaves rocks out, which contradicts the exact count of uniform_count",
            "use relocate or allow");
  v.Choice(
      "mirror_line", mirror_line,
      Published("virtual arenas: what happens to a rock that crosses a mirror line: merge makes it "
                "one with its image, keep_off treats it as overlapping one placed before it",
                "Matthies 1995 sec. 7: random across the central 2.2 m of the course width, and "
                "mirror-image periodic beyond that"));
  v.Real("clusters_per_m2", clusters_per_m2,
         Setting("moore, golombek: number of clusters per m2 about which all rocks lie, each rock "
                 "about one of them; 0: no clusters, rocks lie anywhere",
                 {0.0, 10.0}));
  v.Real("cluster_radius_m", cluster_radius_m,
         Assumed("moore, golombek: standard deviation of rocks from the middle of their cluster, "
                 "along x and along y",
                 "no effect without clusters; no published value was at hand", {0.05, 50.0},
                 {0.3, 3.0}));
  // A cluster covers about 4 pi radius^2: the density at its middle over that area holds it all.
  constexpr double kFullestCluster = 0.25;
  v.Require("cluster_radius_m",
            overlap == OverlapRule::kAllow ||
                LawCover() <= kFullestCluster * clusters_per_m2 * 4.0 * std::numbers::pi *
                                  cluster_radius_m * cluster_radius_m ||
                clusters_per_m2 == 0.0,
            "packs more rocks into a cluster than find a place without overlap",
            "use a larger cluster_radius_m, a larger clusters_per_m2 or overlap allow");
  v.Real("clear_radius_m", clear_radius_m,
         Assumed("no rock reaches nearer than this to the start or the goal",
                 "half the rover's diagonal is 0.40 m", {0.0, 5.0}, {0.42, 0.8}));
  v.Choice("mobility", mobility,
           Assumed("whether the rover can push rocks away",
                   "rocks large enough to matter, a third buried, hold; the paper mentions none "
                   "that moved"));
  v.Group("holding", holding, "what holds a movable rock; no effect on fixed ones");
}

}  // namespace rockyard::terrain
