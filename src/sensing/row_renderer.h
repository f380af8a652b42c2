// Light on the pixels of one image line: rays cast at the edges between pixels, the laser stripes
// integrated over each pixel in closed form.
#pragma once

#include <array>
#include <vector>

#include "math/pose.h"
#include "messages/calibration.h"
#include "sensing/beam_profile.h"
#include "sensing/image_scene.h"
#include "sensing/light_stripe_params.h"
#include "sensing/view_row.h"

namespace rockyard::sensing {

// Expected photoelectrons per second of one image line.
struct RenderedRow {
  struct LaserPixel {
    int pixel = 0;  // counts from the first column of the line
    int laser = 0;
    double rate_e_s = 0.0;
  };

  int row = 0;
  std::vector<double> sun_e_s;     // per pixel, all lasers off
  std::vector<LaserPixel> lasers;  // what each laser adds, where it adds anything
};

// Sunlight of a pixel: mean of its two edges. Laser light of a pixel on one surface: with the
// angles a, b of its edges out of the light plane, seen from the emitter,
//   E = P / (F r^2) cos(i) (C(b) - C(a)) / (b - a),
// P optical power, F lit angle of the fan, r range, i incidence, C cumulative beam profile; P / (F
// r^2) cos(i) is the mean of the two edges, 0 for an edge out of the fan or hidden from the
// emitter. The pixels of a line share the edges, so that the sum over them loses no light. Pixels
// in which the surface ends are split into kParts parts by further rays. Lambert surfaces.
//
// Deviations: a pixel is sampled along the line through its middle, so that a stripe which runs
// across the line is as wide as it is there (those of the default layout move by 0.1 to 0.2 columns
// from line to line). The lens is sharp, nothing reflects twice, and the rover's own parts show no
// laser light.
class RowRenderer {
 public:
  static constexpr int kParts = 8;

  RowRenderer(const LightStripeParams& params, const messages::StripeCalibration& calibration);

  // Cost: see the benchmark of the images; about 0.1 ms for 768 pixels.
  RenderedRow Render(const ImageScene& scene, const math::Vector3& eye_R,
                     const ViewRow& view) const;

 private:
  // Where one emitter sends its light.
  struct Emitter {
    math::Vector3 p_RoE_R;
    math::Vector3 normal_R;
    std::vector<math::Vector3> axes_R;  // centres of its fans
    double half_fan_cosine = 1.0;
  };
  struct Job;  // one call of Render

  static Emitter MakeEmitter(const LightStripeParams& params,
                             const messages::StripeCalibration& calibration, std::size_t laser);
  static bool InFan(const Emitter& emitter, const math::Vector3& away_R);
  double OutOfPlane(const Job& job, std::size_t laser, const math::Vector3& p_W) const;
  double PeakIrradiance(const Job& job, std::size_t laser, const SurfacePoint& point) const;
  void AddLasers(const Job& job, const SurfacePoint& left, const SurfacePoint& right, int pixel,
                 double share, RenderedRow& row) const;
  void SplitPixel(const Job& job, const ViewRow& view, int pixel, RenderedRow& row) const;

  std::vector<Emitter> emitters_;
  BeamCrossSection beam_;
  double fan_power_w_rad_ = 0.0;
  double electrons_per_radiance_ = 0.0;
};

}  // namespace rockyard::sensing
