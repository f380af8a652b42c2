// What a lander's map holds of the rocks, by their range and height, as CSV.
//   lander_map_study SCENARIO FIELDS [PATH=VALUE]...
// Rocks of the layout alone count, not their mirror images.

#include <cmath>
#include <cstdlib>
#include <iostream>

#include "core/error.h"
#include "scenario/load.h"
#include "terrain/arena.h"
#include "terrain/field.h"
#include "trial/course/goal_designation.h"
#include "trial/course/layout.h"

namespace rockyard::trial {
namespace {

constexpr double kBin_m = 2.5;
constexpr std::size_t kBins = 20;
constexpr double kLow_m = 0.05;  // from which routes lead round rocks
constexpr double kHigh_m = 0.13;

struct Tally {
  int low = 0;  // rocks of kLow_m and higher
  int low_known = 0;
  int high = 0;  // of kHigh_m and higher
  int high_known = 0;
  double share_seen = 0.0;    // sums over known ones of kLow_m and higher
  double squared_m2 = 0.0;    // believed to true centre
  double radius_ratio = 0.0;  // believed to true largest half axis
};

using Tallies = std::array<Tally, kBins>;

bool IsOfLayout(const DriveParams& drive, const terrain::Rock& rock) {
  const terrain::Rectangle bounds = terrain::LayoutBounds(drive.terrain);
  return rock.center_W.x() >= bounds.x_min_m && rock.center_W.x() <= bounds.x_max_m &&
         rock.center_W.y() >= bounds.y_min_m && rock.center_W.y() <= bounds.y_max_m;
}

void AddField(const DriveParams& drive, core::TrialKey key, Tallies& tallies) {
  const terrain::Field field =
      terrain::BuildField(drive.terrain, LayoutKey(drive, key), TerrainCourse(drive.course));
  const std::vector<MappedRock> map = MapFromLander(drive.course, field.terrain, key);
  auto known = map.begin();
  for (std::size_t i = 0; i < field.terrain.rocks().size(); ++i) {
    const bool is_known = known != map.end() && known->index == i;
    const terrain::Rock& rock = field.terrain.rocks()[i];
    const double range_m = drive.course.DesignationRange_m({rock.center_W.x(), rock.center_W.y()});
    const auto bin = static_cast<std::size_t>(range_m / kBin_m);
    if (rock.height_m >= kLow_m && bin < kBins && IsOfLayout(drive, rock)) {
      Tally& tally = tallies[bin];
      ++tally.low;
      tally.high += rock.height_m >= kHigh_m ? 1 : 0;
      if (is_known) {
        ++tally.low_known;
        tally.high_known += rock.height_m >= kHigh_m ? 1 : 0;
        tally.share_seen += known->share_seen;
        tally.squared_m2 += (known->rock.center_W - rock.center_W).head<2>().squaredNorm();
        tally.radius_ratio += known->rock.semi_axes_m.x() / rock.semi_axes_m.x();
      }
    }
    if (is_known) ++known;
  }
}

int Run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 2) {
    std::cerr << "usage: lander_map_study SCENARIO FIELDS [PATH=VALUE]...\n";
    return 2;
  }
  const std::vector<std::string> overrides(arguments.begin() + 2, arguments.end());
  const auto fields = static_cast<std::uint32_t>(std::strtoul(arguments[1].c_str(), nullptr, 10));
  try {
    const scenario::Scenario scenario = scenario::LoadScenario(arguments[0], overrides);
    Tallies tallies;
    for (std::uint32_t field = 0; field < fields; ++field) {
      AddField(scenario.drive, {static_cast<std::uint64_t>(scenario.seed), field}, tallies);
    }
    std::cout << "range_m,rocks_5cm,known_5cm,rocks_13cm,known_13cm,share_seen,rms_error_m,"
                 "radius_ratio\n";
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      const Tally& tally = tallies[bin];
      if (tally.low_known == 0) continue;
      std::cout << (static_cast<double>(bin) + 0.5) * kBin_m << ',' << tally.low << ','
                << tally.low_known << ',' << tally.high << ',' << tally.high_known << ','
                << tally.share_seen / tally.low_known << ','
                << std::sqrt(tally.squared_m2 / tally.low_known) << ','
                << tally.radius_ratio / tally.low_known << '\n';
    }
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
