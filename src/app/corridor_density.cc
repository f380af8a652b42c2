#include "app/corridor_density.h"

#include <fmt/format.h>

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/fields.h"
#include "statistics/counts.h"
#include "terrain/corridor.h"
#include "terrain/field.h"
#include "trial/layout.h"

namespace rockyard::app {
namespace {

using terrain::CorridorClass;
using terrain::LineRule;
using terrain::OverlapRule;

template <class Enum>
std::string_view Name(Enum value) {
  return core::EnumNames<Enum>::kNames[static_cast<std::size_t>(value)];
}

struct Rules {
  LineRule line;
  OverlapRule overlap;
};

// Every pair that differs: rocks that may overlap may cross a line under either rule, exact counts
// leave no rock out, and without mirror lines their rule says nothing.
std::vector<Rules> RulesOf(const terrain::TerrainParams& params) {
  std::vector<LineRule> lines{LineRule::kMerge};
  if (params.arena.IsVirtual()) lines.push_back(LineRule::kKeepOff);
  std::vector<Rules> rules;
  for (const LineRule line : lines) {
    rules.push_back({line, OverlapRule::kRelocate});
    if (params.rocks.kind == terrain::RockFieldKind::kMoore) {
      rules.push_back({line, OverlapRule::kReject});
    }
    if (line == LineRule::kMerge) rules.push_back({line, OverlapRule::kAllow});
  }
  return rules;
}

std::vector<CorridorClass> Counted(const terrain::TerrainParams& params,
                                   const terrain::Course& course, std::uint64_t seed,
                                   std::int64_t fields) {
  std::vector<CorridorClass> classes = terrain::ExpectedInCorridor(params, course);
  for (std::int64_t i = 0; i < fields; ++i) {
    const terrain::Field field =
        terrain::BuildField(params, {seed, static_cast<std::uint32_t>(i)}, course);
    // Images lie beyond the lines, and the corridor between them.
    terrain::CountInCorridor(field.terrain.rocks(), course, classes);
  }
  return classes;
}

std::string Rows(const terrain::TerrainParams& params, const terrain::Course& course,
                 std::uint64_t seed, std::int64_t fields) {
  const bool lines = params.arena.IsVirtual();
  std::string text;
  for (const CorridorClass& c : Counted(params, course, seed, fields)) {
    const double expected = c.expected * static_cast<double>(fields);
    const statistics::Interval interval = statistics::PoissonInterval(c.observed);
    text +=
        fmt::format("  {:<11} {:<8} {:8.2f} .. {:.2f} {:10.1f} {:9} {:7.3f}  {:.3f} .. {:.3f}\n",
                    lines ? Name(params.rocks.mirror_line) : "none", Name(params.rocks.overlap),
                    c.from_m, c.to_m, expected, c.observed, c.observed / expected,
                    interval.low / expected, interval.high / expected);
  }
  return text;
}

}  // namespace

std::string CorridorDensityText(const scenario::Scenario& scenario, std::uint64_t seed,
                                std::int64_t fields) {
  terrain::TerrainParams params = scenario.drive.terrain;
  const terrain::Course course = trial::TerrainCourse(scenario.drive.course);
  if (terrain::ExpectedInCorridor(params, course).empty()) {
    throw core::UserError(
        "terrain", "lets expect no density in a corridor along the course",
        "use rocks of kind moore or uniform_count, a course straight along x, and a "
        "layout at least 0.5 m wide on either side of it");
  }
  std::string text = fmt::format(
      "rock centres within {:.1f} m of the course, {} fields, against the law outside the clear "
      "zones\n  mirror_line overlap  diameter [m]    expected  observed   ratio  95 %\n",
      terrain::kCorridorHalfWidth_m, fields);
  for (const auto& [line, overlap] : RulesOf(params)) {
    params.rocks.mirror_line = line;
    params.rocks.overlap = overlap;
    text += Rows(params, course, seed, fields);
  }
  return text;
}

}  // namespace rockyard::app
