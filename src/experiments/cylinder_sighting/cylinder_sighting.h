// The experiment "cylinder_sighting" (make_experiment.cc): where finders see the coloured cylinder,
// in rendered images. A scene is a view, which is measured several times with new noise. All
// finders are given the same images.
//
// Range is the distance along the ground from the origin of L; depth the distance before the left
// camera along its axis.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/fields.h"
#include "core/random.h"
#include "experiments/cell_experiment.h"
#include "experiments/cylinder_sighting/cylinder_sighting_params.h"
#include "experiments/experiment.h"
#include "math/pose.h"
#include "rendering/cylinder/cylinder_scene.h"
#include "truth/record.h"
#include "vision/cylinder/cylinder_sighting.h"

namespace rockyard::experiments {

inline constexpr std::size_t kCylinderMisses = core::EnumNames<vision::CylinderMiss>::kNames.size();

// What the views of one cell add up to for one finder.
struct FinderSums {
  double found = 0.0;
  double wrong = 0.0;  // found and wrong (JudgeSighting)
  double right = 0.0;  // found and not wrong
  // What was not found, by reason; the first entry is of no reason.
  std::array<double, kCylinderMisses> misses{};
  // Errors of what was found, wrong or not.
  ErrorSums orientation_deg;
  ErrorSums stereo;
  ErrorSums size;
  // Errors of what was right.
  ErrorSums right_orientation_deg;
  ErrorSums right_range;
  ErrorSums right_bearing_mrad;
  double nees = 0.0;
};

struct SightingSums {
  double measurements = 0.0;
  FinderSums published;
  FinderSums robust;
};

// Visits every column of a finder, called `called` in words.
template <typename Visitor>
void ForEachFinderColumn(const std::string& finder, const std::string& called,
                         truth::ColumnRole found_role, const FinderSums& s, const Visitor& visit) {
  using enum truth::ColumnRole;
  const std::string found = finder + "_found";
  const std::string right = finder + "_right";
  visit({found, "1", "of these, with a pose by " + called, found_role, "measurements"}, s.found);
  visit({finder + "_wrong", "1",
         "of these, off by more than 3 of its own standard deviations and more than "
         "10 deg or 10 %, or without a cylinder in view",
         kCount, found},
        s.wrong);
  visit({right, "1", "of these, not wrong", kCount, found}, s.right);
  // Stored runs depend on the reasons: another reason, or another name of one, is another column.
  for (std::size_t i = 1; i < kCylinderMisses; ++i) {
    const std::string reason(core::EnumNames<vision::CylinderMiss>::kNames[i]);
    visit({std::string(finder).append("_").append(reason), "1",
           "without a pose, for the reason " + reason, kCount, "measurements"},
          s.misses[i]);
  }
  const auto error = [&](const std::string& name, const std::string& ending,
                         const std::string& unit, const std::string& meaning, const std::string& of,
                         const ErrorSums& sums) {
    VisitError(finder + "_" + name, ending, {"", unit, meaning, kSum, of}, sums, visit);
  };
  error("orientation", "_deg", "deg", "measured less true orientation, wrong ones too", found,
        s.orientation_deg);
  error("stereo", "", "1", "depth by stereo over the true one, less 1, wrong ones too", found,
        s.stereo);
  error("size", "", "1", "depth by size over the true one, less 1, wrong ones too", found, s.size);
  error("right_orientation", "_deg", "deg", "measured less true orientation", right,
        s.right_orientation_deg);
  error("right_range", "", "1", "range along the ground over the true one, less 1", right,
        s.right_range);
  error("right_bearing", "_mrad", "mrad", "measured less true bearing", right,
        s.right_bearing_mrad);
  visit({finder + "_nees", "1",
         "squared error of place and orientation in units of the stated covariance: 4 "
         "on average where that is right",
         kSum, right},
        s.nees);
}

template <typename Visitor>
void ForEachColumn(const SightingSums& s, const Visitor& visit) {
  using enum truth::ColumnRole;
  visit({"measurements", "1", "pairs of images", kTrials}, s.measurements);
  ForEachFinderColumn("published", "the published finder", kMainCount, s.published, visit);
  ForEachFinderColumn("robust", "rockyard's own finder", kCount, s.robust, visit);
}

// What is true of a view. Frame L is that of rendering/cylinder/cylinder_scene.h.
struct CylinderTruth {
  bool present = true;
  double orientation_rad = 0.0;
  math::Vector3 p_LT_L = math::Vector3::Zero();
  double depth_m = 0.0;  // before the left camera along its axis
};

// Adds one finding to the sums. A pose is wrong if its orientation is off by more than three of its
// own standard deviations and more than 10 deg, or its range by more than three of its own standard
// deviations and more than 10 %; without a cylinder every pose is wrong. Distances by stereo and by
// size are depths, compared as shares of the true depth.
void JudgeSighting(const CylinderTruth& truth, const vision::CylinderFinding& finding,
                   FinderSums& sums);

// Returns every column but the number of the cell: the factors that may name a cell, then those of
// SightingSums.
const truth::RecordSchema& CylinderSightingColumns();

// A view of a cell: what is before the cameras, and what finders are told.
struct StudiedView {
  rendering::CylinderPictureParams picture;
  rendering::CylinderView view;
  vision::PublishedFinderParams published;
  vision::RobustFinderParams robust;
};

class CylinderSightingExperiment final : public CellExperiment {
 public:
  // Cost of a run: 50 to 110 ms a view, 15 ms a measurement and what the finders take. Randomness:
  // kExperiment for what a view draws, and the streams of rendering/cylinder, under a key of each
  // view; measurement j reads its two images out with the noise of numbers 2 j and 2 j + 1.
  explicit CylinderSightingExperiment(const CylinderSightingParams& params);

  // Returns the view of that key in a cell: orientation, sun, bearing and distance as the
  // parameters draw them. Finders are told the third colour, and that rows above the horizon are
  // not theirs.
  StudiedView Draw(std::size_t cell, core::TrialKey key) const;

 private:
  std::vector<double> Measure(std::size_t cell, core::TrialKey key) const override;

  CylinderSightingParams params_;
};

}  // namespace rockyard::experiments
