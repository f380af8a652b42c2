#include "terrain/terrain_params.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::terrain {

namespace {

using core::Assumed;
using core::Published;

// Bounds on the work of one field: rocks kept, and rocks drawn before thinning. Messages below name
// the numbers.
constexpr double kMaxRocks = 50000.0;
constexpr double kMaxReferenceRocks = 1e6;

bool CountAreaFits(const RockFieldParams& rocks, const ArenaParams& arena) {
  const double width_m = arena.IsVirtual() ? 2.0 * arena.MirrorLine() : arena.width_m;
  // A micrometre of tolerance, so that 4 - 2 x 0.9 holds 2.2 whatever the rounding.
  constexpr double kTolerance_m = 1e-6;
  return rocks.count_area_x_m >= arena.x_min_m - kTolerance_m &&
         rocks.count_area_x_m + rocks.count_area_length_m <=
             arena.x_min_m + arena.length_m + kTolerance_m &&
         rocks.count_area_width_m <= width_m + kTolerance_m;
}

constexpr core::Bounds kWavelengths_m{0.2, 100.0};

// The roughness of a model is summed with it on one lattice (relief_spline.h).
void RequireNestedLattices(const GroundParams& ground, core::FieldVisitor& v) {
  if (!ground.elevation.IsGiven() || ground.roughness_rms_m == 0.0) return;
  const double octaves = math::Log2(ground.roughness_wavelength_m / ground.elevation.cell_m);
  const double nearest_m = ground.elevation.cell_m * math::Exp2(std::round(octaves));
  v.Require("roughness_wavelength_m",
            std::abs(ground.roughness_wavelength_m / nearest_m - 1.0) < 1e-9,
            "is not the cell of the elevation model times a power of two",
            fmt::format("use {:.10g}", nearest_m));
}

// Beyond its edges a model knows nothing. The area is that of DrivableBounds (arena.h), which holds
// the layout.
void RequireArenaOnModel(const TerrainParams& p, core::FieldVisitor& v) {
  const ElevationParams& model = p.ground.elevation;
  if (!model.IsGiven() || !model.IsSound()) return;
  const ArenaParams& arena = p.arena;
  const double margin_m = arena.kind == ArenaKind::kOpen ? arena.open_margin_m : 0.0;
  double half_width_m = 0.5 * arena.width_m + margin_m;
  if (arena.kind == ArenaKind::kVirtualUnfolded) {
    half_width_m = (1.0 + 2.0 * static_cast<double>(arena.unfolded_strips)) * arena.MirrorLine();
  }
  const double west_m = arena.x_min_m - margin_m;
  const double east_m = arena.x_min_m + arena.length_m + margin_m;
  const auto at = [&model](std::int64_t node) { return static_cast<double>(node) * model.cell_m; };
  v.Require("arena", model.Holds(west_m, east_m, -half_width_m, half_width_m),
            fmt::format(
                "reaches from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) m, beyond the elevation model, "
                "which has heights from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) m",
                west_m, -half_width_m, east_m, half_width_m, at(-model.origin_column),
                at(-model.origin_row), at(model.columns - 1 - model.origin_column),
                at(model.rows() - 1 - model.origin_row)),
            "use a smaller length_m, width_m or open_margin_m, another x_min_m, or a larger crop");
}

// Caps end on level ground and are held by nothing below it.
void RequireGroundOfCaps(const TerrainParams& p, core::FieldVisitor& v) {
  const bool caps = p.rocks.kind != RockFieldKind::kNone && p.rocks.pointedness > 0.0;
  v.Require("rocks.pointedness", !caps || p.ground.IsLevel(),
            "is above 0 on ground that is not level: pointed rocks have a flat base, under which a "
            "gap would open",
            "use 0, or ground.slope_deg 0, ground.roughness_rms_m 0, no elevation model and no "
            "ditches or pits");
  v.Require("rocks.pointedness", !caps || p.rocks.mobility == RockMobility::kFixed,
            "is above 0 with movable rocks: the soil's hold is known for ellipsoids only",
            "use 0, or rocks.mobility fixed");
}

// A rock that stands on an edge or a flank would stand partly in the air.
void RequireRocksBesideDepressions(const TerrainParams& p, core::FieldVisitor& v) {
  if (p.rocks.kind != RockFieldKind::kListed || !p.ground.HasDepressions()) return;
  const ListedRocksParams& rocks = p.rocks.listed;
  const std::vector<Depression> depressions = ListDepressions(p.ground.ditches, p.ground.pits);
  for (std::size_t i = 0; i < rocks.x_m.size(); ++i) {
    for (const Depression& one : depressions) {
      const double distance_m = one.Distance_m(rocks.x_m[i], rocks.y_m[i]);
      const double radius_m = 0.5 * rocks.diameter_m[i];
      if (distance_m >= one.half_width_m + radius_m ||
          distance_m + radius_m <= one.half_width_m - one.flank_m) {
        continue;
      }
      v.Require("rocks.listed.x_m[" + std::to_string(i) + "]", false,
                "puts the rock on the flank of a ditch or pit, partly in the air",
                "place it beside, or whole on the level floor");
      return;
    }
  }
}

// Returns whether lists that belong together have one length. Where not, their groups refuse them.
bool HasSoundLists(const TerrainParams& p) {
  return p.ground.ditches.IsSound() && p.ground.pits.IsSound() && p.rocks.listed.IsSound();
}

}  // namespace

