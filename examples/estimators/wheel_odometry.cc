// An estimator in one file: wheels and gyro, and an account of its own of how far it may be off. It
// takes the poses that aids measure, each by its weight, and counts them. No bias, no late data:
// what a filter needs beyond this is in src/localization.
#include <array>
#include <cmath>
#include <memory>
#include <span>

#include "plugin/estimator_plugin.h"

namespace {

namespace core = rockyard::core;
namespace localization = rockyard::localization;
namespace math = rockyard::math;
namespace messages = rockyard::messages;

struct WheelOdometryParams {
  double way_scale = 1.0;
  double variance_m2_per_m = 0.02;

  void Visit(core::FieldVisitor& v) {
    v.Real("way_scale", way_scale,
           core::Assumed("way of the rover over what its wheels roll", "1 for wheels without slip",
                         {0.1, 2.0}, {0.8, 1.0}));
    v.Real("variance_m2_per_m", variance_m2_per_m,
           core::Assumed("variance of x and y that a metre adds", "14 cm after a metre, as on sand",
                         {0.0, 1.0}, {0.002, 0.1}));
  }
};

class WheelOdometry final : public localization::Estimator {
 public:
  WheelOdometry(const WheelOdometryParams& params, const localization::EstimatorSetup& setup)
      : params_(params), radius_m_(setup.calibration.wheel_radius_m) {
    Place({setup.start.x_m, setup.start.y_m, setup.start.heading_rad});
    estimate_.covariance = messages::PoseCovariance::Zero();
  }

  void Propagate(const messages::MotionMeasurement& motion) override {
    double rolled_rad = 0.0;
    for (const double turn_rad : motion.wheel_turn_rad) rolled_rad += turn_rad;
    const double way_m = params_.way_scale * radius_m_ * rolled_rad / messages::kWheelCount;
    // Aids move the pose and leave the odometry alone: maps and manoeuvres go by it.
    Advance(way_m, motion.turn_rad, estimate_.pose);
    Advance(way_m, motion.turn_rad, estimate_.odometry);
    for (const int row : {kX, kY}) {
      (*estimate_.covariance)(row, row) += params_.variance_m2_per_m * std::abs(way_m);
    }
  }

  void Feel(const messages::VehicleState&, double) override {}  // it takes the ground for level

  void Place(const messages::PoseUpdate& update) override {
    estimate_.pose.x_m = update.x_m;
    estimate_.pose.y_m = update.y_m;
    estimate_.pose.heading_rad = math::WrapAngle(update.heading_rad);
    estimate_.odometry = estimate_.pose;
    // Operators measured where it stands, unless they mirrored it: then its error is mirrored, too.
    if (!update.mirrored) estimate_.covariance = messages::PoseCovariance::Zero();
  }

  using Estimator::Update;  // of motions, which are of no interest
  // Takes a place as if it were measured now, though the rover went on since.
  localization::AidUse Update(const messages::PoseFix& fix) override {
    const bool place = fix.measured[kX] && fix.measured[kY];
    if (!place || fix.in_lander_frame) return localization::AidUse::kNoInterest;
    Correct(kX, fix, estimate_.pose.x_m);
    Correct(kY, fix, estimate_.pose.y_m);
    fixes_[0] += 1.0;
    return localization::AidUse::kUsed;
  }

  const messages::LocalizationEstimate& estimate() const override { return estimate_; }
  std::span<const double> own_values() const override { return fixes_; }

 private:
  static constexpr int kX = messages::Index(messages::PoseCoordinate::kX);
  static constexpr int kY = messages::Index(messages::PoseCoordinate::kY);

  static void Advance(double way_m, double turn_rad, messages::PoseEstimate& pose) {
    const double along_rad = pose.heading_rad + 0.5 * turn_rad;
    pose.x_m += way_m * std::cos(along_rad);
    pose.y_m += way_m * std::sin(along_rad);
    pose.heading_rad = math::WrapAngle(pose.heading_rad + turn_rad);
    pose.distance_m += std::abs(way_m);
  }

  void Correct(int row, const messages::PoseFix& fix, double& coordinate_m) {
    double& variance = (*estimate_.covariance)(row, row);
    if (variance <= 0.0) return;  // nothing was driven since it was put down
    const double weight = variance / (variance + fix.covariance(row, row));
    coordinate_m += weight * (fix.pose[row] - coordinate_m);
    variance *= 1.0 - weight;
  }

  WheelOdometryParams params_;
  double radius_m_;
  messages::LocalizationEstimate estimate_;
  std::array<double, 1> fixes_{};
};

localization::EstimatorDescription<WheelOdometryParams> DescribeWheelOdometry() {
  return {.name = "wheel_odometry",
          .doc = "wheels and gyro, corrected by measured places",
          .make = [](const WheelOdometryParams& params, const localization::EstimatorSetup& setup)
              -> std::unique_ptr<localization::Estimator> {
            return std::make_unique<WheelOdometry>(params, setup);
          },
          .takes_fixes = true,
          .own_values = {{"fixes", "1", "Places measured by aids that it used."}}};
}

}  // namespace

ROCKYARD_PLUGIN(DescribeWheelOdometry)
