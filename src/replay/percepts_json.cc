// What a rover sees and chooses, and what happens to it, as members of the JSON of a replay page
// (payload_text.h declares the functions).
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "replay/payload_text.h"

namespace rockyard::replay {
namespace {

using core::JsonList;
using core::JsonObject;

using messages::MapCellView;
using messages::MotionVote;
using messages::SplineVote;

constexpr double kVoteDigits = 10.0;
constexpr double kCoarseDigits = 1e3;  // of map cells and range points
constexpr int kUnknown = -1;

std::string StripePointText(const StripePoint& point) {
  return JsonObject()
      .Add("x", Length(point.p_W.x()))
      .Add("y", Length(point.p_W.y()))
      .Add("z", Length(point.p_W.z()))
      .AddInteger("stripe", static_cast<std::int64_t>(point.stripe))
      .Add("height", Length(point.height_m))
      .Text();
}

// Returns a map. Without `heights` all elevations are null, which takes next to no room.
std::string MapText(const messages::MapView& map, bool heights) {
  const auto byte = [&](std::uint8_t MapCellView::*member) {
    return JsonList(map.cells, [member](const MapCellView& cell) {
      return std::to_string(cell.known ? int{cell.*member} : kUnknown);
    });
  };
  return JsonObject()
      .Add("x0", Length(map.x0_m))
      .Add("y0", Length(map.y0_m))
      .AddNumber("xstep", map.xstep_m)
      .AddNumber("ystep", map.ystep_m)
      .AddInteger("nx", map.nx)
      .AddInteger("ny", map.ny)
      .Add("goodness", byte(&MapCellView::goodness))
      .Add("certainty", byte(&MapCellView::certainty))
      .Add("elevation", JsonList(map.cells,
                                 [heights](const MapCellView& cell) {
                                   return heights && cell.has_data
                                              ? Rounded(cell.elevation_m, kCoarseDigits)
                                              : std::string("null");
                                 }))
      .Text();
}

std::string VoteText(std::string_view kind, const MotionVote& vote) {
  const bool turn = kind == "turn";
  return JsonObject()
      .AddText("kind", kind)
      .Add("curvature",
           turn ? std::to_string(vote.motion.direction) : Length(vote.motion.curvature_per_m))
      .Add("hazard", Rounded(vote.hazard, kVoteDigits))
      .Add("certainty", Rounded(vote.hazard_certainty, kVoteDigits))
      .Add("waypoint", Rounded(vote.waypoint, kVoteDigits))
      .Add("merged", Rounded(vote.merged, kVoteDigits))
      .AddFlag("chosen", vote.chosen)
      .Text();
}

std::string VotesText(const messages::NavigationView& view) {
  std::vector<std::string> votes;
  for (const MotionVote& vote : view.forward) votes.push_back(VoteText("forward", vote));
  for (const MotionVote& vote : view.backward) votes.push_back(VoteText("backward", vote));
  for (const MotionVote& vote : view.point_turns) votes.push_back(VoteText("turn", vote));
  return JsonList(votes);
}

std::string RangePointText(const math::Vector3& p) {
  return JsonList(std::array{Rounded(p.x(), kCoarseDigits), Rounded(p.y(), kCoarseDigits),
                             Rounded(p.z(), kCoarseDigits)});
}

// Returns splines as one list for each member, as there may be hundreds of splines; "chosen" is the
// index of the chosen one in the lists, or -1.
std::string SplineColumnsText(std::span<const SplineVote> votes) {
  const auto column = [&](const auto& text) { return JsonList(votes, text); };
  const auto curvature = [&](double messages::Spline::*member) {
    return column([member](const SplineVote& vote) { return Length(vote.spline.*member); });
  };
  const auto share = [&](double SplineVote::*member) {
    return column([member](const SplineVote& vote) { return Rounded(vote.*member, 1.0); });
  };
  const auto chosen =
      std::find_if(votes.begin(), votes.end(), [](const SplineVote& vote) { return vote.chosen; });
  return JsonObject()
      .Add("start", curvature(&messages::Spline::start_per_m))
      .Add("first", curvature(&messages::Spline::first_knot_per_m))
      .Add("second", curvature(&messages::Spline::second_knot_per_m))
      .Add("length", curvature(&messages::Spline::length_m))
      .Add("hazard", share(&SplineVote::hazard))
      .Add("certainty", share(&SplineVote::hazard_certainty))
      .Add("waypoint", share(&SplineVote::waypoint))
      .Add("merged", share(&SplineVote::merged))
      .Add("feasible", column([](const SplineVote& vote) {
             return std::string(vote.feasible ? "true" : "false");
           }))
      .AddInteger("chosen", chosen == votes.end() ? -1 : chosen - votes.begin())
      .Text();
}

// Returns all splines of a step; the chosen one alone where the step has no details.
std::string SplinesText(const std::vector<SplineVote>& votes, bool detailed) {
  if (votes.empty()) return "null";
  if (detailed) return SplineColumnsText(votes);
  std::vector<SplineVote> kept;
  for (const SplineVote& vote : votes) {
    if (vote.chosen) kept.push_back(vote);
  }
  return SplineColumnsText(kept);
}

std::string BelievedText(const messages::PoseEstimate& believed) {
  return PoseText({believed.x_m, believed.y_m, believed.heading_rad});
}

std::string StepText(const ReplayStep& step, bool detailed) {
  const std::string look = JsonObject()
                               .Add("t", Length(step.look_time_s))
                               .Add("believed", PoseText(step.look_believed))
                               .Text();
  return JsonObject()
      .Add("t", Length(step.time_s))
      .AddInteger("step", step.view.step)
      .Add("look", look)
      .Add("believed", BelievedText(step.view.estimate))
      .Add("pose", PoseText(step.pose))
      .AddFlag("behind", step.view.looked_behind)
      .Add("map", MapText(step.view.map, detailed))
      .Add("votes", VotesText(step.view))
      .Add("splines", SplinesText(step.view.splines, detailed))
      .Add("spline_start", BelievedText(step.view.spline_start))
      .Add("points", detailed ? JsonList(step.points_W, RangePointText) : "[]")
      .Text();
}

using core::JsonObject;

std::size_t PictureBytes(std::span<const ReplayLook> looks) {
  std::size_t bytes = 0;
  for (const ReplayLook& look : looks) bytes += look.left_png.size() + look.disparity_png.size();
  return bytes;
}

std::string LookText(const ReplayLook& look) {
  return JsonObject()
      .Add("t", Length(look.time_s))
      .AddInteger("number", look.number)
      .AddFlag("behind", look.behind)
      .AddInteger("points", look.points)
      .AddNumber("least", look.least_disparity_px)
      .AddNumber("most", look.most_disparity_px)
      .AddText("left", look.left_png)
      .AddText("disparity", look.disparity_png)
      .Text();
}

}  // namespace

std::string ScansJson(std::span<const ReplayScan> scans) {
  return JsonList(scans, [](const ReplayScan& scan) {
    JsonObject object;
    object.Add("t", Length(scan.time_s));
    return AddPose(object, scan.pose)
        .Add("points", JsonList(scan.points, StripePointText))
        .Add("hazards",
             JsonList(scan.hazards, [](bool hazard) { return hazard ? "true" : "false"; }))
        .Text();
  });
}

std::string StepsJson(std::span<const ReplayStep> steps) {
  const std::size_t every = (steps.size() + kMaxDetailedSteps - 1) / kMaxDetailedSteps;
  std::size_t number = 0;
  return JsonList(steps,
                  [&](const ReplayStep& step) { return StepText(step, number++ % every == 0); });
}

std::string EventsJson(std::span<const truth::TraceEvent> events) {
  return JsonList(events, [](const truth::TraceEvent& event) {
    JsonObject object;
    object.Add("t", Length(event.time_s))
        .AddText("kind", event.kind)
        .AddText("detail", event.detail);
    return AddPose(object, event.pose).Text();
  });
}

std::string EyesJson(std::span<const ReplayLook> looks) {
  if (looks.empty()) return "null";
  const std::size_t every = (PictureBytes(looks) + kMaxLookBytes - 1) / kMaxLookBytes;
  std::vector<std::string> shown;
  std::array<std::size_t, 2> number{};  // of the next look ahead and behind
  for (const ReplayLook& look : looks) {
    if (number.at(look.behind ? 1 : 0)++ % every == 0) shown.push_back(LookText(look));
  }
  return JsonObject()
      .AddInteger("every", static_cast<std::int64_t>(every))
      .Add("looks", core::JsonList(shown))
      .Text();
}

}  // namespace rockyard::replay
