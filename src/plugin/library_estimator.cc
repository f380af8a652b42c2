#include "plugin/library_estimator.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "navigation/navigator_fault.h"

namespace rockyard::plugin {
namespace {

using localization::AidUse;
using navigation::FaultKind;
using navigation::NavigatorFault;

rockyard_motion Motion(const messages::MotionMeasurement& from) {
  rockyard_motion to{};
  to.duration_s = from.duration_s;
  std::copy(from.wheel_turn_rad.begin(), from.wheel_turn_rad.end(), to.wheel_turn_rad);
  std::copy(from.steer_rad.begin(), from.steer_rad.end(), to.steer_rad);
  to.turn_rad = from.turn_rad;
  return to;
}

rockyard_fix Fix(const messages::PoseFix& from) {
  rockyard_fix to{};
  to.capture = from.capture;
  for (std::size_t i = 0; i < messages::kPoseCoordinates; ++i) {
    to.measured[i] = from.measured[i] ? 1 : 0;
  }
  std::copy_n(from.pose.data(), from.pose.size(), to.pose);
  std::copy_n(from.covariance.data(), from.covariance.size(), to.covariance);
  to.in_lander_frame = from.in_lander_frame ? 1 : 0;
  return to;
}

rockyard_relative_motion Relative(const messages::RelativeMotion& from) {
  rockyard_relative_motion to{};
  to.from = from.from;
  to.to = from.to;
  std::copy_n(from.motion_F.data(), from.motion_F.size(), to.motion_F);
  std::copy_n(from.covariance.data(), from.covariance.size(), to.covariance);
  return to;
}

rockyard_memory Memory(const localization::EstimatorMemory& from) {
  rockyard_memory to{};
  to.x_m = from.pose.x_m;
  to.y_m = from.pose.y_m;
  to.heading_rad = from.pose.heading_rad;
  to.gyro_scale = from.gyro_scale;
  to.wheel_scale = from.wheel_scale;
  to.pan_rad = from.pan_rad;
  to.has_covariance = from.covariance ? 1 : 0;
  if (from.covariance) {
    std::copy_n(from.covariance->data(), from.covariance->size(), to.covariance);
  }
  return to;
}

messages::PoseEstimate Pose(const rockyard_pose& from) {
  return {from.x_m, from.y_m, from.heading_rad, from.distance_m};
}

// Throws where one of the numbers is none; `name_of(place)` names it. At every tick, so that the
// sum is looked at first.
template <typename NameOf>
void RequireFinite(const LibraryCalls& calls, std::span<const double> numbers,
                   const NameOf& name_of) {
  double sum = 0.0;
  for (const double each : numbers) sum += 0.0 * each;
  if (sum == 0.0) return;
  const auto wrong =
      std::ranges::find_if(numbers, [](double each) { return !std::isfinite(each); });
  const auto place = static_cast<std::size_t>(wrong - numbers.begin());
  throw NavigatorFault(FaultKind::kNonsense,
                       fmt::format("{}{} is {}", calls.who(), name_of(place), *wrong));
}

void RequirePose(const LibraryCalls& calls, const char* prefix, const rockyard_pose& pose) {
  RequireFinite(calls, std::array{pose.x_m, pose.y_m, pose.heading_rad, pose.distance_m},
                [&](std::size_t place) {
                  constexpr std::array kNames{"x_m", "y_m", "heading_rad", "distance_m"};
                  return fmt::format("{}.{}", prefix, kNames[place]);
                });
}

void RequireCovariance(const LibraryCalls& calls, const char* prefix,
                       std::span<const double> covariance) {
  RequireFinite(calls, covariance, [&](std::size_t place) {
    constexpr std::array kNames{"x", "y", "z", "roll", "pitch", "heading"};
    return fmt::format("{} of {} and {}", prefix, kNames[place % kNames.size()],
                       kNames[place / kNames.size()]);
  });
}

// One estimator of a library. It keeps what the library believes, so that to look at it asks
// nobody, also after a failure.
class LibraryEstimator final : public localization::Estimator {
 public:
  LibraryEstimator(const rockyard_estimator_type& type, const Description& description,
                   const localization::EstimatorSetup& setup)
      : calls_(fmt::format("estimator {}: ", description.name), setup.call_cpu_s,
               setup.drive_cpu_s),
        type_(type),
        own_values_(description.own_values.size()) {}
  ~LibraryEstimator() override {
    if (estimator_ != nullptr) type_.destroy(estimator_);
  }
  LibraryEstimator(const LibraryEstimator&) = delete;
  LibraryEstimator& operator=(const LibraryEstimator&) = delete;

