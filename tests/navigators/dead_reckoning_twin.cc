// rockyard's dead reckoning as a plugin: the same sources, so that a drive with it is that of the
// built-in one, bit for bit. Beside it, one that counts ticks, and fails where it is told to.
#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string_view>

#include "localization/dead_reckoning.h"
#include "plugin/estimator_plugin.h"

namespace {

namespace localization = rockyard::localization;
namespace messages = rockyard::messages;
namespace core = rockyard::core;

[[maybe_unused]] localization::EstimatorDescription<core::NoParams> DescribeTwin() {
  auto description = localization::DescribeDeadReckoning();
  description.name = "dead_reckoning_twin";
  return description;
}

enum class Fault { kNone, kThrows, kNoNumber, kCrashes, kHangs };

}  // namespace

template <>
struct rockyard::core::EnumNames<Fault> {
  static constexpr std::array<std::string_view, 5> kNames{"none", "throws", "no_number", "crashes",
                                                          "hangs"};
};

namespace {

struct CountingParams {
  double scale = 1.0;
  Fault fault = Fault::kNone;
  std::int64_t at_tick = 100;

  void Visit(core::FieldVisitor& v) {
    v.Real("scale", scale, core::Assumed("factor on turns of the wheels", "a test", {0.1, 2.0}));
    v.Choice("fault", fault, core::Setting("how it fails"));
    v.Integer("at_tick", at_tick, core::Setting("when it fails", {0, 1000000}));
  }
};

class Counting final : public localization::Estimator {
 public:
  Counting(const CountingParams& params, const localization::EstimatorSetup& setup)
      : params_(params), flown_(setup), estimate_(flown_.estimate()) {}

  void Propagate(const messages::MotionMeasurement& motion) override {
    ticks_[0] += 1.0;
    messages::MotionMeasurement scaled = motion;
    for (double& turn_rad : scaled.wheel_turn_rad) turn_rad *= params_.scale;
    flown_.Propagate(scaled);
    estimate_ = flown_.estimate();
    if (ticks_[0] == static_cast<double>(params_.at_tick)) Fail();
  }
  void Feel(const messages::VehicleState& felt, double duration_s) override {
    flown_.Feel(felt, duration_s);
    estimate_ = flown_.estimate();
  }
  void Place(const messages::PoseUpdate& update) override {
    flown_.Place(update);
    estimate_ = flown_.estimate();
  }
  const messages::LocalizationEstimate& estimate() const override { return estimate_; }
  std::span<const double> own_values() const override { return ticks_; }

 private:
  void Fail() {
    if (params_.fault == Fault::kThrows) throw std::runtime_error("lost its way");
    if (params_.fault == Fault::kCrashes) std::abort();
    if (params_.fault == Fault::kNoNumber) {
      estimate_.pose.heading_rad = std::numeric_limits<double>::quiet_NaN();
    }
    while (params_.fault == Fault::kHangs) {
      hung_ = hung_ + 1;
    }
  }

  CountingParams params_;
  localization::DeadReckoningEstimator flown_;
  messages::LocalizationEstimate estimate_;
  std::array<double, 1> ticks_{};
  volatile std::uint64_t hung_ = 0;
};

[[maybe_unused]] localization::EstimatorDescription<CountingParams> DescribeCounting() {
  return {.name = "counting",
          .doc = "dead reckoning that counts its ticks",
          .make = [](const CountingParams& params, const localization::EstimatorSetup& setup)
              -> std::unique_ptr<localization::Estimator> {
            return std::make_unique<Counting>(params, setup);
          },
          .own_values = {{"ticks", "1", "Ticks of wheels and gyro."}}};
}

}  // namespace

ROCKYARD_PLUGIN(ESTIMATORS)  // of CMakeLists.txt
