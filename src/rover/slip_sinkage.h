// How far the wheels of a rover have dug in by slipping.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "messages/wheels.h"
#include "terrain/soil_params.h"

namespace rockyard::rover {

// Every wheel has a slip that it has dug in for, d in [0, 1], from which wheel_rut_params.h tells
// its rut. It follows the slip i of the moment over the way s of the rim,
//
//   dd/ds = i (i - d) / L          where it digs in (i > d): i ds is the way that the rim slides,
//   dd/ds = (1 - i) (i - d) / L    where it comes out of its hole: the way that it rolls on.
//
// So a wheel that spins on the spot sinks little by little, and one that stands stays as it is. The
// law of Ding et al. 2010 is of steady slip; this lag is our assumption.
class SlipSinkage {
 public:
  explicit SlipSinkage(const terrain::SlipSinkageParams& params) : params_(params) {}

  bool enabled() const { return params_.enabled; }
  double dug_slip(std::size_t wheel) const { return dug_slip_[wheel]; }

  // A wheel turns by `rim_way_m` >= 0 at a slip >= 0, of which more than 1 counts as 1.
  void Roll(std::size_t wheel, double slip, double rim_way_m);
  // The rover stands elsewhere: no wheel has dug.
  void Clear() { dug_slip_.fill(0.0); }

 private:
  terrain::SlipSinkageParams params_;
  messages::PerWheel<double> dug_slip_{};
};

inline void SlipSinkage::Roll(std::size_t wheel, double slip, double rim_way_m) {
  if (!params_.enabled) return;
  const double i = std::min(slip, 1.0);
  double& d = dug_slip_[wheel];
  const double way_m = rim_way_m * (i > d ? i : 1.0 - i);
  // The equation above, solved for a constant slip.
  d += (i - d) * -std::expm1(-way_m / params_.length_m);
}

}  // namespace rockyard::rover
