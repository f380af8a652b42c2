// What `rockyard mobility` does, for that command, Python and tests: how a rover gets on on slopes
// and over steps of one soil and load after another. No record depends on it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "campaign/mobility/measured_points.h"
#include "campaign/mobility/slope_drive.h"
#include "campaign/mobility/wheel_curve.h"
#include "campaign/rover_source.h"
#include "campaign/stop.h"
#include "campaign/work.h"

namespace rockyard::campaign {

// The soil of the scenario as it is, beside the names of presets.
inline constexpr const char* kOwnSoil = "own";

struct MobilityRequest {
  std::string rover;                   // as LoadRover takes it
  std::vector<std::string> overrides;  // "PATH=VALUE"
  // Presets, and kOwnSoil; none: landscaping_sand, mars_drift, hard_ground.
  std::vector<std::string> soils;
  std::vector<double> loads{1.0};  // factors of all masses
  std::vector<double> slopes_deg;  // ascending, in [0, 60]
  double slip_limit = 0.8;
  int draws = 20;  // of the soil, for bands
  std::uint64_t seed = 1;
  bool steps = true;
  rover::Fidelity fidelity = rover::Fidelity::kQuasiStatic;  // of the drives on slopes
  std::filesystem::path points;                              // measured; "": none
  int threads = 0;                                           // 0: all of the machine
};

// What one soil answers.
struct SoilCurves {
  std::array<std::vector<SlopePoint>, 3> slopes;  // by SlopeWay, in the order of the request
  std::vector<WheelPoint> wheel;
  // Straight up, to 0.1 deg: the steepest slope on which the slip is less than the limit, and on
  // which the rover gets on at all. 0 also where it does not on level ground; kSteepest_deg where
  // it does so there.
  double limit_deg = 0.0;
  double climbs_deg = 0.0;
  std::optional<double> step_m;  // the highest that it climbs; none where steps are not asked for
};
inline constexpr double kSteepest_deg = 60.0;

// One soil under one load.
struct MobilityCase {
  std::string soil;
  double load = 1.0;
  rover::RoverParams rover;
  terrain::SoilParams values;
  SoilCurves curves;
  std::vector<SoilCurves> draws;
};

struct MobilityResult {
  Outcome outcome = Outcome::kDone;  // or kInterrupted: the cases are not whole
  RoverSource source;
  std::vector<MobilityCase> cases;
  std::vector<MeasuredPoint> points;
  std::vector<double> slopes_deg;
};

// Called by several threads, one at a time.
using MobilityProgress = std::function<void(std::size_t done, std::size_t planned)>;

// Drives all of it. The soil of preset NAME has that preset's values, its law among them, with the
// spread of the scenario, and then what the overrides say of terrain.ground.soil. The
// draws of a soil are terrain::DrawSoil with the seed and numbers from 0, the same for all cases.
// What comes back does not depend on the threads. Cost: 3 soils, 26 slopes and 20 draws take about
// 20 s of one processor, four fifths of it for steps. Throws core::UserError for all that is wrong
// with the request.
MobilityResult StudyMobility(const MobilityRequest& request, const MobilityProgress& progress,
                             const Stop& stop);

// Returns the 5 % and 95 % points of a value over the draws that have a finite one; both are NaN
// where fewer than nine of ten have.
struct DrawnBand {
  double low;
  double high;
};
DrawnBand BandOver(const MobilityCase& of, const std::function<double(const SoilCurves&)>& value);

}  // namespace rockyard::campaign
