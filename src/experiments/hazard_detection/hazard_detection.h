// The experiment "hazard_detection": what the light stripe sensor sees, misses and imagines.
//
// One run is a block of independent scenes of one cell; run i belongs to cell i modulo their
// number, so that every prefix of the runs covers the cells evenly. Its record holds the cell's
// factors, then counts and sums; its outcome is `measured`.
#pragma once

#include <memory>

#include "experiments/experiment.h"
#include "experiments/hazard_detection/hazard_detection_params.h"
#include "trial/drive_params.h"
#include "trial/watchers.h"
#include "truth/record.h"

namespace rockyard::experiments {

// Every column of any study but the number of the cell: first the factors that name a cell, then
// the bases, and counts and sums of these. A study takes those that it measures, and its factors
// those of their lists (CellFactor::column). Its sums stand in the order in which it names them.
const truth::RecordSchema& HazardColumns();

// What hazard_detection.scenes_per_run scenes of one cell count. Draws from the sensor's streams
// and from kSceneRock, kScenePlacement and kScenePhase under the key of each scene. The watcher
// sees the scans of the scenes, not those of bare sand that they are compared with. Scan numbers
// begin at 0 in every scene and count on from pose to pose.
std::unique_ptr<Experiment> MakeHazardDetection(const HazardDetectionParams& params,
                                                const trial::DriveParams& drive,
                                                const trial::ScanWatcher& watcher = {});

// Its studies. rock_studies.cc: one rock, seen from where the rover stands, or on the way past it.
std::unique_ptr<Experiment> MakeDetectionStudy(const HazardDetectionParams& params,
                                               const trial::DriveParams& drive,
                                               const trial::ScanWatcher& watcher);
std::unique_ptr<Experiment> MakeApproachStudy(const HazardDetectionParams& params,
                                              const trial::DriveParams& drive,
                                              const trial::ScanWatcher& watcher);
// alarm_study.cc: flat sand; hazards in random fields.
std::unique_ptr<Experiment> MakeAlarmStudy(const HazardDetectionParams& params,
                                           const trial::DriveParams& drive,
                                           const trial::ScanWatcher& watcher);
std::unique_ptr<Experiment> MakeMissedStudy(const HazardDetectionParams& params,
                                            const trial::DriveParams& drive,
                                            const trial::ScanWatcher& watcher);
// plane_study.cc: a plane at known heights.
std::unique_ptr<Experiment> MakePrecisionStudy(const HazardDetectionParams& params,
                                               const trial::DriveParams& drive,
                                               const trial::ScanWatcher& watcher);

}  // namespace rockyard::experiments
