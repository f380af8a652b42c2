#include "campaign/mobility/mobility.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <string_view>
#include <utility>

#include "batch/parallel_tasks.h"
#include "campaign/mobility/step_drive.h"
#include "core/archive.h"
#include "core/error.h"
#include "core/json_file.h"
#include "core/provenance.h"
#include "core/text.h"
#include "math/angles.h"
#include "statistics/sample_statistics.h"
#include "terrain/soil_draw.h"

namespace rockyard::campaign {
namespace {

using core::JsonValue;
using PresetNames = core::EnumNames<terrain::SoilPreset>;

constexpr std::string_view kSoilPath = "terrain.ground.soil.";
constexpr double kLimitWithin_deg = 0.1;

// Throws what a scenario with this rover would be refused for.
void CheckRover(const rover::RoverParams& params) {
  rover::RoverParams read;
  const JsonValue document = core::WriteParams(params);
  try {
    core::ReadParams(document, read);
  } catch (const core::UserError& error) {
    std::vector<core::Problem> problems = error.problems();
    for (core::Problem& problem : problems) problem.path = "rover." + problem.path;
    throw core::UserError(std::move(problems));
  }
}

void CheckStands(const rover::RoverParams& params) {
  const rover::ComRange range = rover::StandingComRange(params);
  const double com_m = params.mass.chassis_com_x_m;
  if (com_m > range.min_m && com_m < range.max_m) return;
  throw core::UserError(
      "rover.mass.chassis_com_x_m",
      fmt::format("is {:g}, with which not all wheels of the rover would stand on level ground",
                  com_m),
      fmt::format("use a value between {:.3g} and {:.3g} m", range.min_m, range.max_m));
}

void CheckSlopes(const std::vector<double>& slopes_deg) {
  const auto wrong = [](std::string reason) {
    throw core::UserError("--slopes", std::move(reason),
                          fmt::format("give slopes from 0 to {:g} deg in ascending order, such as "
                                      "0:25:1 (from, to, by) or 0,5,10",
                                      kSteepest_deg));
  };
  if (slopes_deg.empty()) wrong("names no slope");
  for (std::size_t i = 0; i < slopes_deg.size(); ++i) {
    if (!(slopes_deg[i] >= 0.0 && slopes_deg[i] <= kSteepest_deg)) {
      wrong(fmt::format("has {:g} deg", slopes_deg[i]));
    }
    if (i > 0 && slopes_deg[i] <= slopes_deg[i - 1]) {
      wrong(fmt::format("has {:g} after {:g} deg", slopes_deg[i], slopes_deg[i - 1]));
    }
  }
}

std::vector<std::string> SoilNames(const MobilityRequest& request) {
  if (request.soils.empty()) return {"landscaping_sand", "mars_drift", "hard_ground"};
  std::vector<std::string_view> known(PresetNames::kNames.begin(), PresetNames::kNames.end());
  known.emplace_back(kOwnSoil);
  for (std::size_t i = 0; i < request.soils.size(); ++i) {
    const std::string& name = request.soils[i];
    if (std::ranges::find(known, name) == known.end()) {
      throw core::UserError("--soil", fmt::format("\"{}\" is no soil", name),
                            core::Suggest(name, known));
    }
    if (std::find(request.soils.begin(), request.soils.begin() + static_cast<std::ptrdiff_t>(i),
                  name) != request.soils.begin() + static_cast<std::ptrdiff_t>(i)) {
      throw core::UserError("--soil", fmt::format("names {} twice", name), "name each soil once");
    }
  }
  return request.soils;
}

// The values of a soil, as StudyMobility says.
terrain::SoilParams SoilOf(const MobilityRequest& request, const terrain::SoilParams& own,
                           const std::string& name) {
  if (name == kOwnSoil) return own;
  JsonValue document = JsonValue::Object();
  document.Set("preset", JsonValue(name));
  document.Set("spread", *core::WriteParams(own).Find("spread"));
  for (const std::string& assignment : request.overrides) {
    if (!assignment.starts_with(kSoilPath)) continue;
    const std::string rest = assignment.substr(kSoilPath.size());
    if (rest.starts_with("preset=")) {
      throw core::UserError("--set " + assignment, "names the soil that --soil names",
                            "give --soil own for the soil of the scenario, or leave it out");
    }
    core::ApplyOverride(document, rest);
  }
  terrain::SoilParams soil;
  core::ReadParams(document, soil);
  return soil;
}

// Returns the steepest slope, to 0.1 deg, on which the rover does well, of those that answers on
// the way are known of: they lie one slope apart.
double SteepestOf(const std::vector<SlopePoint>& known,
                  const std::function<SlopePoint(double)>& drive,
                  const std::function<bool(const SlopePoint&)>& well) {
  double good_deg = 0.0;
  double bad_deg = kSteepest_deg;
  for (const SlopePoint& point : known) {
    (well(point) ? good_deg : bad_deg) = math::RadToDeg(point.slope_rad);
    if (!well(point)) break;
  }
  if (bad_deg == kSteepest_deg && well(drive(bad_deg))) return bad_deg;
  while (bad_deg - good_deg > kLimitWithin_deg) {
    const double middle_deg = 0.5 * (good_deg + bad_deg);
    (well(drive(middle_deg)) ? good_deg : bad_deg) = middle_deg;
  }
  return good_deg;
}

SoilCurves CurvesOf(const MobilityRequest& request, const rover::RoverParams& rover,
                    const terrain::SoilParams& soil, const std::function<bool()>& stop) {
  SoilCurves curves;
  for (const SlopeWay way : {SlopeWay::kUp, SlopeWay::kDown, SlopeWay::kAcross}) {
    for (const double slope_deg : request.slopes_deg) {
      if (stop()) return curves;
      curves.slopes[static_cast<std::size_t>(way)].push_back(
          DriveSlope(rover, soil, math::DegToRad(slope_deg), way));
    }
  }
  curves.wheel = WheelCurve(rover, soil);
  const auto drive = [&](double slope_deg) {
    return DriveSlope(rover, soil, math::DegToRad(slope_deg), SlopeWay::kUp);
  };
  const auto gets_on = [](const SlopePoint& point) {
    return point.state == SlopeState::kDrives || point.state == SlopeState::kCreeps;
  };
  const auto& up = curves.slopes[static_cast<std::size_t>(SlopeWay::kUp)];
  curves.climbs_deg = SteepestOf(up, drive, gets_on);
  curves.limit_deg = SteepestOf(up, drive, [&](const SlopePoint& point) {
    return gets_on(point) && point.slip < request.slip_limit;
  });
  if (request.steps) curves.step_m = HighestStep(rover, soil, stop);
  return curves;
}

std::vector<MobilityCase> CasesOf(const MobilityRequest& request, const RoverSource& source) {
  std::vector<MobilityCase> cases;
  rover::RoverParams rover = source.params;
  rover.fidelity = request.fidelity;
  CheckRover(rover);
  CheckStands(rover);
  for (const std::string& name : SoilNames(request)) {
    const terrain::SoilParams soil = SoilOf(request, source.soil, name);
    for (const double load : request.loads) {
      cases.push_back({.soil = name,
                       .load = load,
                       .rover = Loaded(rover, load),
                       .values = soil,
                       .curves = {},
                       .draws = std::vector<SoilCurves>(static_cast<std::size_t>(request.draws))});
    }
  }
  return cases;
}

// The pieces of work: of each case its soil and its draws.
class MobilityWork {
 public:
  MobilityWork(const MobilityRequest& request, std::vector<MobilityCase>& cases,
               const MobilityProgress& progress, const Stop& stop)
      : request_(request),
        cases_(cases),
        progress_(progress),
        wish_(stop),
        each_(static_cast<std::size_t>(request.draws) + 1) {}

