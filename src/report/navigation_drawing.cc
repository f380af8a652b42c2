#include "report/navigation_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "core/numbers.h"
#include "math/angles.h"
#include "report/result_table.h"
#include "report/step_scene.h"
#include "report/xml_text.h"

namespace rockyard::report {
namespace {

using messages::MapCellView;
using messages::MapView;
using messages::MotionVote;
using messages::NavigationView;

// Pixels.
constexpr double kPanel = 380.0;
constexpr double kMapGap = 24.0;
constexpr double kSceneTop = 70.0;  // of course and camera
constexpr double kSceneHeight = 416.0;
constexpr double kMapTop = kSceneTop + kSceneHeight + kCourseKeyHeight + 30.0;
constexpr double kVoteWidth = 14.0;
constexpr double kVoteHeight = 20.0;
constexpr double kVoteLabel = 62.0;

constexpr double kDrawnArc_m = 1.5;
constexpr int kArcPoints = 16;
constexpr double kBestVote = 255.0;

// Maps of one size side by side: x to the right, y up.
class MapPanel {
 public:
  MapPanel(const MapView& map, double left, double top)
      : map_(map),
        left_(left),
        top_(top),
        scale_(kPanel / std::max({map.nx * map.xstep_m, map.ny * map.ystep_m, map.xstep_m})) {}

  double X(double x_m) const { return left_ + scale_ * (x_m - map_.x0_m); }
  double Y(double y_m) const { return top_ + scale_ * (map_.y0_m + map_.ny * map_.ystep_m - y_m); }

  // Neighbours of one colour in a row share a rectangle. What has no colour stays grey.
  std::string Cells(
      const std::function<std::optional<image_files::Rgb>(const MapCellView&)>& colour) const {
    std::string svg = SvgBox(X(map_.x0_m), top_, scale_ * map_.nx * map_.xstep_m,
                             scale_ * map_.ny * map_.ystep_m, "fill=\"#d0d0d0\"");
    for (int iy = 0; iy < map_.ny; ++iy) {
      for (int ix = 0; ix < map_.nx;) {
        const std::optional<image_files::Rgb> here = colour(map_.Cell(ix, iy));
        int end = ix + 1;
        while (end < map_.nx && colour(map_.Cell(end, iy)) == here) ++end;
        if (here) {
          svg += SvgBox(X(map_.x0_m + ix * map_.xstep_m), Y(map_.y0_m + (iy + 1) * map_.ystep_m),
                        scale_ * (end - ix) * map_.xstep_m, scale_ * map_.ystep_m, SvgFill(*here));
        }
        ix = end;
      }
    }
    return svg;
  }

  // A triangle that points along the heading, and a ring around the goal where it is in sight.
  std::string RoverAndGoal(const NavigationView& view) const {
    const double x = X(view.estimate.x_m);
    const double y = Y(view.estimate.y_m);
    std::string svg = fmt::format(
        "<path d=\"M 12 0 L -8 7 L -8 -7 Z\" transform=\"translate({:.1f} {:.1f}) "
        "rotate({:.2f})\" fill=\"#fff\" stroke=\"#000\"/>\n",
        x, y, -math::RadToDeg(view.estimate.heading_rad));
    const double goal_x = X(view.goal.x_m);
    const double goal_y = Y(view.goal.y_m);
    const bool inside =
        goal_x >= left_ && goal_x <= left_ + kPanel && goal_y >= top_ && goal_y <= top_ + kPanel;
    if (inside) {
      svg += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"7\" fill=\"none\" stroke=\"#d55e00\" "
          "stroke-width=\"3\"/>\n",
          goal_x, goal_y);
    }
    return svg;
  }

  // The first kDrawnArc_m of a candidate.
  std::string Arc(const NavigationView& view, const MotionVote& vote) const {
    std::vector<SvgPoint> points;
    for (int i = 0; i <= kArcPoints; ++i) {
      const double s = vote.motion.direction * kDrawnArc_m * i / kArcPoints;
      const double turned = 0.5 * vote.motion.curvature_per_m * s;
      // Chord of the arc: 2 sin(c s / 2) / c long, at half the turned angle.
      const double chord = turned == 0.0 ? s : s * std::sin(turned) / turned;
      const double direction = view.estimate.heading_rad + turned;
      points.push_back({X(view.estimate.x_m + chord * std::cos(direction)),
                        Y(view.estimate.y_m + chord * std::sin(direction))});
    }
    return SvgPolyline(points, vote.chosen ? "fill=\"none\" stroke=\"#d55e00\" stroke-width=\"4\""
                                           : "fill=\"none\" stroke=\"#fff\" stroke-width=\"0.8\"");
  }

