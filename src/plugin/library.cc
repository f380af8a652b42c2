#include "plugin/library.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/json_text.h"
#include "plugin/abi.h"
#include "plugin/guarded_call.h"

namespace rockyard::plugin {
namespace {

namespace fs = std::filesystem;
using navigation::FaultKind;
using navigation::NavigatorFault;
using Clock = std::chrono::steady_clock;

// No call in which a process forks takes less.
constexpr std::chrono::microseconds kForkTakes{20};
// What calls that are no longer take by the clock on the wall counts as CPU time.
constexpr std::chrono::milliseconds kShort{1};

// Loads the library into this process. Throws std::runtime_error with the reason of the loader.
const rockyard_plugin_info& Load(const fs::path& file) {
  // A library is never unloaded: threads of its own may still run in it.
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error(dlerror());
  void* symbol = dlsym(library, ROCKYARD_PLUGIN_FUNCTION);
  if (symbol == nullptr) {
    throw std::runtime_error(
        fmt::format("it has no function {}: it is no plugin of rockyard, or names its navigators "
                    "by no ROCKYARD_NAVIGATORS",
                    ROCKYARD_PLUGIN_FUNCTION));
  }
  const auto function = reinterpret_cast<rockyard_plugin_function>(symbol);
  const rockyard_plugin_info* info = function();
  if (info == nullptr) throw std::runtime_error("it hands over no navigators");
  if (info->abi != ROCKYARD_PLUGIN_ABI) {
    throw std::runtime_error(
        fmt::format("it was built for version {} of the plugin interface, and this program has "
                    "version {}: build it with the headers of this program",
                    info->abi, ROCKYARD_PLUGIN_ABI));
  }
  if (info->navigator_count == 0 || info->navigators == nullptr) {
    throw std::runtime_error("it has no navigators");
  }
  return *info;
}

void TakeText(void* to, const char* text, std::size_t bytes) {
  static_cast<std::string*>(to)->assign(text, bytes);
}

// Returns what a function of a plugin reports, up to the end of the field at most.
std::string TextOf(const rockyard_error& error) {
  return {std::begin(error.text), std::find(std::begin(error.text), std::end(error.text), '\0')};
}

// Throws what a function of a plugin reports.
void RequireDone(int result, const rockyard_error& error) {
  if (result != 0) throw std::runtime_error(TextOf(error));
}

// The values of parameters as the C interface has them; views of `parameters`.
class AbiValues {
 public:
  explicit AbiValues(const Parameters& parameters) {
    for (const FieldValue& value : parameters.values()) {
      rockyard_value& to = values_.emplace_back();
      to.real = value.real;
      to.integer = value.boolean ? 1 : value.choice != 0 ? value.choice : value.integer;
      to.text = value.text.c_str();
      to.reals = value.reals.data();
      to.integers = value.integers.data();
      to.count = std::max(value.reals.size(), value.integers.size());
    }
    all_ = {values_.data(), values_.size()};
  }
  AbiValues(const AbiValues&) = delete;
  AbiValues& operator=(const AbiValues&) = delete;

  const rockyard_values* get() const { return &all_; }

