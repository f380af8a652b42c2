// An estimator of a rover that drives along x: as much of a filter as it takes to be corrected by
// aids that are late. Its variance grows by q a metre.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "core/fields.h"
#include "localization/cloned_covariance.h"
#include "localization/estimator.h"
#include "localization/estimator_set_params.h"

namespace rockyard::localization {

struct ToyParams {
  double variance_m = 0.01;  // m2 a metre

  void Visit(core::FieldVisitor& v) {
    v.Real("variance_m", variance_m, core::Assumed("variance that a metre adds, m2", {}, {0, 1}));
  }
};

class ToyEstimator final : public Estimator {
 public:
  ToyEstimator(const ToyParams& params, const EstimatorSetup& setup)
      : params_(params), radius_m_(setup.calibration.wheel_radius_m) {
    Place({setup.start.x_m, setup.start.y_m, setup.start.heading_rad});
  }

  void Propagate(const messages::MotionMeasurement& motion) override {
    const double step_m = motion.wheel_turn_rad[0] * radius_m_;
    estimate_.pose.x_m += step_m;
    estimate_.pose.distance_m += step_m;
    estimate_.odometry.x_m += step_m;
    estimate_.odometry.distance_m += step_m;
    errors_.Propagate(One(1.0), One(params_.variance_m * step_m));
    Tell();
  }
  void Feel(const messages::VehicleState& /*felt*/, double /*duration_s*/) override {}
  void Place(const messages::PoseUpdate& update) override {
    estimate_.pose.x_m = update.x_m;
    estimate_.pose.y_m = update.y_m;
    estimate_.pose.heading_rad = update.heading_rad;
    estimate_.odometry = estimate_.pose;
    errors_ = ClonedCovariance(One(0.0));
    kept_x_m_.clear();
    Tell();
  }

  void Capture(messages::CaptureNumber capture) override {
    errors_.Clone(capture);
    kept_x_m_[capture] = estimate_.pose.x_m;
  }
  void Forget(messages::CaptureNumber capture) override {
    errors_.Forget(capture);
    kept_x_m_.erase(capture);
  }

  AidUse Update(const messages::PoseFix& fix) override {
    if (!fix.measured[kX]) return AidUse::kNoInterest;
    if (!errors_.Has(fix.capture)) return AidUse::kUnknown;
    return Take({{fix.capture, One(1.0)}}, fix.pose[kX] - kept_x_m_[fix.capture],
                fix.covariance(kX, kX));
  }
  AidUse Update(const messages::RelativeMotion& motion) override {
    if (!errors_.Has(motion.from) || !errors_.Has(motion.to)) return AidUse::kUnknown;
    return Take({{motion.from, One(-1.0)}, {motion.to, One(1.0)}},
                motion.motion_F[kX] - (kept_x_m_[motion.to] - kept_x_m_[motion.from]),
                motion.covariance(kX, kX));
  }

  const messages::LocalizationEstimate& estimate() const override { return estimate_; }

 private:
  static constexpr int kX = messages::Index(messages::PoseCoordinate::kX);

  static Eigen::MatrixXd One(double value) { return Eigen::MatrixXd::Constant(1, 1, value); }

  AidUse Take(const std::vector<ClonedCovariance::Part>& parts, double residual, double noise) {
    constexpr double kGate = 25.0;  // five standard deviations
    if (errors_.MahalanobisSquared(parts, One(residual), One(noise)) > kGate) {
      return AidUse::kGatedOut;
    }
    const auto correction = errors_.Update(parts, One(residual), One(noise));
    estimate_.pose.x_m += correction.changes(0, 0);
    Eigen::Index column = 1;
    for (const std::int64_t clone : errors_.clones()) {
      kept_x_m_[clone] += correction.changes(0, column++);
    }
    Tell();
    return AidUse::kUsed;
  }

  void Tell() {
    estimate_.covariance = messages::PoseCovariance::Zero();
    (*estimate_.covariance)(kX, kX) = errors_.now()(0, 0);
  }

  ToyParams params_;
  double radius_m_;
  ClonedCovariance errors_{One(0.0)};
  std::map<messages::CaptureNumber, double> kept_x_m_;
  messages::LocalizationEstimate estimate_;
};

inline EstimatorDescription<ToyParams> DescribeToy(std::string_view name = "toy") {
  return {.name = name,
          .doc = "drives along x",
          .make = [](const ToyParams& params,
                     const EstimatorSetup& setup) -> std::unique_ptr<Estimator> {
            return std::make_unique<ToyEstimator>(params, setup);
          }};
}

}  // namespace rockyard::localization
