#include "experiments/three_rock_run/rock_layout_draw.h"

#include <cmath>

#include "core/random.h"

namespace rockyard::experiments {

core::RandomStream StreamOf(DrawnPart part, std::int64_t number, core::TrialKey key) {
  // 0; 1, 3, 5, ... of B; 2, 4, 6, ... of C.
  const std::int64_t substream =
      part == DrawnPart::kStart ? 0 : 2 * number + (part == DrawnPart::kSecondRock ? 1 : 2);
  return {key, core::Purpose::kExperiment, static_cast<std::uint32_t>(substream)};
}

double DrawUniform(const UniformRange& range, core::RandomStream& stream) {
  return core::SampleUniform(stream, range[0], range[1]);
}

DrawnRock DrawRock(const RockPrior& prior, core::RandomStream& stream) {
  DrawnRock rock;
  rock.along_m = DrawUniform(prior.along_m, stream);
  rock.offset_m = DrawUniform(prior.offset_m, stream);
  rock.diameter_m = DrawUniform(prior.diameter_m, stream);
  rock.height_m = DrawUniform(prior.height_m, stream);
  return rock;
}

PlacedRock PlaceFirstRock(const DrawnRock& rock, double path_m, double front_x_m) {
  return {path_m + front_x_m + rock.along_m + 0.5 * rock.diameter_m, rock.offset_m, rock.diameter_m,
          rock.height_m};
}

std::optional<PlacedRock> PlaceOnPath(const DrawnRock& rock, double path_m,
                                      const RunHistory& history) {
  const Moment* at = history.At(path_m);
  if (at == nullptr) return std::nullopt;
  return PlacedRock{at->pose.x_m - rock.offset_m * std::sin(at->pose.heading_rad),
                    at->pose.y_m + rock.offset_m * std::cos(at->pose.heading_rad), rock.diameter_m,
                    rock.height_m};
}

}  // namespace rockyard::experiments