 private:
  const MapView& map_;
  double left_;
  double top_;
  double scale_;  // pixels per metre
};

struct ElevationRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

ElevationRange Elevations(const MapView& map) {
  ElevationRange range;
  for (const MapCellView& cell : map.cells) {
    if (!cell.has_data) continue;
    range.low = std::min(range.low, cell.elevation_m);
    range.high = std::max(range.high, cell.elevation_m);
  }
  return range;
}

std::string ElevationPanel(const NavigationView& view, const MapPanel& panel, double left) {
  const ElevationRange range = Elevations(view.map);
  const double span_m = std::max(range.high - range.low, 1e-3);
  std::string title = "elevation: no data";
  if (range.low <= range.high) {
    title = fmt::format("elevation: dark {:.2f} m, light {:.2f} m", range.low, range.high);
  }
  return SvgText(left, kMapTop - 8.0, title) +
         panel.Cells([&](const MapCellView& cell) -> std::optional<image_files::Rgb> {
           if (!cell.has_data) return std::nullopt;
           return RampColour((cell.elevation_m - range.low) / span_m);
         });
}

std::string BytePanel(std::string_view title, const MapPanel& panel, double left,
                      std::uint8_t MapCellView::*value) {
  return SvgText(left, kMapTop - 8.0, title) +
         panel.Cells([&](const MapCellView& cell) -> std::optional<image_files::Rgb> {
           if (!cell.known) return std::nullopt;
           return ByteColour(cell.*value);
         });
}

// Candidates from the leftmost to the rightmost turn; the view has them the other way round
// (messages/navigation_view.h).
std::vector<const MotionVote*> LeftToRight(const std::vector<MotionVote>& votes) {
  std::vector<const MotionVote*> ordered;
  ordered.reserve(votes.size());
  for (const MotionVote& vote : votes) ordered.push_back(&vote);
  std::reverse(ordered.begin(), ordered.end());
  return ordered;
}

std::string VoteBlock(std::string_view title, const std::vector<MotionVote>& votes, double left,
                      double top) {
  struct Row {
    std::string_view name;
    double MotionVote::*value;
  };
  constexpr Row kRows[] = {{"waypoint", &MotionVote::waypoint},
                           {"hazard", &MotionVote::hazard},
                           {"merged", &MotionVote::merged}};
  std::string svg = SvgText(left, top - 8.0, title);
  double y = top;
  for (const Row& row : kRows) {
    svg += SvgText(left, y + 0.7 * kVoteHeight, row.name, 12.0);
    double x = left + kVoteLabel;
    for (const MotionVote* vote : LeftToRight(votes)) {
      svg += SvgBox(x, y, kVoteWidth - 1.0, kVoteHeight - 1.0,
                    SvgFill(RampColour(vote->*row.value / kBestVote)));
      x += kVoteWidth;
    }
    y += kVoteHeight;
  }
  double x = left + kVoteLabel;
  for (const MotionVote* vote : LeftToRight(votes)) {
    if (vote->best) svg += SvgBox(x, y + 2.0, kVoteWidth - 1.0, 3.0, "fill=\"#009e73\"");
    if (vote->chosen) {
      svg += SvgBox(x - 1.0, top - 1.0, kVoteWidth + 1.0, 3 * kVoteHeight + 1.0,
                    "fill=\"none\" stroke=\"#009e73\" stroke-width=\"2\"");
    }
    x += kVoteWidth;
  }
  return svg;
}

// Course and camera side by side, as wide as three maps.
std::string ScenePanels(const StepScene& scene, const NavigationView& view, double width) {
  const SvgFrame course{kMapGap, kSceneTop, 0.5 * (width - 3.0 * kMapGap), kSceneHeight};
  SvgFrame camera = course;
  camera.left += course.width + kMapGap;
  return SvgText(course.left, kSceneTop - 8.0, "course: simulated rocks, and the path so far") +
         CoursePanel(scene, view, course) +
         SvgText(camera.left, kSceneTop - 8.0,
                 "left front camera: simulated rocks, and the rover's map in colours of goodness") +
         CameraPanel(scene, view, camera);
}

}  // namespace

