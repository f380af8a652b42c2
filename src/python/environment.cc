#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <barrier>
#include <cmath>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <new>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.h"
#include "navigation/navigator_fault.h"
#include "plugin/foreign_navigator.h"
#include "python/parts.h"
#include "python/stepped_drive.h"
#include "scenario/scenario.h"
#include "sensing/stripe_layout_params.h"

namespace rockyard::python {
namespace {

namespace py = pybind11;
using navigation::NavigatorDecision;

// Columns of an action. Must agree: ACTION in rockyard/environment.py.
enum class ActionColumn { kKind, kCurvature, kDistance, kTurn, kPeriod, kSpeed };
constexpr py::ssize_t kActionColumns = 6;
// Values of its kind, in the order of rockyard.environment.Kind.
enum class ActionKind {
  kForward,
  kBackward,
  kTurnLeft,
  kTurnRight,
  kLookAhead,
  kLookBehind,
  kRest,
  kArrived,
  kGaveUp
};
constexpr int kActionKinds = 9;
constexpr double kSharpest_per_m = 1e3;

using Actions = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Returns the decision that a row of actions stands for. A distance, turn or period of 0 has no
// end: the drive asks at events. Throws core::UserError where a number is out of bounds.
NavigatorDecision DecisionOf(const double* action) {
  const auto column = [&](ActionColumn at) { return action[static_cast<int>(at)]; };
  const auto require = [](bool holds, const char* name, double value, const char* right) {
    if (!holds) throw core::UserError("action", fmt::format("{} is {}", name, value), right);
  };
  const auto limit = [&](ActionColumn at, const char* name) {
    const double value = column(at);
    require(value >= 0.0, name, value, "use 0 or more; 0: until an event");
    return value > 0.0 ? value : std::numeric_limits<double>::infinity();
  };
  const double distance_m = limit(ActionColumn::kDistance, "distance_m");
  const double turn_rad = limit(ActionColumn::kTurn, "turn_rad");
  const double period_s = limit(ActionColumn::kPeriod, "period_s");
  const double kind = std::round(column(ActionColumn::kKind));
  require(kind >= 0.0 && kind < kActionKinds, "kind", column(ActionColumn::kKind),
          "use a value of Kind");
  navigation::Until until = navigation::AtEvents();
  messages::MotionCommand motion;
  const double speed = column(ActionColumn::kSpeed);
  require(speed >= 0.0 && speed <= 1.0, "speed_share", speed, "use 0 to 1; 0: full speed");
  const double curvature_per_m = column(ActionColumn::kCurvature);
  require(std::abs(curvature_per_m) <= kSharpest_per_m, "curvature_per_m", curvature_per_m,
          "use -1000 to 1000");
  motion.speed_share = speed > 0.0 ? speed : 1.0;
  switch (static_cast<ActionKind>(static_cast<int>(kind))) {
    case ActionKind::kForward:
    case ActionKind::kBackward:
      motion.kind = messages::MotionKind::kArc;
      motion.curvature_per_m = curvature_per_m;
      motion.direction = kind == 0.0 ? 1 : -1;
      until.distance_m = distance_m;
      return navigation::Move(motion, until);
    case ActionKind::kTurnLeft:
    case ActionKind::kTurnRight:
      motion.kind = messages::MotionKind::kTurnInPlace;
      motion.direction = static_cast<ActionKind>(kind) == ActionKind::kTurnLeft ? 1 : -1;
      until.turn_rad = turn_rad;
      return navigation::Move(motion, until);
    case ActionKind::kLookAhead:
      return navigation::LookAt(messages::LookDirection::kAhead);
    case ActionKind::kLookBehind:
      return navigation::LookAt(messages::LookDirection::kBehind);
    case ActionKind::kRest:
      until.period_s = period_s;
      return navigation::Move(motion, until);
    case ActionKind::kArrived:
      return navigation::Finish(navigation::NavigatorStatus::kArrived);
    case ActionKind::kGaveUp:
      break;
  }
  return navigation::Finish(navigation::NavigatorStatus::kGaveUp);
}

// An array of one row a lane that Python sees without a copy, and the place to write it.
template <typename Value>
struct Rows {
  py::array_t<Value> array;
  Value* data;
  std::size_t width;

