// How fast a squared error grows along a run.
#pragma once

namespace rockyard::trial {

// Slope of the squared error e^2 against the true distance x, by least squares through the origin
// over the whole path: (sum of x e^2 dx) / (sum of x^2 dx), in the unit of e squared a metre. Where
// e is a random walk the mean over runs is its variance a metre. It is linear in e^2, so that the
// mean over runs of equal length is the slope of the line fitted to their error variance, which
// Matthies 1995 sec. 5 reads off twenty runs (fig. 5).
class ErrorGrowth {
 public:
  // After `distance_m` of true way, which never falls. Where it has not grown nothing counts.
  void Observe(double distance_m, double error) {
    const double weight_m2 = distance_m * (distance_m - last_m_);
    moment_ += weight_m2 * error * error;
    weight_m3_ += weight_m2 * distance_m;
    last_m_ = distance_m;
  }

  // 0 where there was no way.
  double per_m() const { return weight_m3_ > 0.0 ? moment_ / weight_m3_ : 0.0; }

 private:
  double last_m_ = 0.0;
  double moment_ = 0.0;
  double weight_m3_ = 0.0;
};

}  // namespace rockyard::trial
