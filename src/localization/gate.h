// Whether a measurement is believed, and the way back after good ones were not.
//
// A measurement of m values is let in where r' S^-1 r is at most the chi-squared quantile of
// 1 - chance with m degrees of freedom: a filter that knows its own error turns away one good
// measurement in 1 / chance. One that does not (wheels that slipped, a gyro that was shaken) turns
// all of them away, for ever. So the `patience`-th measurement that is turned away in a row is let
// in, after the filter has doubted itself by as much as that measurement asks for. Each kind of
// measurement has a gate of its own: good ones of the heading do not excuse those of the place.
// Wrong measurements that come singly, with probability p each, are let in so with p^patience.
#pragma once

#include <array>
#include <cstdint>

#include "localization/error_state_filter_params.h"

namespace rockyard::localization {

enum class GateAnswer {
  kIn,
  kOut,
  kDoubtYourself,  // let in, after the filter's own error was made larger
};

class Gate {
 public:
  explicit Gate(const GateParams& params);

  // `mahalanobis_squared`: r' S^-1 r of a measurement of 1 to 6 values.
  GateAnswer Ask(double mahalanobis_squared, int values);
  // Forgets what was turned away.
  void Restart() { turned_away_ = 0; }

 private:
  static constexpr int kMostValues = 6;

  std::array<double, kMostValues + 1> limit_{};  // by the number of values
  std::int64_t patience_;
  std::int64_t turned_away_ = 0;  // in a row
};

}  // namespace rockyard::localization
