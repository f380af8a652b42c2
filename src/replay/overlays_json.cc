// What the navigator shows, as a member of the JSON of a replay page (payload_text.h declares the
// function).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "replay/payload_text.h"

namespace rockyard::replay {
namespace {

using core::JsonList;
using core::JsonObject;

constexpr double kPointDigits = 1e3;  // of points: millimetres
constexpr double kFullValue = 255.0;
constexpr int kUnknownValue = -1;

std::string PointText(const messages::Goal& p) {
  return JsonList(std::array{Rounded(p.x_m, kPointDigits), Rounded(p.y_m, kPointDigits)});
}

// A point that is none is left out: its line goes on to the next one.
std::string LineText(const messages::OverlayLine& line) {
  std::vector<std::string> points;
  points.reserve(line.points.size());
  for (const messages::Goal& p : line.points) {
    if (std::isfinite(p.x_m) && std::isfinite(p.y_m)) points.push_back(PointText(p));
  }
  return JsonObject().AddText("name", line.name).Add("points", JsonList(points)).Text();
}

std::string ValueText(double value) {
  if (std::isnan(value)) return std::to_string(kUnknownValue);
  return std::to_string(std::lround(kFullValue * std::clamp(value, 0.0, 1.0)));
}

std::string GridText(const messages::OverlayGrid& grid) {
  return JsonObject()
      .AddText("name", grid.name)
      .Add("x0", Length(grid.x0_m))
      .Add("y0", Length(grid.y0_m))
      .AddNumber("step", grid.step_m)
      .AddInteger("nx", grid.nx)
      .AddInteger("ny", grid.ny)
      .Add("values", JsonList(grid.values, ValueText))
      .Text();
}

std::string OverlayText(const ReplayOverlay& overlay) {
  return JsonObject()
      .Add("t", Length(overlay.time_s))
      .Add("pose", PoseText(overlay.pose))
      .Add("believed", PoseText(overlay.believed))
      .Add("lines", JsonList(overlay.shown.lines, LineText))
      .Add("grids", JsonList(overlay.shown.grids, GridText))
      .Text();
}

// Returns the size of every `stride`-th text.
std::size_t BytesOf(std::span<const std::string> texts, std::size_t stride) {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < texts.size(); i += stride) bytes += texts[i].size();
  return bytes;
}

}  // namespace

std::string OverlaysJson(std::span<const ReplayOverlay> overlays, std::size_t every) {
  if (overlays.empty()) return "null";
  std::vector<std::string> texts;
  texts.reserve(overlays.size());
  for (const ReplayOverlay& overlay : overlays) texts.push_back(OverlayText(overlay));
  std::size_t stride = 1;
  while (stride < texts.size() && BytesOf(texts, stride) > kMaxOverlayBytes) ++stride;
  std::vector<std::string> shown;
  if (BytesOf(texts, stride) <= kMaxOverlayBytes) {
    for (std::size_t i = 0; i < texts.size(); i += stride) shown.push_back(std::move(texts[i]));
  }
  return JsonObject()
      .AddInteger("every", static_cast<std::int64_t>(every * stride))
      .Add("shown", JsonList(shown))
      .Text();
}

}  // namespace rockyard::replay
