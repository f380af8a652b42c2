#include "trial/drive_monitor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rockyard::trial {

DriveMonitor::DriveMonitor(const Underside& underside, const terrain::Terrain& terrain)
    : underside_(underside),
      terrain_(terrain),
      min_clearance_m_(std::numeric_limits<double>::infinity()) {}

void DriveMonitor::Restart(const truth::RoverState& state) {
  distance_m_ += OpenChord();
  last_ = math::ToPose2(state.X_WR);
  chord_x_m_ = last_.x_m;
  chord_y_m_ = last_.y_m;
  ObserveClearance(state);
}

double DriveMonitor::OpenChord() const {
  return std::hypot(last_.x_m - chord_x_m_, last_.y_m - chord_y_m_);
}

void DriveMonitor::Observe(const truth::RoverState& state, bool turning) {
  const math::Pose2 pose = math::ToPose2(state.X_WR);
  const double chord_m = std::hypot(pose.x_m - chord_x_m_, pose.y_m - chord_y_m_);
  if (chord_m >= kChord_m) {
    distance_m_ += chord_m;
    chord_x_m_ = pose.x_m;
    chord_y_m_ = pose.y_m;
  }
  if (turning) turned_rad_ += std::abs(math::WrapAngle(pose.heading_rad - last_.heading_rad));
  last_ = pose;
  max_tilt_rad_ = std::max(max_tilt_rad_, math::Tilt(state.X_WR));
  max_bogie_rad_ =
      std::max({max_bogie_rad_, std::abs(state.left_bogie_rad), std::abs(state.right_bogie_rad)});
  ObserveClearance(state);
}

void DriveMonitor::ObserveClearance(const truth::RoverState& state) {
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      const math::Vector3 p_W =
          state.X_WR * math::Vector3(underside_.centre_x_m + x * underside_.half_length_m,
                                     y * underside_.half_width_m, underside_.height_m);
      min_clearance_m_ = std::min(min_clearance_m_, p_W.z() - terrain_.Height(p_W.x(), p_W.y()));
    }
  }
}

void DriveMonitor::Report(truth::DriveRecord& record) const {
  record.true_distance_m = distance_m_ + OpenChord();
  record.turned_in_place_rad = turned_rad_;
  record.max_tilt_deg = math::RadToDeg(max_tilt_rad_);
  record.max_bogie_deg = math::RadToDeg(max_bogie_rad_);
  record.min_clearance_m = min_clearance_m_;
}

}  // namespace rockyard::trial
