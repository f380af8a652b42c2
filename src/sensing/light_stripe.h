// The light stripe sensor without images (fidelity geometric): where light planes and scanlines
// meet the terrain, and the measured errors of detection. Drives and studies of hazard detection
// look by it. Records depend on its bits and draws; within a step points draw in turn, row by row,
// whether found or not.
//
// Words of all files of this sensor, here and on board. The array has a point for each scanline and
// laser, indexed [row][stripe] (messages/stripe_array.h): a row is the points of one scanline, 0
// nearest; a stripe is the points of one laser. A scanline is the image row on which a camera looks
// for the points of one row. An image column is a place along it, in pixels from the optical axis.
// Ranges are distances along the ray.
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
#include "sensing/stripe_light.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

// The measured error model. It disturbs a scan in this order, each point on its own:
//   column    moved by a normal amount with deviation column_noise_px, rounded to whole pixels, and
//             kept inside the searched part
//   missed    not found with missed_probability, or with the point's own chance (missed_at)
//   misplaced at a random column with wrong_place_probability, also where nothing was visible
//
// Outliers persist: from one scan to the next a point keeps its lot (whether it is misplaced, and
// to which column) with the chance r = outlier_persistence; otherwise the lot is drawn anew. The
// share of misplaced points stays p = wrong_place_probability. A misplaced point is misplaced in
// the next scan, too, with the chance r + (1 - r) p. Matthies 1995, section 6, counts on
// independence (r = 0, the default); figure 8's run shows a false alarm that two scans must have
// agreed on.
class StripeErrors {
 public:
  // The searched part of the scanline of each point.
  using Searched = messages::StripeArray<messages::ColumnRange>;

  explicit StripeErrors(const LightStripeParams& params) : params_(params) {}

  // Adds the errors to a scan. It is a pure function of its arguments, whatever was scanned before:
  // an older lot is drawn again by the number of its scan. It draws from (kStripeColumnNoise,
  // kStripeMissed, kStripeWrongPlace; scan number). With persistence it also draws from
  // (kStripePersistence; scan number) and goes back to the scan in which the oldest lot was drawn:
  // 1 + log(points) / log(1 / r) scans on average, of 0.5 us each. Errors of size zero draw nothing
  // and cost nothing.
  void Disturb(core::TrialKey key, const Searched& searched, messages::StripeScan& scan) const;

 private:
  void MoveColumns(core::TrialKey key, const Searched& searched, messages::StripeScan& scan) const;
  void Miss(core::TrialKey key, messages::StripeScan& scan) const;
  void Misplace(core::TrialKey key, const Searched& searched, messages::StripeScan& scan) const;
  // Calls place(point, column) for every point that the draws of that scan misplace.
  template <typename Place>
  void DrawMisplaced(core::TrialKey key, std::int64_t number, const Searched& searched,
                     Place place) const;

  LightStripeParams params_;
};

// The sensor: which points of its array are found, and in which image column.
//
// Model (Matthies 1995, section 6, table 3). With the lens kEquidistantRows, row r of a camera sees
// the scanline plane that holds the camera's lateral axis and lies row_angle[r] below its optical
// axis; a stripe's point is the first surface along the line in which scanline plane and light
// plane meet, starting at the emitter. Other lenses see curved surfaces, which meet the light plane
// in a curve (ScanCurve) that is followed in the same way, from the image border on. The point
// is found if
//   - light reaches it: within the fan and unobstructed from the emitter (with emitters on the
//     cameras' lateral axis, the layout of the defaults, the line itself is the light ray),
//   - the camera sees it: unobstructed, within max_range and the field of view,
//   - its column belongs to the searched part of the scanline: those of elevations between
//     search_low and search_high.
// The column is rounded to a whole pixel. Then the measured errors of detection are added
// (StripeErrors). Columns are all that it reports: elevations are made on board, by the geometry
// that the rover believes.
//
// Deviations. Beam width, partly lit pixels, stray light, and the rover's own parts are left out;
// of several points that one laser lights on a scanline only the one nearest to the emitter counts.
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
    // Between these distances along the line, points are within max_range of the camera; none where
    // last < 0, as on a light ray outside of the fan.
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