  explicit Rows(std::vector<py::ssize_t> shape)
      : array(shape), data(array.mutable_data()), width(1) {
    for (std::size_t i = 1; i < shape.size(); ++i) width *= static_cast<std::size_t>(shape[i]);
    std::fill_n(data, static_cast<std::size_t>(array.size()), Value{});
  }
  Value* Row(std::size_t lane) const { return data + lane * width; }
  // Returns a copy of a row.
  py::array_t<Value> Copy(std::size_t lane) const {
    std::vector<py::ssize_t> shape(array.shape() + 1, array.shape() + array.ndim());
    return py::array_t<Value>(std::move(shape), Row(lane));
  }
};

// What is seen of every lane. Must agree: the spaces in rockyard/environment.py.
struct Seen {
  Rows<double> time_s;
  Rows<std::uint32_t> events;
  Rows<double> pose;      // believed x, y, heading, odometer
  Rows<double> attitude;  // roll, pitch, z
  Rows<double> goal;      // x, y, believed distance and bearing
  Rows<std::int8_t> looked;
  Rows<std::int8_t> hazards;  // by stripe; -1: not known
  Rows<float> points;
  Rows<std::int32_t> point_count;
  Rows<std::int8_t> felt;  // 1 + kind of the hazard, touches behind, notices stuck

  Seen(py::ssize_t lanes, py::ssize_t stripes, py::ssize_t most_points)
      : time_s({lanes}),
        events({lanes}),
        pose({lanes, 4}),
        attitude({lanes, 3}),
        goal({lanes, 4}),
        looked({lanes}),
        hazards({lanes, stripes}),
        points({lanes, most_points, 3}),
        point_count({lanes}),
        felt({lanes, 3}) {}

  void Take(std::size_t lane, const navigation::NavigatorInput& input,
            const messages::Goal& to) const {
    const messages::PoseEstimate& at = input.estimate;
    *time_s.Row(lane) = input.time_s;
    *events.Row(lane) = input.events.bits();
    std::ranges::copy(std::array{at.x_m, at.y_m, at.heading_rad, at.distance_m}, pose.Row(lane));
    std::ranges::copy(
        std::array{input.attitude.roll_rad, input.attitude.pitch_rad, input.attitude.z_m},
        attitude.Row(lane));
    const double dx_m = to.x_m - at.x_m;
    const double dy_m = to.y_m - at.y_m;
    std::ranges::copy(
        std::array{to.x_m, to.y_m, std::sqrt(dx_m * dx_m + dy_m * dy_m),
                   std::remainder(std::atan2(dy_m, dx_m) - at.heading_rad, 2.0 * std::numbers::pi)},
        goal.Row(lane));
    TakeLook(lane, input);
    std::int8_t* feels = felt.Row(lane);
    feels[0] = input.vehicle_hazard == nullptr
                   ? std::int8_t{0}
                   : static_cast<std::int8_t>(1 + static_cast<int>(input.vehicle_hazard->kind));
    feels[1] = input.touches_behind ? 1 : 0;
    feels[2] = input.notices_stuck ? 1 : 0;
  }

 private:
  void TakeLook(std::size_t lane, const navigation::NavigatorInput& input) const {
    *looked.Row(lane) = input.look != nullptr ? 1 : 0;
    std::int8_t* stripes = hazards.Row(lane);
    std::fill_n(stripes, hazards.width, std::int8_t{-1});
    if (input.report != nullptr) {
      const auto& told = input.report->stripe_hazard;
      for (std::size_t i = 0; i < std::min(hazards.width, told.size()); ++i) {
        stripes[i] = told[i] ? 1 : 0;
      }
    }
    const std::size_t most = points.width / 3;
    std::size_t count = 0;
    if (input.cloud != nullptr) {
      float* row = points.Row(lane);
      count = std::min(most, input.cloud->points_R.size());
      for (std::size_t i = 0; i < count; ++i) {
        const math::Vector3& point = input.cloud->points_R[i];
        for (int axis = 0; axis < 3; ++axis) *row++ = static_cast<float>(point[axis]);
      }
    }
    *point_count.Row(lane) = static_cast<std::int32_t>(count);
  }
};

// Returns the experiment of drives. Throws core::UserError where it is another one, which asks no
// navigator or has several drives.
std::unique_ptr<experiments::Experiment> DriveOf(const OpenScenario& scenario) {
  const std::string_view kind = scenario.values.values().experiment.chosen().name();
  if (kind != "drive") {
    throw core::UserError("experiment.kind",
                          fmt::format("is {}, and an environment needs a drive", kind),
                          "use a scenario of drives");
  }
  const py::gil_scoped_release released;
  return scenario.values.MakeExperiment();
}

// Drives side by side, each at its next decision. With several threads a lane stays on one of them;
// else it goes on in the thread that calls, whichever that is.
class Drives {
 public:
  Drives(const OpenScenario& scenario, std::size_t lanes, int threads, py::ssize_t most_points)
      : experiment_(DriveOf(scenario)),
        lanes_(lanes),
        seen_(static_cast<py::ssize_t>(lanes), Stripes(scenario), most_points),
        starter_(getpid()) {
    const auto count = std::clamp<std::size_t>(static_cast<std::size_t>(std::max(threads, 1)), 1,
                                               std::max<std::size_t>(lanes, 1));
    if (count == 1) return;
    start_.emplace(static_cast<std::ptrdiff_t>(count + 1));
    end_.emplace(static_cast<std::ptrdiff_t>(count + 1));
    for (std::size_t worker = 0; worker < count; ++worker) {
      threads_.emplace_back([this, worker, count] { Serve(worker, count); });
    }
  }
  ~Drives() {
    if (starter_ != getpid()) {  // a fork has none of the threads, and the drives are the parent's
      static_cast<void>(new (std::nothrow) std::vector<std::thread>(std::move(threads_)));
      for (Lane& lane : lanes_) lane.drive.release();
      return;
    }
    const py::gil_scoped_release released;
    if (threads_.empty()) return;
    Do([this](std::size_t lane) { lanes_[lane].drive.reset(); });
    ends_ = true;
    start_->arrive_and_wait();
    for (std::thread& thread : threads_) thread.join();
  }
  Drives(const Drives&) = delete;
  Drives& operator=(const Drives&) = delete;

