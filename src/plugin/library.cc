#include "plugin/library.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/json_text.h"
#include "plugin/abi.h"
#include "plugin/guarded_call.h"
#include "plugin/library_calls.h"
#include "plugin/library_estimator.h"
#include "plugin/library_reader.h"

namespace rockyard::plugin {
namespace {

namespace fs = std::filesystem;
using navigation::FaultKind;
using navigation::NavigatorFault;

rockyard_pose Pose(const messages::PoseEstimate& pose) {
  return {pose.x_m, pose.y_m, pose.heading_rad, pose.distance_m};
}
rockyard_place Place(const messages::Goal& goal) { return {goal.x_m, goal.y_m}; }
rockyard_attitude Attitude(const messages::AttitudeEstimate& attitude) {
  return {attitude.roll_rad, attitude.pitch_rad, attitude.z_m};
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
    if (from.images != nullptr) Take(*from.images);
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
    felt_.Take(from);
    input_.felt = felt_.get();
  }
  void Take(const messages::LookImages& from) {
    images_ = AbiImages(from);
    input_.images = &images_;
  }

  rockyard_input input_{};
  rockyard_report report_{};
  rockyard_cloud cloud_{};
  rockyard_look look_{};
  rockyard_hazard hazard_{};
  AbiFelt felt_;
  rockyard_images images_{};
  std::array<std::uint8_t, messages::kMaxStripes> stripes_{};
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

// One navigator of a library.
class LibraryNavigator final : public navigation::Navigator {
 public:
  LibraryNavigator(const rockyard_navigator_type& type, const navigation::NavigatorSetup& setup,
                   std::size_t own_values)
      : calls_("", setup.limits.decision_cpu_s, setup.limits.drive_cpu_s),
        type_(type),
        on_end_(setup.on_end),
        own_values_(own_values) {}
  ~LibraryNavigator() override {
    if (navigator_ != nullptr) type_.destroy(navigator_);
    if (on_end_) on_end_(calls_.use());
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
                            .rover = AbiRover(setup.rover),
                            .site_map = setup.site_map ? &map : nullptr};
    Call(
        [&](rockyard_error* error) { return type_.create(values.get(), &to, &navigator_, error); });
    if (navigator_ == nullptr) throw NavigatorFault(FaultKind::kThrew, "it made no navigator");
  }

  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    const AbiInput from(input);
    rockyard_decision to{};
    calls_.CountQuestion();
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
    const messages::NavigatorUse use = calls_.use();
    Call([&](rockyard_error* error) { return type_.overlay(navigator_, &shown, error); });
    calls_.ResetUse(use);  // a drive that is watched is the same as one that is not
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

  template <typename Function>
  void Call(const Function& function) const {
    calls_.Call(function);
  }

  const LibraryCalls calls_;
  const rockyard_navigator_type& type_;
  const std::function<void(const messages::NavigatorUse&)> on_end_;
  const std::size_t own_values_;
  void* navigator_ = nullptr;
  mutable messages::Overlay overlay_;
  mutable std::vector<double> values_;
};

// One kind of navigators of a library.
class LibrarySource final : public NavigatorSource {
 public:
  LibrarySource(std::shared_ptr<const LoadedLibrary> library, std::size_t place,
                std::unique_ptr<const Description> description)
      : NavigatorSource(library->file().string(), std::move(description)),
        library_(std::move(library)),
        place_(place) {}

  std::unique_ptr<navigation::Navigator> Make(
      const Parameters& parameters, const navigation::NavigatorSetup& setup) const override {
    auto navigator = std::make_unique<LibraryNavigator>(*library_->info().navigators[place_], setup,
                                                        description().own_values.size());
    navigator->Begin(parameters, setup);
    return navigator;
  }

 protected:
  core::JsonValue AskTraits(const Parameters& parameters) const override {
    return AskOfParameters(*library_, parameters, [&](const rockyard_plugin_info& info) {
      return info.navigators[place_]->traits;
    });
  }

 private:
  const std::shared_ptr<const LoadedLibrary> library_;
  const std::size_t place_;
};

// What the library says of one list of its kinds.
template <typename Type>
std::string DescribeAll(const Type* const* types, std::size_t count) {
  std::string all = "[";
  for (std::size_t i = 0; i < count; ++i) {
    rockyard_error error{};
    std::string one;
    RequireDone(types[i]->describe(TakeText, &one, &error), error);
    all += (i == 0 ? "" : ",") + one;
  }
  return all + "]";
}

std::string DescribeAll(const fs::path& file) {
  const rockyard_plugin_info& info = Load(file);
  return "[" + DescribeAll(info.navigators, info.navigator_count) + "," +
         DescribeAll(info.estimators, info.estimator_count) + "," +
         DescribeAll(info.readers, info.reader_count) + "]";
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

OpenedLibrary OpenLibrary(const fs::path& file, const std::string& hash) {
  const std::string name = file.string();
  const core::JsonValue answers =
      core::ParseJson(InChild(name, [&] { return DescribeAll(file); }), name);
  const core::JsonValue::List& navigators = answers.list()[0].list();
  const core::JsonValue::List& estimators = answers.list()[1].list();
  const core::JsonValue::List& readers = answers.list()[2].list();
  const auto library = std::make_shared<const LoadedLibrary>(file, hash, navigators.size(),
                                                             estimators.size(), readers.size());
  OpenedLibrary opened;
  for (const core::JsonValue& answer : navigators) {
    opened.navigators.push_back(std::make_shared<LibrarySource>(library, opened.navigators.size(),
                                                                ReadDescription(answer, name)));
  }
  for (const core::JsonValue& answer : estimators) {
    opened.estimators.push_back(
        MakeLibraryEstimators(library, opened.estimators.size(), ReadDescription(answer, name)));
  }
  for (const core::JsonValue& answer : readers) {
    opened.readers.push_back(
        MakeLibraryReaders(library, opened.readers.size(), ReadDescription(answer, name)));
  }
  return opened;
}

}  // namespace rockyard::plugin
