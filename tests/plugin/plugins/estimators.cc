// Estimators for the tests of the layer and of its host, and a navigator beside them: `told` shows
// the last message as its own values and believes what its parameters say; `faulty` fails where its
// parameter says.
#include <array>
#include <cstdint>
#include <ctime>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "plugin/estimator_plugin.h"
#include "plugin/navigator_plugin.h"
#include "plugin/whole_estimator_messages.h"

namespace {

using namespace rockyard;
using core::Setting;
using localization::AidUse;
using localization::Estimator;
using localization::EstimatorDescription;
using localization::EstimatorSetup;

struct ToldParams {
  bool has_covariance = true;
  bool has_world = true;
  std::int64_t use = 1;  // AidUse
  double low = 1.0;
  double high = 2.0;

  void Visit(core::FieldVisitor& v) {
    v.Boolean("has_covariance", has_covariance, Setting("of what it believes"));
    v.Boolean("has_world", has_world, Setting("of what it believes"));
    v.Integer("use", use, Setting("what it makes of aids", {-1, 9}));
    v.Real("low", low, core::Assumed("lower end", "nobody knows", {0.0, 9.0}, {1.0, 3.0}));
    v.Real("high", high, Setting("upper end", {0.0, 9.0}));
    v.Require("low", low <= high, "is above high", "use less");
  }
};

class Told final : public Estimator {
 public:
  Told(const ToldParams& params, const EstimatorSetup& setup)
      : params_(params), memory_(setup.memory), told_(plugin::NumbersOf(setup)) {
    estimate_ = plugin::WholeEstimate();
    if (!params.has_covariance) estimate_.covariance.reset();
    if (!params.has_world) estimate_.world.reset();
  }

  void Propagate(const messages::MotionMeasurement& motion) override {
    told_ = plugin::NumbersOf(motion);
    estimate_.pose.x_m += 1.0;
  }
  void Feel(const messages::VehicleState& felt, double duration_s) override {
    told_ = plugin::NumbersOf(felt, duration_s);
  }
  void Place(const messages::PoseUpdate& update) override { told_ = plugin::NumbersOf(update); }
  void Capture(messages::CaptureNumber capture) override { told_ = plugin::NumbersOf(1, capture); }
  void Forget(messages::CaptureNumber capture) override { told_ = plugin::NumbersOf(2, capture); }
  AidUse Update(const messages::PoseFix& fix) override {
    told_ = plugin::NumbersOf(fix);
    return static_cast<AidUse>(params_.use);
  }
  AidUse Update(const messages::RelativeMotion& motion) override {
    told_ = plugin::NumbersOf(motion);
    return static_cast<AidUse>(params_.use);
  }
  const messages::LocalizationEstimate& estimate() const override { return estimate_; }
  localization::EstimatorMemory Remember() const override {
    return memory_ != nullptr ? *memory_ : Estimator::Remember();
  }
  std::span<const double> own_values() const override { return told_; }

 private:
  ToldParams params_;
  const localization::EstimatorMemory* memory_;  // which is there as long as it
  plugin::Numbers told_;
  messages::LocalizationEstimate estimate_;
};

EstimatorDescription<ToldParams> DescribeTold() {
  EstimatorDescription<ToldParams> description;
  description.name = "told";
  description.doc = "tells what it is told";
  description.make = [](const ToldParams& params,
                        const EstimatorSetup& setup) -> std::unique_ptr<Estimator> {
    return std::make_unique<Told>(params, setup);
  };
  description.takes_fixes = true;
  for (std::size_t i = 0; i < plugin::kShownNumbers; ++i) {
    description.own_values.push_back({"v" + std::to_string(i), "1", "a number that it was told"});
  }
  return description;
}

enum class Fault {
  kNone,
  kMaking,
  kMakesNone,
  kPropagating,
  kFeeling,
  kPlacing,
  kCapturing,
  kForgetting,
  kFixing,
  kSeeing,
  kRemembering,
  kCounting,
  kCountsTooFew,
  kThrowsAnything,
  kNoNumber,
  kInfiniteVariance,
  kNoWorld,
  kRemembersNoNumber,
  kComputes,
};

}  // namespace

