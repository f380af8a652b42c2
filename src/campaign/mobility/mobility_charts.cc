#include "campaign/mobility/mobility_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "campaign/mobility/mobility_tables.h"
#include "report/chart_drawing.h"
#include "report/line_text.h"

namespace rockyard::campaign {
namespace {

using core::JsonValue;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// A soil under a load, as every chart draws it.
struct CaseStyle {
  std::string soil;
  double load;
  std::string label;
  std::string colour;
  std::string dash;
};

std::vector<CaseStyle> StylesOf(const MobilityResult& result) {
  constexpr std::array<std::string_view, 4> kDashes{"", "7 4", "2 3", "9 3 2 3"};
  std::vector<std::string> soils;
  std::vector<double> loads;
  std::vector<CaseStyle> styles;
  for (const MobilityCase& of : result.cases) {
    if (std::ranges::find(soils, of.soil) == soils.end()) soils.push_back(of.soil);
    if (std::ranges::find(loads, of.load) == loads.end()) loads.push_back(of.load);
  }
  for (const MobilityCase& of : result.cases) {
    const auto soil = static_cast<std::size_t>(std::ranges::find(soils, of.soil) - soils.begin());
    const auto load = static_cast<std::size_t>(std::ranges::find(loads, of.load) - loads.begin());
    std::string label = of.soil;
    std::ranges::replace(label, '_', ' ');
    if (of.load != 1.0) label += fmt::format(" x {:g}", of.load);
    styles.push_back({of.soil, of.load, std::move(label), std::string(report::CurveColour(soil)),
                      std::string(kDashes[load % kDashes.size()])});
  }
  return styles;
}

// What a chart shows of a table.
struct ChartOf {
  std::string title;
  std::string x;  // columns
  std::string y;
  std::string x_title;
  std::string y_title;
  std::string_view way = {};  // of slopes
  double scale = 1.0;         // of y
};

double Cell(const JsonValue& cell) { return cell.IsNumber() ? cell.number() : kNone; }

class ChartMaker {
 public:
  explicit ChartMaker(const MobilityResult& result)
      : result_(result),
        styles_(StylesOf(result)),
        slopes_(SlopeTable(result)),
        wheel_(WheelTable(result)) {}

  report::Chart Make(const ChartOf& of) const {
    report::Chart chart{of.title, of.x_title, of.y_title, {}, {}, {}};
    for (const CaseStyle& style : styles_) {
      chart.curves.push_back({style.label, style.colour, style.dash, Points(of, style)});
    }
    for (const MeasuredPoint& point : result_.points) {
      const auto x = point.values.find(of.x);
      const auto y = point.values.find(of.y);
      if (x == point.values.end() || y == point.values.end()) continue;
      if (!of.way.empty() && point.way != of.way) continue;
      chart.marks.push_back({x->second, of.scale * y->second, ColourOf(point.soil)});
    }
    return chart;
  }

  const std::vector<CaseStyle>& styles() const { return styles_; }

 private:
  std::string ColourOf(const std::string& soil) const {
    const auto found = std::ranges::find(styles_, soil, &CaseStyle::soil);
    return found != styles_.end() ? found->colour : "#000000";
  }

  std::vector<report::ChartPoint> Points(const ChartOf& of, const CaseStyle& style) const {
    const MobilityTable& table = of.way.empty() ? wheel_ : slopes_;
    const MobilityColumn& y = table.At(of.y);
    const bool banded = !result_.cases.front().draws.empty();
    std::vector<report::ChartPoint> points;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      if (table.At("soil").cells[row].text() != style.soil) continue;
      if (table.At("load").cells[row].number() != style.load) continue;
      if (!of.way.empty() && table.At("way").cells[row].text() != of.way) continue;
      const auto band = [&](const char* end) {
        return banded ? of.scale * Cell(table.At(of.y + end).cells[row]) : kNone;
      };
      points.push_back({Cell(table.At(of.x).cells[row]), of.scale * Cell(y.cells[row]),
                        band("_low"), band("_high")});
    }
    return points;
  }

