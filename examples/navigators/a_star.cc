// A* (Hart, Nilsson and Raphael 1968) on the map: after each look the shortest way to the goal is
// searched anew, with ground that nobody has seen taken to be free. On a graph that is sensed
// without error such a rover reaches any goal that can be reached (Koenig, Tovey and Smirnov 2003).
//
// Here steps that the belly would not pass are grown by the room that the rover takes, the way is
// pulled straight as far as that leaves it free, and its first leg is driven. False steps can shut
// the last way: then it gives up. Where a map of the site tells of rocks that nobody has seen yet,
// ways over them count as longer.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <queue>
#include <utility>
#include <vector>

#include "plugin/navigator_plugin.h"
#include "stop_and_look.h"

namespace {

using namespace examples;
using core::Assumed;

struct AStarParams {
  CycleParams cycle;
  double obstacle_share = 0.8;
  double margin_m = 0.1;
  double step_m = 0.3;
  double step_points = 10.0;
  double map_weight = 10.0;

  void Visit(core::FieldVisitor& v) {
    cycle.Visit(v);
    v.Real("obstacle_share", obstacle_share,
           Assumed("height of a step that it goes round, as a share of the belly's clearance",
                   "what the rover cannot straddle, less the noise of points", {0.05, 5.0},
                   {0.5, 1.0}));
    v.Real("margin_m", margin_m,
           Assumed("room on either side of the rover", "one cell of the map", {0.0, 1.0},
                   {0.05, 0.2}));
    v.Real("step_m", step_m,
           Assumed("how far it drives between two looks", "half of a small rover's length",
                   {0.02, 5.0}, {0.15, 0.5}));
    v.Real("step_points", step_points,
           Assumed("points that a cell needs to be a step",
                   "stray points, one or two in a cell, would shut ways far off",
                   {1.0, 1000.0}, {3.0, 20.0}));
    v.Real("map_weight", map_weight,
           Assumed("detour that an unseen metre is worth where the site's map is rocks throughout",
                   "a rock in such a cell costs some rover's lengths", {0.0, 1000.0},
                   {3.0, 30.0}));
  }
};

// Counted by hand: a cell's step from nine heights; a searched cell's eight neighbours and its
// place in the queue.
constexpr double kOpsPerCell = 30.0, kOpsPerSearched = 150.0;

class AStar final : public StopAndLook {
 public:
  AStar(const AStarParams& params, const navigation::NavigatorSetup& setup)
      : StopAndLook(params.cycle, setup), params_(params) {
    own_ = {0.0};
    if (setup.site_map) GrowRocks(*setup.site_map);
  }

 private:
  Move Plan(const Pose& here, const Pose& goal) override {
    x0_ = map_.Index(here.x_m) - side_ / 2;
    y0_ = map_.Index(here.y_m) - side_ / 2;
    Grow(here);
    const double searched = own_[0];
    way_ = Search(goal);
    Move move;
    if (!way_.empty()) {
      const Place leg = Leg(here, goal);
      const double x_m = leg.x_m - here.x_m, y_m = leg.y_m - here.y_m;
      move = Towards(here, std::atan2(y_m, x_m), std::min(params_.step_m, Length(x_m, y_m)));
    }
    move.work_ops = kOpsPerCell * static_cast<double>(blocked_.size()) + kOpsPerSearched * (own_[0] - searched);
    return move;
  }

  /// Stray points stand high far away: a few of them are no step yet.
  bool IsStep(std::int64_t ix, std::int64_t iy) const {
    const Cell* cell = map_.Find(ix, iy);
    if (cell == nullptr || !(cell->felt || cell->points >= params_.step_points)) return false;
    return map_.Step_m(ix, iy) > params_.obstacle_share * rover_.belly_clearance_m;
  }

