// The light of a stripe: where a scanline meets its plane, for the geometric sensor, and how bright
// it is there, for the sensor's images. The lasers are lamps of a rendered image: the cross section
// of a beam, the fan of one emitter, the stripes of all emitters. Records depend on the bits of
// ScanCurve where lenses bend rows, on all others where drives take images.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "math/functions.h"
#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/camera.h"
#include "rendering/image_scene.h"
#include "rendering/row_renderer.h"
#include "sensing/light_stripe_params.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

// The curve in which a scanline meets a light plane. An image row sees a curved surface; with the
// light plane n . (p - e) = 0 it has the curve
//   p(c) = o + ray(c) n . (e - o) / n . ray(c)
// in common, o the camera, ray(c) the viewing ray of column c (vision/lens.h). The curve is
// followed by chords between points on it, from the image border near the emitter down to the
// lowest searched elevation. Chords lie in the light plane; a point on one lies less than
// kChordError_m off the curve, by which the row that sees it differs from the scanline, not its
// column.
class ScanCurve {
 public:
  // A tenth of what a pixel of the published sensor resolves at 30 cm.
  static constexpr double kChordError_m = 0.0002;

  // The curve is empty where no column of the camera sees the light plane above the lowest searched
  // elevation. Cost: one viewing ray per column.
  ScanCurve(const messages::StripeCalibration& calibration, std::size_t row, std::size_t stripe);

  // Returns the columns of the elevations between search_low and search_high, within the image.
  messages::ColumnRange searched() const { return searched_; }

  // Returns the first surface along the chords, in W, with the rover at X_WR; none where the curve
  // ends first. Cost: one ray query a chord.
  std::optional<math::Vector3> FirstHit(const terrain::Terrain& terrain,
                                        const math::Transform& X_WR,
                                        std::span<const int> rocks) const;

  // Returns the ends of the chords, in R, from the emitter's side downwards.
  const std::vector<math::Vector3>& vertices() const { return vertices_R_; }

 private:
  std::vector<math::Vector3> vertices_R_;
  messages::ColumnRange searched_;
};

// How the light of a beam is spread across the light plane. Both profiles carry the power 1.
// Gaussian: f(a) = exp(-a^2 / 2 s^2) / (s sqrt(2 pi)) with s = w / 4, so that the width w lies
// between the points at 1/e2 of the peak (ISO 11146: 4 s); it is cut off at 5 s, which drops 6e-7
// of the light. Top hat: 1 / w within w / 2.
class BeamCrossSection {
 public:
  BeamCrossSection(BeamProfile profile, double width_rad)
      : profile_(profile), width_rad_(width_rad), sigma_rad_(0.25 * width_rad) {}

  // Returns the angle beyond which there is no light.
  double reach_rad() const {
    return profile_ == BeamProfile::kTopHat ? 0.5 * width_rad_ : 5.0 * sigma_rad_;
  }

  // Returns f at an angle, 1/rad.
  double Density(double angle_rad) const {
    if (std::abs(angle_rad) > reach_rad()) return 0.0;
    if (profile_ == BeamProfile::kTopHat) return 1.0 / width_rad_;
    const double x = angle_rad / sigma_rad_;
    return math::Exp(-0.5 * x * x) / (sigma_rad_ * std::sqrt(2.0 * std::numbers::pi));
  }

  // Returns the integral of f up to the angle, C.
  double Cumulative(double angle_rad) const {
    if (angle_rad <= -reach_rad()) return 0.0;
    if (angle_rad >= reach_rad()) return 1.0;
    if (profile_ == BeamProfile::kTopHat) return 0.5 + angle_rad / width_rad_;
    return 0.5 * math::Erfc(-angle_rad / (sigma_rad_ * std::numbers::sqrt2));
  }

  // Returns the mean of f between two angles, 1/rad: what a pixel between them sees.
  double Mean(double from_rad, double to_rad) const {
    constexpr double kPoint_rad = 1e-9;
    const double width_rad = to_rad - from_rad;
    if (std::abs(width_rad) < kPoint_rad) return Density(from_rad);
    return (Cumulative(to_rad) - Cumulative(from_rad)) / width_rad;
  }

 private:
  BeamProfile profile_;
  double width_rad_;
  double sigma_rad_;
};

// Returns P / F of LaserFan, W/rad: the optical power of one emitter over the angle of its light
// plane that it lights.
double FanPower(const LightStripeParams& params);