  const MobilityResult& result_;
  std::vector<CaseStyle> styles_;
  MobilityTable slopes_;
  MobilityTable wheel_;
};

report::BarChart SlopeBars(const MobilityResult& result, const std::vector<CaseStyle>& styles,
                           double slip_limit) {
  report::BarChart chart{
      fmt::format("Steepest slope up, slip below {:g} %", 100.0 * slip_limit), "slope [deg]", {}};
  for (std::size_t i = 0; i < styles.size(); ++i) {
    const MobilityCase& of = result.cases[i];
    const DrawnBand band = BandOver(of, [](const SoilCurves& curves) { return curves.limit_deg; });
    const double value = of.curves.limit_deg;
    chart.bars.push_back({styles[i].label, styles[i].colour, value, band.low, band.high,
                          value >= kSteepest_deg ? "or more" : fmt::format("{:.1f} deg", value)});
  }
  return chart;
}

report::BarChart StepBars(const MobilityResult& result, const std::vector<CaseStyle>& styles) {
  report::BarChart chart{"Highest step across its width", "height [cm]", {}};
  for (std::size_t i = 0; i < styles.size(); ++i) {
    const MobilityCase& of = result.cases[i];
    const auto height_cm = [](const SoilCurves& curves) {
      return 100.0 * curves.step_m.value_or(kNone);
    };
    const DrawnBand band = BandOver(of, height_cm);
    const double value = height_cm(of.curves);
    const double diameter_cm = 200.0 * of.rover.geometry.wheel_radius_m;
    chart.bars.push_back({styles[i].label, styles[i].colour, value, band.low, band.high,
                          fmt::format("{:.1f} cm = {:.1f} diameters", value, value / diameter_cm)});
  }
  return chart;
}

std::string LawsOf(const MobilityResult& result) {
  std::vector<std::string_view> laws;
  for (const MobilityCase& of : result.cases) {
    const std::string_view law =
        core::EnumNames<terrain::WheelLaw>::kNames.at(static_cast<std::size_t>(of.values.law));
    if (std::ranges::find(laws, law) == laws.end()) laws.push_back(law);
  }
  return fmt::format("{}", fmt::join(laws, ", "));
}

}  // namespace

std::vector<std::string> MobilityHead(const MobilityRequest& request,
                                      const MobilityResult& result) {
  const rover::RoverParams& rover = result.source.params;
  const rover::RoverParams& driven = result.cases.front().rover;
  std::string drawn = "no soils drawn";
  if (request.draws > 0) {
    drawn = fmt::format("bands: 5 to 95 % of {} soils drawn by terrain.ground.soil.spread, seed {}",
                        request.draws, request.seed);
  }
  return {
      fmt::format("{:g} kg, wheels of radius {:g} m and width {:g} m, {:g} m/s2; rims at {:g} "
                  "m/s, motors stall at {:g} Nm",
                  rover.mass.total_kg, rover.geometry.wheel_radius_m, rover.geometry.wheel_width_m,
                  rover.physics.gravity_m_s2, rover.drive.speed_m_s, rover.drive.stall_torque_Nm),
      fmt::format(
          "wheel law {}; slopes by the {} rover{}; {}", LawsOf(result),
          core::EnumNames<rover::Fidelity>::kNames.at(static_cast<std::size_t>(driven.fidelity)),
          request.steps ? ", steps by the multibody" : "", drawn)};
}

std::string MobilitySvg(const MobilityRequest& request, const MobilityResult& result) {
  const ChartMaker maker(result);
  const std::string slope = "slope [deg]";
  report::ChartSheet sheet{.title = "Mobility of " + report::Printable(result.source.name),
                           .lines = MobilityHead(request, result),
                           .charts = {},
                           .bars = {}};
  if (!result.points.empty()) {
    sheet.lines.back() +=
        "; circles: measured, " + report::Printable(request.points.filename().string());
  }
  report::Chart up =
      maker.Make({"Slip straight up", "slope_deg", "slip", slope, "slip [%]", "up", 100.0});
  up.rules.push_back(
      {100.0 * request.slip_limit, fmt::format("limit {:g} %", 100.0 * request.slip_limit)});
  report::Chart wheel_torque =
      maker.Make({fmt::format("Largest motor torque, up (stall: {:g} Nm)",
                              result.source.params.drive.stall_torque_Nm),
                  "slope_deg", "wheel_torque_Nm", slope, "torque [Nm]", "up"});
  sheet.charts = {
      std::move(up),
      maker.Make({"Slip across", "slope_deg", "slip", slope, "slip [%]", "across", 100.0}),
      maker.Make({"Side slip across, heading held", "slope_deg", "side_slip_deg", slope,
                  "side slip angle [deg]", "across"}),
      maker.Make({"Slip straight down", "slope_deg", "slip", slope, "slip [%]", "down", 100.0}),
      maker.Make({"Mean sinkage, up", "slope_deg", "sinkage_mm", slope, "sinkage [mm]", "up"}),
      std::move(wheel_torque),
      maker.Make(
          {"Torque of all motors, up", "slope_deg", "torque_Nm", slope, "torque [Nm]", "up"}),
      maker.Make(
          {"Mechanical power of all motors, up", "slope_deg", "power_W", slope, "power [W]", "up"}),
      maker.Make({"Drawbar pull of a wheel, mean load", "slip", "pull_per_load", "slip [-]",
                  "pull over load [-]"}),
      maker.Make(
          {"Sinkage of a wheel, mean load", "slip", "sinkage_mm", "slip [-]", "sinkage [mm]"})};
  sheet.bars.push_back(SlopeBars(result, maker.styles(), request.slip_limit));
  if (request.steps) sheet.bars.push_back(StepBars(result, maker.styles()));
  return report::ChartSheetSvg(sheet);
}

}  // namespace rockyard::campaign
