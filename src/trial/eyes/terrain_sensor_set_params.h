// The terrain sensors that a scenario can name, and all that a trial asks of a sensor, whichever it
// is: what it requires of a scenario, what it shows, how long a look takes, and how it is made. The
// two sides of a drive make their halves of it, checks of scenarios and times of looks ask it.
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

// The array of the hazard reports that a sensor leads to.
struct ReportArray {
  std::int64_t stripes = 0;
  std::string_view owner;       // whose number of stripes this is, as the end of a sentence
  std::string_view suggestion;  // remedy where a navigator names another number
};

// One kind of sensor. A kind with parameters of its own derives from
// core::KindWithParams<TerrainSensorKind, Params>.
class TerrainSensorKind : public core::Kind {
 public:
  using core::Kind::Kind;

  virtual std::unique_ptr<TerrainSensorKind> Clone() const = 0;

  // Returns whether the sensor's data are worked out by the rover's computer, which starts up
  // before the first look and judges elevations after each look.
  virtual bool uses_computer() const = 0;
  // Returns whether looks are counted as sets of images, with looks behind counted apart, not as
  // scans.
  virtual bool takes_image_sets() const = 0;

  // Require what must hold in every experiment that uses the sensor, and in a drive to a goal.
  virtual void Require(const DriveParams& drive, core::FieldVisitor& v) const = 0;
  virtual void RequireDrive(const DriveParams& drive, core::FieldVisitor& v) const = 0;

  virtual ReportArray report_array(const DriveParams& drive) const = 0;
  // Returns where a hazard report shows the ground, in R.
  virtual Zone reported_zone(const DriveParams& drive) const = 0;
  // Returns the time of a look, without what the navigator adds.
  virtual LookTime look_time(const DriveParams& drive, const ComputeTimes& times) const = 0;
  // Returns the stereo cameras, whose view can be drawn; nullptr where the sensor has none.
  virtual const sensing::StereoParams* cameras(const DriveParams& drive) const = 0;

  // Make the two halves of the sensor: what measures the world, where it takes images with
  // `cameras`, which outlive it; and what reads the measurements on board.
  virtual std::unique_ptr<TerrainSensor> MakeSensor(const DriveParams& drive, core::TrialKey key,
                                                    RoverCameras& cameras) const = 0;
  virtual std::unique_ptr<TerrainReader> MakeReader(const DriveParams& drive,
                                                    const SightWatchers& watchers) const = 0;
};

// The terrain sensors that a scenario can name.
class TerrainSensorSet : public core::KindSet<TerrainSensorKind> {
 public:
  TerrainSensorSet();

  // Adds a kind. Throws core::UserError where the name is taken or cannot be a key.
  void Add(std::unique_ptr<TerrainSensorKind> kind) { AddKind(std::move(kind)); }
};

// Returns the one list of terrain sensors: light_stripe, which is the default, and stereo.
TerrainSensorSet StandardTerrainSensors();

}  // namespace rockyard::trial