std::string NavigationSvg(const NavigationPicture& picture) {
  const NavigationView& view = picture.view;
  const auto left = [](int column) { return kMapGap + column * (kPanel + kMapGap); };
  const double votes_top = kMapTop + kPanel + 50.0;
  const double width = left(3);
  const double height = votes_top + 3 * kVoteHeight + 40.0;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\">\n",
      width, height);
  svg += SvgBox(0.0, 0.0, width, height, "fill=\"#fff\"");
  svg += SvgText(kMapGap, 28.0, fmt::format("{}: {}", picture.title, ChosenText(view)), 17.0);
  svg += ScenePanels(picture.scene, view, width);
  const MapPanel elevation(view.map, left(0), kMapTop);
  const MapPanel goodness(view.map, left(1), kMapTop);
  const MapPanel certainty(view.map, left(2), kMapTop);
  svg += ElevationPanel(view, elevation, left(0));
  svg += BytePanel("goodness: dark 0 (obstacle), light 255; grey: unknown", goodness, left(1),
                   &MapCellView::goodness);
  for (const MotionVote& vote : view.forward) svg += goodness.Arc(view, vote);
  for (const MotionVote& vote : view.backward) svg += goodness.Arc(view, vote);
  svg += BytePanel("certainty: dark 0, light 255; grey: unknown", certainty, left(2),
                   &MapCellView::certainty);
  for (const MapPanel* panel : {&elevation, &goodness, &certainty}) {
    svg += panel->RoverAndGoal(view);
  }
  svg +=
      VoteBlock("forward arcs, left to right: dark 0, light 255", view.forward, left(0), votes_top);
  svg += VoteBlock("backward arcs, same curvatures", view.backward, left(1), votes_top);
  svg += VoteBlock("turns in place", view.point_turns, left(2), votes_top);
  return svg + "</svg>\n";
}

namespace {

std::string VoteRows(std::string_view kind, const std::vector<MotionVote>& votes) {
  std::string csv;
  for (const MotionVote& vote : votes) {
    csv += CsvLine(kind, vote.motion.curvature_per_m, vote.motion.direction, vote.hazard,
                   vote.hazard_certainty, vote.waypoint, vote.merged, vote.best, vote.chosen);
  }
  return csv;
}

const MotionVote* Chosen(const std::vector<MotionVote>& votes) {
  for (const MotionVote& vote : votes) {
    if (vote.chosen) return &vote;
  }
  return nullptr;
}

}  // namespace

std::string MapCsv(const messages::MapView& map) {
  std::string csv = "x_m,y_m,elevation_m,goodness,certainty\n";
  for (int iy = 0; iy < map.ny; ++iy) {
    for (int ix = 0; ix < map.nx; ++ix) {
      const messages::MapCellView& cell = map.Cell(ix, iy);
      CsvRow row(map.x0_m + (ix + 0.5) * map.xstep_m, map.y0_m + (iy + 0.5) * map.ystep_m,
                 cell.has_data ? cell.elevation_m : core::kNaN);
      if (cell.known) row.Add(cell.goodness, cell.certainty);
      csv += row.AddEmpty(cell.known ? 0 : 2).Line();
    }
  }
  return csv;
}

std::string VotesCsv(const messages::NavigationView& view) {
  return "kind,curvature_per_m,direction,hazard,hazard_certainty,waypoint,merged,best,chosen\n" +
         VoteRows("forward", view.forward) + VoteRows("backward", view.backward) +
         VoteRows("point_turn", view.point_turns);
}

std::string CloudCsv(const messages::PointCloud& cloud) {
  std::string csv = "x_m,y_m,z_m\n";
  for (const math::Vector3& p_R : cloud.points_R) csv += CsvLine(p_R.x(), p_R.y(), p_R.z());
  return csv;
}

std::string ChosenText(const messages::NavigationView& view) {
  for (const auto* arcs : {&view.forward, &view.backward}) {
    const MotionVote* vote = Chosen(*arcs);
    if (vote == nullptr) continue;
    return fmt::format("{} {:+.2f} /m (vote {:.0f})",
                       vote->motion.direction > 0 ? "forward" : "backward",
                       vote->motion.curvature_per_m, vote->merged);
  }
  const MotionVote* turn = Chosen(view.point_turns);
  if (turn == nullptr) return "nothing";
  return fmt::format("turn {} (vote {:.0f})", turn->motion.direction > 0 ? "left" : "right",
                     turn->merged);
}

}  // namespace rockyard::report
