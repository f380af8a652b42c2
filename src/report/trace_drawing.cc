// The drawing of a trial's course, and paths of a trace (trace_view.h).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text.h"
#include "math/angles.h"
#include "report/trace_view.h"
#include "report/xml_text.h"

namespace rockyard::report {
namespace {

using truth::TraceEvent;
using truth::TraceSample;

constexpr std::string_view kTrueColour = "#000";
constexpr std::string_view kBelievedColour = "#b0005a";
constexpr std::string_view kScrapeColour = "#e06000";
constexpr double kMarkSpacing_m = 0.02;
constexpr double kPlanFooter_m = 0.75;  // below the plan: scale, key, title

void Include(double x_m, double y_m, DrawnArea& area) {
  area.x_min_m = std::min(area.x_min_m, x_m);
  area.x_max_m = std::max(area.x_max_m, x_m);
  area.y_min_m = std::min(area.y_min_m, y_m);
  area.y_max_m = std::max(area.y_max_m, y_m);
}

// Collects elements and grows the area by what it draws.
class Canvas {
 public:
  explicit Canvas(const DrawnArea& plan) : drawing_{{}, plan} {}

  void DrawPath(const TracePath& path, std::string_view name, std::string_view style) {
    Write("<g fill=\"none\" {}><title>{}</title>\n", style, name);
    for (const PathPiece& piece : path) {
      if (piece.size() < 2) continue;
      Write("<polyline points=\"");
      for (const math::Pose2& pose : piece) {
        Include(pose.x_m, pose.y_m, drawing_.area);
        Write("{:.3f},{:.3f} ", pose.x_m, -pose.y_m);
      }
      Write("\"/>\n");
    }
    Write("</g>\n");
  }

  void DrawDot(const math::Pose2& at, double radius_m, std::string_view colour,
               std::string_view name) {
    Write("<circle cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{}\" fill=\"{}\"><title>{}</title></circle>\n",
          at.x_m, -at.y_m, radius_m, colour, name);
  }

  void DrawPlus(const math::Pose2& at, std::string_view name) {
    constexpr double kArm_m = 0.05;
    Write("<path d=\"M{:.3f} {:.3f}h{}m{} {}v{}\" stroke=\"{}\" stroke-width=\"0.025\">",
          at.x_m - kArm_m, -at.y_m, 2 * kArm_m, -kArm_m, -kArm_m, 2 * kArm_m, kScrapeColour);
    Write("<title>{}</title></path>\n", name);
  }

  // An arrow head that points along the heading.
  void DrawArrow(const math::Pose2& at, std::string_view colour, std::string_view name) {
    Write(
        "<path transform=\"translate({:.3f} {:.3f}) rotate({:.1f})\" d=\"M0.16 0L-0.1 0.1V-0.1Z\" "
        "fill=\"{}\" fill-opacity=\"0.35\" stroke=\"{}\" stroke-width=\"0.02\">",
        at.x_m, -at.y_m, -math::RadToDeg(at.heading_rad), colour, colour);
    Write("<title>{}</title></path>\n", name);
  }

  void DrawLine(double x_m, double y_m, double length_m, std::string_view style) {
    Write("<line x1=\"{:.3f}\" y1=\"{:.3f}\" x2=\"{:.3f}\" y2=\"{:.3f}\" {}/>\n", x_m, -y_m,
          x_m + length_m, -y_m, style);
  }

  void DrawText(double x_m, double y_m, const std::string& text) {
    Write(
        "<text x=\"{:.3f}\" y=\"{:.3f}\" font-family=\"sans-serif\" font-size=\"0.19\">{}</text>\n",
        x_m, -y_m, text);
  }

  const DrawnArea& area() const { return drawing_.area; }
  void GrowDown(double by_m) { drawing_.area.y_min_m -= by_m; }
  TraceDrawing Take() { return std::move(drawing_); }

 private:
  template <typename... Args>
  void Write(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(drawing_.elements), format, std::forward<Args>(args)...);
  }