  void Begin(const Parameters& parameters, const localization::EstimatorSetup& setup) {
    const AbiValues values(parameters);
    rockyard_estimator_setup to{};
    WriteWheels(setup.calibration, to);
    to.distance_scale = setup.dead_reckoning.distance_scale;
    to.wheels = static_cast<std::int32_t>(setup.dead_reckoning.wheels);
    to.step_heading = static_cast<std::int32_t>(setup.dead_reckoning.step_heading);
    to.attitude_source = static_cast<std::int32_t>(setup.attitude.source);
    to.height = static_cast<std::int32_t>(setup.attitude.height);
    to.attitude_filter_s = setup.attitude.filter_s;
    to.start_x_m = setup.start.x_m;
    to.start_y_m = setup.start.y_m;
    to.start_heading_rad = setup.start.heading_rad;
    rockyard_lander lander{};
    if (setup.lander) {
      lander = {setup.lander->x_m, setup.lander->y_m, setup.lander->pan_sd_rad};
      to.lander = &lander;
    }
    rockyard_memory memory{};
    if (setup.memory != nullptr) {
      memory = Memory(*setup.memory);
      to.memory = &memory;
    }
    calls_.Call(
        [&](rockyard_error* error) { return type_.create(values.get(), &to, &estimator_, error); });
    if (estimator_ == nullptr) {
      throw NavigatorFault(FaultKind::kThrew, calls_.who() + "it made no estimator");
    }
    Tell([](rockyard_error*) { return 0; });
  }

  void Propagate(const messages::MotionMeasurement& motion) override {
    const rockyard_motion to = Motion(motion);
    Tell([&](rockyard_error* error) { return type_.propagate(estimator_, &to, error); });
  }
  void Feel(const messages::VehicleState& felt, double duration_s) override {
    const AbiFelt to(felt);
    Tell(
        [&](rockyard_error* error) { return type_.feel(estimator_, to.get(), duration_s, error); });
  }
  void Place(const messages::PoseUpdate& update) override {
    const rockyard_update to{update.x_m, update.y_m, update.heading_rad, update.mirrored ? 1 : 0};
    Tell([&](rockyard_error* error) { return type_.place(estimator_, &to, error); });
  }
  void Capture(messages::CaptureNumber capture) override {
    Tell([&](rockyard_error* error) { return type_.capture(estimator_, capture, error); });
  }
  void Forget(messages::CaptureNumber capture) override {
    Tell([&](rockyard_error* error) { return type_.forget(estimator_, capture, error); });
  }
  AidUse Update(const messages::PoseFix& fix) override {
    const rockyard_fix to = Fix(fix);
    std::int32_t use = 0;
    Tell([&](rockyard_error* error) { return type_.fix(estimator_, &to, &use, error); });
    return Use(use);
  }
  AidUse Update(const messages::RelativeMotion& motion) override {
    const rockyard_relative_motion to = Relative(motion);
    std::int32_t use = 0;
    Tell([&](rockyard_error* error) { return type_.motion(estimator_, &to, &use, error); });
    return Use(use);
  }

  const messages::LocalizationEstimate& estimate() const override { return estimate_; }

  localization::EstimatorMemory Remember() const override {
    rockyard_memory from{};
    calls_.Call([&](rockyard_error* error) { return type_.remember(estimator_, &from, error); });
    RequireFinite(calls_,
                  std::array{from.x_m, from.y_m, from.heading_rad, from.gyro_scale,
                             from.wheel_scale, from.pan_rad},
                  [](std::size_t place) {
                    constexpr std::array kNames{"pose.x_m",   "pose.y_m",    "pose.heading_rad",
                                                "gyro_scale", "wheel_scale", "pan_rad"};
                    return fmt::format("memory.{}", kNames[place]);
                  });
    localization::EstimatorMemory memory{.pose = {from.x_m, from.y_m, from.heading_rad},
                                         .covariance = std::nullopt,
                                         .gyro_scale = from.gyro_scale,
                                         .wheel_scale = from.wheel_scale,
                                         .pan_rad = from.pan_rad};
    if (from.has_covariance != 0) {
      RequireFinite(calls_, from.covariance, [](std::size_t place) {
        return fmt::format("memory.covariance, entry {},", place);
      });
      memory.covariance = Eigen::Map<const localization::ErrorMatrix>(from.covariance);
    }
    return memory;
  }

