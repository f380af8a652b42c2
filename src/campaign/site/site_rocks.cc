#include "campaign/site/site_rocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "math/angles.h"

namespace rockyard::campaign {
namespace {

// Bounds of terrain.rocks.listed: smaller rocks do not matter to a wheel.
constexpr double kSmallest_m = 0.02;
constexpr double kLargest_m = 5.0;
constexpr double kLowest_m = 0.01;

// Rounds to a tenth of a millimetre, as heights of the model are.
double Tenths(double metres) { return std::round(metres * 1e4) / 1e4; }

// The lists of terrain.rocks.listed.
struct Lists {
  std::vector<double> x_m, y_m, diameter_m, height_m, buried_share, width_ratio, yaw_deg;
  bool buried = false, oblong = false, turned = false;  // whether any rock says so

  core::JsonValue Json() const {
    core::JsonValue json = core::JsonValue::Object();
    json.Set("x_m", core::ListOf(x_m));
    json.Set("y_m", core::ListOf(y_m));
    json.Set("diameter_m", core::ListOf(diameter_m));
    json.Set("height_m", core::ListOf(height_m));
    if (buried) json.Set("buried_share", core::ListOf(buried_share));
    if (oblong) json.Set("width_ratio", core::ListOf(width_ratio));
    if (turned) json.Set("yaw_deg", core::ListOf(yaw_deg));
    return json;
  }
};

// What was left out or assumed, as counts.
struct LeftOut {
  std::size_t beyond = 0, bumps = 0, small = 0, large = 0, no_height = 0, low = 0, deep = 0;
};

void Tell(const LeftOut& out, const ListedRequest& request, double shape,
          std::vector<std::string>& notes) {
  const auto tell = [&](std::size_t count, const std::string& what) {
    if (count > 0) notes.push_back(fmt::format("{} rocks {}", count, what));
  };
  tell(out.beyond, "of the catalogue lie beyond the arena and are left out");
  tell(out.bumps, fmt::format("of more than {:.3g} m are bumps of the model already and are left "
                              "out (--keep-bumps keeps them)",
                              request.largest_m));
  tell(out.small, fmt::format("of less than {:g} m are left out", kSmallest_m));
  tell(out.large, fmt::format("of more than {:g} m are left out", kLargest_m));
  tell(out.no_height,
       fmt::format("have no height: the mean shape of the scenario's rocks gives {:.2f} of the "
                   "diameter, buried part included",
                   shape));
  tell(out.low, fmt::format("of less than {:g} m of height are given that", kLowest_m));
  tell(out.deep, "are buried by more than 0.95 of their height and are given that");
}

}  // namespace

core::JsonValue ListedRocks(const RockCatalogue& catalogue, const ListedRequest& request,
                            const terrain::RockFieldParams& base,
                            const std::function<SitePoint(const CatalogueRock&)>& place,
                            std::vector<std::string>& notes) {
  const double shape = 0.5 * (base.min_height_ratio + base.max_height_ratio);
  constexpr double kDeepest = 0.95;
  Lists lists;
  LeftOut out;
  for (const CatalogueRock& rock : catalogue.rocks) {
    const SitePoint at = place(rock);
    if (!request.bounds.Contains(at.x_m, at.y_m)) {
      ++out.beyond;
    } else if (request.largest_m > 0.0 && rock.diameter_m > request.largest_m) {
      ++out.bumps;
    } else if (rock.diameter_m < kSmallest_m) {
      ++out.small;
    } else if (rock.diameter_m > kLargest_m) {
      ++out.large;
    } else {
      double buried = rock.buried_share.value_or(base.burial_mean);
      if (buried > kDeepest) ++out.deep;
      buried = std::min(buried, kDeepest);
      if (!rock.height_m) ++out.no_height;
      double height_m = rock.height_m.value_or(rock.diameter_m * shape * (1.0 - buried));
      if (height_m < kLowest_m) ++out.low;
      height_m = std::clamp(height_m, kLowest_m, kLargest_m);
      lists.x_m.push_back(Tenths(at.x_m));
      lists.y_m.push_back(Tenths(at.y_m));
      lists.diameter_m.push_back(Tenths(rock.diameter_m));
      lists.height_m.push_back(Tenths(height_m));
      lists.buried_share.push_back(buried);
      lists.width_ratio.push_back(rock.width_ratio.value_or(1.0));
      const double yaw_deg = rock.yaw_deg.value_or(0.0) + math::RadToDeg(request.turned_rad);
      lists.yaw_deg.push_back(std::remainder(yaw_deg, 360.0));
      lists.buried |= rock.buried_share.has_value();
      lists.oblong |= rock.width_ratio.has_value();
      lists.turned |= rock.yaw_deg.has_value();
    }
  }
  Tell(out, request, shape, notes);
  if (lists.x_m.empty()) {
    throw core::UserError(
        "--rocks", "names a catalogue none of whose rocks lies on the site",
        "check the frame of its places: --rock-places, or the columns lon and lat");
  }
  core::JsonValue json = core::JsonValue::Object();
  json.Set("kind", core::JsonValue("listed"));
  core::JsonValue listed = lists.Json();
  if (request.rest) {
    const bool golombek = base.kind == terrain::RockFieldKind::kGolombek;
    if (!golombek && base.kind != terrain::RockFieldKind::kMoore) {
      throw core::UserError("--rest", "asks for a law that the scenario has not",
                            "use a scenario whose rocks are of kind moore or golombek");
    }
    const double smallest_m = *std::ranges::min_element(lists.diameter_m);
    if (smallest_m <= base.min_diameter_m) {
      throw core::UserError(
          "--rest",
          fmt::format("has no room: the smallest rock of the catalogue has {:g} m, the smallest of "
                      "the law {:g} m",
                      smallest_m, base.min_diameter_m),
          "leave --rest out, or set a smaller terrain.rocks.min_diameter_m");
    }
    json.Set("max_diameter_m", core::JsonValue(std::min(base.max_diameter_m, smallest_m)));
    listed.Set("rest", core::JsonValue(golombek ? "golombek" : "moore"));
  }
  json.Set("listed", std::move(listed));
  return json;
}

core::JsonValue RocksBelow(const terrain::RockFieldParams& base, double effective_m,
                           std::vector<std::string>& notes) {
  core::JsonValue json = core::JsonValue::Object();
  if (base.kind == terrain::RockFieldKind::kNone || base.kind == terrain::RockFieldKind::kListed) {
    return json;
  }
  const bool uniform = base.kind == terrain::RockFieldKind::kUniformCount;
  const double smallest_m = uniform ? base.uniform_min_diameter_m : base.min_diameter_m;
  const double largest_m = uniform ? base.uniform_max_diameter_m : base.max_diameter_m;
  if (largest_m <= effective_m) return json;
  if (smallest_m >= effective_m) {
    json.Set("kind", core::JsonValue("none"));
    notes.push_back(fmt::format(
        "no rocks are laid: all of {:g} m and more are bumps of the model already", smallest_m));
    return json;
  }
  json.Set(uniform ? "uniform_max_diameter_m" : "max_diameter_m",
           core::JsonValue(Tenths(effective_m)));
  notes.push_back(
      fmt::format("rocks of the law end at {:.3g} m, the model's effective resolution: "
                  "larger ones are bumps of the model already",
                  effective_m));
  return json;
}

}  // namespace rockyard::campaign