template <>
struct rockyard::core::EnumNames<Fault> {
  static constexpr std::array<std::string_view, 19> kNames{"none",           "making",
                                                           "makes_none",     "propagating",
                                                           "feeling",        "placing",
                                                           "capturing",      "forgetting",
                                                           "fixing",         "seeing",
                                                           "remembering",    "counting",
                                                           "counts_too_few", "throws_anything",
                                                           "no_number",      "infinite_variance",
                                                           "no_world",       "remembers_no_number",
                                                           "computes"};
};

namespace {

struct FaultyParams {
  Fault fault = Fault::kNone;

  void Visit(core::FieldVisitor& v) { v.Choice("fault", fault, Setting("how it fails")); }
};

// Some 50 ms of the thread's own time.
void Compute() {
  const auto now_s = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double end_s = now_s() + 0.05;
  while (now_s() < end_s) {
  }
}

class Faulty final : public Estimator {
 public:
  explicit Faulty(Fault fault) : fault_(fault) { FailAt(Fault::kMaking); }

  void Propagate(const messages::MotionMeasurement&) override {
    FailAt(Fault::kPropagating);
    if (fault_ == Fault::kThrowsAnything) throw 7;
    if (fault_ == Fault::kComputes) Compute();
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (fault_ == Fault::kNoNumber) estimate_.attitude.pitch_rad = kNone;
    if (fault_ == Fault::kInfiniteVariance) {
      estimate_.covariance = messages::PoseCovariance::Identity();
      (*estimate_.covariance)(2, 1) = std::numeric_limits<double>::infinity();
    }
    if (fault_ == Fault::kNoWorld)
      estimate_.world = messages::WorldEstimate{{kNone, 0.0, 0.0, 0.0}};
    estimate_.pose.x_m = 8.5;
  }
  void Feel(const messages::VehicleState&, double) override { FailAt(Fault::kFeeling); }
  void Place(const messages::PoseUpdate&) override { FailAt(Fault::kPlacing); }
  void Capture(messages::CaptureNumber) override { FailAt(Fault::kCapturing); }
  void Forget(messages::CaptureNumber) override { FailAt(Fault::kForgetting); }
  AidUse Update(const messages::PoseFix&) override {
    FailAt(Fault::kFixing);
    return AidUse::kUsed;
  }
  AidUse Update(const messages::RelativeMotion&) override {
    FailAt(Fault::kSeeing);
    return AidUse::kUsed;
  }
  const messages::LocalizationEstimate& estimate() const override { return estimate_; }
  localization::EstimatorMemory Remember() const override {
    FailAt(Fault::kRemembering);
    localization::EstimatorMemory memory = Estimator::Remember();
    if (fault_ == Fault::kRemembersNoNumber) {
      memory.gyro_scale = std::numeric_limits<double>::quiet_NaN();
    }
    return memory;
  }
  std::span<const double> own_values() const override {
    FailAt(Fault::kCounting);
    if (fault_ == Fault::kCountsTooFew) return {};
    return own_;
  }

 private:
  void FailAt(Fault place) const {
    if (fault_ == place) throw std::runtime_error("no way out of here");
  }

  Fault fault_;
  messages::LocalizationEstimate estimate_;
  std::array<double, 1> own_{3.5};
};

EstimatorDescription<FaultyParams> DescribeFaulty() {
  EstimatorDescription<FaultyParams> description;
  description.name = "faulty";
  description.doc = "fails";
  description.make = [](const FaultyParams& params,
                        const EstimatorSetup&) -> std::unique_ptr<Estimator> {
    if (params.fault == Fault::kMakesNone) return nullptr;
    return std::make_unique<Faulty>(params.fault);
  };
  description.takes_motions = true;
  description.own_values = {{"first", "1", "the one that it has"}};
  return description;
}

class Idle final : public navigation::Navigator {
 public:
  navigation::NavigatorDecision Decide(const navigation::NavigatorInput&) override { return {}; }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, navigation::GoalChange) override {}
};

navigation::NavigatorDescription<core::NoParams> DescribeIdle() {
  navigation::NavigatorDescription<core::NoParams> description;
  description.name = "idle";
  description.doc = "stands";
  description.traits = [](const core::NoParams&) -> navigation::NavigatorTraits {
    return {navigation::LookReading::kNothing, navigation::CostOfLook{}, {"", 0.25}};
  };
  description.make = [](const core::NoParams&, const navigation::NavigatorSetup&)
      -> std::unique_ptr<navigation::Navigator> { return std::make_unique<Idle>(); };
  return description;
}

}  // namespace

ROCKYARD_PLUGIN(DescribeTold, DescribeIdle, DescribeFaulty)