  std::span<const double> own_values() const override {
    values_.assign(own_values_, 0.0);
    if (own_values_ == 0) return values_;
    calls_.Call([&](rockyard_error* error) {
      return type_.own_values(estimator_, values_.data(), values_.size(), error);
    });
    return values_;
  }

 private:
  AidUse Use(std::int32_t use) const {
    if (use >= 0 && use <= static_cast<std::int32_t>(AidUse::kNoInterest)) {
      return static_cast<AidUse>(use);
    }
    throw NavigatorFault(FaultKind::kNonsense,
                         fmt::format("{}its use of an aid is {}", calls_.who(), use));
  }

  // Calls a function that may change what is believed, and takes what is believed then.
  template <typename Function>
  void Tell(const Function& function) {
    calls_.Call([&](rockyard_error* error) {
      const int result = function(error);
      return result != 0 ? result : type_.estimate(estimator_, &told_, error);
    });
    const rockyard_pose& pose = told_.pose;
    const rockyard_attitude& attitude = told_.attitude;
    const rockyard_pose& odometry = told_.odometry;
    RequirePose(calls_, "pose", pose);
    RequirePose(calls_, "odometry", odometry);
    RequireFinite(calls_, std::array{attitude.roll_rad, attitude.pitch_rad, attitude.z_m},
                  [](std::size_t place) {
                    constexpr std::array kNames{"roll_rad", "pitch_rad", "z_m"};
                    return fmt::format("attitude.{}", kNames[place]);
                  });
    if (told_.has_covariance != 0) RequireCovariance(calls_, "covariance", told_.covariance);
    if (told_.has_world != 0) {
      RequirePose(calls_, "world", told_.world);
      RequireCovariance(calls_, "covariance in the world", told_.world_covariance);
    }
    estimate_.pose = Pose(pose);
    estimate_.attitude = {attitude.roll_rad, attitude.pitch_rad, attitude.z_m};
    estimate_.odometry = Pose(odometry);
    estimate_.covariance.reset();
    estimate_.world.reset();
    using Covariance = Eigen::Map<const messages::PoseCovariance>;
    if (told_.has_covariance != 0) estimate_.covariance = Covariance(told_.covariance);
    if (told_.has_world != 0) {
      estimate_.world =
          messages::WorldEstimate{Pose(told_.world), Covariance(told_.world_covariance)};
    }
  }

  const LibraryCalls calls_;
  const rockyard_estimator_type& type_;
  const std::size_t own_values_;
  void* estimator_ = nullptr;
  rockyard_estimate told_{};
  messages::LocalizationEstimate estimate_;
  mutable std::vector<double> values_;
};

// One kind of estimators of a library.
class LibraryEstimatorSource final : public EstimatorSource {
 public:
  LibraryEstimatorSource(std::shared_ptr<const LoadedLibrary> library, std::size_t place,
                         std::unique_ptr<const Description> description)
      : EstimatorSource(library->file().string(), std::move(description)),
        library_(std::move(library)),
        place_(place) {}

  std::unique_ptr<localization::Estimator> Make(
      const Parameters& parameters, const localization::EstimatorSetup& setup) const override {
    auto estimator = std::make_unique<LibraryEstimator>(*library_->info().estimators[place_],
                                                        description(), setup);
    estimator->Begin(parameters, setup);
    return estimator;
  }

 protected:
  core::JsonValue AskProblems(const Parameters& parameters) const override {
    return AskOfParameters(*library_, parameters, [&](const rockyard_plugin_info& info) {
      return info.estimators[place_]->check;
    });
  }

 private:
  const std::shared_ptr<const LoadedLibrary> library_;
  const std::size_t place_;
};

}  // namespace

std::shared_ptr<const EstimatorSource> MakeLibraryEstimators(
    std::shared_ptr<const LoadedLibrary> library, std::size_t place,
    std::unique_ptr<const Description> description) {
  return std::make_shared<LibraryEstimatorSource>(std::move(library), place,
                                                  std::move(description));
}

}  // namespace rockyard::plugin
