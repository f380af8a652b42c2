// Everything before the cameras that is no background: the cylinder, its stand, rocks, hardware.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/random.h"
#include "math/pose.h"
#include "rendering/cylinder/colour_light.h"
#include "rendering/cylinder/cylinder_params.h"
#include "rendering/cylinder/cylinder_view.h"

namespace rockyard::rendering {

// A half line from `origin` (m) along `direction`, of any length.
struct ColourRay {
  math::Vector3 origin = math::Vector3::Zero();
  math::Vector3 direction = math::Vector3::UnitX();
};

struct BodyHit {
  double along = 0.0;  // origin + along * direction
  math::Vector3 normal = math::Vector3::UnitZ();
  int part = 0;  // a face or a quadrant, from 0 on; below kBodyParts
};

inline constexpr int kBodyParts = 8;

enum class BodyShape {
  kEllipsoid,  // of these half axes
  kBox,        // of these half sides
  kCylinder,   // upright: radius half.x(), half height half.z(); quadrants of its wall are parts 0
               // to 3, its flat top is part 4
};

// Positions are in L. A body stands upright and is turned by its heading about z.
struct ColouredBody {
  BodyShape shape = BodyShape::kBox;
  math::Vector3 middle_L = math::Vector3::Zero();
  math::Vector3 half = math::Vector3::Ones();
  double heading_rad = 0.0;
  std::array<Colour, kBodyParts> colours{};  // by part
};

// The first meeting of a ray with a body from outside, by closed forms; the bottom of a cylinder is
// not seen. Nothing behind the origin.
class BodyCaster {
 public:
  explicit BodyCaster(ColouredBody body);

  std::optional<BodyHit> Cast(const ColourRay& ray) const;
  const ColouredBody& body() const { return body_; }
  // Corners of the upright box around it, in L.
  std::array<math::Vector3, 8> Corners() const;

 private:
  std::optional<BodyHit> CastEllipsoid(const ColourRay& ray_B) const;
  std::optional<BodyHit> CastBox(const ColourRay& ray_B) const;
  std::optional<BodyHit> CastCylinder(const ColourRay& ray_B) const;

  ColouredBody body_;
  double cosine_;
  double sine_;
};

// Bodies in L. With the cylinder present the first is the cylinder.
//
// Rocks are ellipsoids, sunk by a tenth of their height; hardware are boxes. Their numbers are
// Poisson's, their places uniform over the ground between nearest_m and farthest_m within the
// columns' field of view; one that would come nearer to the cylinder than clear_m is left out.
// Draws from (key, kCylinderScene): substream 0 rocks, 1 hardware, whatever the view is, so that
// surroundings stay where the cylinder turns.
std::vector<BodyCaster> CylinderBodies(const CylinderPictureParams& params,
                                       const CylinderView& view, core::TrialKey key);

}  // namespace rockyard::rendering