void GroundParams::Visit(core::FieldVisitor& v) {
  v.Angle("slope_deg", slope_rad, core::Setting("inclination of the ground plane", {0.0, 45.0}));
  v.Angle("slope_direction_deg", slope_direction_rad,
          core::Setting("uphill direction, from +x towards +y", {-360.0, 360.0}));
  v.Group("elevation", elevation, "heights of a place, which the plane carries");
  v.Real("roughness_rms_m", roughness_rms_m,
         core::Setting("root mean square height of the fractal roughness; 0 leaves a plane",
                       {0.0, 0.5}));
  v.Real("hurst_exponent", hurst_exponent,
         core::Assumed("Hurst exponent of the roughness", "no effect at the default RMS of 0",
                       {0.05, 1.0}, {0.5, 1.0}));
  v.Real("roughness_wavelength_m", roughness_wavelength_m,
         core::Assumed("longest wavelength of the roughness", "no effect at the default RMS of 0",
                       kWavelengths_m, {1.0, 8.0}));
  RequireNestedLattices(*this, v);
  v.Group("ditches", ditches, "straight trenches with round ends, one by one");
  v.Group("pits", pits, "round holes, one by one");
  v.Group("soil", soil, "what the ground does to wheels");
}

void ArenaParams::Visit(core::FieldVisitor& v) {
  v.Choice(
      "kind", kind,
      Published("open: the field goes on; walled; virtual_unfolded: mirror-periodic plane; "
                "virtual_reflected: the rover and its estimate are reflected at the mirror lines",
                "Matthies 1995 sec. 7 used the reflected virtual arena"));
  v.Real("x_min_m", x_min_m,
         Assumed("where the arena begins; the start is at 0 by default",
                 "splits the 12 m about the 7.6 m course, 2.0 m behind the start and 2.4 m beyond "
                 "the goal",
                 {-1000.0, 1000.0}, {-3.4, -1.0}));
  v.Real("length_m", length_m,
         Published("extent along the course", "Matthies 1995 sec. 3", {1.0, 1000.0}));
  v.Real("width_m", width_m,
         Published("extent across the course", "Matthies 1995 sec. 3", {1.0, 1000.0}));
  v.Real("mirror_margin_m", mirror_margin_m,
         Published("virtual arenas: distance of the mirror lines from the edges",
                   "Matthies 1995 sec. 7", {0.0, 50.0}));
  v.Require("mirror_margin_m", !IsVirtual() || MirrorLine() >= 0.25,
            "leaves less than 0.5 m between the mirror lines",
            "use a value below half the width less 0.25 m");
  v.Require("mirror_margin_m",
            kind != ArenaKind::kVirtualReflected || mirror_margin_m <= 2.0 * MirrorLine(),
            "is wider than the strip between the mirror lines, whose image is to fill it",
            "use a value of up to a third of the width");
  v.Real("open_margin_m", open_margin_m,
         Assumed("open: how far the rock field goes on beyond the arena",
                 "more than any detour on a 7.6 m course", {0.0, 50.0}, {2.0, 8.0}));
  v.Integer("unfolded_strips", unfolded_strips,
            Assumed("virtual_unfolded: mirror images on each side",
                    "wide enough for any detour on a 7.6 m course", {1, 20}, {1, 4}));
}

