// The true path, tilt, articulation and clearance of a drive, and its belief held against the
// truth: the observer of a drive fills columns of the record by them, and missions those of a sol.
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "math/pose.h"
#include "messages/estimates.h"
#include "terrain/terrain.h"
#include "truth/drive_record.h"
#include "truth/rover_state.h"

namespace rockyard::trial {

// The belly as nine points of a rectangle in R, for the clearance over rocks.
struct Underside {
  double centre_x_m = 0.0;
  double half_length_m = 0.0;
  double half_width_m = 0.0;
  double height_m = 0.0;
};

// Path length counts chords of kChord_m between horizontal positions, so that the jitter of a rover
// at work (turning, rocking over a stone) does not add up to travel. The overhead tracker of
// Matthies 1995 sec. 3 resolves 0.3 mm at 15 Hz, 1 cm at the speed of Rocky 3.2. Records depend on
// the chord: true_distance_m of every drive, and with it rates, patience and errors of odometry.
class DriveMonitor {
 public:
  static constexpr double kChord_m = 0.01;

  DriveMonitor(const Underside& underside, const terrain::Terrain& terrain);

  // Starts, or starts again after operators moved the rover by hand: what they moved does not
  // count.
  void Restart(const truth::RoverState& state);

  // Takes the state after one control tick. `turning`: the rover turns in place by itself.
  void Observe(const truth::RoverState& state, bool turning);

  double distance_m() const { return distance_m_; }
  double turned_in_place_rad() const { return turned_rad_; }
  double max_sinkage_m() const { return max_sinkage_m_; }

  // Fills the columns of true path and displacement, tilt, articulation, clearance and sinkage.
  void Report(truth::DriveRecord& record) const;

 private:
  double OpenChord() const;  // from the last counted position to the present one, m
  void ObserveClearance(const math::Transform& X_WR);

  std::array<math::Vector3, 9> belly_R_;  // points of the belly
  const terrain::Terrain& terrain_;
  math::Transform last_X_WR_ = math::Transform::Identity();
  std::optional<std::pair<double, double>> start_m_;  // x, y
  double chord_x_m_ = 0.0;
  double chord_y_m_ = 0.0;
  double distance_m_ = 0.0;
  double turned_rad_ = 0.0;
  double min_tilt_cosine_ = 1.0;
  double max_bogie_rad_ = 0.0;
  double max_rocker_rad_ = 0.0;
  double max_roll_sine_ = 0.0;
  double max_pitch_sine_ = 0.0;
  double min_clearance_m_;
  double max_sinkage_m_ = 0.0;
};

// What the rover believes of its own error, held against the truth.
struct Belief {
  double position_sd_m = 0.0;  // root of the summed variances of x and y
  double heading_sd_rad = 0.0;
  double nees = 0.0;       // e' P^-1 e of x, y, heading: chi-squared, 3 degrees of freedom
  bool inside_95 = false;  // nees is at most the 95 % quantile of that distribution
};

// Returns the believed pose in W.
const messages::PoseEstimate& WorldPose(const messages::LocalizationEstimate& estimate);

// Returns the belief in W. Nothing where the estimate has no covariance, or one that is not
// positive definite: an oracle's, or that of a rover that has not moved.
std::optional<Belief> BeliefOf(const messages::LocalizationEstimate& estimate,
                               const math::Pose2& truth_W);

// Returns the belief in the frame in which goals are told; `truth` is the true pose in that frame.
// Nothing where BeliefOf has nothing.
std::optional<Belief> GoalFrameBeliefOf(const messages::LocalizationEstimate& estimate,
                                        const math::Pose2& truth);

}  // namespace rockyard::trial