  /// Marks the cells that the rover's middle cannot be in. It has room where it stands.
  void Grow(const Pose& here) {
    const double room_m = Room_m();
    const auto reach = static_cast<std::int64_t>(room_m / map_.cell_m());
    blocked_.assign(static_cast<std::size_t>(side_ * side_), false);
    for (std::size_t slot = 0; slot < blocked_.size(); ++slot) {
      const std::int64_t i = Column(slot), j = Row(slot);
      if (!IsStep(x0_ + i, y0_ + j)) continue;
      const Place step = Middle(slot);
      for (std::int64_t v = std::max<std::int64_t>(0, j - reach); v <= j + reach && v < side_; ++v) {
        for (std::int64_t u = std::max<std::int64_t>(0, i - reach); u <= i + reach && u < side_; ++u) {
          const Place at = Middle(Slot(u, v));
          const bool stands = Length(at.x_m - here.x_m, at.y_m - here.y_m) <= room_m;
          if (stands ? Slot(u, v) == slot : Length(at.x_m - step.x_m, at.y_m - step.y_m) <= room_m) {
            blocked_[Slot(u, v)] = true;
          }
        }
      }
    }
    blocked_[Start()] = false;
  }

  /// Returns the cells of the shortest way from the rover's to the goal's; empty where there is
  /// none. Where the goal lies beyond the grid, the way ends at the edge.
  std::vector<std::size_t> Search(const Pose& goal) {
    std::vector<double> way_m(blocked_.size(), std::numeric_limits<double>::infinity());
    std::vector<std::size_t> from(blocked_.size(), Start());
    using Open = std::pair<double, std::size_t>;  // by what the whole way is at least
    std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
    const auto left_m = [&](std::size_t slot) {
      const Place at = Middle(slot);
      return Length(goal.x_m - at.x_m, goal.y_m - at.y_m);
    };
    const Place first = Middle(0), last = Middle(blocked_.size() - 1);
    const bool beyond = goal.x_m < first.x_m || goal.y_m < first.y_m || goal.x_m > last.x_m ||
                        goal.y_m > last.y_m;
    const double near_m = std::max(0.5 * params_.cycle.goal_tolerance_m, map_.cell_m());
    way_m[Start()] = 0.0;
    open.emplace(left_m(Start()), Start());
    while (!open.empty()) {
      const auto [whole_m, slot] = open.top();
      open.pop();
      if (whole_m > way_m[slot] + left_m(slot)) continue;  // a shorter way was found since
      own_[0] += 1.0;
      const std::int64_t i = Column(slot), j = Row(slot);
      const bool edge = i == 0 || j == 0 || i == side_ - 1 || j == side_ - 1;
      if (beyond ? edge : left_m(slot) <= near_m) {
        std::vector<std::size_t> way{slot};
        while (way.back() != Start()) way.push_back(from[way.back()]);
        return {way.rbegin(), way.rend()};
      }
      for (std::int64_t v = std::max<std::int64_t>(0, j - 1); v <= j + 1 && v < side_; ++v) {
        for (std::int64_t u = std::max<std::int64_t>(0, i - 1); u <= i + 1 && u < side_; ++u) {
          const std::size_t beside = Slot(u, v);
          const double cells = Length(static_cast<double>(u - i), static_cast<double>(v - j));
          if (blocked_[beside]) continue;
          const double longer = 1.0 + params_.map_weight * RockShare(beside);
          const double reached_m = way_m[slot] + map_.cell_m() * cells * longer;
          if (reached_m >= way_m[beside]) continue;
          way_m[beside] = reached_m;
          from[beside] = slot;
          open.emplace(reached_m + left_m(beside), beside);
        }
      }
    }
    return {};
  }

  /// Gives each cell of the site's map the largest share of rocks in the rover's room around it.
  void GrowRocks(const messages::SiteMap& site) {
    if (site.rock_share.empty()) return;
    site_ = site;
    side_ = 2 * GroundMap::kSide;
    const int reach = static_cast<int>(std::ceil(Room_m() / site.step_m));
    for (int y = 0; y < site.ny; ++y) {
      for (int x = 0; x < site.nx; ++x) {
        double& share = site_.rock_share[site.Index(x, y)];
        for (int v = std::max(0, y - reach); v <= std::min(site.ny - 1, y + reach); ++v) {
          for (int u = std::max(0, x - reach); u <= std::min(site.nx - 1, x + reach); ++u) {
            if (Length(u - x, v - y) * site.step_m > Room_m()) continue;
            share = std::max(share, site.rock_share[site.Index(u, v)]);
          }
        }
      }
    }
  }

