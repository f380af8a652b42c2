// Errors of motions that were found in rendered images, in units of their covariance.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/random.h"
#include "experiments/scenario_experiment.h"
#include "scenario/shipped.h"

namespace rockyard::experiments {

// What motions by the whole pipeline add up to: images of hazard cameras at random places of
// nominal terrain, ways of 0 to 1 m and turns of 0 to 18 deg, each of the 20 combinations as
// often.
struct RenderedMotions {
  int found = 0;
  double nees = 0.0;  // e' P^-1 e
};

inline RenderedMotions MeasureMotions(const std::string& source, std::uint64_t runs) {
  // The seeds of the study that chose variance_factor are 1 and 2.
  constexpr std::uint64_t kSeed = 3;
  const std::vector<std::string> overrides{"visual_motion.steps_per_run=1",
                                           "perception.visual_odometry.placement.source=" + source};
  const auto experiment =
      MakeExperiment(scenario::Shipped("visual_odometry/steps_hazcam", overrides));
  RenderedMotions motions;
  for (std::uint64_t run = 0; run < runs; ++run) {
    const truth::Record record = Measure(*experiment, kSeed, run);
    motions.found += static_cast<int>(ValueOf(experiment->schema(), record, "found"));
    motions.nees += ValueOf(experiment->schema(), record, "nees");
  }
  return motions;
}

// Two-sided alpha 0.001 of chi-squared with 6 degrees of freedom a motion.
inline bool IsWithin(double nees, int found) {
  return nees > core::ChiSquaredQuantile(0.0005, 6 * found) &&
         nees < core::ChiSquaredQuantile(0.9995, 6 * found);
}

// Negative controls: a quarter of the covariance, and four times it.
inline void ExpectHonest(const std::string& source, std::uint64_t runs) {
  const RenderedMotions motions = MeasureMotions(source, runs);
  EXPECT_GE(6 * motions.found, static_cast<int>(5 * runs));
  EXPECT_TRUE(IsWithin(motions.nees, motions.found)) << motions.nees / motions.found << " not 6";
  EXPECT_FALSE(IsWithin(4.0 * motions.nees, motions.found));
  EXPECT_FALSE(IsWithin(motions.nees / 4.0, motions.found));
}

}  // namespace rockyard::experiments
