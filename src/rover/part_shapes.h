// The parts of the rover that can touch something: each a convex core grown by a margin. The
// contact finders of both fidelities test these parts, URDF files and replays show them.
#pragma once

#include <vector>

#include "math/pose.h"
#include "rover/multibody/multibody.h"
#include "rover/rover_params.h"
#include "truth/rover_state.h"

namespace rockyard::rover {

// Sine of a wheel's tilt against ground or wall at which it stands on the edge of its rim. At a
// smaller tilt the contact moves across the rim in proportion to the tilt, as soft soil bears the
// whole width; the contact of the wheel's side with a wall moves across that side in the same way.
inline constexpr double kEdgeTilt = 0.1;
// Cosine of the tilt of the chassis beyond which corners of chassis and panel are tested against
// plane ground: below that tilt they cannot touch it, as far as rockers and bogies let the chassis
// lean.
inline constexpr double kUprightCosine = 0.9;

// The core of a part, given by the vectors a_B and b_B of the part.
enum class Core {
  kPoint,
  kSegment,   // between a and b
  kCylinder,  // about the y axis through a: radius b.x, half width b.y
  kBox,       // centre a, half extents b; axes of the body
};

// What a part is tested against. kEverything: rocks, ground and walls.
enum class Meets { kRocks, kEverything, kGroundAndWalls };

// A part of the rover: all points within margin_m of its core. Vectors are in the frame of its
// body.
struct Part {
  truth::BodyPart kind;
  int body;  // as numbered in multibody.h
  Core core;
  Meets meets;
  math::Vector3 a_B;
  math::Vector3 b_B;
  double margin_m;
  math::Vector3 center_B;  // of a ball that holds core and margin
  double bounding_radius_m;
};

// Makes the parts. Must stay: wheels come first, in the order of messages::Wheel, as users take the
// index of a wheel's part for the wheel. Records depend on the order of all parts, which is the
// order of contacts. Wheels are cylinders with rounded edges. Arms are capsules along the lines
// pivot to pivot, pivot to knee and, as strut beside the wheel, knee to hub; hubs are balls at the
// inner face of each wheel, the panel is a slab of the overall length and width on top. Against
// ground and walls the corners of chassis and panel stand for these two boxes.
std::vector<Part> MakeParts(const RoverGeometryParams& params);

// Returns the point of the core nearest to p, both in the frame of the body.
math::Vector3 NearestOnCore(const Part& part, const math::Vector3& p_B);

// Returns the smallest n . x over the points x of the core, both in the frame of the body, m.
double LeastAlong(const Part& part, const math::Vector3& n_B);

}  // namespace rockyard::rover