double TerrainParams::LayoutArea() const {
  switch (arena.kind) {
    case ArenaKind::kOpen:
      return (arena.length_m + 2.0 * arena.open_margin_m) *
             (arena.width_m + 2.0 * arena.open_margin_m);
    case ArenaKind::kWalled:
      return arena.length_m * arena.width_m;
    case ArenaKind::kVirtualUnfolded:
    case ArenaKind::kVirtualReflected:
      break;
  }
  if (rocks.kind == RockFieldKind::kUniformCount) {
    return rocks.count_area_length_m * rocks.count_area_width_m;
  }
  return arena.length_m * 2.0 * arena.MirrorLine();
}

double TerrainParams::ExpectedRocks() const {
  double strips = 1.0;
  if (arena.kind == ArenaKind::kVirtualUnfolded) {
    strips += 2.0 * static_cast<double>(arena.unfolded_strips);
  } else if (arena.kind == ArenaKind::kVirtualReflected) {
    strips = arena.width_m / (2.0 * arena.MirrorLine());
  }
  return rocks.RocksPerM2() * LayoutArea() * strips;
}

void TerrainParams::Visit(core::FieldVisitor& v) {
  v.Group("ground", ground, "the surface between the rocks");
  v.Group("rocks", rocks, "sizes, counts, shapes and placement");
  v.Group("arena", arena, "extent and edges");
  RequireGroundOfCaps(*this, v);
  if (HasSoundLists(*this)) RequireRocksBesideDepressions(*this, v);
  RequireArenaOnModel(*this, v);
  v.Require("rocks.count_area_length_m",
            rocks.kind != RockFieldKind::kUniformCount || CountAreaFits(rocks, arena),
            "puts the count area outside the arena, or outside the strip between the mirror lines",
            "keep count_area_x_m, count_area_length_m and count_area_width_m within the arena");
  // Written so that what is no number fails too.
  v.Require("rocks.min_diameter_m", ExpectedRocks() <= kMaxRocks,
            "asks for more than 50000 rocks with the present arena",
            "use a larger min_diameter_m, a smaller k_per_m2 or cover, or a smaller arena");
  v.Require("rocks.clusters_per_m2",
            !rocks.FollowsLaw() || rocks.clusters_per_m2 == 0.0 ||
                rocks.clusters_per_m2 * LayoutArea() >= 1.0,
            "lets expect less than one cluster in the layout area, with all rocks of the field",
            "use 0 for rocks without clusters, or a larger number");
  const bool golombek = rocks.RandomKind() == RockFieldKind::kGolombek;
  v.Require(
      golombek ? "rocks.cover_reference" : "rocks.k_reference_per_m2",
      rocks.ReferenceRocksPerM2() * LayoutArea() <= kMaxReferenceRocks,
      "asks for more than a million rocks before thinning",
      golombek ? "use a cover_reference nearer to cover, a larger min_diameter_m or a smaller arena"
               : "use a k_reference_per_m2 nearer to k_per_m2, a larger min_diameter_m or a "
                 "smaller arena");
}

namespace {

using core::Setting;

void VisitPlaces(std::vector<double>& x_m, std::vector<double>& y_m, core::FieldVisitor& v) {
  v.Reals("x_m", x_m, Setting("x of every middle", {-1000.0, 1000.0}));
  v.Reals("y_m", y_m, Setting("y of every middle", {-1000.0, 1000.0}));
}

void VisitProfile(std::string_view width_name, std::vector<double>& width_m,
                  std::vector<double>& depth_m, std::vector<double>& flank_m,
                  core::FieldVisitor& v) {
  v.Reals(width_name, width_m,
          Setting("width of every one at the top, from edge to edge", {0.05, 100.0}));
  v.Reals("depth_m", depth_m,
          Setting("depth of every one below the ground around it", {0.001, 10.0}));
  v.Reals("flank_m", flank_m,
          Setting("horizontal width of every flank, from the edge to the level floor; an empty "
                  "list: half of the width, no floor",
                  {0.01, 50.0}));
}

// Requires a list to be as long as x_m.
void RequireLength(std::string_view name, std::size_t size, std::size_t wanted,
                   core::FieldVisitor& v) {
  v.Require(name, size == wanted,
            "has " + std::to_string(size) + " entries where x_m has " + std::to_string(wanted),
            "give every list one entry for each place");
}

// Refuses flanks that meet before they reach the floor.
void RequireFlanks(const std::vector<double>& width_m, const std::vector<double>& flank_m,
                   core::FieldVisitor& v) {
  if (flank_m.empty()) return;
  RequireLength("flank_m", flank_m.size(), width_m.size(), v);
  for (std::size_t i = 0; i < std::min(flank_m.size(), width_m.size()); ++i) {
    v.Require("flank_m[" + std::to_string(i) + "]", flank_m[i] <= 0.5 * width_m[i],
              "is wider than half of the whole", "use at most half of the width");
  }
}

double FlankOf(const std::vector<double>& flank_m, std::size_t i, double half_width_m) {
  return flank_m.empty() ? half_width_m : flank_m[i];
}

}  // namespace

