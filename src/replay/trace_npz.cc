#include "replay/trace_npz.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "replay/npz_file.h"
#include "replay/payload_text.h"

namespace rockyard::replay {
namespace {

// A two-dimensional array of numbers, filled row by row.
class NpzTable {
 public:
  explicit NpzTable(std::size_t columns) : columns_(columns) {}

  template <typename Values>
  void Add(const Values& values) {
    for (const double value : values) numbers_.push_back(value);
  }
  void Add(const math::Pose2& pose) { Add(std::array{pose.x_m, pose.y_m, pose.heading_rad}); }

  void Write(std::string_view name, NpzFile& file) const {
    file.AddReals(name, numbers_, {numbers_.size() / columns_, columns_});
  }

 private:
  std::size_t columns_;
  std::vector<double> numbers_;
};

// Adds an array with one number for each item.
template <typename Items, typename Value>
void AddColumn(std::string_view name, const Items& items, const Value& value, NpzFile& file) {
  std::vector<double> numbers;
  numbers.reserve(items.size());
  for (const auto& item : items) numbers.push_back(value(item));
  file.AddReals(name, numbers, {numbers.size()});
}

using core::JsonObject;

using messages::MapCellView;
using messages::MotionVote;
using messages::SplineVote;

// The version of the arrays, as README.md of this folder lists them; other programs read them by
// name.
constexpr int kFormatVersion = 1;
constexpr std::int64_t kUnknownCell = -1;

void AddMoments(std::span<const ReplayPose> poses, NpzFile& file) {
  NpzTable position(3);
  NpzTable attitude(4);
  NpzTable rocker(2);
  NpzTable bogie(2);
  NpzTable steer(messages::kWheelCount);
  NpzTable wheel(messages::kWheelCount);
  NpzTable believed(4);
  std::vector<std::string> activity;
  std::vector<std::uint8_t> set_back;
  for (const ReplayPose& pose : poses) {
    const truth::RoverPosture& posture = pose.sample.posture;
    const messages::PoseEstimate& estimate = pose.sample.estimate;
    const Eigen::Quaterniond q(posture.X_WR.linear());
    const math::Vector3 p = posture.X_WR.translation();
    position.Add(std::array{p.x(), p.y(), p.z()});
    attitude.Add(std::array{q.w(), q.x(), q.y(), q.z()});
    rocker.Add(std::array{posture.left_rocker_rad, posture.right_rocker_rad});
    bogie.Add(std::array{posture.left_bogie_rad, posture.right_bogie_rad});
    steer.Add(posture.steer_rad);
    wheel.Add(posture.wheel_angle_rad);
    believed.Add(std::array{estimate.x_m, estimate.y_m, estimate.heading_rad, estimate.distance_m});
    activity.push_back(pose.sample.activity);
    set_back.push_back(pose.set_back ? 1 : 0);
  }
  AddColumn(
      "time_s", poses, [](const ReplayPose& p) { return p.sample.time_s; }, file);
  position.Write("position_m", file);
  attitude.Write("attitude_wxyz", file);
  AddColumn(
      "heading_rad", poses, [](const ReplayPose& p) { return p.sample.pose.heading_rad; }, file);
  AddColumn(
      "tilt_rad", poses, [](const ReplayPose& p) { return p.sample.tilt_rad; }, file);
  rocker.Write("rocker_rad", file);
  bogie.Write("bogie_rad", file);
  steer.Write("steer_rad", file);
  wheel.Write("wheel_angle_rad", file);
  believed.Write("believed", file);
  file.AddTexts("activity", activity);
  file.AddFlags("set_back", set_back, {set_back.size()});
}

void AddEvents(const truth::Trace& trace, NpzFile& file) {
  NpzTable pose(3);
  std::vector<std::string> kind;
  std::vector<std::string> detail;
  for (const truth::TraceEvent& event : trace.events) {
    pose.Add(event.pose);
    kind.push_back(event.kind);
    detail.push_back(event.detail);
  }
  AddColumn(
      "event_time_s", trace.events, [](const auto& event) { return event.time_s; }, file);
  pose.Write("event_pose", file);
  file.AddTexts("event_kind", kind);
  file.AddTexts("event_detail", detail);
  NpzTable moves(5);
  for (const truth::RockMove& move : trace.rock_moves) {
    moves.Add(std::array{move.time_s, static_cast<double>(move.rock), move.center_W.x(),
                         move.center_W.y(), move.center_W.z()});
  }
  moves.Write("rock_moves", file);
}

void AddScans(std::span<const ReplayScan> scans, NpzFile& file) {
  NpzTable pose(3);
  NpzTable points(6);
  std::vector<std::uint8_t> hazards;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    pose.Add(scans[i].pose);
    for (const bool hazard : scans[i].hazards) hazards.push_back(hazard ? 1 : 0);
    for (const StripePoint& point : scans[i].points) {
      points.Add(std::array{static_cast<double>(i), point.p_W.x(), point.p_W.y(), point.p_W.z(),
                            static_cast<double>(point.stripe), point.height_m});
    }
  }
  const std::size_t stripes = scans.empty() ? 0 : scans.front().hazards.size();
  AddColumn(
      "scan_time_s", scans, [](const ReplayScan& scan) { return scan.time_s; }, file);
  pose.Write("scan_pose", file);
  file.AddFlags("scan_hazards", hazards, {scans.size(), stripes});
  points.Write("scan_points", file);
}

// The arrays of every candidate motion of every step.
class Votes {
 public:
  void Add(std::size_t step, const messages::NavigationView& view) {
    for (const MotionVote& vote : view.forward) Add(step, "forward", vote);
    for (const MotionVote& vote : view.backward) Add(step, "backward", vote);
    for (const MotionVote& vote : view.point_turns) Add(step, "turn", vote);
  }