// An emitter sends its power P evenly over the angle F of its fan and, across the light plane, in
// the beam's cross section f: the irradiance of a surface at range r, incidence i and the angle a
// out of the plane is E = P / (F r^2) f(a) cos(i). A full fan has F = fan_rad. With three_scanlines
// each measured point has an emitter of its own, of the same power, that lights three scanlines
// around the point: F = 3 row pitches (Matthies 1995, section 6). Where scanlines are planes (every
// lens but kEquidistant) and emitters sit on the cameras' lateral axis, as in the default layout,
// the point of a raised surface lies on the same scanline. Elsewhere a thin beam leaves its
// scanline; parameters refuse three_scanlines with kEquidistant.
class LaserFan {
 public:
  LaserFan(const LightStripeParams& params, const messages::StripeCalibration& calibration,
           const messages::StripeLaser& laser);

  const math::Vector3& p_RoE_R() const { return p_RoE_R_; }
  const math::Vector3& normal_R() const { return normal_R_; }
  double power_w_rad() const { return power_w_rad_; }  // P / F

  // Returns whether a direction from the emitter, taken in the light plane, is lit.
  bool Lights(const math::Vector3& away_R) const;

 private:
  math::Vector3 p_RoE_R_;
  math::Vector3 normal_R_;
  std::vector<math::Vector3> axes_R_;  // directions to the middles of what it lights
  double half_fan_cosine_ = 1.0;
  double power_w_rad_ = 0.0;
};

// The fan of one emitter in the scene of one scan.
class LitFan {
 public:
  // This must not outlive any of its arguments. `reach_rad` is that of the beam's cross section.
  LitFan(const LaserFan& fan, const rendering::ImageScene& scene, double reach_rad);

  // Returns the angle, rad, of a point out of the light plane, seen from the emitter; positive on
  // the side of the plane's normal.
  double OutOfPlane(const math::Vector3& p_W) const;

  // Returns whether both points lie on the same side of the plane and too far from it for any
  // light.
  bool PassesBy(const math::Vector3& a_W, const math::Vector3& b_W) const {
    const double a_m = normal_W_.dot(a_W) - offset_m_;
    const double b_m = normal_W_.dot(b_W) - offset_m_;
    return (a_m > width_m_ && b_m > width_m_) || (a_m < -width_m_ && b_m < -width_m_);
  }

  // Returns E / f(a) of a point, W/m2 times rad; 0 where it is out of the fan, turned away, or
  // hidden from the emitter.
  double Irradiance(const rendering::SurfacePoint& point) const;

 private:
  const LaserFan* fan_;
  const rendering::ImageScene* scene_;
  math::Vector3 p_WoE_W_;
  math::Vector3 normal_W_;
  double offset_m_;         // normal . p of the light plane
  double width_m_;          // of the lit sheet on each side, where it is widest
  std::vector<int> rocks_;  // those that reach into the sheet
};

// The stripes in one scene, integrated over each pixel in closed form. For a pixel that shows one
// surface, let a and b be the angles of its edges out of the light plane, seen from the emitter.
// The light of a laser on it is
//   E = P / (F r^2) cos(i) (C(b) - C(a)) / (b - a),
// C the cumulative cross section of the beam; P / (F r^2) cos(i) (LitFan) is the mean of the
// two edges. The pixels of a line share the edges, so that the sum over them loses no light.
//
// Deviation: a pixel is sampled along the middle of its line, so that a stripe which runs across
// the line is as wide as it is there (those of the default layout move by 0.1 to 0.2 columns from
// line to line).
class LitStripes final : public rendering::Lamps {
 public:
  // The scene of the fans and the beam must outlive this.
  LitStripes(const BeamCrossSection& beam, std::vector<LitFan> fans)
      : beam_(beam), fans_(std::move(fans)) {}

  void Add(const rendering::SurfacePoint& left, const rendering::SurfacePoint& right, int pixel,
           double gain, rendering::RenderedRow& row) const override;

 private:
  const BeamCrossSection& beam_;
  std::vector<LitFan> fans_;
};

// All lasers of the sensor, made once.
class StripeLight {
 public:
  StripeLight(const LightStripeParams& params, const messages::StripeCalibration& calibration);

  // Finds what each laser may light in the scene. Scene and this must outlive the stripes.
  LitStripes Meet(const rendering::ImageScene& scene) const;

 private:
  std::vector<LaserFan> fans_;
  BeamCrossSection beam_;
};

}  // namespace rockyard::sensing
