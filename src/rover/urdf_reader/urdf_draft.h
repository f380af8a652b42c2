// A rover while it is read from a URDF file: the parameters so far, and which of them the file
// tells. The parts of the reader (dimensions, masses, motors) each add what they know.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "math/pose.h"
#include "rover/rover_params.h"
#include "rover/urdf_reader/urdf_findings.h"
#include "rover/urdf_reader/urdf_model.h"
#include "rover/urdf_reader/urdf_skeleton.h"

namespace rockyard::rover {

// Lengths that differ by less count as the same: what nobody measures on a rover, m.
inline constexpr double kSameLength_m = 1e-4;
// The same for other numbers, as a share of the larger.
inline constexpr double kSameShare = 1e-6;

// Returns a length without the rounding errors of sums of origins: the nearest whole picometre. So
// decimals that somebody wrote come back as the same double.
double WithoutRounding_m(double length_m);

// Returns the same of other sums and products: twelve significant digits.
double TwelveDigits(double value);

// A value and where it stands in the file.
struct ToldValue {
  double value = 0.0;
  std::string place;
};

// What the parts of the reader work on.
struct UrdfDraft {
  const UrdfModel& model;
  const UrdfSkeleton& skeleton;
  UrdfFindings& findings;
  RoverParams params{};                         // defaults where the file tells nothing
  std::map<std::string, std::string> places{};  // of parameters that the file tells, by path

  // Sets a parameter. `path` is that of `field`, "geometry.wheel_radius_m".
  template <typename Value>
  void Carry(std::string_view path, Value& field, const Value& value, std::string_view place) {
    field = value;
    places[std::string(path)] = place;
  }

  // Sets a parameter to what several places tell of it, which is their mean where they differ; by
  // more than `tolerance`, that is named. Does nothing where none tells it.
  void CarryAgreed(std::string_view path, double& field, const std::vector<ToldValue>& told,
                   double tolerance);
  // The same of lengths, without rounding errors.
  void CarryLength(std::string_view path, double& field, std::vector<ToldValue> told,
                   double tolerance_m = kSameLength_m);

  // Returns the centre of a wheel's rim in R, m.
  math::Vector3 p_RWheel(std::size_t wheel) const {
    return skeleton.wheels[wheel].rim.center_0 - skeleton.p_0R;
  }
  const UrdfJoint& Joint(std::size_t joint) const { return model.joints[joint]; }
};

// Wheels, pivots, and which wheels steer.
void ReadUrdfWheels(UrdfDraft& draft);
// Arms and hubs; after the wheels.
void ReadUrdfArms(UrdfDraft& draft);
// Chassis and panel; after the wheels.
void ReadUrdfBody(UrdfDraft& draft);
// Masses; inertias are compared with those of rockyard's rover, so that it comes after the
// dimensions.
void ReadUrdfMasses(UrdfDraft& draft);
// Stops, motors, the differential, and what other joints there are; after the wheels.
void ReadUrdfJoints(UrdfDraft& draft);

}  // namespace rockyard::rover
