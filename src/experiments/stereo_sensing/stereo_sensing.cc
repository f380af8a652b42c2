#include "experiments/stereo_sensing/stereo_sensing.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "experiments/look_factors.h"
#include "experiments/record_of.h"
#include "experiments/stereo_sensing/look_map.h"
#include "experiments/stereo_sensing/pixel_errors.h"
#include "math/angles.h"
#include "sensing/stereo_ground_truth.h"
#include "sensing/stereo_sensor.h"
#include "trial/eyes/stereo_eyes.h"

namespace rockyard::experiments {
namespace {

using enum truth::ColumnRole;

void AddPixelKinds(truth::RecordSchema& columns) {
  constexpr std::array<const char*, kPixelKinds.size()> kMeanings{
      "lit, away from jumps in depth",
      "on the nearer side of a jump in depth, within sensors.stereo.edge_reach_px",
      "on its farther side", "outside of the sun, away from jumps"};
  for (std::size_t i = 0; i < kPixelKinds.size(); ++i) {
    const std::string kind = kPixelKinds[i];
    const std::string meaning = kMeanings[i];
    columns.push_back({kind + "_pixels", "1", "of the pixels: " + meaning, kBase});
    columns.push_back({kind + "_good", "1", "matched within 1 px", kCount, kind + "_pixels"});
    columns.push_back({kind + "_wrong", "1", "matched farther off", kCount, kind + "_pixels"});
    columns.push_back(
        {kind + "_bias_px", "px", "matched less true disparity", kSum, kind + "_good"});
    columns.push_back(
        {kind + "_error_px", "px", "matched less true disparity", kSquares, kind + "_good"});
  }
}

// Of one side of a jump in depth, `ending` columns from it.
void AddSide(const std::string& side, const std::string& ending, truth::RecordSchema& columns) {
  const std::string base = side + "_pixels" + ending;
  columns.push_back(
      {base, "1", "pixels as many columns from the nearest jump in depth, on that side", kBase});
  columns.push_back({side + "_matched" + ending, "1", "of these, matched", kCount, base});
  columns.push_back({side + "_wrong" + ending, "1", "of these, off by 1 px", kCount, base});
}

void AddNeighbours(truth::RecordSchema& columns) {
  for (std::size_t i = 1; i <= kEdgeDistances; ++i) {
    const std::string ending = std::string("_").append(std::to_string(i));
    for (const char* side : {"front", "behind"}) {
      AddSide(side, ending, columns);
    }
  }
  for (std::size_t i = 1; i <= kLags; ++i) {
    const std::string base = "pairs_" + std::to_string(i);
    columns.push_back({base, "1", "pairs of good plain pixels as many columns apart", kBase});
    columns.push_back({"product_px2_" + std::to_string(i), "px2",
                       "product of their errors of disparity", kSum, base});
  }
}

void AddRocks(truth::RecordSchema& columns) {
  for (const char* height : kRockHeights) {
    const std::string base = std::string("rocks_") + height;
    columns.push_back({base, "1",
                       "rocks in view of at least as many tenths of hazard_height_m, below the "
                       "next class",
                       kBase});
    columns.push_back({std::string("perfect_") + height, "1",
                       "the navigator's map calls a hazard with perfect matches", kCount, base});
    columns.push_back({std::string("found_") + height, "1",
                       "it does so with the points of the look", kCount, base});
  }
}

truth::RecordSchema MakeStereoColumns() {
  truth::RecordSchema columns{
      {"soil_graininess", "1", "texture of the soil, from drift to gravel", kFactor},
      {"sun_elevation_deg", "deg", "sun above the horizon", kFactor},
      {"baseline_m", "m", "between the two cameras", kFactor},
      {"nearest_m", "m", "from the left camera: what the cell begins with", kFactor},
      {"farthest_m", "m", "from the left camera: what the cell ends before", kFactor},
      {"looks", "1", "looks, each on a terrain of its own", kTrials},
      {"pixels", "1", "pixels whose surface both cameras see, away from margins", kBase},
      {"matched", "1", "of these, with a disparity: the density", kMainCount, "pixels"},
      {"good", "1", "off by less than 1 px", kCount, "pixels"},
      {"wrong", "1", "off by 1 px or more", kCount, "matched"},
      {"bias_px", "px", "matched less true disparity", kSum, "good"},
      {"error_px", "px", "matched less true disparity", kSquares, "good"},
      {"range_m", "m", "true range from the left camera", kSum, "good"},
      {"range_bias_m", "m", "measured less true range", kSum, "good"},
      {"range_error_m", "m", "measured less true range", kSquares, "good"},
      {"range_step_m", "m", "range that one pixel of disparity stands for, r Z / (f B)", kSquares,
       "good"},
      {"axis_step_m", "m", "the same on the optical axis, r^2 / (f B)", kSquares, "good"},
  };
  AddPixelKinds(columns);
  AddNeighbours(columns);
  columns.push_back({"margin_pixels", "1",
                     "seen by both, but a window reaches over an image's edge or the rover",
                     kBase});
  columns.push_back({"margin_matched", "1", "of these, matched", kCount, "margin_pixels"});
  columns.push_back({"hidden_pixels", "1", "what the left camera alone sees", kBase});
  columns.push_back({"hidden_matched", "1", "of these, matched", kCount, "hidden_pixels"});
  AddRocks(columns);
  columns.push_back(
      {"clear_cells", "1", "cells of the map without hazard with perfect matches", kBase});
  columns.push_back({"clear_known", "1", "of these, known from the look", kCount, "clear_cells"});
  columns.push_back({"imagined", "1", "of these, called a hazard", kCount, "clear_known"});
  columns.push_back({"hazard_cells", "1", "cells with a hazard with perfect matches", kBase});
  columns.push_back(
      {"hazard_found", "1", "of these, called a hazard from the look", kCount, "hazard_cells"});
  return columns;
}

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

}  // namespace

const truth::RecordSchema& StereoColumns() {
  static const truth::RecordSchema kColumns = MakeStereoColumns();
  return kColumns;
}

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
    : params_(params),
      table_(params.Factors()),
      schema_(CellSchema<StereoSums>(StereoColumns(), table_, {"farthest_m"})) {
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
    std::vector<double> values = cell.factors;
    values.push_back(cell.bin.farthest_m);
    return CellRecord(index, number, std::move(values), Measure(cell, key));
  });
}

}  // namespace rockyard::experiments