  void Write(NpzFile& file) const {
    file.AddIntegers("vote_step", step_, {step_.size()});
    file.AddTexts("vote_kind", kind_);
    numbers_.Write("vote", file);
    file.AddFlags("vote_chosen", chosen_, {chosen_.size()});
  }

 private:
  void Add(std::size_t step, const char* kind, const MotionVote& vote) {
    step_.push_back(static_cast<std::int64_t>(step));
    kind_.emplace_back(kind);
    numbers_.Add(std::array{vote.motion.curvature_per_m, static_cast<double>(vote.motion.direction),
                            vote.hazard, vote.hazard_certainty, vote.waypoint, vote.merged});
    chosen_.push_back(vote.chosen ? 1 : 0);
  }

  std::vector<std::int64_t> step_;
  std::vector<std::string> kind_;
  NpzTable numbers_{6};
  std::vector<std::uint8_t> chosen_;
};

// The arrays of every spline of every step, for navigators that steer while they drive.
class Splines {
 public:
  void Add(std::size_t step, const messages::NavigationView& view) {
    const messages::PoseEstimate& start = view.spline_start;
    start_.Add(math::Pose2{start.x_m, start.y_m, start.heading_rad});
    for (const SplineVote& vote : view.splines) Add(step, vote);
  }

  void Write(NpzFile& file) const {
    start_.Write("spline_start", file);
    file.AddIntegers("spline_step", step_, {step_.size()});
    knots_.Write("spline", file);
    votes_.Write("spline_vote", file);
    file.AddFlags("spline_feasible", feasible_, {feasible_.size()});
    file.AddFlags("spline_chosen", chosen_, {chosen_.size()});
  }

 private:
  void Add(std::size_t step, const SplineVote& vote) {
    const messages::Spline& spline = vote.spline;
    step_.push_back(static_cast<std::int64_t>(step));
    knots_.Add(std::array{spline.start_per_m, spline.first_knot_per_m, spline.second_knot_per_m,
                          spline.length_m});
    votes_.Add(std::array{vote.hazard, vote.hazard_certainty, vote.waypoint, vote.merged});
    feasible_.push_back(vote.feasible ? 1 : 0);
    chosen_.push_back(vote.chosen ? 1 : 0);
  }

  NpzTable start_{3};
  std::vector<std::int64_t> step_;
  NpzTable knots_{4};
  NpzTable votes_{4};
  std::vector<std::uint8_t> feasible_;
  std::vector<std::uint8_t> chosen_;
};

void AddMaps(std::span<const ReplayStep> steps, NpzFile& file) {
  NpzTable grid(4);
  std::vector<double> elevation;
  std::vector<std::int64_t> goodness;
  std::vector<std::int64_t> certainty;
  for (const ReplayStep& step : steps) {
    const messages::MapView& map = step.view.map;
    grid.Add(std::array{map.x0_m, map.y0_m, map.xstep_m, map.ystep_m});
    for (const MapCellView& cell : map.cells) {
      elevation.push_back(cell.has_data ? cell.elevation_m
                                        : std::numeric_limits<double>::quiet_NaN());
      goodness.push_back(cell.known ? std::int64_t{cell.goodness} : kUnknownCell);
      certainty.push_back(cell.known ? std::int64_t{cell.certainty} : kUnknownCell);
    }
  }
  // Must hold: the maps of a trial have one size, or they would be no array.
  NpzFile::Shape shape{steps.size(), 0, 0};
  if (!steps.empty()) {
    shape[1] = static_cast<std::size_t>(steps.front().view.map.ny);
    shape[2] = static_cast<std::size_t>(steps.front().view.map.nx);
  }
  grid.Write("map_grid", file);
  file.AddReals("map_elevation_m", elevation, shape);
  file.AddIntegers("map_goodness", goodness, shape);
  file.AddIntegers("map_certainty", certainty, shape);
}

void AddSteps(std::span<const ReplayStep> steps, NpzFile& file) {
  NpzTable pose(3);
  NpzTable believed(3);
  std::vector<std::int64_t> number;
  std::vector<std::uint8_t> behind;
  Votes votes;
  Splines splines;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const messages::NavigationView& view = steps[i].view;
    pose.Add(steps[i].pose);
    believed.Add(math::Pose2{view.estimate.x_m, view.estimate.y_m, view.estimate.heading_rad});
    number.push_back(view.step);
    behind.push_back(view.looked_behind ? 1 : 0);
    votes.Add(i, view);
    splines.Add(i, view);
  }
  AddColumn(
      "step_time_s", steps, [](const ReplayStep& step) { return step.time_s; }, file);
  file.AddIntegers("step_number", number, {number.size()});
  pose.Write("step_pose", file);
  believed.Write("step_believed", file);
  file.AddFlags("step_behind", behind, {behind.size()});
  votes.Write(file);
  splines.Write(file);
  AddMaps(steps, file);
}

