#include "experiments/stereo_sensing/stereo_sensing.h"

#include <cstdint>
#include <string>
#include <string_view>

#include "experiments/look_factors.h"
#include "experiments/record_of.h"
#include "experiments/scene_key.h"
#include "experiments/stereo_sensing/columns.h"
#include "experiments/stereo_sensing/look_map.h"
#include "experiments/stereo_sensing/pixel_errors.h"
#include "experiments/stereo_sensing/random_place.h"
#include "math/angles.h"
#include "sensing/stereo_ground_truth.h"
#include "sensing/stereo_sensor.h"
#include "trial/stereo_eyes.h"
#include "truth/measurement_record.h"

namespace rockyard::experiments {
namespace {

using messages::LookDirection;

constexpr LookDirection kAhead = LookDirection::kAhead;

sensing::StereoParams OfRays(sensing::StereoParams params) {
  params.fidelity = sensing::StereoFidelity::kErrorModel;
  return params;
}

// One over the depths that perfect matches give: of what both eyes see, as far as it is searched.
sensing::DepthImage PerfectMatches(const sensing::StereoTruth& truth,
                                   const sensing::StereoParams& cameras, double scale_px_m) {
  return (truth.both_px >= cameras.min_disparity_px && truth.both_px <= cameras.max_disparity_px)
      .select(truth.both_px / scale_px_m, 0.0);
}

truth::RecordSchema StereoSchema(const CellTable& table) {
  std::vector<std::string> names;
  for (const std::string_view name : table.columns()) names.emplace_back(name);
  names.emplace_back("farthest_m");
  ForEachSum(StereoSums{}, [&](const std::string& name, double) { names.push_back(name); });
  const std::vector<std::string_view> views(names.begin(), names.end());
  return truth::MeasurementSchema(StereoColumns(), views);
}

}  // namespace

struct StereoSensingExperiment::Cell {
  Cell(const StereoSensingParams& params, const trial::DriveParams& of_cell,
       const std::vector<double>& of_factors)
      : drive(of_cell),
        factors(of_factors),
        bin{of_factors.back(), params.FarthestOf(of_factors.back())},
        truth(drive.sensors.stereo, drive.sensors.sun, drive.rover.geometry,
              static_cast<int>(drive.perception.stereo.window_side_px)),
        rays(OfRays(drive.sensors.stereo)) {}

  // What of a look's pixels belongs to it.
  PixelLimits Limits() const {
    const sensing::StereoParams& cameras = drive.sensors.stereo;
    return {bin.nearest_m, bin.farthest_m, cameras.min_disparity_px, cameras.max_disparity_px,
            static_cast<int>(cameras.edge_reach_px)};
  }

  trial::DriveParams drive;
  std::vector<double> factors;
  DistanceBin bin;
  sensing::StereoGroundTruth truth;
  sensing::StereoSensor rays;  // of both eyes: for the points that disparities stand for
};

StereoSensingExperiment::StereoSensingExperiment(const StereoSensingParams& params,
                                                 const trial::DriveParams& drive)
    : params_(params), table_(params.Factors()), schema_(StereoSchema(table_)) {
  cells_.reserve(table_.size());
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const std::vector<double> values = table_.Values(i);
    cells_.emplace_back(params, WithLookFactors(drive, table_.columns(), values), values);
  }
}

StereoSensingExperiment::~StereoSensingExperiment() = default;

StereoSums StereoSensingExperiment::Measure(const Cell& cell, core::TrialKey key) const {
  // One rover, whose cameras keep their faults, at one place after the other.
  const trial::StereoEyes eyes(cell.drive, key);
  const sensing::StereoView& view_R = cell.truth.view_R(kAhead);
  const double scale_px_m = view_R.focal_px * view_R.baseline_m;
  StereoSums sums;
  for (std::int64_t look = 0; look < params_.looks_per_run; ++look) {
    const core::TrialKey scene = SceneKey(key, params_.looks_per_run, look);
    const terrain::Terrain terrain = SceneTerrainOf(cell.drive, scene);
    const math::Transform X_WR = RandomPlace(cell.drive, terrain, params_.hazard_height_m, scene);
    const sensing::StereoTruth truth = cell.truth.See(terrain, X_WR, kAhead);
    const trial::StereoSeen seen = eyes.See(terrain, X_WR, look, kAhead);
    sums.looks += 1.0;
    AddPixels(truth, seen.disparities_px, view_R, cell.Limits(), sums);
    const auto& navigator = cell.drive.navigation.navigators.chosen();
    const messages::MapView perfect = MapOfLook(
        navigator, cell.rays.PointsOf(PerfectMatches(truth, cell.drive.sensors.stereo, scale_px_m),
                                      look, kAhead));
    const messages::MapView map = MapOfLook(navigator, seen.cloud);
    AddRocksInView(params_, terrain, truth, view_R, {perfect, map}, cell.bin, sums);
    AddCellsOfMap(params_, view_R, {perfect, map}, cell.bin, sums);
  }
  return sums;
}

truth::Record StereoSensingExperiment::Run(std::uint64_t seed, std::uint64_t index) const {
  return RecordOf(seed, index, [&](const core::TrialKey& key) {
    const std::size_t number = index % table_.size();
    const Cell& cell = cells_[number];
    truth::Record record{index, truth::TrialOutcome::kMeasured, "", {static_cast<double>(number)}};
    for (const double value : cell.factors) record.values.push_back(value);
    record.values.push_back(cell.bin.farthest_m);
    const StereoSums sums = Measure(cell, key);
    ForEachSum(sums, [&](const std::string&, double value) { record.values.push_back(value); });
    return record;
  });
}

}  // namespace rockyard::experiments
