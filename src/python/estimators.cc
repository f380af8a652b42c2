#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/fields.h"
#include "core/json_text.h"
#include "localization/estimator.h"
#include "navigation/navigator_fault.h"
#include "plugin/foreign_estimator.h"
#include "python/errors.h"
#include "python/held.h"
#include "python/parts.h"

namespace rockyard::python {
namespace {

namespace py = pybind11;
using localization::AidUse;
using navigation::FaultKind;
using navigation::NavigatorFault;

constexpr std::array<std::string_view, 5> kUses{"used", "gated_out", "used_in_doubt", "unknown",
                                                "no_interest"};

template <typename Enum>
std::string_view NameOf(Enum value) {
  return core::EnumNames<Enum>::kNames[static_cast<std::size_t>(value)];
}

py::object Optional(const std::optional<math::Vector3>& vector) {
  if (!vector) return py::none();
  return py::make_tuple(vector->x(), vector->y(), vector->z());
}

py::dict FeltToPython(const messages::VehicleState& felt) {
  py::dict dict;
  dict["articulation_rad"] = py::none();
  if (felt.articulation) {
    const messages::Articulation& joints = *felt.articulation;
    dict["articulation_rad"] = py::make_tuple(joints.left_rocker_rad, joints.right_rocker_rad,
                                              joints.left_bogie_rad, joints.right_bogie_rad);
  }
  dict["specific_force_R"] = Optional(felt.specific_force_R);
  dict["motor_current_A"] = felt.motor_current_A;
  dict["contact"] = felt.contact;
  return dict;
}

py::dict SetupToPython(const localization::EstimatorSetup& setup) {
  const messages::DriveCalibration& wheels = setup.calibration;
  py::dict dict;
  dict["wheel_radius_m"] = wheels.wheel_radius_m;
  dict["radius_ratio"] = wheels.radius_ratio;
  dict["wheel_x_m"] = wheels.wheel_x_m;
  dict["wheel_y_m"] = wheels.wheel_y_m;
  dict["steered"] = wheels.steered;
  const localization::DeadReckoningParams& reckoning = setup.dead_reckoning;
  dict["distance_scale"] = reckoning.distance_scale;
  dict["odometry_wheels"] = NameOf(reckoning.wheels);
  dict["step_heading"] = NameOf(reckoning.step_heading);
  dict["attitude_source"] = NameOf(setup.attitude.source);
  dict["attitude_filter_s"] = setup.attitude.filter_s;
  dict["height"] = NameOf(setup.attitude.height);
  dict["start"] = py::make_tuple(setup.start.x_m, setup.start.y_m, setup.start.heading_rad);
  dict["lander"] = py::none();
  if (setup.lander) {
    dict["lander"] = py::make_tuple(setup.lander->x_m, setup.lander->y_m, setup.lander->pan_sd_rad);
  }
  return dict;
}

// Something told that is not as rockyard.estimate() makes it.
class WrongShape : public std::runtime_error {
 public:
  explicit WrongShape(const std::string& what)
      : std::runtime_error("estimate() returns no " + what + ": use rockyard.estimate(...)") {}
};

// Something told that is no number.
class NoNumber : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Returns the numbers that Python told. Throws what is wrong with them.
template <std::size_t kCount>
std::array<double, kCount> Numbers(const py::handle& told, const char* what,
                                   const std::array<const char*, kCount>& names) {
  std::array<double, kCount> numbers{};
  try {
    numbers = told.cast<std::array<double, kCount>>();
  } catch (const py::cast_error&) {
    throw WrongShape(fmt::format("{} of {} numbers", what, kCount));
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    if (std::isfinite(numbers[i])) continue;
    throw NoNumber(fmt::format("{}.{} is {}", what, names[i], numbers[i]));
  }
  return numbers;
}

messages::PoseEstimate Pose(const py::handle& told, const char* what) {
  constexpr std::array kNames{"x_m", "y_m", "heading_rad", "distance_m"};
  const auto [x_m, y_m, heading_rad, distance_m] = Numbers(told, what, kNames);
  return {x_m, y_m, heading_rad, distance_m};
}

messages::PoseCovariance Covariance(const py::handle& told) {
  messages::PoseCovariance covariance;
  try {
    covariance = told.cast<messages::PoseCovariance>();
  } catch (const py::cast_error&) {
    throw WrongShape("covariance of 6 x 6 numbers");
  }
  if (!covariance.allFinite()) throw NoNumber("its covariance is not finite");
  return covariance;
}

// Calls Python, whose errors are faults of the estimator.
template <typename Call>
auto GuardedCall(const std::string& who, const Call& call) {
  const py::gil_scoped_acquire lock;
  try {
    return call();
  } catch (const py::error_already_set& error) {
    throw NavigatorFault(FaultKind::kThrew, who + TextOf(error));
  } catch (const py::cast_error& error) {
    throw NavigatorFault(FaultKind::kMessage, who + error.what());
  } catch (const WrongShape& error) {
    throw NavigatorFault(FaultKind::kMessage, who + error.what());
  } catch (const NoNumber& error) {
    throw NavigatorFault(FaultKind::kNonsense, who + error.what());
  }
}

// One estimator of a class in Python. It keeps what the object believes, as estimate() is asked
// from C++ far more often than that changes.
class PythonEstimator final : public localization::Estimator {
 public:
  PythonEstimator(const Held& make, const plugin::Description& description,
                  const plugin::Parameters& parameters, const localization::EstimatorSetup& setup)
      : who_(fmt::format("estimator {}: ", description.name)),
        own_values_(description.own_values.size()) {
    GuardedCall(who_, [&] {
      object_.Take(make.get()(core::CompactJson(parameters.ToJson()), SetupToPython(setup)));
      propagate_.Take(object_.get().attr("propagate"));
      tell_.Take(object_.get().attr("estimate"));
      feels_ = object_.get().attr("feels").cast<bool>();
      Believe();
    });
  }