double Depression::Distance_m(double at_x_m, double at_y_m) const {
  const double dx_m = at_x_m - x_m;
  const double dy_m = at_y_m - y_m;
  const auto [s, c] = math::SinCos(direction_rad);
  // Along the segment only the distance beyond its end counts.
  const double beyond_m = std::max(std::abs(c * dx_m + s * dy_m) - half_length_m, 0.0);
  return math::Hypot(beyond_m, c * dy_m - s * dx_m);
}

bool DitchesParams::IsSound() const {
  const std::size_t size = x_m.size();
  return y_m.size() == size && direction_deg.size() == size && length_m.size() == size &&
         width_m.size() == size && depth_m.size() == size &&
         (flank_m.empty() || flank_m.size() == size);
}

void DitchesParams::Visit(core::FieldVisitor& v) {
  VisitPlaces(x_m, y_m, v);
  v.Reals("direction_deg", direction_deg,
          Setting("direction of every ditch, from +x towards +y", {-360.0, 360.0}));
  v.Reals("length_m", length_m,
          Setting("length of every ditch at the top, round ends included; 0 for one without an end",
                  {0.0, 2000.0}));
  VisitProfile("width_m", width_m, depth_m, flank_m, v);
  RequireLength("y_m", y_m.size(), x_m.size(), v);
  RequireLength("direction_deg", direction_deg.size(), x_m.size(), v);
  RequireLength("length_m", length_m.size(), x_m.size(), v);
  RequireLength("width_m", width_m.size(), x_m.size(), v);
  RequireLength("depth_m", depth_m.size(), x_m.size(), v);
  RequireFlanks(width_m, flank_m, v);
  for (std::size_t i = 0; i < std::min(length_m.size(), width_m.size()); ++i) {
    v.Require("length_m[" + std::to_string(i) + "]",
              length_m[i] == 0.0 || length_m[i] >= width_m[i], "is less than the width",
              "use at least the width, or 0 for a ditch without an end");
  }
}

bool PitsParams::IsSound() const {
  const std::size_t size = x_m.size();
  return y_m.size() == size && diameter_m.size() == size && depth_m.size() == size &&
         (flank_m.empty() || flank_m.size() == size);
}

void PitsParams::Visit(core::FieldVisitor& v) {
  VisitPlaces(x_m, y_m, v);
  VisitProfile("diameter_m", diameter_m, depth_m, flank_m, v);
  RequireLength("y_m", y_m.size(), x_m.size(), v);
  RequireLength("diameter_m", diameter_m.size(), x_m.size(), v);
  RequireLength("depth_m", depth_m.size(), x_m.size(), v);
  RequireFlanks(diameter_m, flank_m, v);
}

std::vector<Depression> ListDepressions(const DitchesParams& ditches, const PitsParams& pits) {
  std::vector<Depression> all;
  for (std::size_t i = 0; i < ditches.x_m.size(); ++i) {
    const double half_width_m = 0.5 * ditches.width_m[i];
    // The round ends reach half a width beyond the segment.
    const double half_length_m = ditches.length_m[i] == 0.0
                                     ? std::numeric_limits<double>::infinity()
                                     : 0.5 * ditches.length_m[i] - half_width_m;
    all.push_back({ditches.x_m[i], ditches.y_m[i], math::DegToRad(ditches.direction_deg[i]),
                   half_length_m, half_width_m, FlankOf(ditches.flank_m, i, half_width_m),
                   ditches.depth_m[i]});
  }
  for (std::size_t i = 0; i < pits.x_m.size(); ++i) {
    const double half_width_m = 0.5 * pits.diameter_m[i];
    all.push_back({pits.x_m[i], pits.y_m[i], 0.0, 0.0, half_width_m,
                   FlankOf(pits.flank_m, i, half_width_m), pits.depth_m[i]});
  }
  return all;
}

}  // namespace rockyard::terrain
