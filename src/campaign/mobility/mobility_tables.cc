#include "campaign/mobility/mobility_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/json_pieces.h"
#include "math/angles.h"
#include "report/result_table.h"

namespace rockyard::campaign {
namespace {

using core::JsonValue;
using messages::kWheelCount;
using messages::PerWheel;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<std::string_view, kWheelCount> kWheelNames{
    "left_front", "left_middle", "left_rear", "right_front", "right_middle", "right_rear"};

double SumOf(const PerWheel<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}
double LargestOf(const PerWheel<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

// A column of numbers of one kind of row.
template <typename Row>
struct NumberColumn {
  std::string name;
  std::string unit;
  std::string what;
  std::function<double(const Row&)> value;
};

using SlopeColumn = NumberColumn<SlopePoint>;
using WheelColumn = NumberColumn<WheelPoint>;
using LimitColumn = NumberColumn<SoilCurves>;

const std::vector<SlopeColumn>& BandedSlopeColumns() {
  static const std::vector<SlopeColumn> columns{
      {"slip", "", "1 - speed ahead over that of the rims; 1 where it gets nowhere",
       [](const SlopePoint& p) { return p.slip; }},
      {"side_slip_deg", "deg", "angle from heading to motion, positive downhill",
       [](const SlopePoint& p) { return math::RadToDeg(p.side_slip_rad); }},
      {"sinkage_mm", "mm", "mean over the wheels",
       [](const SlopePoint& p) { return 1e3 * SumOf(p.sinkage_m) / kWheelCount; }},
      {"torque_Nm", "Nm", "sum over the drive motors, at the wheels",
       [](const SlopePoint& p) { return SumOf(p.torque_Nm); }},
      {"wheel_torque_Nm", "Nm", "largest of a drive motor, at the wheel",
       [](const SlopePoint& p) { return LargestOf(p.torque_Nm); }},
      {"power_W", "W", "mechanical, sum over the wheels",
       [](const SlopePoint& p) { return SumOf(p.power_W); }}};
  return columns;
}

const std::vector<WheelColumn>& BandedWheelColumns() {
  static const std::vector<WheelColumn> columns{
      {"pull_N", "N", "drawbar pull: traction less motion resistance",
       [](const WheelPoint& p) { return p.forces.pull_N; }},
      {"pull_per_load", "", "drawbar pull over load",
       [](const WheelPoint& p) { return p.forces.pull_N / p.load_N; }},
      {"torque_Nm", "Nm", "at the wheel", [](const WheelPoint& p) { return p.forces.torque_Nm; }},
      {"sinkage_mm", "mm", "", [](const WheelPoint& p) { return 1e3 * p.forces.sinkage_m; }}};
  return columns;
}

const std::vector<LimitColumn>& BandedLimitColumns() {
  static const std::vector<LimitColumn> columns{
      {"slip_limit_slope_deg", "deg", "steepest slope straight up with less than the limit of slip",
       [](const SoilCurves& c) { return c.limit_deg; }},
      {"largest_slope_deg", "deg", "steepest slope straight up on which it gets on",
       [](const SoilCurves& c) { return c.climbs_deg; }},
      {"largest_step_m", "m", "highest step across its whole width that it climbs",
       [](const SoilCurves& c) { return c.step_m.value_or(kNothing); }}};
  return columns;
}

class TableMaker {
 public:
  explicit TableMaker(std::string name) { table_.name = std::move(name); }

  void Text(const std::string& name, const std::string& what, std::string_view value) {
    Column(name, "", what).cells.emplace_back(value);
  }
  void Number(const std::string& name, const std::string& unit, const std::string& what,
              double value) {
    Column(name, unit, what).cells.push_back(core::NumberOrNull(value));
  }
  void Case(const MobilityCase& of) {
    next_ = 0;
    Text("soil", "name of its soil", of.soil);
    Number("load", "", "factor of the rover's masses", of.load);
  }
  // Adds a value and its band. `row` finds the row in curves.
  template <typename Row, typename Find>
  void Banded(const NumberColumn<Row>& column, const MobilityCase& of, const Find& row) {
    const auto value = [&](const SoilCurves& curves) {
      const Row* found = row(curves);
      return found != nullptr ? column.value(*found) : kNothing;
    };
    Number(column.name, column.unit, column.what, value(of.curves));
    if (of.draws.empty()) return;
    const DrawnBand band = BandOver(of, value);
    Number(column.name + "_low", column.unit, "5 % point over the draws of the soil", band.low);
    Number(column.name + "_high", column.unit, "95 % point over the draws of the soil", band.high);
  }
  MobilityTable Take() { return std::move(table_); }

 private:
  // Columns come in the same order in every row.
  MobilityColumn& Column(const std::string& name, const std::string& unit,
                         const std::string& what) {
    if (next_ == table_.columns.size()) table_.columns.push_back({name, unit, what, {}});
    return table_.columns[next_++];
  }

  MobilityTable table_;
  std::size_t next_ = 0;
};

void AddWheels(const SlopePoint& point, TableMaker& table) {
  const auto add = [&](std::string_view what, std::string_view unit, double scale,
                       const PerWheel<double>& values) {
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      table.Number(fmt::format("{}_{}_{}", what, kWheelNames[i], unit), std::string(unit),
                   fmt::format("{} of this wheel", what),
                   point.has_values ? scale * values[i] : kNothing);
    }
  };
  add("load", "N", 1.0, point.load_N);
  add("sinkage", "mm", 1e3, point.sinkage_m);
  add("torque", "Nm", 1.0, point.torque_Nm);
  add("power", "W", 1.0, point.power_W);
}

template <typename Enum>
std::string_view WordOf(Enum value) {
  return core::EnumNames<Enum>::kNames.at(static_cast<std::size_t>(value));
}

}  // namespace

const MobilityColumn& MobilityTable::At(std::string_view column) const {
  return *std::ranges::find(columns, column, &MobilityColumn::name);
}

std::string MobilityTable::Csv() const {
  report::CsvRow head;
  for (const MobilityColumn& column : columns) head.Add(column.name);
  std::string csv = head.Line();
  for (std::size_t row = 0; row < rows(); ++row) {
    report::CsvRow line;
    for (const MobilityColumn& column : columns) {
      const JsonValue& cell = column.cells[row];
      if (cell.Is(JsonValue::Type::kText)) {
        line.Add(cell.text());
      } else if (cell.IsNumber()) {
        line.Add(cell.number());
      } else {
        line.AddEmpty(1);
      }
    }
    csv += line.Line();
  }
  return csv;
}

JsonValue MobilityTable::Json() const {
  JsonValue json = JsonValue::Object();
  for (const MobilityColumn& column : columns) {
    json.Set(column.name, JsonValue(JsonValue::List(column.cells)));
  }
  return json;
}

JsonValue MobilityTable::Meanings() const {
  return core::ListOf(columns, [](const MobilityColumn& column) {
    return report::ObjectTree("name", column.name, "unit", column.unit, "what", column.what);
  });
}

MobilityTable SlopeTable(const MobilityResult& result) {
  TableMaker table("slopes");
  for (const MobilityCase& of : result.cases) {
    for (const SlopeWay way : {SlopeWay::kUp, SlopeWay::kDown, SlopeWay::kAcross}) {
      const auto& points = of.curves.slopes[static_cast<std::size_t>(way)];
      for (std::size_t i = 0; i < points.size(); ++i) {
        table.Case(of);
        table.Text("way", "where it heads: up, down, or across with its left side up", WordOf(way));
        table.Number("slope_deg", "deg", "of the ground", result.slopes_deg[i]);
        table.Text("state",
                   "drives; creeps: not steady within its way; spins; slides; stalls; turns off; "
                   "tips over",
                   WordOf(points[i].state));
        for (const SlopeColumn& column : BandedSlopeColumns()) {
          table.Banded<SlopePoint>(column, of, [&](const SoilCurves& curves) {
            const SlopePoint& point = curves.slopes[static_cast<std::size_t>(way)][i];
            return point.has_values ? &point : nullptr;
          });
        }
        AddWheels(points[i], table);
      }
    }
  }
  return table.Take();
}

MobilityTable WheelTable(const MobilityResult& result) {
  TableMaker table("wheel");
  for (const MobilityCase& of : result.cases) {
    for (std::size_t i = 0; i < of.curves.wheel.size(); ++i) {
      table.Case(of);
      table.Number("slip", "", "of the wheel", of.curves.wheel[i].slip);
      table.Number("load_N", "N", "mean load of a wheel on level ground",
                   of.curves.wheel[i].load_N);
      for (const WheelColumn& column : BandedWheelColumns()) {
        table.Banded<WheelPoint>(column, of,
                                 [&](const SoilCurves& curves) { return &curves.wheel[i]; });
      }
    }
  }
  return table.Take();
}

MobilityTable LimitTable(const MobilityResult& result) {
  TableMaker table("limits");
  for (const MobilityCase& of : result.cases) {
    table.Case(of);
    table.Number("mass_kg", "kg", "of the rover", of.rover.mass.total_kg);
    for (const LimitColumn& column : BandedLimitColumns()) {
      table.Banded<SoilCurves>(column, of, [](const SoilCurves& curves) { return &curves; });
    }
  }
  return table.Take();
}

}  // namespace rockyard::campaign