  /// Returns what the site's map says of rocks near ground that is not seen well yet.
  double RockShare(std::size_t slot) const {
    if (site_.rock_share.empty()) return 0.0;
    const Cell* cell = map_.Find(x0_ + Column(slot), y0_ + Row(slot));
    if (cell != nullptr && cell->points >= params_.step_points) return 0.0;
    const messages::Goal at = Told({Middle(slot).x_m, Middle(slot).y_m});
    const double x = std::floor((at.x_m - site_.x0_m) / site_.step_m);
    const double y = std::floor((at.y_m - site_.y0_m) / site_.step_m);
    if (!(x >= 0.0 && y >= 0.0 && x < site_.nx && y < site_.ny)) return 0.0;
    return site_.rock_share[site_.Index(static_cast<int>(x), static_cast<int>(y))];
  }

  /// Returns the farthest place of the way that the rover can drive straight to.
  Place Leg(const Pose& here, const Pose& goal) const {
    if (way_.size() == 1) return {goal.x_m, goal.y_m};
    std::size_t last = 1;
    while (last + 1 < way_.size() && IsFree(here, Middle(way_[last + 1]))) ++last;
    return Middle(way_[last]);
  }
  bool IsFree(const Pose& here, const Place& to) const {
    const double x_m = to.x_m - here.x_m, y_m = to.y_m - here.y_m;
    const int checks = static_cast<int>(std::ceil(2.0 * Length(x_m, y_m) / map_.cell_m()));
    for (int i = 1; i <= checks; ++i) {
      const std::int64_t u = map_.Index(here.x_m + x_m * i / checks) - x0_;
      const std::int64_t v = map_.Index(here.y_m + y_m * i / checks) - y0_;
      if (blocked_[Slot(u, v)] || RockShare(Slot(u, v)) > 0.0) return false;
    }
    return true;
  }

  double Room_m() const { return 0.5 * rover_.width_m + params_.margin_m; }
  std::size_t Slot(std::int64_t i, std::int64_t j) const {
    return static_cast<std::size_t>(j * side_ + i);
  }
  std::int64_t Column(std::size_t slot) const { return static_cast<std::int64_t>(slot) % side_; }
  std::int64_t Row(std::size_t slot) const { return static_cast<std::int64_t>(slot) / side_; }
  std::size_t Start() const { return Slot(side_ / 2, side_ / 2); }
  Place Middle(std::size_t slot) const {
    return {map_.cell_m() * (static_cast<double>(x0_ + Column(slot)) + 0.5),
            map_.cell_m() * (static_cast<double>(y0_ + Row(slot)) + 0.5)};
  }

  void OnOtherWay() override { way_.clear(); }

  void Show(messages::Overlay& overlay) const override {
    messages::OverlayLine line{.name = "way", .points = {}};
    for (const std::size_t slot : way_) {
      const Place at = Middle(slot);
      line.points.push_back(Told({at.x_m, at.y_m}));
    }
    overlay.lines.push_back(std::move(line));
    ShowSteps(params_.obstacle_share * rover_.belly_clearance_m, overlay);
  }

  const AStarParams params_;
  messages::SiteMap site_;  // its rocks grown
  std::int64_t side_ = GroundMap::kSide;  // of the grid: what is remembered, or told of a site
  std::int64_t x0_ = 0, y0_ = 0;   // the grid's first cell
  std::vector<bool> blocked_;      // row by row
  std::vector<std::size_t> way_;   // of the last plan
};

navigation::NavigatorDescription<AStarParams> DescribeAStar() {
  return {.name = "a_star",
          .doc = "A* on the map, with unseen ground free (Hart, Nilsson and Raphael 1968)",
          .traits = [](const AStarParams& params) { return params.cycle.Traits(); },
          .make = [](const AStarParams& params, const navigation::NavigatorSetup& setup)
              -> std::unique_ptr<navigation::Navigator> {
            return std::make_unique<AStar>(params, setup);
          },
          .own_values = {{"searched_cells", "1", "Cells that its searches went through."}}};
}

}  // namespace

ROCKYARD_NAVIGATORS(DescribeAStar)
