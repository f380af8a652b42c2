#include "experiments/look_factors.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "core/random.h"
#include "math/angles.h"
#include "math/functions.h"
#include "terrain/field.h"
#include "trial/course/layout.h"

namespace rockyard::experiments {

trial::DriveParams WithLookFactors(trial::DriveParams drive,
                                   const std::vector<std::string_view>& columns,
                                   const std::vector<double>& values) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] == "soil_graininess") {
      drive.sensors.look.soil_graininess = values[i];
    } else if (columns[i] == "sun_elevation_deg") {
      drive.sensors.sun.elevation_rad = math::DegToRad(values[i]);
    } else if (columns[i] == "baseline_m") {
      drive.sensors.stereo.baseline_m = values[i];
    }
  }
  return drive;
}

namespace {

bool IsFree(const terrain::Terrain& terrain, double x_m, double y_m, double radius_m,
            double hazard_height_m) {
  std::vector<int> near;
  terrain.RocksNear(x_m, y_m, radius_m, near);
  return std::none_of(near.begin(), near.end(), [&](int index) {
    const terrain::Rock& rock = terrain.rocks()[static_cast<std::size_t>(index)];
    const double distance_m = math::Hypot(rock.center_W.x() - x_m, rock.center_W.y() - y_m);
    return rock.height_m >= hazard_height_m && distance_m < radius_m + rock.semi_axes_m.x();
  });
}

}  // namespace

terrain::Terrain SceneTerrainOf(const trial::DriveParams& drive, core::TrialKey key) {
  return terrain::BuildField(drive.terrain, trial::LayoutKey(drive, key),
                             trial::TerrainCourse(drive.course))
      .terrain;
}

math::Transform RandomPlace(const trial::DriveParams& drive, const terrain::Terrain& terrain,
                            double hazard_height_m, core::TrialKey key) {
  constexpr int kDraws = 1000;
  const terrain::ArenaParams& arena = drive.terrain.arena;
  const double half_width_m = arena.IsVirtual() ? arena.MirrorLine() : 0.5 * arena.width_m;
  const double radius_m = 0.5 * drive.rover.geometry.length_m;
  core::RandomStream stream(key, core::Purpose::kExperiment);
  for (int draw = 0; draw < kDraws; ++draw) {
    const double x_m = core::SampleUniform(stream, arena.x_min_m, arena.x_min_m + arena.length_m);
    const double y_m = core::SampleUniform(stream, -half_width_m, half_width_m);
    const double heading_rad = core::SampleUniform(stream, -std::numbers::pi, std::numbers::pi);
    if (!IsFree(terrain, x_m, y_m, radius_m, hazard_height_m)) continue;
    return math::MakePose({x_m, y_m, terrain.ground().Height(x_m, y_m)}, heading_rad, 0.0, 0.0);
  }
  throw std::runtime_error("the terrain has no place that is free of rocks for the rover");
}

}  // namespace rockyard::experiments
