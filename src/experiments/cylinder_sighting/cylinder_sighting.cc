#include "experiments/cylinder_sighting/cylinder_sighting.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "core/distributions.h"
#include "experiments/cylinder_sighting/columns.h"
#include "experiments/cylinder_sighting/judge_sighting.h"
#include "experiments/record_of.h"
#include "experiments/scene_key.h"
#include "math/angles.h"
#include "rendering/cylinder/colour_readout.h"
#include "rendering/cylinder/cylinder_renderer.h"
#include "truth/measurement_record.h"
#include "vision/cylinder/published_finder.h"
#include "vision/cylinder/robust_finder.h"

namespace rockyard::experiments {
namespace {

using core::SampleUniform;
using rendering::CylinderPictureParams;

truth::RecordSchema SchemaOfSightings(const CellTable& table) {
  std::vector<std::string> names;
  for (const std::string_view name : table.columns()) names.emplace_back(name);
  ForEachSum(SightingSums{}, [&](const std::string& name, double) { names.push_back(name); });
  const std::vector<std::string_view> views(names.begin(), names.end());
  return truth::MeasurementSchema(CylinderSightingColumns(), views);
}

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

CylinderSightingExperiment::CylinderSightingExperiment(const CylinderSightingParams& params)
    : params_(params), table_(params.Factors()), schema_(SchemaOfSightings(table_)) {}

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
    truth::Record record{index, truth::TrialOutcome::kMeasured, "", {static_cast<double>(cell)}};
    for (const double value : table_.Values(cell)) record.values.push_back(value);
    const SightingSums sums = Measure(cell, key);
    ForEachSum(sums, [&](const std::string&, double value) { record.values.push_back(value); });
    return record;
  });
}

}  // namespace rockyard::experiments
