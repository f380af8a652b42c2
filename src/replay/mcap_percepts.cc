// What the rover sees and decides, what its navigator shows, and what happens to it, as messages of
// a trace in MCAP (mcap_messages.h declares the function).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "replay/mcap_messages.h"

namespace rockyard::replay {
namespace {

using core::JsonList;
using math::Vector3;
using messages::MotionVote;

constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();
constexpr double kUnrated = -1.0;
constexpr double kOverlayLift_m = 0.015;
constexpr double kOverlayWidth_px = 3.0;
// Lines of one name have one colour.
constexpr std::array kOverlayColours{Colour{0.42, 0.3, 0.9},  Colour{0.45, 0.7, 0.1},
                                     Colour{0.0, 0.65, 0.7},  Colour{0.75, 0.25, 0.85},
                                     Colour{0.85, 0.65, 0.1}, Colour{0.5, 0.58, 0.65}};

std::string CloudJson(double time_s, const PackedRows& rows) {
  return ObjectJson("timestamp", TimeJson(time_s), "frame_id", core::QuoteJson(kWorldFrame), "pose",
                    PlaceJson(Vector3::Zero()), "point_stride", rows.stride_bytes(), "fields",
                    rows.fields(), "data", rows.data());
}

// Returns a grid of nx columns whose lower corner is at `corner`.
std::string GridJson(double time_s, const Vector3& corner, const Eigen::Vector2d& cell_m, int nx,
                     const PackedRows& cells) {
  return ObjectJson("timestamp", TimeJson(time_s), "frame_id", core::QuoteJson(kWorldFrame), "pose",
                    PlaceJson(corner), "column_count", std::int64_t{nx}, "cell_size",
                    ObjectJson("x", cell_m.x(), "y", cell_m.y()), "row_stride",
                    nx * cells.stride_bytes(), "cell_stride", cells.stride_bytes(), "fields",
                    cells.fields(), "data", cells.data());
}

void AddScan(const ReplayScan& scan, McapMessages& to) {
  PackedRows rows({"x", "y", "z", "stripe", "height", "hazard"});
  for (const StripePoint& point : scan.points) {
    rows.Add({point.p_W.x(), point.p_W.y(), point.p_W.z(), static_cast<double>(point.stripe),
              point.height_m, scan.hazards[point.stripe] ? 1.0 : 0.0});
  }
  to.push_back({"/scan", "foxglove.PointCloud", scan.time_s, CloudJson(scan.time_s, rows)});
}

std::string VoteJson(std::string_view kind, const MotionVote& vote) {
  const double curvature = kind == "turn" ? vote.motion.direction : vote.motion.curvature_per_m;
  return ObjectJson("kind", core::QuoteJson(kind), "curvature", curvature, "hazard", vote.hazard,
                    "certainty", vote.hazard_certainty, "waypoint", vote.waypoint, "merged",
                    vote.merged, "chosen", vote.chosen);
}

// The map lies as high as the rover stood: a height of its own it has not, and the ground does not
// hide it there.
void AddStep(const ReplayStep& step, double height_m, McapMessages& to) {
  const messages::NavigationView& view = step.view;
  const messages::MapView& map = view.map;
  PackedRows cells({"goodness", "certainty", "elevation"});
  for (const messages::MapCellView& cell : map.cells) {
    cells.Add({cell.known ? cell.goodness : kUnrated, cell.known ? cell.certainty : kUnrated,
               cell.has_data ? cell.elevation_m : kUnseen});
  }
  to.push_back({"/map", "foxglove.Grid", step.time_s,
                GridJson(step.time_s, {map.x0_m, map.y0_m, height_m}, {map.xstep_m, map.ystep_m},
                         map.nx, cells)});
  std::vector<std::string> votes;
  const auto add = [&](std::string_view kind, const std::vector<MotionVote>& some) {
    for (const MotionVote& vote : some) votes.push_back(VoteJson(kind, vote));
  };
  add("forward", view.forward);
  add("backward", view.backward);
  add("turn", view.point_turns);
  to.push_back({"/votes", "rockyard.Votes", step.time_s,
                ObjectJson("timestamp", TimeJson(step.time_s), "step", view.step, "behind",
                           view.looked_behind, "votes", JsonList(votes))});
  if (step.points_W.empty()) return;
  PackedRows points({"x", "y", "z"});
  for (const Vector3& p_W : step.points_W) points.Add({p_W.x(), p_W.y(), p_W.z()});
  to.push_back({"/look", "foxglove.PointCloud", step.time_s, CloudJson(step.time_s, points)});
}

void AddPictures(const ReplayLook& look, McapMessages& to) {
  const auto add = [&](const char* topic, const std::string& png) {
    to.push_back(
        {topic, "foxglove.CompressedImage", look.time_s,
         ObjectJson("timestamp", TimeJson(look.time_s), "frame_id", core::QuoteJson(kRoverFrame),
                    "data", core::QuoteJson(png), "format", R"("png")")});
  };
  add("/camera/left", look.left_png);
  add("/camera/disparity", look.disparity_png);
}

std::vector<std::string> LineNames(std::span<const ReplayOverlay> overlays) {
  std::vector<std::string> names;  // in the order in which they appear
  for (const ReplayOverlay& overlay : overlays) {
    for (const messages::OverlayLine& line : overlay.shown.lines) {
      if (std::find(names.begin(), names.end(), line.name) == names.end()) {
        names.push_back(line.name);
      }
    }
  }
  return names;
}

// A point that is none is left out: its line goes on to the next one.
std::string OverlayLineJson(const messages::OverlayLine& line, double height_m,
                            const Colour& colour) {
  std::vector<std::string> points;
  for (const messages::Goal& p : line.points) {
    if (std::isfinite(p.x_m) && std::isfinite(p.y_m)) {
      points.push_back(VectorJson({p.x_m, p.y_m, 0.0}));
    }
  }
  return LineStripJson(JsonList(points), height_m + kOverlayLift_m, kOverlayWidth_px, colour);
}

// Adds lines as entities, one a name. Names come and go: each message takes away what the one
// before showed.
void AddOverlayLines(const ReplayOverlay& overlay, const std::vector<std::string>& names,
                     double height_m, McapMessages& to) {
  constexpr std::int64_t kAll = 1;  // of foxglove.SceneEntityDeletionType
  const std::string deletion =
      ObjectJson("timestamp", TimeJson(overlay.time_s), "type", kAll, "id", R"("")");
  std::vector<std::string> entities;
  for (std::size_t i = 0; i < names.size(); ++i) {
    SceneParts parts;
    for (const messages::OverlayLine& line : overlay.shown.lines) {
      if (line.name != names[i]) continue;
      parts.lines.push_back(
          OverlayLineJson(line, height_m, kOverlayColours.at(i % kOverlayColours.size())));
    }
    if (parts.lines.empty()) continue;
    entities.push_back(EntityJson(overlay.time_s, kWorldFrame, names[i], parts));
  }
  AddSceneUpdate("/scene/overlay", overlay.time_s, entities, to, "[" + deletion + "]");
}

void AddOverlayGrids(const ReplayOverlay& overlay, double height_m, McapMessages& to) {
  for (const messages::OverlayGrid& grid : overlay.shown.grids) {
    PackedRows cells({"value"});
    for (const double value : grid.values) cells.Add({value});
    to.push_back({"/overlay/" + grid.name, "foxglove.Grid", overlay.time_s,
                  GridJson(overlay.time_s, {grid.x0_m, grid.y0_m, height_m},
                           {grid.step_m, grid.step_m}, grid.nx, cells)});
  }
}

void AddEvent(const truth::TraceEvent& event, bool arrived, McapMessages& to) {
  constexpr std::array<std::string_view, 5> kTrouble{"hazard", "felt", "scrape", "stall",
                                                     "reflection"};
  // Of foxglove.LogLevel.
  constexpr std::int64_t kInfo = 2;
  constexpr std::int64_t kWarning = 3;
  constexpr std::int64_t kError = 4;
  constexpr std::int64_t kNoLine = 0;
  const bool trouble = std::find(kTrouble.begin(), kTrouble.end(), event.kind) != kTrouble.end();
  const std::int64_t level =
      event.kind == "end" && !arrived ? kError : (trouble ? kWarning : kInfo);
  to.push_back({"/events", "foxglove.Log", event.time_s,
                ObjectJson("timestamp", TimeJson(event.time_s), "level", level, "message",
                           core::QuoteJson(event.detail), "name", core::QuoteJson(event.kind),
                           "file", R"("")", "line", kNoLine)});
}

}  // namespace

void AddPerceptMessages(const ReplayData& data, McapMessages& to) {
  const auto height = [&](double time_s) { return StandingHeight(data.poses, time_s); };
  for (const ReplayScan& scan : data.scans) AddScan(scan, to);
  for (const ReplayStep& step : data.steps) AddStep(step, height(step.time_s), to);
  for (const ReplayLook& look : data.looks) AddPictures(look, to);
  const std::vector<std::string> names = LineNames(data.overlays);
  for (const ReplayOverlay& overlay : data.overlays) {
    if (!names.empty()) AddOverlayLines(overlay, names, height(overlay.time_s), to);
    AddOverlayGrids(overlay, height(overlay.time_s), to);
  }
  const bool arrived = data.record.outcome == truth::TrialOutcome::kGoalReached;
  for (const truth::TraceEvent& event : data.events) AddEvent(event, arrived, to);
}

}  // namespace rockyard::replay
