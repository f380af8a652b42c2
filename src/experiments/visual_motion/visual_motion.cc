#include "experiments/visual_motion/visual_motion.h"

#include <cmath>
#include <numbers>
#include <string>

#include "core/random.h"
#include "experiments/look_factors.h"
#include "experiments/record_of.h"
#include "math/angles.h"
#include "math/decompositions.h"

namespace rockyard::experiments {
namespace {

using enum truth::ColumnRole;

truth::RecordSchema MakeVisualColumns() {
  truth::RecordSchema columns{
      {"step_m", "m", "length of the way", kFactor},
      {"turn_deg", "deg", "turn, to either side", kFactor},
      {"soil_graininess", "1", "of sensors.look", kFactor},
      {"sun_elevation_deg", "deg", "of sensors.sun", kFactor},
      {"baseline_m", "m", "of sensors.stereo", kFactor},
      {"steps", "1", "motions, each at a place of its own", kTrials},
      {"found", "1", "of these, with a motion", kMainCount, "steps"},
      {"wrong", "1",
       "of these, off by more than 6 standard deviations of their own statement and more than 5 cm "
       "or 2 deg",
       kCount, "found"},
      {"matches", "1", "features of two left images that look alike", kSum, "steps"},
      {"points", "1", "of these, with a place at both moments", kSum, "steps"},
      {"consistent", "1", "of these, moved as one", kSum, "steps"},
      {"nees", "1",
       "squared error in units of the stated covariance: 6 on average where that is right", kSum,
       "found"},
      {"position_m", "m", "length of the error of the way", kSum, "found"},
  };
  const auto add = [&](const std::string& name, const std::string& unit,
                       const std::string& meaning) {
    columns.push_back({name + "_bias_" + unit, unit, meaning, kSum, "found"});
    columns.push_back({name + "_error_" + unit, unit, meaning, kSquares, "found"});
  };
  add("along", "m", "measured less true way, along x of the first rover frame");
  add("across", "m", "along y");
  add("up", "m", "along z");
  add("roll", "deg", "measured less true turn, about x of the first rover frame");
  add("pitch", "deg", "about y");
  add("heading", "deg", "about z");
  return columns;
}

using math::Transform;

constexpr double kWrongSigma = 6.0;
constexpr double kWrong_m = 0.05;
constexpr double kWrong_rad = 2.0 * std::numbers::pi / 180.0;

// An arc of a length and a turn, from the middle of its chord's direction.
Transform Arc(double way_m, double turn_rad) {
  const double half = 0.5 * turn_rad;
  const double chord_m = half == 0.0 ? way_m : way_m * std::sin(half) / half;
  return math::MakePose({chord_m * std::cos(half), chord_m * std::sin(half), 0.0}, turn_rad, 0.0,
                        0.0);
}

// Draws from (key, kExperiment), substream 1: 0 is the place's.
StudiedStep DrawStep(const VisualMotionStudyParams& params, const Transform& level, double way_m,
                     double turn_rad, core::TrialKey key) {
  core::RandomStream stream(key, core::Purpose::kExperiment, 1);
  const auto normal = [&] { return core::SampleNormal(stream, 0.0, 1.0); };
  const auto tilted = [&] {
    return math::MakePose(math::Vector3::Zero(), 0.0, params.tilt_sd_rad * normal(),
                          params.tilt_sd_rad * normal());
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
  static const truth::RecordSchema kColumns = MakeVisualColumns();
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
  const Eigen::AngleAxisd turned(seen.motion->X_FS.linear() * truth.linear().transpose());
  const math::Vector3 way_m = seen.motion->X_FS.translation() - truth.translation();
  const math::Vector3 turn_rad = turned.angle() * turned.axis();
  math::Vector6 error;
  error << way_m, turn_rad;
  const double nees = error.dot(math::SolveSymmetric(seen.motion->covariance, error));
  sums.nees += nees;
  sums.position_m += way_m.norm();
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
    : params_(params),
      table_(params.Factors()),
      schema_(CellSchema<VisualSums>(VisualMotionColumns(), table_)) {
  for (std::size_t i = 0; i < table_.size(); ++i) {
    drives_.push_back(WithLookFactors(drive, table_.columns(), table_.Values(i)));
  }
}

VisualSums VisualMotionExperiment::Measure(std::size_t cell, core::TrialKey key) const {
  const trial::DriveParams& drive = drives_[cell];
  const std::vector<double> factors = table_.Values(cell);
  VisualSums sums;
  for (std::int64_t i = 0; i < params_.steps_per_run; ++i) {
    const core::TrialKey scene = SceneKey(key, params_.steps_per_run, i);
    const terrain::Terrain terrain = SceneTerrainOf(drive, scene);
    const Transform level = RandomPlace(drive, terrain, params_.hazard_height_m, scene);
    const StudiedStep step =
        DrawStep(params_, level, factors[0], math::DegToRad(factors[1]), scene);
    const auto eyes = trial::MakeVisualEyes(drive, scene, terrain);
    eyes->Look(step.X_WF, Transform::Identity());
    AddStep(step, eyes->Look(step.X_WS, step.predicted_FS).result, sums);
  }
  return sums;
}

truth::Record VisualMotionExperiment::Run(std::uint64_t seed, std::uint64_t index) const {
  return RecordOf(seed, index, [&](const core::TrialKey& key) {
    const std::size_t cell = index % table_.size();
    return CellRecord(index, cell, table_.Values(cell), Measure(cell, key));
  });
}

}  // namespace rockyard::experiments