 private:
  std::vector<rockyard_value> values_;
  rockyard_values all_{};
};

rockyard_pose Pose(const messages::PoseEstimate& pose) {
  return {pose.x_m, pose.y_m, pose.heading_rad, pose.distance_m};
}
rockyard_place Place(const messages::Goal& goal) { return {goal.x_m, goal.y_m}; }
rockyard_attitude Attitude(const messages::AttitudeEstimate& attitude) {
  return {attitude.roll_rad, attitude.pitch_rad, attitude.z_m};
}

rockyard_rover Rover(const messages::RoverBelief& from) {
  rockyard_rover to{};
  to.length_m = from.length_m;
  to.width_m = from.width_m;
  to.belly_clearance_m = from.belly_clearance_m;
  to.wheel_width_m = from.wheel_width_m;
  to.max_rocker_rad = from.max_rocker_rad;
  to.max_bogie_rad = from.max_bogie_rad;
  to.max_tilt_rad = from.max_tilt_rad;
  to.wheel_radius_m = from.drive.wheel_radius_m;
  to.max_wheel_speed_m_s = from.drive.max_wheel_speed_m_s;
  to.max_steer_rad = from.drive.max_steer_rad;
  to.steering_offset_rad = from.drive.steering_offset_rad;
  for (std::size_t wheel = 0; wheel < messages::kWheelCount; ++wheel) {
    to.wheel_x_m[wheel] = from.drive.wheel_x_m[wheel];
    to.wheel_y_m[wheel] = from.drive.wheel_y_m[wheel];
    to.radius_ratio[wheel] = from.drive.radius_ratio[wheel];
    to.steered[wheel] = from.drive.steered[wheel] ? 1 : 0;
  }
  return to;
}

// A NavigatorInput as the C interface has it; views of `from`.
class AbiInput {
 public:
  explicit AbiInput(const navigation::NavigatorInput& from) {
    input_.time_s = from.time_s;
    input_.events = from.events.bits();
    input_.estimate = Pose(from.estimate);
    input_.odometry = Pose(from.odometry);
    input_.attitude = Attitude(from.attitude);
    input_.touches_behind = from.touches_behind ? 1 : 0;
    input_.notices_stuck = from.notices_stuck ? 1 : 0;
    if (from.report != nullptr) Take(*from.report);
    if (from.cloud != nullptr) Take(*from.cloud);
    if (from.look != nullptr) {
      look_ = {from.look->number, from.look->time_s, Pose(from.look->estimate),
               Pose(from.look->odometry), Attitude(from.look->attitude)};
      input_.look = &look_;
    }
    if (from.vehicle_hazard != nullptr) {
      hazard_ = {static_cast<std::int32_t>(from.vehicle_hazard->kind),
                 static_cast<std::int32_t>(from.vehicle_hazard->side)};
      input_.hazard = &hazard_;
    }
    if (from.felt != nullptr) Take(*from.felt);
    // Symmetric, so that rows and columns are one.
    if (from.covariance != nullptr) input_.covariance = from.covariance->data();
  }
  AbiInput(const AbiInput&) = delete;
  AbiInput& operator=(const AbiInput&) = delete;

  const rockyard_input* get() const { return &input_; }

 private:
  void Take(const messages::HazardReport& from) {
    std::copy(from.stripe_hazard.begin(), from.stripe_hazard.end(), stripes_.begin());
    report_ = {from.scan_number, from.stripe_hazard.size(), stripes_.data()};
    input_.report = &report_;
  }
  void Take(const messages::PointCloud& from) {
    static_assert(sizeof(math::Vector3) == 3 * sizeof(double));
    cloud_ = {from.number, from.direction == messages::LookDirection::kBehind ? 1 : 0,
              from.points_R.size(), from.points_R.empty() ? nullptr : from.points_R.front().data()};
    input_.cloud = &cloud_;
  }
  void Take(const messages::VehicleState& from) {
    if (from.articulation) {
      joints_ = {from.articulation->left_rocker_rad, from.articulation->right_rocker_rad,
                 from.articulation->left_bogie_rad, from.articulation->right_bogie_rad};
      felt_.articulation_rad = joints_.data();
    }
    if (from.specific_force_R) felt_.specific_force_R = from.specific_force_R->data();
    if (from.motor_current_A) felt_.motor_current_A = from.motor_current_A->data();
    if (from.contact) {
      std::copy(from.contact->begin(), from.contact->end(), contact_.begin());
      felt_.contact = contact_.data();
    }
    input_.felt = &felt_;
  }

