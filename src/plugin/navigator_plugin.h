/// @file
/// Makes a plugin of navigators, header only: a shared library that includes this file, links
/// nothing of rockyard and names its navigators once.
///
///   navigation::NavigatorDescription<MineParams> DescribeMine();  // as for a built-in navigator
///   ROCKYARD_NAVIGATORS(DescribeMine)
///
/// Class, parameters and description are the same as those of a navigator that a program links, so
/// that one source serves both. What a navigator throws ends its drive as a fault of the navigator.
/// Limits: views (Navigator::view), plan_counts, stripe names, rates of curvature and routes do not
/// pass through a plugin; overlays and own values do.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/fields.h"
#include "messages/calibration.h"
#include "messages/estimates.h"
#include "messages/look_images.h"
#include "messages/navigation_view.h"
#include "messages/point_cloud.h"
#include "messages/site_map.h"
#include "messages/vehicle_state.h"
#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"
#include "navigation/navigator_traits_params.h"
#include "plugin/abi.h"
#include "plugin/plugin_fields.h"

namespace rockyard::plugin {

/// What follows is for the macro below alone.
namespace layer {

/// Returns what the command hands over as a message.
inline messages::Goal Place(const rockyard_place& place) { return {place.x_m, place.y_m}; }

/// Returns the map of the site; null where there is none.
inline std::shared_ptr<const messages::SiteMap> SiteMap(const rockyard_site_map* from) {
  if (from == nullptr) return nullptr;
  auto map = std::make_shared<messages::SiteMap>();
  map->x0_m = from->x0_m;
  map->y0_m = from->y0_m;
  map->step_m = from->step_m;
  map->nx = from->nx;
  map->ny = from->ny;
  const auto cells = static_cast<std::size_t>(from->nx) * static_cast<std::size_t>(from->ny);
  if (from->height_m != nullptr) map->height_m.assign(from->height_m, from->height_m + cells);
  map->height_sd_m = from->height_sd_m;
  if (from->rock_share != nullptr) {
    map->rock_share.assign(from->rock_share, from->rock_share + cells);
  }
  return map;
}

/// Returns all that a navigator gets at the start.
inline navigation::NavigatorSetup Setup(const rockyard_setup& from) {
  navigation::NavigatorSetup setup;
  setup.goal = Place(from.goal);
  for (std::size_t i = 0; i < from.place_count; ++i) setup.places.push_back(Place(from.places[i]));
  setup.judges_hazards = from.judges_hazards != 0;
  setup.full_speed_m_s = from.full_speed_m_s;
  setup.control_period_s = from.control_period_s;
  setup.operations_per_s = from.operations_per_s;
  setup.random_seed = from.random_seed;
  setup.rover = Rover(from.rover);
  setup.site_map = SiteMap(from.site_map);
  return setup;
}

/// Holds what a NavigatorInput points to.
class Input {
 public:
  explicit Input(const rockyard_input& from) {
    input_.time_s = from.time_s;
    input_.events = navigation::Events(from.events);
    input_.estimate = Pose(from.estimate);
    input_.odometry = Pose(from.odometry);
    input_.attitude = Attitude(from.attitude);
    input_.touches_behind = from.touches_behind != 0;
    input_.notices_stuck = from.notices_stuck != 0;
    if (from.report != nullptr) TakeReport(*from.report);
    if (from.cloud != nullptr) TakeCloud(*from.cloud);
    if (from.look != nullptr) {
      look_ = {from.look->number, from.look->time_s, Pose(from.look->estimate),
               Pose(from.look->odometry), Attitude(from.look->attitude)};
      input_.look = &look_;
    }
    if (from.hazard != nullptr) {
      hazard_ = {static_cast<messages::VehicleHazardKind>(from.hazard->kind),
                 static_cast<messages::HazardSide>(from.hazard->side)};
      input_.vehicle_hazard = &hazard_;
    }
    if (from.felt != nullptr) TakeFelt(*from.felt);
    if (from.covariance != nullptr) {
      covariance_ = Eigen::Map<const messages::PoseCovariance>(from.covariance);
      input_.covariance = &covariance_;
    }
    if (from.images != nullptr) {
      images_ = Images(*from.images);
      input_.images = &images_;
    }
  }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  const navigation::NavigatorInput& get() const { return input_; }

