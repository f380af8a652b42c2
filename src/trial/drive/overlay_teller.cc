#include "trial/drive/overlay_teller.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <string>
#include <utility>

namespace rockyard::trial {
namespace {

using messages::Goal;
using messages::Overlay;
using messages::OverlayGrid;
using messages::OverlayLine;

bool SameLine(const OverlayLine& a, const OverlayLine& b) {
  return a.name == b.name &&
         std::ranges::equal(a.points, b.points, [](const Goal& p, const Goal& q) {
           return p.x_m == q.x_m && p.y_m == q.y_m;
         });
}

// What is not known in both is the same in both, though NaN is no number.
bool SameGrid(const OverlayGrid& a, const OverlayGrid& b) {
  const auto same = [](double p, double q) { return p == q || (std::isnan(p) && std::isnan(q)); };
  return a.name == b.name && a.x0_m == b.x0_m && a.y0_m == b.y0_m && a.step_m == b.step_m &&
         a.nx == b.nx && a.ny == b.ny && std::ranges::equal(a.values, b.values, same);
}

bool SameOverlay(const Overlay& a, const Overlay& b) {
  return std::ranges::equal(a.lines, b.lines, SameLine) &&
         std::ranges::equal(a.grids, b.grids, SameGrid);
}

// Returns what keeps a grid from being drawn; "" where nothing does. Those of plugins and processes
// have been held to it before.
std::string ProblemOf(const OverlayGrid& grid) {
  const bool shaped =
      grid.nx >= 0 && grid.ny >= 0 &&
      grid.values.size() == static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny);
  if (shaped && std::isfinite(grid.x0_m) && std::isfinite(grid.y0_m) && grid.step_m > 0.0 &&
      std::isfinite(grid.step_m)) {
    return "";
  }
  return fmt::format("the grid \"{}\" of its overlay has {} values for {} x {} cells of {} m",
                     grid.name, grid.values.size(), grid.nx, grid.ny, grid.step_m);
}

class OverlayTeller {
 public:
  OverlayTeller(OverlayWatcher watch, const World& world)
      : watch_(std::move(watch)), world_(&world) {}

  void operator()(const navigation::Navigator& asked, const navigation::NavigatorInput& input) {
    if (failed_) return;
    const std::string failure = Ask(asked);
    failed_ = !failure.empty();
    if (failed_) now_ = {};
    if (!failed_ && SameOverlay(now_, told_)) return;
    std::swap(told_, now_);
    watch_({input.time_s, world_->state().X_WR, input.estimate, told_, failure});
  }

 private:
  // Sets now_. Returns why it cannot be shown; "" where it can. A picture that fails must not
  // become a fault of the trial: it would be another one than without the watcher.
  std::string Ask(const navigation::Navigator& asked) {
    try {
      const Overlay* shown = asked.overlay();
      now_ = shown == nullptr ? Overlay{} : *shown;
    } catch (const std::exception& error) {
      const std::string text = error.what();
      return text.empty() ? "it said no reason" : text;
    }
    for (const OverlayGrid& grid : now_.grids) {
      if (std::string problem = ProblemOf(grid); !problem.empty()) return problem;
    }
    return "";
  }

  OverlayWatcher watch_;
  const World* world_;
  Overlay now_;
  Overlay told_;
  bool failed_ = false;
};

}  // namespace

navigation::AskedListener TellsOverlays(const OverlayWatcher& watch, const World& world) {
  if (!watch) return {};
  return OverlayTeller(watch, world);
}

}  // namespace rockyard::trial