  rockyard_input input_{};
  rockyard_report report_{};
  rockyard_cloud cloud_{};
  rockyard_look look_{};
  rockyard_hazard hazard_{};
  rockyard_felt felt_{};
  std::array<std::uint8_t, messages::kMaxStripes> stripes_{};
  std::array<std::uint8_t, messages::kContactSwitchCount> contact_{};
  std::array<double, 4> joints_{};
};

navigation::NavigatorDecision Decision(const rockyard_decision& from) {
  navigation::NavigatorDecision to;
  to.status = static_cast<navigation::NavigatorStatus>(from.status);
  if (from.look != 0) {
    to.look = from.look == 2 ? messages::LookDirection::kBehind : messages::LookDirection::kAhead;
  }
  to.looks_on_the_move = from.looks_on_the_move != 0;
  to.motion = {static_cast<messages::MotionKind>(from.motion),
               from.curvature_per_m,
               from.direction,
               from.curvature_rate_per_m2,
               from.speed_share,
               from.end_m,
               from.move};
  to.until = {from.until_period_s, from.until_distance_m, from.until_turn_rad,
              from.until_near_goal_m};
  to.work_ops = from.work_ops;
  return to;
}

double ThreadCpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// One navigator of a library.
class LibraryNavigator final : public navigation::Navigator {
 public:
  LibraryNavigator(const rockyard_navigator_type& type, const navigation::NavigatorSetup& setup,
                   std::size_t own_values)
      : type_(type), limits_(setup.limits), on_end_(setup.on_end), own_values_(own_values) {}
  ~LibraryNavigator() override {
    if (navigator_ != nullptr) type_.destroy(navigator_);
    if (on_end_) on_end_(use_);
  }
  LibraryNavigator(const LibraryNavigator&) = delete;
  LibraryNavigator& operator=(const LibraryNavigator&) = delete;

  void Begin(const Parameters& parameters, const navigation::NavigatorSetup& setup) {
    const AbiValues values(parameters);
    std::vector<rockyard_place> places;
    for (const messages::Goal& place : setup.places) places.push_back(Place(place));
    rockyard_site_map map{};
    if (setup.site_map) {
      const messages::SiteMap& from = *setup.site_map;
      map = {from.x0_m,        from.y0_m,
             from.step_m,      from.nx,
             from.ny,          from.height_m.empty() ? nullptr : from.height_m.data(),
             from.height_sd_m, from.rock_share.empty() ? nullptr : from.rock_share.data()};
    }
    const rockyard_setup to{.goal = Place(setup.goal),
                            .places = places.data(),
                            .place_count = places.size(),
                            .judges_hazards = setup.judges_hazards ? 1 : 0,
                            .full_speed_m_s = setup.full_speed_m_s,
                            .control_period_s = setup.control_period_s,
                            .operations_per_s = setup.operations_per_s,
                            .random_seed = setup.random_seed,
                            .rover = Rover(setup.rover),
                            .site_map = setup.site_map ? &map : nullptr};
    Call(
        [&](rockyard_error* error) { return type_.create(values.get(), &to, &navigator_, error); });
    if (navigator_ == nullptr) throw NavigatorFault(FaultKind::kThrew, "it made no navigator");
  }

  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    const AbiInput from(input);
    rockyard_decision to{};
    ++use_.questions;
    Call([&](rockyard_error* error) { return type_.decide(navigator_, from.get(), &to, error); });
    navigation::NavigatorDecision decision = Decision(to);
    CheckDecision(decision);
    return decision;
  }

