#include "experiments/cylinder_sighting/cylinder_sighting.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "core/random.h"
#include "experiments/cylinder_sighting/sighting_sums.h"
#include "experiments/record_of.h"
#include "math/angles.h"
#include "rendering/cylinder/colour_readout.h"
#include "rendering/cylinder/cylinder_renderer.h"
#include "vision/cylinder/published_finder.h"
#include "vision/cylinder/robust_finder.h"

namespace rockyard::experiments {
namespace {

using enum truth::ColumnRole;

void AddFinder(const std::string& finder, const std::string& called, truth::ColumnRole found_role,
               truth::RecordSchema& columns) {
  const std::string found = finder + "_found";
  const std::string right = finder + "_right";
  columns.push_back({found, "1", "of these, with a pose by " + called, found_role, "measurements"});
  columns.push_back({finder + "_wrong", "1",
                     "of these, off by more than 3 of its own standard deviations and more than "
                     "10 deg or 10 %, or without a cylinder in view",
                     kCount, found});
  columns.push_back({right, "1", "of these, not wrong", kCount, found});
  for (std::size_t i = 1; i < kCylinderMisses; ++i) {
    const std::string reason(core::EnumNames<vision::CylinderMiss>::kNames[i]);
    std::string name = finder + "_";
    name += reason;
    columns.push_back(
        {name, "1", "without a pose, for the reason " + reason, kCount, "measurements"});
  }
  const auto error = [&](const std::string& name, const std::string& suffix,
                         const std::string& unit, const std::string& meaning,
                         const std::string& of) {
    columns.push_back({finder + "_" + name + "_bias" + suffix, unit, meaning, kSum, of});
    columns.push_back({finder + "_" + name + "_error" + suffix, unit, meaning, kSquares, of});
  };
  error("orientation", "_deg", "deg", "measured less true orientation, wrong ones too", found);
  error("stereo", "", "1", "depth by stereo over the true one, less 1, wrong ones too", found);
  error("size", "", "1", "depth by size over the true one, less 1, wrong ones too", found);
  error("right_orientation", "_deg", "deg", "measured less true orientation", right);
  error("right_range", "", "1", "range along the ground over the true one, less 1", right);
  error("right_bearing", "_mrad", "mrad", "measured less true bearing", right);
  columns.push_back({finder + "_nees", "1",
                     "squared error of place and orientation in units of the stated covariance: 4 "
                     "on average where that is right",
                     kSum, right});
}

truth::RecordSchema MakeSightingColumns() {
  truth::RecordSchema columns{
      {"distance_m", "m", "from the cameras' centre of rotation along the ground", kFactor},
      {"orientation_deg", "deg", "theta: azimuth of the cameras in the cylinder's frame", kFactor},
      {"sun_elevation_deg", "deg", "of picture.light", kFactor},
      {"clutter_level", "1", "factor of the numbers of picture.clutter", kFactor},
      {"third_colour", "1", "0 orange, 1 green", kFactor},
      {"measurements", "1", "pairs of images", kTrials},
  };
  AddFinder("published", "the published finder", kMainCount, columns);
  AddFinder("robust", "rockyard's own finder", kCount, columns);
  return columns;
}

using core::SampleUniform;
using rendering::CylinderPictureParams;

void SetFactor(std::string_view name, double value, StudiedView& studied) {
  CylinderPictureParams& picture = studied.picture;
  if (name == "distance_m") {
    studied.view.distance_m = value;
  } else if (name == "orientation_deg") {
    studied.view.orientation_rad = math::WrapAngle(math::DegToRad(value));
  } else if (name == "sun_elevation_deg") {
    picture.light.elevation_rad = math::DegToRad(value);
  } else if (name == "clutter_level") {
    picture.clutter.rocks *= value;
    picture.clutter.hardware *= value;
  } else {
    picture.target.third_colour =
        value == 0.0 ? rendering::ThirdColour::kOrange : rendering::ThirdColour::kGreen;
  }
}

// The share of the image above the highest hills: three deviations above their mean, or the level
// line of sight where that is higher.
double SkyShare(const CylinderPictureParams& picture, const vision::Cahv& camera) {
  const rendering::BackdropParams& hills = picture.backdrop;
  const double height_m = hills.horizon_distance_m * std::tan(hills.horizon_elevation_rad) +
                          3.0 * hills.horizon_relief_m;
  const auto pixel =
      vision::Project(camera, {hills.horizon_distance_m, 0.0, std::fmax(0.0, height_m)});
  if (!pixel) return 0.0;
  const double share = (pixel->y() + 1.0) / static_cast<double>(picture.cameras.rows);
  return std::clamp(share, 0.0, 0.9);
}

vision::ColourCylinder ShapeOf(const CylinderPictureParams& picture) {
  return {picture.target.diameter_m, picture.target.height_m};
}

CylinderTruth TruthOf(const StudiedView& studied, const vision::Cahv& left) {
  const math::Vector3 p_LT_L = rendering::CylinderPose(studied.picture, studied.view).translation();
  return {studied.view.present, studied.view.orientation_rad, p_LT_L,
          (p_LT_L - left.C).dot(left.A)};
}

}  // namespace

const truth::RecordSchema& CylinderSightingColumns() {
  static const truth::RecordSchema kColumns = MakeSightingColumns();
  return kColumns;
}

CylinderSightingExperiment::CylinderSightingExperiment(const CylinderSightingParams& params)
    : params_(params),
      table_(params.Factors()),
      schema_(CellSchema<SightingSums>(CylinderSightingColumns(), table_)) {}

StudiedView CylinderSightingExperiment::Draw(std::size_t cell, core::TrialKey key) const {
  StudiedView studied{params_.picture, {}, params_.published, params_.robust};
  core::RandomStream stream(key, core::Purpose::kExperiment);
  studied.view.present = params_.present;
  studied.view.orientation_rad = SampleUniform(stream, -std::numbers::pi, std::numbers::pi);
  const double azimuth_rad = SampleUniform(stream, -std::numbers::pi, std::numbers::pi);
  if (params_.any_sun_azimuth) studied.picture.light.azimuth_rad = azimuth_rad;
  studied.view.bearing_rad = params_.largest_bearing_rad * SampleUniform(stream, -1.0, 1.0);
  const double spread = params_.distance_spread * SampleUniform(stream, -1.0, 1.0);
  const std::vector<double> values = table_.Values(cell);
  const std::vector<std::string_view> names = table_.columns();
  for (std::size_t i = 0; i < names.size(); ++i) SetFactor(names[i], values[i], studied);
  studied.view.distance_m *= 1.0 + spread;
  if (studied.picture.target.third_colour == rendering::ThirdColour::kGreen) {
    studied.published.classes.red = vision::GreenRatios();
    studied.robust.surfaces.third = vision::kGreenSurface;
  }
  studied.published.sky_share =
      SkyShare(studied.picture, rendering::CylinderCameras(studied.picture, studied.view)[0]);
  return studied;
}

SightingSums CylinderSightingExperiment::Measure(std::size_t cell, core::TrialKey key) const {
  SightingSums sums;
  for (std::int64_t i = 0; i < params_.views_per_run; ++i) {
    const core::TrialKey scene = SceneKey(key, params_.views_per_run, i);
    const StudiedView studied = Draw(cell, scene);
    const auto cameras = rendering::CylinderCameras(studied.picture, studied.view);
    const vision::ImageSize size{static_cast<int>(studied.picture.cameras.columns),
                                 static_cast<int>(studied.picture.cameras.rows)};
    const CylinderTruth truth = TruthOf(studied, cameras[0]);
    const rendering::ColourReadout readout(studied.picture.cameras, studied.picture.light,
                                           rendering::ToColour(studied.picture.backdrop.ground));
    const auto light = rendering::RenderCylinder(studied.picture, studied.view, scene);
    const std::array counts{readout.Counts(light[0]), readout.Counts(light[1])};
    for (std::uint32_t j = 0; j < params_.measurements_per_view; ++j) {
      const vision::ColourImage left = readout.Read(counts[0], scene, 2 * j);
      const vision::ColourImage right = readout.Read(counts[1], scene, 2 * j + 1);
      const vision::ColourPair pair{left, right, {cameras[0], size}, {cameras[1], size}};
      sums.measurements += 1.0;
      const vision::ColourCylinder shape = ShapeOf(studied.picture);
      JudgeSighting(truth, vision::FindCylinderAsPublished(pair, shape, studied.published),
                    sums.published);
      JudgeSighting(truth, vision::FindCylinder(pair, shape, studied.robust), sums.robust);
    }
  }
  return sums;
}

truth::Record CylinderSightingExperiment::Run(std::uint64_t seed, std::uint64_t index) const {
  return RecordOf(seed, index, [&](const core::TrialKey& key) {
    const std::size_t cell = index % table_.size();
    return CellRecord(index, cell, table_.Values(cell), Measure(cell, key));
  });
}

}  // namespace rockyard::experiments
