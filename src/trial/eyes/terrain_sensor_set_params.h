// The terrain sensors that a scenario can name, and all that a trial asks of one, whichever it is:
// what it requires of a scenario, what it shows, how long a look takes, and how it is made.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

#include "core/fields.h"
#include "core/kind_set.h"
#include "core/random.h"
#include "sensing/stereo_params.h"

namespace rockyard::trial {

struct ComputeTimes;
struct DriveParams;
struct LookTime;
struct SightWatchers;
struct Zone;
class RoverCameras;
class TerrainReader;
class TerrainSensor;

// The array of a hazard report that the sensor leads to.
struct ReportArray {
  std::int64_t stripes = 0;
  std::string_view owner;       // whose number of stripes this is, as the end of a sentence
  std::string_view suggestion;  // where a navigator names another number
};

// One with parameters of its own derives from core::KindWithParams<TerrainSensorKind, Params>.
class TerrainSensorKind : public core::Kind {
 public:
  using core::Kind::Kind;

  virtual std::unique_ptr<TerrainSensorKind> Clone() const = 0;

  // Whether its data are worked out by the rover's computer, which starts up before the first look
  // and judges elevations after each.
  virtual bool uses_computer() const = 0;
  // Whether looks are counted as sets of images, of those that look behind apart, not as scans.
  virtual bool takes_image_sets() const = 0;

  // Requires what must hold in every experiment that uses it, and in a drive.
  virtual void Require(const DriveParams& drive, core::FieldVisitor& v) const = 0;
  virtual void RequireDrive(const DriveParams& drive, core::FieldVisitor& v) const = 0;

  virtual ReportArray report_array(const DriveParams& drive) const = 0;
  // Where such a report shows the ground, in R.
  virtual Zone reported_zone(const DriveParams& drive) const = 0;
  // Of a look without what the navigator adds.
  virtual LookTime look_time(const DriveParams& drive, const ComputeTimes& times) const = 0;
  // Whose view can be drawn; nullptr where it has none.
  virtual const sensing::StereoParams* cameras(const DriveParams& drive) const = 0;

  // Its two halves: what measures the world, with `cameras`, which outlive it, where it takes
  // images; and what reads its measurements on board.
  virtual std::unique_ptr<TerrainSensor> MakeSensor(const DriveParams& drive, core::TrialKey key,
                                                    RoverCameras& cameras) const = 0;
  virtual std::unique_ptr<TerrainReader> MakeReader(const DriveParams& drive,
                                                    const SightWatchers& watchers) const = 0;
};

class TerrainSensorSet : public core::KindSet<TerrainSensorKind> {
 public:
  TerrainSensorSet();

  // Throws core::UserError where the name is taken or is no key at all.
  void Add(std::unique_ptr<TerrainSensorKind> kind) { AddKind(std::move(kind)); }
};

// The one list of them: light_stripe (chosen), stereo.
TerrainSensorSet StandardTerrainSensors();

}  // namespace rockyard::trial