 private:
  void TakeReport(const rockyard_report& from) {
    report_.scan_number = from.scan_number;
    report_.stripe_hazard = messages::PerStripe<bool>(from.stripes);
    for (std::size_t i = 0; i < from.stripes; ++i) report_.stripe_hazard[i] = from.hazard[i] != 0;
    input_.report = &report_;
  }
  void TakeCloud(const rockyard_cloud& from) {
    cloud_.number = from.number;
    cloud_.direction =
        from.behind != 0 ? messages::LookDirection::kBehind : messages::LookDirection::kAhead;
    cloud_.points_R.resize(from.count);
    if (from.count > 0) {
      std::memcpy(static_cast<void*>(cloud_.points_R.data()), from.points_R,
                  3 * sizeof(double) * from.count);
    }
    input_.cloud = &cloud_;
  }
  void TakeFelt(const rockyard_felt& from) {
    felt_ = Felt(from);
    input_.felt = &felt_;
  }

  navigation::NavigatorInput input_;
  messages::HazardReport report_;
  messages::PointCloud cloud_;
  messages::LookMoment look_;
  messages::VehicleHazard hazard_;
  messages::VehicleState felt_;
  messages::PoseCovariance covariance_ = messages::PoseCovariance::Zero();
  messages::LookImages images_;
};

/// Writes a decision.
inline void Write(const navigation::NavigatorDecision& from, rockyard_decision& to) {
  to = {};
  to.status = static_cast<std::int32_t>(from.status);
  if (from.look) to.look = *from.look == messages::LookDirection::kAhead ? 1 : 2;
  to.looks_on_the_move = from.looks_on_the_move ? 1 : 0;
  to.motion = static_cast<std::int32_t>(from.motion.kind);
  to.direction = from.motion.direction;
  to.curvature_per_m = from.motion.curvature_per_m;
  to.curvature_rate_per_m2 = from.motion.curvature_rate_per_m2;
  to.speed_share = from.motion.speed_share;
  to.end_m = from.motion.end_m;
  to.move = from.motion.move;
  to.until_period_s = from.until.period_s;
  to.until_distance_m = from.until.distance_m;
  to.until_turn_rad = from.until.turn_rad;
  to.until_near_goal_m = from.until.near_goal_m;
  to.work_ops = from.work_ops;
}

/// A navigator with the overlay that it handed over last.
struct Held {
  std::unique_ptr<navigation::Navigator> navigator;
  std::vector<std::vector<rockyard_place>> points;
  std::vector<rockyard_overlay_line> lines;
  std::vector<rockyard_overlay_grid> grids;

  void Show(const messages::Overlay& from, rockyard_overlay& to) {
    points.clear();
    lines.clear();
    grids.clear();
    for (const messages::OverlayLine& line : from.lines) {
      std::vector<rockyard_place>& places = points.emplace_back();
      for (const messages::Goal& point : line.points) places.push_back({point.x_m, point.y_m});
    }
    for (std::size_t i = 0; i < from.lines.size(); ++i) {
      lines.push_back({from.lines[i].name.c_str(), points[i].data(), points[i].size()});
    }
    for (const messages::OverlayGrid& grid : from.grids) {
      const auto cells = static_cast<std::size_t>(std::max(grid.nx, 0)) *
                         static_cast<std::size_t>(std::max(grid.ny, 0));
      if (grid.values.size() != cells) {
        throw std::runtime_error("the grid \"" + grid.name + "\" of its overlay has " +
                                 std::to_string(grid.values.size()) + " values for " +
                                 std::to_string(cells) + " cells");
      }
      grids.push_back({grid.name.c_str(), grid.x0_m, grid.y0_m, grid.step_m, grid.nx, grid.ny,
                       grid.values.data()});
    }
    to = {lines.data(), lines.size(), grids.data(), grids.size()};
  }
};

/// Returns the traits as JSON, up to the list of problems.
inline std::string TraitsText(const navigation::NavigatorTraits& traits) {
  constexpr std::array<std::string_view, 3> kReads{"hazards", "points", "nothing"};
  JsonLine json;
  json.Raw("{").Member("reads", kReads[static_cast<std::size_t>(traits.reads)]);
  json.Key("goal_tolerance").Raw("{").Member("parameter", traits.goal.path);
  json.Key("value_m").Number(traits.goal.tolerance_m).Raw("}");
  json.Key("cost").Raw("{");
  if (const auto* map = std::get_if<navigation::CostOfMap>(&traits.cost)) {
    json.Member("kind", "map").Key("cell_m").Number(map->cell_m);
    json.Key("area_m2").Number(map->area_m2);
  } else if (const auto* look = std::get_if<navigation::CostOfLook>(&traits.cost)) {
    json.Member("kind", "look").Key("time_s").Number(look->time_s);
  } else {
    json.Member("kind", "judgement");
  }
  json.Raw("}").Key("looks_on_the_move").Raw(traits.looks_on_the_move ? "true" : "false");
  json.Key("steers_on_the_move").Raw(traits.steers_on_the_move ? "true" : "false");
  json.Key("images").Raw(traits.images ? "true" : "false");
  json.Key("problems").Raw("[");
  return json.text();
}

/// The functions of one kind of navigator. `Describe` returns its NavigatorDescription.
template <auto Describe>
struct NavigatorType {
  using Description = decltype(Describe());

