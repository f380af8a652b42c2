// Scraping against rocks and what it does to the measured heading: about 5 degrees at once
// (Matthies 1995, sections 5 and 8; the paper suspects vibration of the gyro).
//
// Trigger: a part of the body (hub, belly, rocker, panel edge; not a wheel) presses on a rock with
// at least min_force while sliding at min_sliding_speed or more. One jump per episode: an episode
// with a rock ends when the rover has not scraped that rock for episode_gap_s and has moved
// episode_gap_m since. Size and sign of the n-th jump come from stream kScrapeJump, substream n.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "sensing/gyro_params.h"
#include "truth/rover_state.h"

namespace rockyard::sensing {

// The scrapes of one trial.
class ScrapeDetector {
 public:
  ScrapeDetector(const ScrapeParams& params, core::TrialKey key) : params_(params), key_(key) {}

  // Looks at one physics step, in order of time. Returns the sum of the jumps that begin with it,
  // radians, positive left; 0 for nearly every step. With params.enabled false, episodes are
  // counted and nothing jumps.
  double Observe(const truth::RoverState& state, double time_s);

  std::int64_t episodes() const { return episodes_; }
  double total_jump_rad() const { return total_jump_rad_; }  // sum of signed jumps

 private:
  struct Episode {
    int rock;
    double last_time_s;
    math::Vector3 last_position_W;
  };

  bool IsScrape(const truth::BodyContact& contact) const;
  bool BeginsEpisode(int rock, double time_s, const math::Vector3& position_W);
  double Jump() const;

  ScrapeParams params_;
  core::TrialKey key_;
  std::vector<Episode> known_;  // latest scrape of each rock
  std::int64_t episodes_ = 0;
  double total_jump_rad_ = 0.0;
};

}  // namespace rockyard::sensing
