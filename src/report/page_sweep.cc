// Sweeps, comparisons, published values and drives on the report page, and the page as a whole
// (page_data.h).
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/json_text.h"
#include "report/comparison_table.h"
#include "report/page_data.h"
#include "report/result_table.h"
#include "report/sweep_summary.h"
#include "statistics/multiple_testing.h"

namespace rockyard::report {
namespace {

using core::JsonList;

using statistics::LogisticFit;

std::string Points(const scenario::Sweep& sweep, const SweepSummary& summary,
                   const SweepCurve& curve, SuccessKind kind) {
  std::vector<std::string> points;
  for (std::size_t i = 0; i < curve.cells.size(); ++i) {
    const std::size_t cell = curve.cells[i];
    const SweepCellSummary& of = summary.cells[cell];
    const statistics::Proportion& rate =
        (kind == SuccessKind::kDeclared ? of.declared_success : of.true_success).rate;
    if (rate.trials == 0) continue;
    points.push_back(ObjectText("x", curve.x[i], "rate", rate.rate, "low", rate.interval.low,
                                "high", rate.interval.high, "trials", rate.trials, "cell",
                                sweep.cells[cell].name));
  }
  return JsonList(points);
}

std::string Line(const LogisticFit& fit) {
  if (fit.status != statistics::FitStatus::kFitted) return "[]";
  return JsonList(FittedLine(fit), [](const FitPoint& point) {
    return ObjectText("x", point.x, "rate", point.rate, "low", point.band.low, "high",
                      point.band.high);
  });
}

// Must stay in the order of statistics::FitStatus.
constexpr std::array<std::string_view, 4> kStatusTexts{
    "fitted", "fewer than two settings have finished trials", "every trial ended alike",
    "successes and failures do not overlap: no curve is the likeliest"};

const char* Rejected(const LogisticFit& fit) {
  if (fit.status != statistics::FitStatus::kFitted || !std::isfinite(fit.p_value)) return "null";
  return Misfits(fit) ? "true" : "false";
}

std::string Curve(const scenario::Sweep& sweep, const SweepSummary& summary,
                  const SweepCurve& curve, SuccessKind kind) {
  const scenario::SweepAxis& axis = sweep.axes[*sweep.fit_axis];
  const LogisticFit& fit = curve.fits[static_cast<std::size_t>(kind)];
  const bool log = sweep.fit_scale == scenario::AxisScale::kLog && curve.x.front() > 0.0;
  return ObjectText(
      "label", curve.label, "axis", axis.name, "unit", axis.unit, "scale", log ? "log" : "linear",
      "success", kind == SuccessKind::kDeclared ? "declared" : "true", "points",
      Json{Points(sweep, summary, curve, kind)}, "fit", Json{Line(fit)}, "fit_status",
      kStatusTexts[static_cast<std::size_t>(fit.status)], "fit_rejected", Json{Rejected(fit)});
}

}  // namespace

std::string PageSweepJson(std::string_view label, std::string_view folder,
                          const scenario::Sweep& sweep, const SweepSummary& summary,
                          const SweepDescription& description) {
  std::vector<std::string> curves;
  for (const SweepCurve& curve : summary.curves) {
    for (const SuccessKind kind : {SuccessKind::kDeclared, SuccessKind::kTrue}) {
      curves.push_back(Curve(sweep, summary, curve, kind));
    }
  }
  return ObjectText("label", label, "folder", folder, "summary",
                    Json{core::CompactJson(SweepValue(sweep, summary, description))}, "curves",
                    Json{JsonList(curves)});
}

namespace {

std::string SuccessJson(const SuccessComparison& success) {
  return ObjectText("what", success.what, "first", success.first.rate, "second",
                    success.second.rate, "difference", success.difference, "low",
                    success.interval.low, "high", success.interval.high, "p", success.p_value);
}

std::string SettingJson(const PageSetting& setting) {
  return ObjectText("path", setting.path, "first", setting.first, "second", setting.second);
}

std::vector<std::string> Notes(const PageComparison& page, bool adjusted) {
  const RunComparison& comparison = page.comparison;
  std::vector<std::string> notes;
  if (!comparison.paired) {
    notes.emplace_back("Different seeds: compared as two samples, not in pairs.");
  } else if (comparison.same_terrain) {
    notes.emplace_back("In pairs of trials with equal rocks and equal noise.");
  } else {
    notes.emplace_back(
        "In pairs of trials with equal random numbers, but other settings of terrain or course.");
  }
  if (comparison.shared_layouts) {
    notes.emplace_back(
        "Trials share layouts of rocks: intervals allow for it, and there are no p-values.");
  }
  notes.emplace_back(adjusted ? "p-values of all pairs of runs are adjusted together by Holm."
                              : "p-values are not adjusted: one for each kind of success.");
  notes.emplace_back(
      "Intervals are each on their own at 95 %: of thirty columns one or two exclude zero by "
      "chance.");
  for (std::string& note : OneSidedNotes(comparison, page.first, page.second)) {
    notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace

void AdjustSuccesses(std::span<PageComparison> comparisons) {
  std::vector<double*> tests;
  for (PageComparison& each : comparisons) {
    for (SuccessComparison& success : each.comparison.successes) {
      if (std::isfinite(success.p_value)) tests.push_back(&success.p_value);
    }
  }
  std::vector<double> p_values;
  p_values.reserve(tests.size());
  for (const double* test : tests) p_values.push_back(*test);
  const std::vector<double> adjusted = statistics::HolmAdjust(p_values);
  for (std::size_t i = 0; i < tests.size(); ++i) *tests[i] = adjusted[i];
}

std::string PageComparisonJson(const PageComparison& comparison, bool adjusted) {
  const RunComparison& result = comparison.comparison;
  const std::string columns = ColumnsOf(result).Json(
      "trials,column as name,unit,n,n_second,first,second,difference,low,high");
  return ObjectText("first", comparison.first, "second", comparison.second, "paired", result.paired,
                    "pairs", result.pairs, "notes", Notes(comparison, adjusted), "settings",
                    Json{JsonList(comparison.settings, SettingJson)}, "successes",
                    Json{JsonList(result.successes, SuccessJson)}, "columns", Json{columns});
}

namespace {

using statistics::ComparedValue;
using statistics::PublishedValue;

// Returns a count as a share of its runs, so that it can be drawn beside a rate.
double Share(double value, const PublishedValue& published) {
  return IsCount(published) ? value / static_cast<double>(published.sample_size) : value;
}

// Returns the remarks, with the other readings that the terminal's table shows below a row.
std::vector<std::string> AllRemarks(const ComparedValue& value) {
  std::vector<std::string> remarks = Remarks(value);
  for (const statistics::SideStatistic& side : value.beside) {
    remarks.push_back(
        fmt::format("{}: {}, p {}", side.name, Prediction(value, side), PValue(side.p_value)));
  }
  return remarks;
}

std::string JsonRow(const ComparedValue& value) {
  const PublishedValue& published = value.published;
  const bool tolerance = statistics::HasTolerance(published.statistic);
  const double predicted = tolerance ? value.pool_value : value.median;
  std::string source = published.place;
  if (published.role != statistics::ValueRole::kPrediction) {
    source += "; " + std::string(RoleName(published.role));
  }
  if (!published.note.empty()) source += "; " + published.note;
  return ObjectText(
      "id", published.id, "what", published.what, "unit", IsCount(published) ? "1" : published.unit,
      "published", Published(published), "published_value", Share(published.value, published),
      "predicted", Prediction(value), "predicted_value", Share(predicted, published),
      "predicted_low", Share(value.interval.low, published), "predicted_high",
      Share(value.interval.high, published), "p_holm", value.holm_p_value, "power", value.power,
      "verdict", statistics::Name(value.verdict), "source", source, "remarks", AllRemarks(value));
}

}  // namespace

std::string PublishedJson(const statistics::PublishedReference& reference,
                          const statistics::ComparisonResult& result, std::string_view scenario) {
  std::vector<std::string> rows;
  for (const ComparedValue& value : result.values) {
    if (value.published.scenario == scenario) rows.push_back(JsonRow(value));
  }
  if (rows.empty()) return "null";
  std::vector<std::string> notes = ComparisonNotes(result);
  notes.emplace_back(
      "Holm's family is that of this run alone: other runs on the page do not change it, and "
      "`rockyard check` of several runs takes all of them as one.");
  const statistics::OtherSettings* changed = result.FindChanged(scenario);
  return ObjectText("reference", reference.title, "citation", reference.citation, "notes", notes,
                    "settings", changed == nullptr ? std::vector<std::string>() : changed->settings,
                    "rows", Json{JsonList(rows)});
}

namespace {

using core::JsonNumber;

void AddCentimetres(double length_m, std::vector<std::string>& to) {
  to.push_back(std::to_string(std::llround(100.0 * length_m)));
}

std::string PlaceJson(const messages::Goal& place) {
  return JsonList(std::vector{JsonNumber(place.x_m), JsonNumber(place.y_m)});
}

// Returns a piece of a path. Points that round to the one before are left out.
std::string Piece(const PathPiece& piece) {
  std::vector<std::string> numbers;
  for (const math::Pose2& pose : piece) {
    AddCentimetres(pose.x_m, numbers);
    AddCentimetres(pose.y_m, numbers);
    const std::size_t n = numbers.size();
    if (n >= 4 && numbers[n - 1] == numbers[n - 3] && numbers[n - 2] == numbers[n - 4]) {
      numbers.resize(n - 2);
    }
  }
  return JsonList(numbers);
}

std::string Rocks(const std::vector<PageRock>& rocks) {
  std::vector<std::string> numbers;
  for (const PageRock& rock : rocks) {
    AddCentimetres(rock.x_m, numbers);
    AddCentimetres(rock.y_m, numbers);
    AddCentimetres(rock.radius_m, numbers);
  }
  return JsonList(numbers);
}

}  // namespace

std::string PageCourseJson(const PageCourse& course) {
  const auto contour = [](const PageContour& each) {
    std::vector<std::string> numbers;
    for (const messages::Goal& point : each.line) {
      AddCentimetres(point.x_m, numbers);
      AddCentimetres(point.y_m, numbers);
    }
    return ObjectText("height_m", each.height_m, "line_cm", Json{JsonList(numbers)});
  };
  return ObjectText(
      "rover", course.rover, "start", Json{PlaceJson({course.start.x_m, course.start.y_m})}, "goal",
      Json{PlaceJson(course.goal)}, "goal_radius_m", course.goal_radius_m, "waypoints",
      Json{JsonList(course.waypoints, PlaceJson)}, "mirror_lines_m",
      Json{JsonList(course.mirror_lines_m, JsonNumber)}, "contours",
      Json{JsonList(course.contours, contour)}, "contour_interval_m", course.contour_interval_m);
}

std::string PageTracksJson(std::span<const PageTrack> tracks) {
  return JsonList(tracks, [](const PageTrack& track) {
    return ObjectText("trial", track.trial, "pieces_cm", Json{JsonList(track.path, Piece)},
                      "rocks_cm", Json{Rocks(track.rocks)});
  });
}

}  // namespace rockyard::report
