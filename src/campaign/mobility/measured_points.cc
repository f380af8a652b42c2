#include "campaign/mobility/measured_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "core/error.h"
#include "core/files.h"
#include "core/text.h"

namespace rockyard::campaign {
namespace {

constexpr std::size_t kMostPointBytes = 10'000'000;
constexpr std::array<std::string_view, 8> kPointColumns{
    "slope_deg",       "slip",    "side_slip_deg", "sinkage_mm", "torque_Nm",
    "wheel_torque_Nm", "power_W", "pull_per_load"};
constexpr std::array<std::string_view, 3> kPointWays{"up", "down", "across"};

std::vector<std::string_view> CsvFields(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t end = std::min(line.find(','), line.size());
    std::string_view field = line.substr(0, end);
    while (!field.empty() && (field.front() == ' ' || field.front() == '"')) field.remove_prefix(1);
    while (!field.empty() && (field.back() == ' ' || field.back() == '"')) field.remove_suffix(1);
    fields.push_back(field);
    if (end == line.size()) return fields;
    line.remove_prefix(end + 1);
  }
}

class PointReader {
 public:
  PointReader(const std::filesystem::path& file, std::span<const std::string> soils)
      : file_(file.string()), soils_(soils.begin(), soils.end()) {}

  std::vector<MeasuredPoint> Read(std::string_view text) {
    int number = 0;
    while (!text.empty() && problems_.size() < 20) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      std::string_view line = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
      ++number;
      if (line.find_first_not_of(" ,") == std::string_view::npos || line.front() == '#') continue;
      where_ = fmt::format("{}, line {}", file_, number);
      if (names_.empty()) {
        ReadNames(CsvFields(line));
      } else {
        ReadLine(CsvFields(line));
      }
    }
    if (names_.empty()) {
      Complain("has no line of names",
               fmt::format("begin with a line such as soil,way,slope_deg,slip; columns: {}",
                           fmt::join(kPointColumns, ", ")));
    }
    if (!problems_.empty()) throw core::UserError(problems_);
    return points_;
  }

 private:
  void Complain(std::string reason, std::string suggestion) {
    problems_.push_back(
        {where_.empty() ? file_ : where_, std::move(reason), std::move(suggestion)});
  }

  void ReadNames(const std::vector<std::string_view>& names) {
    std::vector<std::string_view> known(kPointColumns.begin(), kPointColumns.end());
    known.insert(known.end(), {"soil", "way"});
    for (std::string_view name : names) {
      if (std::ranges::find(known, name) == known.end()) {
        Complain(fmt::format("has a column \"{}\"", name), core::Suggest(name, known));
      }
      names_.emplace_back(name);
    }
  }

  void ReadWord(std::string_view column, std::string_view field, MeasuredPoint& point) {
    std::vector<std::string_view> known(kPointWays.begin(), kPointWays.end());
    if (column == "soil") known.assign(soils_.begin(), soils_.end());
    if (std::ranges::find(known, field) == known.end()) {
      Complain(fmt::format("has the {} \"{}\"", column, field), core::Suggest(field, known));
    }
    (column == "soil" ? point.soil : point.way) = field;
  }

  void ReadLine(const std::vector<std::string_view>& fields) {
    if (fields.size() != names_.size()) {
      Complain(fmt::format("has {} fields, the line of names {}", fields.size(), names_.size()),
               "give every line as many");
      return;
    }
    MeasuredPoint point;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (fields[i].empty()) continue;
      if (names_[i] == "soil" || names_[i] == "way") {
        ReadWord(names_[i], fields[i], point);
      } else if (const auto value = core::FiniteNumber(fields[i])) {
        point.values[names_[i]] = *value;
      } else {
        Complain(fmt::format("has \"{}\" as {}", fields[i], names_[i]), "use a number");
      }
    }
    points_.push_back(std::move(point));
  }

  std::string file_;
  std::vector<std::string_view> soils_;
  std::vector<std::string> names_;
  std::string where_;
  std::vector<MeasuredPoint> points_;
  std::vector<core::Problem> problems_;
};

}  // namespace

std::span<const std::string_view> PointColumns() { return kPointColumns; }

std::vector<MeasuredPoint> ReadPoints(const std::filesystem::path& file,
                                      std::span<const std::string> soils) {
  return PointReader(file, soils)
      .Read(core::ReadTextFile(file, kMostPointBytes, "a CSV file of measured points"));
}

}  // namespace rockyard::campaign
