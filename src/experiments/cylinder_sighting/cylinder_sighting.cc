#include "experiments/cylinder_sighting/cylinder_sighting.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "core/random.h"
#include "experiments/cell_experiment.h"
#include "math/angles.h"
#include "math/functions.h"
#include "rendering/cylinder/colour_readout.h"
#include "rendering/cylinder/cylinder_renderer.h"
#include "vision/cylinder/published_finder.h"
#include "vision/cylinder/robust_finder.h"

namespace rockyard::experiments {
namespace {

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

// Returns the share of the image above the highest hills: three deviations above their mean, or the
// level line of sight where that is higher.
double SkyShare(const CylinderPictureParams& picture, const vision::Cahv& camera) {
  const rendering::BackdropParams& hills = picture.backdrop;
  const double height_m = hills.horizon_distance_m * math::Tan(hills.horizon_elevation_rad) +
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
  using enum truth::ColumnRole;
  static const truth::RecordSchema kColumns = ColumnsOf<SightingSums>({
      {"distance_m", "m", "from the cameras' centre of rotation along the ground", kFactor},
      {"orientation_deg", "deg", "theta: azimuth of the cameras in the cylinder's frame", kFactor},
      {"sun_elevation_deg", "deg", "of picture.light", kFactor},
      {"clutter_level", "1", "factor of the numbers of picture.clutter", kFactor},
      {"third_colour", "1", "0 orange, 1 green", kFactor},
  });
  return kColumns;
}

CylinderSightingExperiment::CylinderSightingExperiment(const CylinderSightingParams& params)
    : CellExperiment(params.Factors(), CylinderSightingColumns()), params_(params) {}

StudiedView CylinderSightingExperiment::Draw(std::size_t cell, core::TrialKey key) const {
  StudiedView studied{params_.picture, {}, params_.published, params_.robust};
  // Records depend on the order of the draws. Everything is drawn, also what a factor or a
  // parameter then replaces, so that the other numbers stay.
  core::RandomStream stream(key, core::Purpose::kExperiment);
  studied.view.present = params_.present;
  studied.view.orientation_rad = SampleUniform(stream, -std::numbers::pi, std::numbers::pi);
  const double azimuth_rad = SampleUniform(stream, -std::numbers::pi, std::numbers::pi);
  if (params_.any_sun_azimuth) studied.picture.light.azimuth_rad = azimuth_rad;
  studied.view.bearing_rad = params_.largest_bearing_rad * SampleUniform(stream, -1.0, 1.0);
  const double spread = params_.distance_spread * SampleUniform(stream, -1.0, 1.0);
  const std::vector<double> values = table().Values(cell);
  const std::vector<std::string_view> names = table().columns();
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

std::vector<double> CylinderSightingExperiment::Measure(std::size_t cell,
                                                        core::TrialKey key) const {
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
  return ValuesOf(sums);
}

namespace {

// Must agree with the meaning of the columns "..._wrong" (ForEachFinderColumn) and with
// JudgeSighting's.
constexpr double kWrongDeviations = 3.0;
constexpr double kWrongTurn_rad = math::DegToRad(10.0);
constexpr double kWrongShare = 0.10;

bool IsOff(double error, double deviation, double least) {
  return std::abs(error) > least && std::abs(error) > kWrongDeviations * deviation;
}

}  // namespace

void JudgeSighting(const CylinderTruth& truth, const vision::CylinderFinding& finding,
                   FinderSums& sums) {
  if (!finding.sighting) {
    sums.misses[static_cast<std::size_t>(finding.miss)] += 1.0;
    return;
  }
  const vision::CylinderSighting& seen = *finding.sighting;
  sums.found += 1.0;
  if (!truth.present) {
    sums.wrong += 1.0;
    return;
  }
  const double turn_rad = math::WrapAngle(seen.orientation_rad - truth.orientation_rad);
  const double true_range_m = truth.p_LT_L.head<2>().norm();
  const double range = seen.p_LT_L.head<2>().norm() / true_range_m - 1.0;
  const Eigen::Vector2d along = truth.p_LT_L.head<2>() / true_range_m;
  const double range_sd =
      std::sqrt(along.dot(seen.covariance.topLeftCorner<2, 2>() * along)) / true_range_m;
  sums.orientation_deg.Add(math::RadToDeg(turn_rad));
  sums.stereo.Add(seen.distance_by_stereo_m / truth.depth_m - 1.0);
  sums.size.Add(seen.distance_by_size_m / truth.depth_m - 1.0);
  if (IsOff(turn_rad, std::sqrt(seen.covariance(3, 3)), kWrongTurn_rad) ||
      IsOff(range, range_sd, kWrongShare)) {
    sums.wrong += 1.0;
    return;
  }
  sums.right += 1.0;
  sums.right_orientation_deg.Add(math::RadToDeg(turn_rad));
  sums.right_range.Add(range);
  const double bearing_rad = math::WrapAngle(math::Atan2(seen.p_LT_L.y(), seen.p_LT_L.x()) -
                                             math::Atan2(truth.p_LT_L.y(), truth.p_LT_L.x()));
  sums.right_bearing_mrad.Add(1e3 * bearing_rad);
  Eigen::Vector4d error;
  error << seen.p_LT_L - truth.p_LT_L, turn_rad;
  sums.nees += error.dot(seen.covariance.ldlt().solve(error));
}

}  // namespace rockyard::experiments
