#include "experiments/three_rock_run/rock_layout_draw.h"

#include <cmath>

#include "core/distributions.h"

namespace rockyard::experiments {
namespace {

double Draw(const UniformRange& range, core::RandomStream& stream) {
  return core::SampleUniform(stream, range[0], range[1]);
}

DrawnRock Draw(const UniformRange& along_m, const UniformRange& offset_m,
               const UniformRange& height_m, const UniformRange& diameter_m,
               core::RandomStream& stream) {
  DrawnRock rock;
  rock.along_m = Draw(along_m, stream);
  rock.offset_m = Draw(offset_m, stream);
  rock.diameter_m = Draw(diameter_m, stream);
  rock.height_m = Draw(height_m, stream);
  return rock;
}

}  // namespace

DrawnLayout DrawLayout(const ThreeRockPrior& prior, core::TrialKey key) {
  core::RandomStream stream(key, core::Purpose::kExperiment);
  DrawnLayout layout;
  layout.goal_m = Draw(prior.goal_m, stream);
  layout.a = Draw(prior.a_gap_m, prior.a_offset_m, prior.tall_height_m, prior.diameter_m, stream);
  layout.b = Draw(prior.b_path_m, prior.b_offset_m, prior.low_height_m, prior.diameter_m, stream);
  layout.c = Draw(prior.c_gap_m, prior.c_offset_m, prior.tall_height_m, prior.diameter_m, stream);
  return layout;
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