  // Begins the trial of each of these lanes.
  void Begin(const std::vector<std::size_t>& lanes, const std::vector<std::uint64_t>& seeds,
             const std::vector<std::uint64_t>& trials) {
    const Turn turn(*this);
    for (const std::size_t lane : lanes) {
      if (lane < lanes_.size()) continue;
      throw core::UserError("lanes", fmt::format("has {}", lane),
                            fmt::format("use 0 to {}", lanes_.size() - 1));
    }
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      Lane& lane = lanes_[lanes[i]];
      lane.seed = seeds.at(i);
      lane.trial = trials.at(i);
      lane.begins = true;
    }
    Each([this](std::size_t at) {
      Lane& lane = lanes_[at];
      if (!std::exchange(lane.begins, false)) return;
      if (!lane.drive) lane.drive = std::make_unique<SteppedDrive>();
      lane.drive->Begin(*experiment_, lane.seed, lane.trial);
      Look(at);
    });
  }

  // Makes the decision of each lane that drives, by its row. Returns which have ended by it.
  py::array_t<bool> Step(const Actions& actions) {
    const Turn turn(*this);
    if (actions.ndim() != 2 || actions.shape(0) != static_cast<py::ssize_t>(lanes_.size()) ||
        actions.shape(1) != kActionColumns) {
      throw core::UserError("action", "has another shape",
                            "give a row of 6 numbers for each drive");
    }
    py::array_t<bool> ended(static_cast<py::ssize_t>(lanes_.size()));
    bool* drove = ended.mutable_data();
    for (std::size_t at = 0; at < lanes_.size(); ++at) {
      drove[at] = IsDriving(at);
      if (!drove[at]) continue;
      lanes_[at].decision = DecisionOf(actions.data(static_cast<py::ssize_t>(at), 0));
    }
    Each([this, drove](std::size_t at) {
      if (!drove[at]) return;
      lanes_[at].drive->Step(lanes_[at].decision);
      Look(at);
      drove[at] = !IsDriving(at);
    });
    return ended;
  }

  // Does the same of one lane, by an action of its own. Returns what is seen of it, and whether it
  // has ended.
  py::tuple Advance(std::size_t lane, const Actions& action) {
    const Turn turn(*this);
    if (action.size() != kActionColumns) {
      throw core::UserError("action", "has another shape", "give 6 numbers");
    }
    if (!threads_.empty()) throw core::UserError("threads", "are several", "step all drives");
    if (!IsDriving(lane))
      throw core::UserError("action", "is for a drive that has ended", "reset it");
    const NavigatorDecision decision = DecisionOf(action.data());
    {
      const py::gil_scoped_release released;
      lanes_[lane].drive->Step(decision);
      Look(lane);
    }
    return py::make_tuple(Observe(lane), !IsDriving(lane));
  }

  py::array_t<bool> Driving() const {
    RequireFree();
    py::array_t<bool> driving(static_cast<py::ssize_t>(lanes_.size()));
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
      driving.mutable_at(lane) = IsDriving(lane);
    }
    return driving;
  }
  py::object Record(std::size_t lane) const {
    RequireFree();
    const auto& drive = lanes_.at(lane).drive;
    if (!drive || !drive->record()) return py::none();
    return RecordOf(*drive->record(), experiment_->schema().size());
  }
  py::dict Observations() const {
    py::dict dict;
    dict["time_s"] = seen_.time_s.array;
    dict["events"] = seen_.events.array;
    dict["pose"] = seen_.pose.array;
    dict["attitude"] = seen_.attitude.array;
    dict["goal"] = seen_.goal.array;
    dict["looked"] = seen_.looked.array;
    dict["hazards"] = seen_.hazards.array;
    dict["points"] = seen_.points.array;
    dict["point_count"] = seen_.point_count.array;
    dict["felt"] = seen_.felt.array;
    return dict;
  }
  // Returns the same of one lane, as copies.
  py::dict Observe(std::size_t lane) const {
    if (lane >= lanes_.size()) throw py::index_error("there is no such drive");
    py::dict dict;
    dict["time_s"] = seen_.time_s.Copy(lane);
    dict["events"] = seen_.events.Copy(lane);
    dict["pose"] = seen_.pose.Copy(lane);
    dict["attitude"] = seen_.attitude.Copy(lane);
    dict["goal"] = seen_.goal.Copy(lane);
    dict["looked"] = seen_.looked.Copy(lane);
    dict["hazards"] = seen_.hazards.Copy(lane);
    dict["points"] = seen_.points.Copy(lane);
    dict["point_count"] = seen_.point_count.Copy(lane);
    dict["felt"] = seen_.felt.Copy(lane);
    return dict;
  }
  py::list Columns() const { return ColumnsOf(experiment_->schema()); }

