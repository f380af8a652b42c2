// One study of the experiment "hazard_detection": what a block of scenes of one cell counts.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "core/random.h"
#include "experiments/hazard_detection/hazard_detection_params.h"
#include "trial/drive_params.h"
#include "trial/watchers.h"

namespace rockyard::experiments {

class HazardStudyRunner {
 public:
  virtual ~HazardStudyRunner() = default;

  // Names of those columns of HazardColumns that follow those of the factors.
  virtual std::vector<std::string_view> columns() const = 0;

  // Their values, summed over hazard_detection.scenes_per_run scenes of one cell. A pure function
  // of its arguments; draws from the sensor's streams and from kSceneRock, kScenePlacement and
  // kScenePhase under the key of each scene. Throws std::out_of_range as SceneKey does.
  virtual std::vector<double> Measure(std::size_t cell, core::TrialKey key) const = 0;
};

// The watcher sees the scans of the scenes, not those of bare sand that they are compared with.
// Scan numbers begin at 0 in every scene and count on from pose to pose. rock_studies.cc: one rock,
// seen from where the rover stands, or on the way past it.
std::unique_ptr<HazardStudyRunner> MakeDetectionStudy(const HazardDetectionParams& params,
                                                      const trial::DriveParams& drive,
                                                      const trial::ScanWatcher& watcher);
std::unique_ptr<HazardStudyRunner> MakeApproachStudy(const HazardDetectionParams& params,
                                                     const trial::DriveParams& drive,
                                                     const trial::ScanWatcher& watcher);
// alarm_study.cc: flat sand.
std::unique_ptr<HazardStudyRunner> MakeAlarmStudy(const HazardDetectionParams& params,
                                                  const trial::DriveParams& drive,
                                                  const trial::ScanWatcher& watcher);

// field_study.cc: hazards in random fields.
std::unique_ptr<HazardStudyRunner> MakeMissedStudy(const HazardDetectionParams& params,
                                                   const trial::DriveParams& drive,
                                                   const trial::ScanWatcher& watcher);
// plane_study.cc: a plane at known heights.
std::unique_ptr<HazardStudyRunner> MakePrecisionStudy(const HazardDetectionParams& params,
                                                      const trial::DriveParams& drive,
                                                      const trial::ScanWatcher& watcher);

}  // namespace rockyard::experiments
