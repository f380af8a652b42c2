// All that a trial asks of a terrain sensor, whichever it is: what it requires of a scenario, what
// it shows, how long a look takes, and how it is made.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "core/fields.h"
#include "core/random.h"
#include "sensing/stereo_params.h"
#include "trial/suite_params.h"

namespace rockyard::trial {

struct ComputeTimes;
struct DriveParams;
struct LookTime;
struct WatchedScan;
struct Zone;
class TerrainSensorModel;

// The array of a hazard report that the sensor leads to.
struct ReportArray {
  std::int64_t stripes = 0;
  std::string_view owner;       // whose number of stripes this is, as the end of a sentence
  std::string_view suggestion;  // where a navigator names another number
};

struct TerrainSensorKind {
  // Its data are worked out by the rover's computer, which starts up before the first look and
  // judges elevations after each.
  bool uses_computer = false;
  // Looks are counted as sets of images, of those that look behind apart, not as scans.
  bool takes_image_sets = false;

  // Requires what must hold in every experiment that uses it, and in a drive.
  void (*require)(const DriveParams&, core::FieldVisitor&) = nullptr;
  void (*require_drive)(const DriveParams&, core::FieldVisitor&) = nullptr;

  ReportArray (*report_array)(const DriveParams&) = nullptr;
  // Where such a report shows the ground, in R.
  Zone (*reported_zone)(const DriveParams&) = nullptr;
  // Of a look without what the navigator adds.
  LookTime (*look_time)(const DriveParams&, const ComputeTimes&) = nullptr;
  // Whose view can be drawn; nullptr where it has none.
  const sensing::StereoParams* (*cameras)(const DriveParams&) = nullptr;

  std::unique_ptr<TerrainSensorModel> (*make)(
      const DriveParams&, core::TrialKey, const std::function<void(const WatchedScan&)>&) = nullptr;
};

// The one list of them.
const TerrainSensorKind& KindOf(TerrainSensor sensor);

}  // namespace rockyard::trial