 private:
  struct Lane {
    std::unique_ptr<SteppedDrive> drive;
    std::uint64_t seed = 0;
    std::uint64_t trial = 0;
    bool begins = false;
    NavigatorDecision decision;
    std::exception_ptr thrown;
  };

  // One call of Begin or Step, of which there is one at a time: no drive can go on twice at once.
  class Turn {
   public:
    explicit Turn(Drives& drives) : drives_(drives) {
      drives.RequireStarter();
      drives.RequireFree();
      drives.busy_ = true;
    }
    ~Turn() { drives_.busy_ = false; }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    Drives& drives_;
  };

  bool IsDriving(std::size_t lane) const {
    return lanes_[lane].drive && lanes_[lane].drive->is_driving();
  }
  static py::ssize_t Stripes(const OpenScenario& scenario) {
    return static_cast<py::ssize_t>(
        sensing::ArraySize(scenario.values.values().drive.sensors.light_stripe).stripes);
  }
  void RequireStarter() const {
    if (starter_ == getpid()) return;
    throw core::UserError("environment", "was made by the process that this one was forked from",
                          "make one after the fork");
  }
  void RequireFree() const {
    if (!busy_) return;
    throw core::UserError("environment", "is at work in another thread",
                          "give each thread one of its own");
  }
  void Look(std::size_t lane) const {
    const SteppedDrive& drive = *lanes_[lane].drive;
    if (drive.is_driving()) seen_.Take(lane, drive.input(), drive.goal());
  }
  // Does something of each lane, on its thread.
  template <typename Work>
  void Each(const Work& work) {
    {
      const py::gil_scoped_release released;
      Do([&](std::size_t lane) {
        try {
          work(lane);
        } catch (...) {
          lanes_[lane].thrown = std::current_exception();
        }
      });
    }
    std::exception_ptr first;
    for (Lane& lane : lanes_) {
      std::exception_ptr thrown = std::exchange(lane.thrown, nullptr);
      if (!first) first = std::move(thrown);
    }
    if (first) std::rethrow_exception(first);
  }
  void Do(const std::function<void(std::size_t)>& work) {
    if (threads_.empty()) {
      for (std::size_t lane = 0; lane < lanes_.size(); ++lane) work(lane);
      return;
    }
    work_ = &work;
    start_->arrive_and_wait();
    end_->arrive_and_wait();
  }
  void Serve(std::size_t worker, std::size_t workers) {
    while (true) {
      start_->arrive_and_wait();
      if (ends_) return;
      for (std::size_t lane = worker; lane < lanes_.size(); lane += workers) (*work_)(lane);
      end_->arrive_and_wait();
    }
  }

  std::unique_ptr<experiments::Experiment> experiment_;
  std::vector<Lane> lanes_;
  Seen seen_;
  pid_t starter_;
  bool busy_ = false;  // under the interpreter's lock
  const std::function<void(std::size_t)>* work_ = nullptr;
  bool ends_ = false;
  std::optional<std::barrier<>> start_;
  std::optional<std::barrier<>> end_;
  std::vector<std::thread> threads_;
};

}  // namespace

void BindEnvironment(py::module_& module) {
  ScenarioClass(module).def("add_caller", [](OpenScenario& scenario) {
    const py::gil_scoped_release released;
    AddCaller(scenario.values.navigators());
  });
  py::class_<Drives>(module, "Drives")
      .def(py::init<const OpenScenario&, std::size_t, int, py::ssize_t>(), py::arg("scenario"),
           py::arg("lanes"), py::arg("threads"), py::arg("most_points"))
      .def("begin", &Drives::Begin)
      .def("step", &Drives::Step)
      .def("driving", &Drives::Driving)
      .def("record", &Drives::Record)
      .def("observe", &Drives::Observe)
      .def("advance", &Drives::Advance)
      .def("observations", &Drives::Observations)
      .def("columns", &Drives::Columns);
}

}  // namespace rockyard::python
