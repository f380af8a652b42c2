// The experiment "visual_motion" (make_experiment.cc): how well visual odometry measures one
// motion, at whichever fidelity the scenario has. A scene is a motion.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/random.h"
#include "experiments/cell_experiment.h"
#include "experiments/experiment.h"
#include "experiments/visual_motion/visual_motion_study_params.h"
#include "trial/drive_params.h"
#include "trial/eyes/visual_eyes.h"
#include "truth/record.h"

namespace rockyard::experiments {

struct VisualSums {
  double steps = 0.0;
  double found = 0.0;  // steps that gave a motion
  double wrong = 0.0;  // motions that are off (the column "wrong")
  double matches = 0.0;
  double points = 0.0;
  double consistent = 0.0;
  double nees = 0.0;        // sum of e' P^-1 e, 6 on average where the covariance is right
  double position_m = 0.0;  // sum of the lengths of errors of the way
  ErrorSums along_m;        // x, y, z of the first rover frame
  ErrorSums across_m;
  ErrorSums up_m;
  ErrorSums roll_deg;  // about x, y, z of the first rover frame
  ErrorSums pitch_deg;
  ErrorSums heading_deg;
};

template <typename Visitor>
void ForEachColumn(const VisualSums& s, const Visitor& visit) {
  using enum truth::ColumnRole;
  visit({"steps", "1", "motions, each at a place of its own", kTrials}, s.steps);
  visit({"found", "1", "of these, with a motion", kMainCount, "steps"}, s.found);
  visit({"wrong", "1",
         "of these, off by more than 6 standard deviations of their own statement and more than "
         "5 cm or 2 deg",
         kCount, "found"},
        s.wrong);
  visit({"matches", "1", "features of two left images that look alike", kSum, "steps"}, s.matches);
  visit({"points", "1", "of these, with a place at both moments", kSum, "steps"}, s.points);
  visit({"consistent", "1", "of these, moved as one", kSum, "steps"}, s.consistent);
  visit({"nees", "1",
         "squared error in units of the stated covariance: 6 on average where that is right", kSum,
         "found"},
        s.nees);
  visit({"position_m", "m", "length of the error of the way", kSum, "found"}, s.position_m);
  const auto error = [&](const std::string& name, const std::string& unit,
                         const std::string& meaning, const ErrorSums& sums) {
    VisitError(name, "_" + unit, {"", unit, meaning, kSum, "found"}, sums, visit);
  };
  error("along", "m", "measured less true way, along x of the first rover frame", s.along_m);
  error("across", "m", "along y", s.across_m);
  error("up", "m", "along z", s.up_m);
  error("roll", "deg", "measured less true turn, about x of the first rover frame", s.roll_deg);
  error("pitch", "deg", "about y", s.pitch_deg);
  error("heading", "deg", "about z", s.heading_deg);
}

// Returns every column but the number of the cell: first the factors that name a cell, of which a
// scenario has those of its lists (VisualMotionStudyParams::Factors), then those of VisualSums.
const truth::RecordSchema& VisualMotionColumns();

class VisualMotionExperiment final : public CellExperiment {
 public:
  // Randomness, all under the key of each motion: the terrain, the place (RandomPlace), the step
  // (DrawStep), and the cameras' faults and noise. Cost of a run: that of four rendered images a
  // motion, 0.5 s; some microseconds by the error model.
  VisualMotionExperiment(const VisualMotionStudyParams& params, const trial::DriveParams& drive);

 private:
  std::vector<double> Measure(std::size_t cell, core::TrialKey key) const override;

  VisualMotionStudyParams params_;
  std::vector<trial::DriveParams> drives_;  // by cell
};

// A motion from a place to another one, and where on-board software expects it to end.
struct StudiedStep {
  math::Transform X_WF = math::Transform::Identity();  // R at the start, frame F
  math::Transform X_WS = math::Transform::Identity();  // R at the end, frame S
  math::Transform predicted_FS = math::Transform::Identity();
};

// Adds one measured motion to `sums`.
void AddStep(const StudiedStep& step, const vision::MotionResult& seen, VisualSums& sums);

}  // namespace rockyard::experiments
