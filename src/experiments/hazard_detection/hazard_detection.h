// The experiment "hazard_detection" (make_experiment.cc): what the light stripe sensor sees, misses
// and imagines.
//
// It has five studies, of which a scenario chooses one (HazardStudy). A scene is one rock before
// the rover, a drive through a field, flat sand or a plane, by study. Stripes, rows and points are
// those of the hazard array (messages/stripe_array.h). A stripe is charged where a report or a scan
// shows a hazard on it. Range is the distance from the camera; distance counts from the rover's
// front along the ground.
#pragma once

#include <memory>

#include "experiments/experiment.h"
#include "experiments/hazard_detection/hazard_detection_params.h"
#include "trial/drive_params.h"
#include "trial/watchers.h"
#include "truth/record.h"

namespace rockyard::experiments {

// Returns every column of any study but the number of the cell: first the factors that name a cell,
// then the bases, and counts and sums of these. A study takes those that it measures, and its
// factors those of their lists (CellFactor::column). Must stay: the order in which a study names
// its columns, which is that of its sums.
const truth::RecordSchema& HazardColumns();

// Makes the study that `params` chooses. A run counts scenes_per_run scenes of one cell. Draws from
// the sensor's streams and from kSceneRock, kScenePlacement and kScenePhase under the key of each
// scene. The watcher sees the scans of the scenes, not those of bare sand that they are compared
// with. Scan numbers begin at 0 in every scene and count on from pose to pose.
std::unique_ptr<Experiment> MakeHazardDetection(const HazardDetectionParams& params,
                                                const trial::DriveParams& drive,
                                                const trial::Watchers& watchers);

// Make its studies. rock_studies.cc: one rock, seen from where the rover stands, or while it drives
// on to the rock.
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