  // Returns whether all was done.
  bool Run() {
    const std::size_t planned = cases_.size() * each_;
    const int threads =
        request_.threads > 0 ? request_.threads : core::CurrentProvenance().cpu_threads;
    const std::size_t done = batch::RunTasks(planned, threads, stop_, [&](std::size_t task) {
      if (IsToStop()) return;
      Do(task);
      if (IsToStop()) return;
      const std::lock_guard lock(mutex_);
      if (progress_) progress_(++done_, planned);
    });
    return done == planned && !stop_;
  }

 private:
  void Do(std::size_t task) {
    MobilityCase& of = cases_[task / each_];
    const std::size_t draw = task % each_;
    const auto stop = [this] { return IsToStop(); };
    if (draw == 0) {
      of.curves = CurvesOf(request_, of.rover, of.values, stop);
    } else {
      const core::TrialKey key{request_.seed, static_cast<std::uint32_t>(draw - 1)};
      of.draws[draw - 1] = CurvesOf(request_, of.rover, terrain::DrawSoil(of.values, key), stop);
    }
  }

  bool IsToStop() {
    if (wish_.IsThere()) stop_ = true;
    return stop_;
  }

  const MobilityRequest& request_;
  std::vector<MobilityCase>& cases_;
  const MobilityProgress& progress_;
  const StopWish wish_;
  std::atomic<bool> stop_ = false;
  const std::size_t each_;  // the soil itself and its draws
  std::mutex mutex_;
  std::size_t done_ = 0;
};

}  // namespace

MobilityResult StudyMobility(const MobilityRequest& request, const MobilityProgress& progress,
                             const Stop& stop) {
  CheckSlopes(request.slopes_deg);
  MobilityResult result;
  result.slopes_deg = request.slopes_deg;
  result.source = LoadRover(request.rover, request.overrides);
  result.cases = CasesOf(request, result.source);
  if (!request.points.empty()) result.points = ReadPoints(request.points, SoilNames(request));
  if (!MobilityWork(request, result.cases, progress, stop).Run()) {
    result.outcome = Outcome::kInterrupted;
  }
  return result;
}

DrawnBand BandOver(const MobilityCase& of, const std::function<double(const SoilCurves&)>& value) {
  std::vector<double> values;
  for (const SoilCurves& draw : of.draws) values.push_back(value(draw));
  const std::vector<double> sorted = statistics::SortedFinite(values);
  if (static_cast<double>(sorted.size()) < 0.9 * static_cast<double>(values.size())) {
    constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
    return {kMissing, kMissing};
  }
  return {statistics::Quantile(sorted, 0.05), statistics::Quantile(sorted, 0.95)};
}

}  // namespace rockyard::campaign