  TraceDrawing drawing_;
};

constexpr std::string_view kTrueStyle =
    "stroke=\"#000\" stroke-width=\"0.03\" stroke-linejoin=\"round\"";
constexpr std::string_view kBelievedStyle =
    "stroke=\"#b0005a\" stroke-width=\"0.03\" stroke-linecap=\"round\" "
    "stroke-dasharray=\"0.001 0.06\"";

void DrawMarks(const truth::Trace& trace, std::string_view kind, Canvas& canvas) {
  const TraceEvent* drawn = nullptr;
  for (const TraceEvent& event : trace.events) {
    if (event.kind != kind) continue;
    if (drawn != nullptr && Apart_m(drawn->pose, event.pose) < kMarkSpacing_m) continue;
    drawn = &event;
    const std::string name =
        core::EscapeXml(fmt::format("{} {} at {:.0f} s", event.kind, event.detail, event.time_s));
    if (kind == "scrape") {
      canvas.DrawPlus(event.pose, name);
      continue;
    }
    canvas.DrawDot(event.pose, 0.045, kTrueColour, name);
    const TraceSample* sample = SampleAt(trace.samples, event.time_s);
    if (sample != nullptr) canvas.DrawDot(BelievedPose(*sample), 0.03, kBelievedColour, name);
  }
}

void DrawFooter(const truth::TracedTrial& trial, Canvas& canvas) {
  const double left_m = canvas.area().x_min_m;
  const double top_m = canvas.area().y_min_m;
  const double keys_y_m = top_m - 0.25;
  canvas.DrawLine(left_m, keys_y_m, 1.0, "stroke=\"#000\" stroke-width=\"0.06\"");
  canvas.DrawText(left_m + 1.1, keys_y_m - 0.06, "1 m");
  canvas.DrawLine(left_m + 1.9, keys_y_m, 0.6, kTrueStyle);
  canvas.DrawText(left_m + 2.6, keys_y_m - 0.06, "true");
  canvas.DrawLine(left_m + 3.3, keys_y_m, 0.6, kBelievedStyle);
  canvas.DrawText(left_m + 4.0, keys_y_m - 0.06, "dead-reckoned");
  canvas.DrawDot({left_m + 5.7, keys_y_m, 0.0}, 0.045, kTrueColour, "key");
  canvas.DrawText(left_m + 5.85, keys_y_m - 0.06, "hazard believed");
  canvas.DrawPlus({left_m + 7.6, keys_y_m, 0.0}, "key");
  canvas.DrawText(left_m + 7.75, keys_y_m - 0.06, "scrape");
  canvas.DrawText(left_m, top_m - 0.65,
                  core::EscapeXml(fmt::format(
                      "{}, seed {}, trial {}: {} ({})", trial.scenario, trial.seed,
                      trial.record.trial, truth::Name(trial.record.outcome), trial.record.detail)));
  canvas.GrowDown(kPlanFooter_m);
}

}  // namespace

TraceDrawing DrawTrace(const truth::TracedTrial& trial, const DrawnArea& plan) {
  const truth::Trace& trace = trial.trace;
  Canvas canvas(plan);
  canvas.DrawPath(Thinned(BelievedPath(trace), kMaxDrawnPoints), "dead-reckoned path",
                  kBelievedStyle);
  canvas.DrawPath(Thinned(TruePath(trace), kMaxDrawnPoints), "true path", kTrueStyle);
  DrawMarks(trace, "hazard", canvas);
  DrawMarks(trace, "scrape", canvas);
  if (!trace.samples.empty()) {
    canvas.DrawArrow(BelievedPose(trace.samples.back()), kBelievedColour, "believed end");
    canvas.DrawArrow(trace.samples.back().pose, kTrueColour, "true end");
  }
  DrawFooter(trial, canvas);
  return canvas.Take();
}