// Points and values of all overlays follow one another, as lines and grids differ in size; lines
// name their overlay, and points their line.
void AddOverlays(std::span<const ReplayOverlay> overlays, NpzFile& file) {
  NpzTable pose(3);
  NpzTable believed(3);
  std::vector<std::int64_t> line_overlay;
  std::vector<std::string> line_name;
  NpzTable points(3);
  std::vector<std::string> grid_name;
  NpzTable grids(6);
  std::vector<double> values;
  for (std::size_t i = 0; i < overlays.size(); ++i) {
    pose.Add(overlays[i].pose);
    believed.Add(overlays[i].believed);
    for (const messages::OverlayLine& line : overlays[i].shown.lines) {
      const auto number = static_cast<double>(line_name.size());
      line_overlay.push_back(static_cast<std::int64_t>(i));
      line_name.push_back(line.name);
      for (const messages::Goal& p : line.points) points.Add(std::array{number, p.x_m, p.y_m});
    }
    for (const messages::OverlayGrid& grid : overlays[i].shown.grids) {
      grid_name.push_back(grid.name);
      grids.Add(std::array{static_cast<double>(i), grid.x0_m, grid.y0_m, grid.step_m,
                           static_cast<double>(grid.nx), static_cast<double>(grid.ny)});
      values.insert(values.end(), grid.values.begin(), grid.values.end());
    }
  }
  AddColumn(
      "overlay_time_s", overlays, [](const ReplayOverlay& overlay) { return overlay.time_s; },
      file);
  pose.Write("overlay_pose", file);
  believed.Write("overlay_believed", file);
  file.AddIntegers("overlay_line", line_overlay, {line_overlay.size()});
  file.AddTexts("overlay_line_name", line_name);
  points.Write("overlay_points", file);
  grids.Write("overlay_grid", file);
  file.AddTexts("overlay_grid_name", grid_name);
  file.AddReals("overlay_values", values, {values.size()});
}

void AddRecord(const truth::TracedTrial& traced, NpzFile& file) {
  const std::size_t columns = std::min(traced.schema.size(), traced.record.values.size());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < columns; ++i) names.push_back(traced.schema[i].name);
  file.AddTexts("record_names", names);
  const std::vector<double> values(traced.record.values.begin(), traced.record.values.end());
  file.AddReals("record", std::span(values).first(columns), {columns});
}

std::string MetaText(const TraceArrays& arrays) {
  const truth::TracedTrial& traced = arrays.traced;
  return JsonObject()
      .AddText("format", "rockyard trace")
      .AddInteger("version", kFormatVersion)
      .AddText("scenario", traced.scenario)
      .AddText("cell", arrays.cell)
      .AddText("seed", std::to_string(traced.seed))
      .AddInteger("trial", static_cast<std::int64_t>(traced.record.trial))
      .AddText("outcome", truth::Name(traced.record.outcome))
      .AddText("detail", traced.record.detail)
      .AddText("record_hash", arrays.record_hash)
      .AddInteger("overlay_every", static_cast<std::int64_t>(arrays.overlay_every))
      .Add("provenance", ProvenanceText(arrays.provenance))
      .Text();
}

}  // namespace

std::string TraceNpz(const TraceArrays& arrays) {
  NpzFile file;
  file.AddText("meta", MetaText(arrays));
  AddRecord(arrays.traced, file);
  AddMoments(arrays.poses, file);
  AddEvents(arrays.traced.trace, file);
  AddScans(arrays.scans, file);
  AddSteps(arrays.steps, file);
  AddOverlays(arrays.overlays, file);
  return file.Bytes();
}

}  // namespace rockyard::replay
