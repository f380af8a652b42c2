// Counts what the image level of the light stripe sensor finds, misses and misplaces, as JSON.
//   stripe_error_study SCENARIO SCENES [PATH=VALUE]...
// fit_stripe_errors.py runs it and fits the error model of the geometric level.
#include <cstdlib>
#include <iostream>

#include "core/error.h"
#include "scenario/load.h"
#include "stripe_levels.h"

namespace rockyard::trial {
namespace {

// Row by row.
void PrintPoints(const std::string& name, const messages::StripeArray<std::int64_t>& counts) {
  std::cout << "\"" << name << "\": [";
  for (std::size_t point = 0; point < counts.points().size(); ++point) {
    std::cout << (point > 0 ? ", " : "") << counts.points()[point];
  }
  std::cout << "]";
}

void Print(const std::string& name, const PointTally& tally) {
  std::cout << "\"" << name << "\": {\"visible\": " << tally.visible
            << ", \"missed\": " << tally.missed << ", \"misplaced\": " << tally.misplaced
            << ", \"hidden\": " << tally.hidden << ", \"ghosts\": " << tally.ghosts
            << ", \"offset_mean_px\": " << tally.offset_mean_px()
            << ", \"offset_deviation_px\": " << tally.offset_deviation_px() << ", \"offsets\": [";
  for (std::size_t i = 0; i < tally.offsets.size(); ++i) {
    std::cout << (i > 0 ? ", " : "") << tally.offsets[i];
  }
  std::cout << "], ";
  PrintPoints("visible_at", tally.visible_at);
  std::cout << ", ";
  PrintPoints("missed_at", tally.missed_at);
  std::cout << "}";
}

int Run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 2) {
    std::cerr << "usage: stripe_error_study SCENARIO SCENES [PATH=VALUE]...\n";
    return 2;
  }
  const std::vector<std::string> overrides(arguments.begin() + 2, arguments.end());
  const auto scenes = static_cast<std::uint32_t>(std::strtoul(arguments[1].c_str(), nullptr, 10));
  try {
    const scenario::Scenario scenario = scenario::LoadScenario(arguments[0], overrides);
    const auto tally = [&](SceneKind kind) {
      return TallyPoints(scenario, sensing::Fidelity::kImage, kind, scenes);
    };
    std::cout << "{";
    Print("flat", tally(SceneKind::kFlat));
    std::cout << ", ";
    Print("rocks", tally(SceneKind::kRocks));
    std::cout << "}\n";
  } catch (const core::UserError& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
  return 0;
}

}  // namespace
}  // namespace rockyard::trial

int main(int argc, char** argv) {
  return rockyard::trial::Run(std::vector<std::string>(argv + 1, argv + argc));
}
