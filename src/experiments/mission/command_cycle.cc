#include "experiments/mission/command_cycle.h"

#include <algorithm>
#include <cmath>

#include "math/sun_position.h"

namespace rockyard::experiments {
namespace {

constexpr double kSecondsPerHour = 3600.0;
constexpr double kSecondsPerMinute = 60.0;

}  // namespace

double NeededBits(const MissionDayParams& day) {
  return day.RoverBits() +
         static_cast<double>(day.lander_images) * day.lander_image_bits / day.compression;
}

double SolBits(const MissionDayParams& day) {
  return day.downlink_bit_s * day.downlink_h * kSecondsPerHour;
}

std::int64_t SpareImages(const MissionDayParams& day) {
  const double spare = SolBits(day) - NeededBits(day);
  if (spare <= 0.0 || day.lander_image_bits <= 0.0) return 0;
  return static_cast<std::int64_t>(spare * day.compression / day.lander_image_bits);
}

std::int64_t SolsPerCommand(const MissionDayParams& day) {
  const double needed = NeededBits(day);
  const double sols_of_bits = std::ceil(needed / SolBits(day));
  // The last session carries what is left of them.
  const double last_s =
      (needed - std::max(0.0, sols_of_bits - 1.0) * SolBits(day)) / day.downlink_bit_s;
  const double answer_s = last_s + 2.0 * day.latency_min * kSecondsPerMinute +
                          day.planning_h * kSecondsPerHour + day.Window_s();
  const double sols = std::max(0.0, sols_of_bits - 1.0) + std::ceil(answer_s / math::kSolOfMars_s);
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(sols));
}

}  // namespace rockyard::experiments