  void OnPoseUpdate(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override {
    OnJump(0, before, after);
  }
  void OnCorrection(const messages::PoseEstimate& before,
                    const messages::PoseEstimate& after) override {
    OnJump(1, before, after);
  }

  void SetGoal(const messages::Goal& goal, navigation::GoalChange change) override {
    const rockyard_place place = Place(goal);
    const int moved = change == navigation::GoalChange::kMoved ? 1 : 0;
    Call([&](rockyard_error* error) { return type_.set_goal(navigator_, &place, moved, error); });
  }

  const messages::Overlay* overlay() const override {
    rockyard_overlay shown{};
    const messages::NavigatorUse use = use_;
    Call([&](rockyard_error* error) { return type_.overlay(navigator_, &shown, error); });
    use_ = use;  // a drive that is watched is the same as one that is not
    overlay_ = {};
    for (std::size_t i = 0; i < shown.line_count; ++i) {
      const rockyard_overlay_line& line = shown.lines[i];
      messages::OverlayLine& to = overlay_.lines.emplace_back();
      to.name = line.name;
      for (std::size_t k = 0; k < line.count; ++k) {
        to.points.push_back({line.points[k].x_m, line.points[k].y_m});
      }
    }
    for (std::size_t i = 0; i < shown.grid_count; ++i) {
      const rockyard_overlay_grid& grid = shown.grids[i];
      constexpr int kMostCells = 4096;  // along a side
      const bool some =
          grid.nx > 0 && grid.ny > 0 && grid.nx <= kMostCells && grid.ny <= kMostCells;
      const std::size_t cells =
          some ? static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny) : 0;
      overlay_.grids.push_back({grid.name,
                                grid.x0_m,
                                grid.y0_m,
                                grid.step_m,
                                grid.nx,
                                grid.ny,
                                {grid.values, grid.values + cells}});
    }
    CheckOverlay(overlay_);
    return overlay_.lines.empty() && overlay_.grids.empty() ? nullptr : &overlay_;
  }

  std::span<const double> own_values() const override {
    values_.assign(own_values_, 0.0);
    if (own_values_ == 0) return values_;
    Call([&](rockyard_error* error) {
      return type_.own_values(navigator_, values_.data(), values_.size(), error);
    });
    return values_;
  }

 private:
  void OnJump(int corrected, const messages::PoseEstimate& before,
              const messages::PoseEstimate& after) {
    const rockyard_pose from = Pose(before);
    const rockyard_pose to = Pose(after);
    Call([&](rockyard_error* error) {
      return type_.on_jump(navigator_, corrected, &from, &to, error);
    });
  }

  // Calls a function of the library, and judges what it took. A navigator may be called at every
  // tick, so that what costs a system call is asked for slow calls alone.
  template <typename Function>
  void Call(const Function& function) const {
    const Clock::time_point began = Clock::now();
    if (began - read_at_ > kShort) {
      cpu_s_ = ThreadCpu_s();
      read_at_ = began;
    }
    rockyard_error error{};
    const int result = function(&error);
    const Clock::duration took = Clock::now() - began;
    // A plugin that forks: its child must not go on with this drive and this store.
    if (took > kForkTakes && getpid() != process_) _exit(1);
    const double took_s = std::chrono::duration<double>(took).count();
    use_.wall_s += took_s;
    use_.longest_s = std::max(use_.longest_s, took_s);
    if (took > kShort) {
      CheckSlow();
    } else {
      use_.cpu_s += took_s;
      Limit(use_.cpu_s, limits_.drive_cpu_s, "for one drive");
    }
    if (result != 0) throw NavigatorFault(FaultKind::kThrew, TextOf(error));
  }

  // Judges a slow call by the CPU time of the thread, in which it may have waited.
  void CheckSlow() const {
    const double now_s = ThreadCpu_s();
    const double used_s = now_s - std::exchange(cpu_s_, now_s);
    read_at_ = Clock::now();
    use_.cpu_s += used_s;
    Limit(used_s, limits_.decision_cpu_s, "for one answer");
    Limit(use_.cpu_s, limits_.drive_cpu_s, "for one drive");
  }

  static void Limit(double used_s, double most_s, const char* what) {
    if (used_s <= most_s) return;
    throw NavigatorFault(FaultKind::kCpuTime, fmt::format("more than {} s {}", most_s, what));
  }

