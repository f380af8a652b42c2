#include "experiments/visual_motion/visual_motion.h"

#include <numbers>
#include <string>

#include "core/random.h"
#include "experiments/look_factors.h"
#include "math/angles.h"
#include "math/decompositions.h"
#include "math/functions.h"

namespace rockyard::experiments {
namespace {

using math::Transform;

// Must agree with the meaning of the column "wrong" (ForEachColumn).
constexpr double kWrongSigma = 6.0;
constexpr double kWrong_m = 0.05;
constexpr double kWrong_rad = 2.0 * std::numbers::pi / 180.0;

// Returns the pose at the end of an arc of a length and a turn from the origin along x. The chord
// leads in the direction of half the turn.
Transform Arc(double way_m, double turn_rad) {
  const double half = 0.5 * turn_rad;
  const double chord_m = half == 0.0 ? way_m : way_m * math::Sin(half) / half;
  return math::MakePose({chord_m * math::Cos(half), chord_m * math::Sin(half), 0.0}, turn_rad, 0.0,
                        0.0);
}

// Returns a step from the level pose `level`. Draws from (key, kExperiment), substream 1: substream
// 0 is RandomPlace's. Records depend on the order: side, two tilts (roll, then
// pitch), errors of way and turn.
StudiedStep DrawStep(const VisualMotionStudyParams& params, const Transform& level, double way_m,
                     double turn_rad, core::TrialKey key) {
  core::RandomStream stream(key, core::Purpose::kExperiment, 1);
  const auto normal = [&] { return core::SampleNormal(stream, 0.0, 1.0); };
  const auto tilted = [&] {
    const double roll_rad = params.tilt_sd_rad * normal();
    const double pitch_rad = params.tilt_sd_rad * normal();
    return math::MakePose(math::Vector3::Zero(), 0.0, pitch_rad, roll_rad);
  };
  const double side = core::SampleBernoulli(stream, 0.5) ? 1.0 : -1.0;
  const Transform first = tilted();
  const Transform second = tilted();
  const double way_error = params.prediction_error * normal();
  const double turn_error = params.prediction_error * normal();
  StudiedStep step;
  step.X_WF = level * first;
  step.X_WS = level * Arc(way_m, side * turn_rad) * second;
  step.predicted_FS = first.inverse() *
                      Arc(way_m * (1.0 + way_error), side * turn_rad * (1.0 + turn_error)) * second;
  return step;
}

}  // namespace

const truth::RecordSchema& VisualMotionColumns() {
  using enum truth::ColumnRole;
  static const truth::RecordSchema kColumns = ColumnsOf<VisualSums>({
      {"step_m", "m", "length of the way", kFactor},
      {"turn_deg", "deg", "turn, to either side", kFactor},
      {"soil_graininess", "1", "of sensors.look", kFactor},
      {"sun_elevation_deg", "deg", "of sensors.sun", kFactor},
      {"baseline_m", "m", "of sensors.stereo", kFactor},
  });
  return kColumns;
}

void AddStep(const StudiedStep& step, const vision::MotionResult& seen, VisualSums& sums) {
  sums.steps += 1.0;
  sums.matches += static_cast<double>(seen.counts.matches);
  sums.points += static_cast<double>(seen.counts.points);
  sums.consistent += static_cast<double>(seen.counts.consistent);
  if (!seen.motion) return;
  sums.found += 1.0;
  const Transform truth = step.X_WF.inverse() * step.X_WS;
  const math::Vector3 way_m = seen.motion->X_FS.translation() - truth.translation();
  const math::Vector3 turn_rad =
      math::TurnOf(seen.motion->X_FS.linear() * truth.linear().transpose()).Vector_rad();
  math::Vector6 error;
  error << way_m, turn_rad;
  const double nees = error.dot(math::SolveSymmetric(seen.motion->covariance, error));
  sums.nees += nees;
  sums.position_m += way_m.norm();
  // An error of kWrongSigma standard deviations in all six coordinates has e' P^-1 e = 6
  // kWrongSigma^2; 6 is the average.
  const bool far = way_m.norm() > kWrong_m || turn_rad.norm() > kWrong_rad;
  if (far && nees > 6.0 * kWrongSigma * kWrongSigma) sums.wrong += 1.0;
  sums.along_m.Add(way_m.x());
  sums.across_m.Add(way_m.y());
  sums.up_m.Add(way_m.z());
  sums.roll_deg.Add(math::RadToDeg(turn_rad.x()));
  sums.pitch_deg.Add(math::RadToDeg(turn_rad.y()));
  sums.heading_deg.Add(math::RadToDeg(turn_rad.z()));
}

VisualMotionExperiment::VisualMotionExperiment(const VisualMotionStudyParams& params,
                                               const trial::DriveParams& drive)
    : CellExperiment(params.Factors(), VisualMotionColumns()), params_(params) {
  for (std::size_t i = 0; i < table().size(); ++i) {
    drives_.push_back(WithLookFactors(drive, table().columns(), table().Values(i)));
  }
}

std::vector<double> VisualMotionExperiment::Measure(std::size_t cell, core::TrialKey key) const {
  const trial::DriveParams& drive = drives_[cell];
  const std::vector<double> factors = table().Values(cell);
  VisualSums sums;
  for (std::int64_t i = 0; i < params_.steps_per_run; ++i) {
    const core::TrialKey scene = SceneKey(key, params_.steps_per_run, i);
    const terrain::Terrain terrain = SceneTerrainOf(drive, scene);
    const Transform level = RandomPlace(drive, terrain, params_.hazard_height_m, scene);
    const StudiedStep step =
        DrawStep(params_, level, factors[0], math::DegToRad(factors[1]), scene);
    trial::RoverCameras cameras(drive, scene);
    trial::VisualEyes eyes(drive, scene, terrain, cameras);
    trial::VisualReader odometry(drive, scene);
    odometry.Read(eyes.Look(step.X_WF), Transform::Identity());
    AddStep(step, odometry.Read(eyes.Look(step.X_WS), step.predicted_FS).result, sums);
  }
  return ValuesOf(sums);
}

}  // namespace rockyard::experiments
