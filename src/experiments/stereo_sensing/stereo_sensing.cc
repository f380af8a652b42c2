#include "experiments/stereo_sensing/stereo_sensing.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "experiments/look_factors.h"
#include "experiments/stereo_sensing/stereo_sums.h"
#include "math/angles.h"
#include "sensing/stereo_ground_truth.h"
#include "sensing/stereo_sensor.h"
#include "trial/eyes/stereo_eyes.h"
#include "trial/sight/stereo_reader.h"

namespace rockyard::experiments {
namespace {

using messages::LookDirection;

constexpr LookDirection kAhead = LookDirection::kAhead;

sensing::StereoParams OfRays(sensing::StereoParams params) {
  params.fidelity = sensing::StereoFidelity::kErrorModel;
  return params;
}

// Returns one over the depths that perfect matches give: those of what both eyes see, within the
// disparities that are searched.
sensing::DepthImage PerfectMatches(const sensing::StereoTruth& truth,
                                   const sensing::StereoParams& cameras, double scale_px_m) {
  return (truth.both_px >= cameras.min_disparity_px && truth.both_px <= cameras.max_disparity_px)
      .select(truth.both_px / scale_px_m, 0.0);
}

}  // namespace

const truth::RecordSchema& StereoColumns() {
  using enum truth::ColumnRole;
  static const truth::RecordSchema kColumns = ColumnsOf<StereoSums>({
      {"soil_graininess", "1", "texture of the soil, from drift to gravel", kFactor},
      {"sun_elevation_deg", "deg", "sun above the horizon", kFactor},
      {"baseline_m", "m", "between the two cameras", kFactor},
      {"nearest_m", "m", "from the left camera: what the cell begins with", kFactor},
      {"farthest_m", "m", "from the left camera: what the cell ends before", kFactor},
  });
  return kColumns;
}

namespace {

// Returns the columns after the factors. farthest_m is no factor of its own: where the cell ends
// follows from where it begins.
std::vector<std::string_view> MeasuredColumns() {
  std::vector<std::string_view> names{"farthest_m"};
  for (const truth::ValueInfo& column : StereoColumns()) {
    if (column.role != truth::ColumnRole::kFactor) names.push_back(column.name);
  }
  return names;
}

}  // namespace

struct StereoSensingExperiment::Cell {
  Cell(const StereoSensingParams& params, const trial::DriveParams& of_cell, double nearest_m)
      : drive(of_cell),
        bin{nearest_m, params.FarthestOf(nearest_m)},
        truth(drive.sensors.stereo, drive.sensors.sun, drive.rover.geometry,
              static_cast<int>(drive.perception.stereo.window_side_px)),
        rays(OfRays(drive.sensors.stereo)),
        rays_R(sensing::MakeStereoView(rays, kAhead)) {}

  // Returns what of a look's pixels belongs to the cell.
  PixelLimits Limits() const {
    const sensing::StereoParams& cameras = drive.sensors.stereo;
    return {bin.nearest_m, bin.farthest_m, cameras.min_disparity_px, cameras.max_disparity_px,
            static_cast<int>(cameras.edge_reach_px)};
  }

  trial::DriveParams drive;
  DistanceBin bin;
  sensing::StereoGroundTruth truth;
  // The cameras as the error model has them, and their view, for the points that disparities stand
  // for.
  sensing::StereoParams rays;
  sensing::StereoView rays_R;
};

StereoSensingExperiment::StereoSensingExperiment(const StereoSensingParams& params,
                                                 const trial::DriveParams& drive)
    : CellExperiment(params.Factors(), StereoColumns(), MeasuredColumns()), params_(params) {
  cells_.reserve(table().size());
  for (std::size_t i = 0; i < table().size(); ++i) {
    const std::vector<double> values = table().Values(i);
    cells_.emplace_back(params, WithLookFactors(drive, table().columns(), values), values.back());
  }
}

StereoSensingExperiment::~StereoSensingExperiment() = default;

std::vector<double> StereoSensingExperiment::Measure(std::size_t number, core::TrialKey key) const {
  const Cell& cell = cells_[number];
  // One rover, whose cameras keep their faults, at one place after the other.
  trial::RoverCameras cameras(cell.drive, key);
  const trial::StereoEyes eyes(cell.drive, key, cameras);
  const trial::StereoReader reader(cell.drive);
  const sensing::StereoView& view_R = cell.truth.view_R(kAhead);
  const double scale_px_m = view_R.focal_px * view_R.baseline_m;
  StereoSums sums;
  for (std::int64_t look = 0; look < params_.looks_per_run; ++look) {
    const core::TrialKey scene = SceneKey(key, params_.looks_per_run, look);
    const terrain::Terrain terrain = SceneTerrainOf(cell.drive, scene);
    const math::Transform X_WR = RandomPlace(cell.drive, terrain, params_.hazard_height_m, scene);
    const sensing::StereoTruth truth = cell.truth.See(terrain, X_WR, kAhead);
    const trial::StereoSeen seen =
        reader.See({.direction = kAhead, .number = look}, eyes.Look(terrain, X_WR, kAhead, look));
    sums.looks += 1.0;
    AddPixels(truth, seen.disparities_px, view_R, cell.Limits(), sums);
    const auto& navigator = cell.drive.navigation.navigators.chosen();
    const messages::MapView perfect =
        MapOfLook(navigator, PointsOf(cell.rays, cell.rays_R,
                                      PerfectMatches(truth, cell.rays, scale_px_m), look, kAhead));
    const messages::MapView map = MapOfLook(navigator, seen.cloud);
    AddRocksInView(params_, terrain, truth, view_R, {perfect, map}, cell.bin, sums);
    AddCellsOfMap(params_, view_R, {perfect, map}, cell.bin, sums);
  }
  return ValuesOf(sums, {cell.bin.farthest_m});
}

}  // namespace rockyard::experiments
