#include "sensing/scrape_detector.h"

#include "core/distributions.h"

namespace rockyard::sensing {

bool ScrapeDetector::IsScrape(const truth::BodyContact& contact) const {
  return contact.rock >= 0 && contact.part != truth::BodyPart::kWheel &&
         contact.normal_force_N >= params_.min_force_N &&
         contact.sliding_speed_m_s >= params_.min_sliding_speed_m_s;
}

bool ScrapeDetector::BeginsEpisode(int rock, double time_s, const math::Vector3& position_W) {
  for (Episode& episode : known_) {
    if (episode.rock != rock) continue;
    // Both a pause and a way: rocking on one rock is one episode.
    const bool over = time_s - episode.last_time_s >= params_.episode_gap_s &&
                      (position_W - episode.last_position_W).norm() >= params_.episode_gap_m;
    episode.last_time_s = time_s;
    episode.last_position_W = position_W;
    return over;
  }
  known_.push_back({rock, time_s, position_W});
  return true;
}

double ScrapeDetector::Jump() const {
  core::RandomStream stream(key_, core::Purpose::kScrapeJump,
                            static_cast<std::uint32_t>(episodes_));
  // Both numbers are drawn for every sign, so that the choice of sign shifts no size.
  const bool left = core::SampleBernoulli(stream, 0.5);
  const double size = core::SampleNormal(stream, params_.jump_rad, params_.jump_spread_rad);
  switch (params_.sign) {
    case ScrapeSign::kLeft:
      return size;
    case ScrapeSign::kRight:
      return -size;
    case ScrapeSign::kRandom:
      break;
  }
  return left ? size : -size;
}

double ScrapeDetector::Observe(const truth::RoverState& state, double time_s) {
  double jump_rad = 0.0;
  for (const truth::BodyContact& contact : state.contacts) {
    if (!IsScrape(contact)) continue;
    if (!BeginsEpisode(contact.rock, time_s, state.X_WR.translation())) continue;
    // Episodes are counted also where nothing jumps.
    if (params_.enabled) jump_rad += Jump();
    ++episodes_;
  }
  total_jump_rad_ += jump_rad;
  return jump_rad;
}

}  // namespace rockyard::sensing