  const rockyard_navigator_type& type_;
  const navigation::LimitParams limits_;
  const std::function<void(const messages::NavigatorUse&)> on_end_;
  const std::size_t own_values_;
  const pid_t process_ = getpid();
  void* navigator_ = nullptr;
  mutable double cpu_s_ = ThreadCpu_s();  // of the thread, at most kShort before a call
  mutable Clock::time_point read_at_ = Clock::now();
  mutable messages::NavigatorUse use_;  // in all calls
  mutable messages::Overlay overlay_;
  mutable std::vector<double> values_;
};

// One kind of navigators of a library.
class LibrarySource final : public NavigatorSource {
 public:
  LibrarySource(fs::path file, std::string hash, std::size_t place,
                std::unique_ptr<const Description> description)
      : NavigatorSource(file.string(), std::move(description)),
        file_(std::move(file)),
        hash_(std::move(hash)),
        place_(place) {}

  std::unique_ptr<navigation::Navigator> Make(
      const Parameters& parameters, const navigation::NavigatorSetup& setup) const override {
    auto navigator =
        std::make_unique<LibraryNavigator>(Type(), setup, description().own_values.size());
    navigator->Begin(parameters, setup);
    return navigator;
  }

 protected:
  core::JsonValue AskTraits(const Parameters& parameters) const override {
    const std::string text = InChild(name(), [&] {
      const AbiValues values(parameters);
      rockyard_error error{};
      std::string answer;
      const rockyard_navigator_type& type = *Load(file_).navigators[place_];
      RequireDone(type.traits(values.get(), TakeText, &answer, &error), error);
      return answer;
    });
    return core::ParseJson(text, name());
  }

 private:
  // Returns the functions; loads the library the first time.
  const rockyard_navigator_type& Type() const {
    const std::lock_guard lock(mutex_);
    if (type_ == nullptr) {
      if (const std::string now = HashOfLibrary(file_); now != hash_) {
        throw core::MachineError(
            name(), "was built anew meanwhile: its hash is " + now + ", and was " + hash_,
            "let it be while it drives, and begin a run of its own");
      }
      try {
        const rockyard_plugin_info& info = Load(file_);
        if (place_ >= info.navigator_count) throw std::runtime_error("it has fewer navigators");
        type_ = info.navigators[place_];
      } catch (const std::runtime_error& error) {
        throw core::UserError(name(), std::string("cannot be loaded: ") + error.what(),
                              "build it anew, and let it be while it is used");
      }
    }
    return *type_;
  }

  const fs::path file_;
  const std::string hash_;
  const std::size_t place_;
  mutable std::mutex mutex_;
  mutable const rockyard_navigator_type* type_ = nullptr;
};

// What the library says of its navigators: a list of descriptions.
std::string DescribeAll(const fs::path& file) {
  const rockyard_plugin_info& info = Load(file);
  std::string all = "[";
  for (std::size_t i = 0; i < info.navigator_count; ++i) {
    rockyard_error error{};
    std::string one;
    RequireDone(info.navigators[i]->describe(TakeText, &one, &error), error);
    all += (i == 0 ? "" : ",") + one;
  }
  return all + "]";
}

}  // namespace

void AddFile(const fs::path& file, core::Hasher& hasher) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw core::UserError(file.string(), "cannot be read", "check its permissions");
  hasher.Text(bytes);
}

std::string HashOfLibrary(const fs::path& file) {
  core::Hasher hasher;
  AddFile(file, hasher);
  return core::Hex(hasher.value());
}

std::vector<std::shared_ptr<const NavigatorSource>> OpenLibrary(const fs::path& file,
                                                                const std::string& hash) {
  const std::string name = file.string();
  const core::JsonValue answers =
      core::ParseJson(InChild(name, [&] { return DescribeAll(file); }), name);
  std::vector<std::shared_ptr<const NavigatorSource>> sources;
  for (const core::JsonValue& answer : answers.list()) {
    sources.push_back(
        std::make_shared<LibrarySource>(file, hash, sources.size(), ReadDescription(answer, name)));
  }
  return sources;
}

}  // namespace rockyard::plugin
