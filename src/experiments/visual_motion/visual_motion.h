// The experiment "visual_motion": how well visual odometry measures one motion, at whichever
// fidelity the scenario has.
//
// One run is a block of motions of one cell; run i belongs to cell i modulo their number, so that
// every prefix of the runs covers the cells evenly. Its record holds the cell's factors, then
// counts and sums; its outcome is `measured`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/random.h"
#include "experiments/cell_table.h"
#include "experiments/experiment.h"
#include "experiments/visual_motion/visual_motion_study_params.h"
#include "trial/drive_params.h"
#include "trial/eyes/visual_eyes.h"
#include "truth/record.h"

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

// Every column but the number of the cell: first the factors that name a cell, of which a scenario
// has those of its lists (VisualMotionStudyParams::Factors), then what VisualSums holds.
const truth::RecordSchema& VisualMotionColumns();

class VisualMotionExperiment final : public Experiment {
 public:
  VisualMotionExperiment(const VisualMotionStudyParams& params, const trial::DriveParams& drive);

  const truth::RecordSchema& schema() const override { return schema_; }
  // Cost: that of four rendered images a motion, 0.5 s; some microseconds by the error model.
  truth::Record Run(std::uint64_t seed, std::uint64_t index) const override;

 private:
  VisualSums Measure(std::size_t cell, core::TrialKey key) const;

  VisualMotionStudyParams params_;
  CellTable table_;
  std::vector<trial::DriveParams> drives_;  // of each cell
  truth::RecordSchema schema_;
};

// A motion from a place to another one, and where on-board software expects it.
struct StudiedStep {
  math::Transform X_WF = math::Transform::Identity();  // R at first
  math::Transform X_WS = math::Transform::Identity();  // and then
  math::Transform predicted_FS = math::Transform::Identity();
};

// Adds one measured motion to `sums`.
void AddStep(const StudiedStep& step, const vision::MotionResult& seen, VisualSums& sums);

}  // namespace rockyard::experiments