  void Propagate(const messages::MotionMeasurement& motion) override {
    GuardedCall(who_, [&] {
      propagate_.get()(motion.duration_s, py::tuple(py::cast(motion.wheel_turn_rad)),
                       py::tuple(py::cast(motion.steer_rad)), motion.turn_rad);
      Believe();
    });
  }
  void Feel(const messages::VehicleState& felt, double duration_s) override {
    if (!feels_) return;
    GuardedCall(who_, [&] {
      object_.get().attr("feel")(FeltToPython(felt), duration_s);
      Believe();
    });
  }
  void Place(const messages::PoseUpdate& update) override {
    GuardedCall(who_, [&] {
      object_.get().attr("place")(update.x_m, update.y_m, update.heading_rad, update.mirrored);
      Believe();
    });
  }
  void Capture(messages::CaptureNumber capture) override {
    GuardedCall(who_, [&] { object_.get().attr("capture")(capture); });
  }
  void Forget(messages::CaptureNumber capture) override {
    GuardedCall(who_, [&] { object_.get().attr("forget")(capture); });
  }
  AidUse Update(const messages::PoseFix& fix) override {
    std::array<bool, messages::kPoseCoordinates> measured{};
    for (std::size_t i = 0; i < measured.size(); ++i) measured[i] = fix.measured[i];
    return Used("fix", fix.capture, measured, fix.pose, fix.covariance, fix.in_lander_frame);
  }
  AidUse Update(const messages::RelativeMotion& motion) override {
    return Used("motion", motion.from, motion.to, motion.motion_F, motion.covariance);
  }
  const messages::LocalizationEstimate& estimate() const override { return estimate_; }
  std::span<const double> own_values() const override {
    if (own_values_ == 0) return {};
    GuardedCall(who_,
                [&] { values_ = object_.get().attr("own_list")().cast<std::vector<double>>(); });
    return values_;
  }

 private:
  template <typename... Data>
  AidUse Used(const char* function, const Data&... data) {
    const AidUse use = GuardedCall(who_, [&] {
      const auto name = py::str(object_.get().attr(function)(data...)).cast<std::string>();
      Believe();
      const auto* found = std::ranges::find(kUses, name);
      if (found != kUses.end()) return static_cast<AidUse>(found - kUses.begin());
      throw NoNumber(fmt::format("{}() returns {}, which is no use of an aid", function, name));
    });
    return use;
  }

  // Takes what is believed: (pose, odometry or None, (roll, pitch, z), covariance or None). The
  // caller holds the interpreter's lock.
  void Believe() {
    const py::object returned = tell_.get()();
    if (!py::isinstance<py::tuple>(returned) || py::len(returned) != 4) {
      throw WrongShape("tuple of four");
    }
    const auto told = py::reinterpret_borrow<py::tuple>(returned);
    estimate_.pose = Pose(told[0], "pose");
    estimate_.odometry = told[1].is_none() ? estimate_.pose : Pose(told[1], "odometry");
    constexpr std::array kAttitude{"roll_rad", "pitch_rad", "z_m"};
    const auto [roll_rad, pitch_rad, z_m] = Numbers(told[2], "attitude", kAttitude);
    estimate_.attitude = {roll_rad, pitch_rad, z_m};
    estimate_.covariance.reset();
    if (!told[3].is_none()) estimate_.covariance = Covariance(told[3]);
  }

  const std::string who_;
  Held object_;
  Held propagate_;  // two functions of it
  Held tell_;
  bool feels_ = true;
  std::size_t own_values_;
  messages::LocalizationEstimate estimate_;
  mutable std::vector<double> values_;
};

class PythonEstimatorSource final : public plugin::EstimatorSource {
 public:
  PythonEstimatorSource(std::string name, std::unique_ptr<const plugin::Description> description,
                        std::shared_ptr<const Held> make)
      : EstimatorSource(std::move(name), std::move(description)), make_(std::move(make)) {}

  std::unique_ptr<localization::Estimator> Make(
      const plugin::Parameters& parameters,
      const localization::EstimatorSetup& setup) const override {
    return std::make_unique<PythonEstimator>(*make_, description(), parameters, setup);
  }

 protected:
  core::JsonValue AskProblems(const plugin::Parameters& /*parameters*/) const override {
    return core::JsonValue::Object();
  }

 private:
  std::shared_ptr<const Held> make_;
};

}  // namespace

void BindEstimators(py::module_& module) {
  ScenarioClass(module).def(
      "add_estimator",
      [](OpenScenario& scenario, const std::string& description, const std::string& identity,
         const py::object& make) {
        const std::string name = "estimator";
        auto source = std::make_shared<PythonEstimatorSource>(
            name, plugin::ReadDescription(core::ParseJson(description, name), name),
            std::make_shared<const Held>(make));
        scenario.values.estimators().Add(
            std::make_unique<plugin::ForeignEstimatorKind>(std::move(source)));
        scenario.AddProgram(identity);
      },
      py::arg("description"), py::arg("identity"), py::arg("make"));
}

}  // namespace rockyard::python