  template <typename Params>
  static Params ParamsIn(const navigation::NavigatorDescription<Params>&) {
    return {};
  }
  using Params = decltype(ParamsIn(std::declval<Description>()));

  static int DescribeIt(rockyard_take_text take, void* to, rockyard_error* error) noexcept {
    return Guarded(error, [&] {
      JsonLine json;
      WriteDescription<Params>(Describe(), json);
      json.Raw("}");
      take(to, json.text().data(), json.text().size());
    });
  }

  static int Traits(const rockyard_values* values, rockyard_take_text take, void* to,
                    rockyard_error* error) noexcept {
    return Guarded(error, [&] {
      Params params = WithValues<Params>(*values);
      JsonLine json;
      json.Raw(TraitsText(Describe().traits(params)));
      Conditions conditions(json);
      params.Visit(conditions);
      json.Raw("]}");
      take(to, json.text().data(), json.text().size());
    });
  }

  static int Create(const rockyard_values* values, const rockyard_setup* setup, void** navigator,
                    rockyard_error* error) noexcept {
    return Guarded(error, [&] {
      auto held = std::make_unique<Held>();
      held->navigator = Describe().make(WithValues<Params>(*values), Setup(*setup));
      if (held->navigator == nullptr) throw std::runtime_error("it made no navigator");
      *navigator = held.release();
    });
  }

  static navigation::Navigator& At(void* navigator) {
    return *static_cast<Held*>(navigator)->navigator;
  }

  static int Decide(void* navigator, const rockyard_input* input, rockyard_decision* decision,
                    rockyard_error* error) noexcept {
    return Guarded(error, [&] { Write(At(navigator).Decide(Input(*input).get()), *decision); });
  }

  static int OnJump(void* navigator, int corrected, const rockyard_pose* before,
                    const rockyard_pose* after, rockyard_error* error) noexcept {
    return Guarded(error, [&] {
      if (corrected != 0) {
        At(navigator).OnCorrection(Pose(*before), Pose(*after));
      } else {
        At(navigator).OnPoseUpdate(Pose(*before), Pose(*after));
      }
    });
  }

  static int SetGoal(void* navigator, const rockyard_place* goal, int moved,
                     rockyard_error* error) noexcept {
    return Guarded(error, [&] {
      At(navigator).SetGoal(Place(*goal), moved != 0 ? navigation::GoalChange::kMoved
                                                     : navigation::GoalChange::kNext);
    });
  }

  static int OwnValues(void* navigator, double* values, std::size_t count,
                       rockyard_error* error) noexcept {
    return Guarded(error, [&] { CopyOwnValues(At(navigator).own_values(), values, count); });
  }

  static int Overlay(void* navigator, rockyard_overlay* overlay, rockyard_error* error) noexcept {
    return Guarded(error, [&] {
      const messages::Overlay* shown = At(navigator).overlay();
      if (shown != nullptr) static_cast<Held*>(navigator)->Show(*shown, *overlay);
    });
  }

  static void Destroy(void* navigator) noexcept { delete static_cast<Held*>(navigator); }

  static constexpr rockyard_navigator_type kType{DescribeIt, Traits,    Create,  Decide, OnJump,
                                                 SetGoal,    OwnValues, Overlay, Destroy};
};

/// What ROCKYARD_PLUGIN takes of a navigator.
template <auto Describe, typename Params>
struct TypeOf<Describe, navigation::NavigatorDescription<Params>> : NavigatorType<Describe> {};

}  // namespace layer
}  // namespace rockyard::plugin

/// Makes the library a plugin of navigators, each named by the function that returns its
/// NavigatorDescription. Stands once in a library, outside of all namespaces. ROCKYARD_PLUGIN is
/// the same, and takes estimators and readers beside them.
#define ROCKYARD_NAVIGATORS(...) ROCKYARD_PLUGIN(__VA_ARGS__)
