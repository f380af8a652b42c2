// The ground between the rocks: a plane with a slope, and optional fractal roughness.
#pragma once

#include <cstdint>
#include <memory>

#include "core/random.h"
#include "math/pose.h"
#include "terrain/ground_params.h"

namespace rockyard::terrain {

class RoughnessField;  // smooth height field, private to ground.cc

class Ground {
 public:
  Ground();  // flat, z = 0
  Ground(const GroundParams& params, core::TrialKey key);

  // Height above the world's z = 0 plane, m.
  double Height(double x_m, double y_m) const;
  // Unit normal, pointing up.
  math::Vector3 Normal(double x_m, double y_m) const;
  // True when the ground is one plane, so that contacts and rays have closed forms.
  bool IsPlane() const { return roughness_ == nullptr; }

 private:
  double slope_x_ = 0.0;  // dz/dx
  double slope_y_ = 0.0;  // dz/dy
  std::shared_ptr<const RoughnessField> roughness_;
};

}  // namespace rockyard::terrain
