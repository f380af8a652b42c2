// Bodies of one colour, or of four: what a ray meets of each.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "math/pose.h"
#include "rendering/cylinder/colour.h"

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

}  // namespace rockyard::rendering