namespace {

constexpr double kFinestSpacing_m = 0.005;
constexpr double kCoarsestSpacing_m = 10.0;

// The path of pose_of(sample), broken at reflections.
template <typename PoseOf>
TracePath PathOf(const truth::Trace& trace, PoseOf pose_of) {
  TracePath path(1);
  auto event = trace.events.begin();
  for (const TraceSample& sample : trace.samples) {
    for (; event != trace.events.end() && event->time_s < sample.time_s; ++event) {
      if (event->kind == "reflection" && !path.back().empty()) path.emplace_back();
    }
    path.back().push_back(pose_of(sample));
  }
  return path;
}

// Keeps both ends, and between them points that are at least `spacing_m` apart.
PathPiece ThinnedPiece(const PathPiece& piece, double spacing_m) {
  PathPiece kept;
  for (const math::Pose2& pose : piece) {
    if (kept.empty() || Apart_m(kept.back(), pose) >= spacing_m) kept.push_back(pose);
  }
  if (!piece.empty() && Apart_m(kept.back(), piece.back()) > 0.0) kept.push_back(piece.back());
  return kept;
}

// Returns the distance from the point to the piece of a line between two others.
double OffLine_m(const math::Pose2& point, const math::Pose2& from, const math::Pose2& to) {
  const double dx_m = to.x_m - from.x_m;
  const double dy_m = to.y_m - from.y_m;
  const double square_m2 = dx_m * dx_m + dy_m * dy_m;
  if (square_m2 == 0.0) return Apart_m(point, from);
  const double along = (dx_m * (point.x_m - from.x_m) + dy_m * (point.y_m - from.y_m)) / square_m2;
  const double share = std::clamp(along, 0.0, 1.0);
  return std::hypot(point.x_m - from.x_m - share * dx_m, point.y_m - from.y_m - share * dy_m);
}

// Keeps of each stretch between two kept points the one that is furthest off too, until none is
// further off than the tolerance.
PathPiece SimplifiedPiece(const PathPiece& piece, double tolerance_m) {
  if (piece.size() < 3) return piece;
  std::vector<bool> kept(piece.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> stretches{{0, piece.size() - 1}};
  while (!stretches.empty()) {
    const auto [from, to] = stretches.back();
    stretches.pop_back();
    std::size_t furthest = from;
    double most_m = tolerance_m;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double off_m = OffLine_m(piece[i], piece[from], piece[to]);
      if (off_m > most_m) {
        most_m = off_m;
        furthest = i;
      }
    }
    if (furthest == from) continue;
    kept[furthest] = true;
    stretches.emplace_back(from, furthest);
    stretches.emplace_back(furthest, to);
  }
  PathPiece simplified;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    if (kept[i]) simplified.push_back(piece[i]);
  }
  return simplified;
}

}  // namespace

math::Pose2 BelievedPose(const TraceSample& sample) {
  return {sample.estimate.x_m, sample.estimate.y_m, sample.estimate.heading_rad};
}

TracePath TruePath(const truth::Trace& trace) {
  return PathOf(trace, [](const TraceSample& sample) { return sample.pose; });
}

TracePath BelievedPath(const truth::Trace& trace) { return PathOf(trace, BelievedPose); }

double Apart_m(const math::Pose2& a, const math::Pose2& b) {
  return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
}

TracePath Simplified(const TracePath& path, double tolerance_m) {
  TracePath simplified;
  simplified.reserve(path.size());
  for (const PathPiece& piece : path) simplified.push_back(SimplifiedPiece(piece, tolerance_m));
  return simplified;
}

TracePath Thinned(const TracePath& path, std::size_t most_points) {
  for (double spacing_m = kFinestSpacing_m;; spacing_m *= 1.5) {
    TracePath thinned;
    std::size_t points = 0;
    for (const PathPiece& piece : path) {
      thinned.push_back(ThinnedPiece(piece, spacing_m));
      points += thinned.back().size();
    }
    if (points <= most_points || spacing_m > kCoarsestSpacing_m) return thinned;
  }
}

}  // namespace rockyard::report
