// What the experiment "visual_motion" counts and adds up of the motions of one cell.
#pragma once

#include <string>

namespace rockyard::experiments {

// Error of one coordinate: sum and sum of squares.
struct CoordinateSums {
  double sum = 0.0;
  double squares = 0.0;

  void Add(double error) {
    sum += error;
    squares += error * error;
  }
};

struct VisualSums {
  double steps = 0.0;
  double found = 0.0;  // motions
  double wrong = 0.0;  // of these, off by more than kWrongSigma of what they state and kWrong_m
  double matches = 0.0;
  double points = 0.0;
  double consistent = 0.0;
  double nees = 0.0;        // of motions: e' P^-1 e, 6 on average where the covariance is right
  double position_m = 0.0;  // length of the error of the way
  CoordinateSums along_m;   // x, y, z of the first rover frame
  CoordinateSums across_m;
  CoordinateSums up_m;
  CoordinateSums roll_deg;  // about these axes
  CoordinateSums pitch_deg;
  CoordinateSums heading_deg;
};

// Calls f(name, value) for every column, in the order of the records.
template <typename F>
void ForEachSum(const VisualSums& s, F&& f) {
  f("steps", s.steps);
  f("found", s.found);
  f("wrong", s.wrong);
  f("matches", s.matches);
  f("points", s.points);
  f("consistent", s.consistent);
  f("nees", s.nees);
  f("position_m", s.position_m);
  const auto coordinate = [&](const std::string& name, const std::string& unit,
                              const CoordinateSums& sums) {
    f(name + "_bias_" + unit, sums.sum);
    f(name + "_error_" + unit, sums.squares);
  };
  coordinate("along", "m", s.along_m);
  coordinate("across", "m", s.across_m);
  coordinate("up", "m", s.up_m);
  coordinate("roll", "deg", s.roll_deg);
  coordinate("pitch", "deg", s.pitch_deg);
  coordinate("heading", "deg", s.heading_deg);
}

}  // namespace rockyard::experiments
