// Light stripe sensor: which of its 20 points are found, and in which image column.
//
// Model (Matthies 1995, section 6, table 3). With the lens kEquidistantRows, row r of a camera sees
// the scanline plane that holds the camera's lateral axis and lies row_angle[r] below its optical
// axis; a stripe's point is the first surface along the line in which scanline plane and light
// plane meet, starting at the emitter. Other lenses see curved surfaces, which meet the light plane
// in a curve (scan_curve.h) that is followed in the same way, from the image border on. The point
// is found if
//   - light reaches it: within the fan and unobstructed from the emitter (with emitters on the
//     cameras' lateral axis, the layout of the defaults, the line itself is the light ray),
//   - the camera sees it: unobstructed, within max_range and the field of view,
//   - its column belongs to the searched part of the scanline: those of elevations between
//     search_low and search_high.
// The column is rounded to a whole pixel. Then the measured errors of detection are added
// (stripe_errors.h).
//
// Deviations. Beam width, partly lit pixels, stray light, and the rover's own wheels are left out;
// of several lit points on one scanline only the one nearest to the emitter counts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/camera.h"
#include "messages/measurements.h"
#include "sensing/light_stripe_params.h"
#include "sensing/scan_curve.h"
#include "sensing/stripe_errors.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

// The sensor at the geometric fidelity.
class LightStripe {
 public:
  explicit LightStripe(const LightStripeParams& params);

  // Makes one scan with the rover at X_WR. It is a pure function of its arguments. It draws as
  // StripeErrors does, whatever the terrain holds: the same points are misplaced on every terrain.
  // Cost: some microseconds; one surface query and one occlusion query per point against the rocks
  // near the footprint; a surface query for each chord with curved scanlines.
  messages::StripeScan Scan(const terrain::Terrain& terrain, const math::Transform& X_WR,
                            core::TrialKey key, std::int64_t scan_number) const;

  // Returns the geometry of the true sensor.
  const messages::StripeCalibration& calibration() const { return calibration_; }

  // Returns the searched part of a point's scanline.
  messages::ColumnRange searched(std::size_t row, std::size_t stripe) const {
    return searched_[row][stripe];
  }

 private:
  // A line in which a scanline plane meets a light plane, in R, and how the camera sees it.
  struct Line {
    math::Vector3 start_R;
    math::Vector3 direction_R;  // unit, away from the sensor
    double length_m = 0.0;      // to the lowest searched elevation
    bool is_light_ray = false;  // starts at the emitter
    // A point at distance t lies forward_m + t forward_slope ahead of the camera within the
    // scanline plane, and right_m + t right_slope to its right.
    double forward_m = 0.0;
    double forward_slope = 0.0;
    double right_m = 0.0;
    double right_slope = 0.0;
    // Points are near enough to the camera and, on a light ray, lit at all between these distances;
    // none where first > last or last < 0.
    double first_m = 0.0;
    double last_m = -1.0;
  };

  // The rocks that the scan may meet, and those of them that reach into the light plane of one
  // stripe.
  struct Candidates {
    std::span<const int> near;
    std::span<const int> lit;
  };

  std::size_t PointIndex(std::size_t row, std::size_t stripe) const {
    return row * calibration_.lasers.size() + stripe;
  }
  const messages::Camera& CameraOf(std::size_t stripe) const {
    return calibration_.cameras[static_cast<std::size_t>(calibration_.lasers[stripe].camera)];
  }
  Line MakeLine(std::size_t row, std::size_t stripe) const;
  void SetView(const messages::Camera& camera, double row_angle_rad, Line& line) const;
  messages::ColumnRange SearchedColumns(const messages::Camera& camera, const Line& line) const;
  static int ColumnAt(const Line& line, double distance_m, const messages::Camera& camera);
  bool InFan(const math::Vector3& p_R, std::size_t stripe) const;
  void AddLines(Eigen::AlignedBox3d& reach_R);
  void AddCurves(Eigen::AlignedBox3d& reach_R);
  messages::StripePixel FindOnLine(const terrain::Terrain& terrain, const math::Transform& X_WR,
                                   std::size_t row, std::size_t stripe,
                                   const Candidates& rocks) const;
  messages::StripePixel FindOnCurve(const terrain::Terrain& terrain, const math::Transform& X_WR,
                                    std::size_t row, std::size_t stripe,
                                    const Candidates& rocks) const;

  LightStripeParams params_;
  StripeErrors errors_;
  messages::StripeCalibration calibration_;
  int last_column_ = 0;  // columns run from -last_column_ to last_column_
  messages::StripeArray<messages::ColumnRange> searched_;
  std::vector<Line> lines_;        // [row][stripe], with straight scanlines
  std::vector<ScanCurve> curves_;  // [row][stripe], with curved ones
  std::vector<double> half_fan_cosine_;
  math::Vector3 reach_center_R_ = math::Vector3::Zero();  // of a sphere around all lines and eyes
  double reach_radius_m_ = 0.0;
};

}  // namespace rockyard::sensing
