#include "campaign/site/height_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "core/error.h"

namespace rockyard::campaign {
namespace {

struct Unit {
  std::string_view name;
  double length_m;
};

constexpr Unit kUnits[] = {
    {"m", 1.0},
    {"metre", 1.0},
    {"metres", 1.0},
    {"meter", 1.0},
    {"meters", 1.0},
    {"km", 1000.0},
    {"kilometer", 1000.0},
    {"kilometers", 1000.0},
    {"dm", 0.1},
    {"cm", 0.01},
    {"centimeter", 0.01},
    {"mm", 0.001},
    {"ft", 0.3048},
    {"foot", 0.3048},
    {"feet", 0.3048},
    {"us-ft", 1200.0 / 3937.0},
    {"us survey foot", 1200.0 / 3937.0},
};

}  // namespace

double HeightUnit_m(const image_files::RasterInfo& info, const std::string& name,
                    std::optional<double> stated, std::vector<std::string>& notes) {
  if (stated) {
    notes.push_back(fmt::format("a unit of height is taken for {:g} m", *stated));
    return *stated;
  }
  if (info.unit.empty()) {
    notes.emplace_back("the file names no unit of height: metres are assumed");
    return 1.0;
  }
  std::string unit = info.unit;
  std::ranges::transform(unit, unit.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const Unit& known : kUnits) {
    if (unit != known.name) continue;
    if (known.length_m != 1.0) {
      notes.push_back(fmt::format("heights in {} were brought to metres", known.name));
    }
    return known.length_m;
  }
  throw core::UserError(
      name, fmt::format("has heights in \"{}\", which is no unit that is known", info.unit),
      "say how many metres one is: --height-scale 1");
}

}  // namespace rockyard::campaign
