#include "sensing/light_stripe.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/check.h"
#include "core/random.h"
#include "math/functions.h"
#include "rendering/occlusion.h"
#include "sensing/stripe_layout_params.h"
#include "vision/lens.h"

namespace rockyard::sensing {

namespace {

using messages::ColumnRange;
using messages::StripePixel;

std::uint32_t Substream(std::int64_t number) { return static_cast<std::uint32_t>(number); }

}  // namespace

void StripeErrors::Disturb(core::TrialKey key, const Searched& searched,
                           messages::StripeScan& scan) const {
  if (params_.column_noise_px > 0.0) MoveColumns(key, searched, scan);
  if (params_.missed_probability > 0.0 || !params_.missed_at.empty()) Miss(key, scan);
  if (params_.wrong_place_probability > 0.0) Misplace(key, searched, scan);
}

void StripeErrors::MoveColumns(core::TrialKey key, const Searched& searched,
                               messages::StripeScan& scan) const {
  core::RandomStream stream(key, core::Purpose::kStripeColumnNoise, Substream(scan.number));
  const auto pixels = scan.pixels.points();
  for (std::size_t point = 0; point < pixels.size(); ++point) {
    // Drawn for every point, found or not: what a scan sees shifts no other point's noise.
    const double shift = std::round(core::SampleNormal(stream, 0.0, params_.column_noise_px));
    if (!pixels[point].detected || searched.points()[point].empty()) continue;
    pixels[point].column_px = std::clamp(pixels[point].column_px + shift,
                                         static_cast<double>(searched.points()[point].first),
                                         static_cast<double>(searched.points()[point].last));
  }
}

// Drops found points. Every point draws, whether it was found or not.
void StripeErrors::Miss(core::TrialKey key, messages::StripeScan& scan) const {
  core::RandomStream missed(key, core::Purpose::kStripeMissed, Substream(scan.number));
  const auto pixels = scan.pixels.points();
  for (std::size_t point = 0; point < pixels.size(); ++point) {
    const double probability =
        params_.missed_at.empty() ? params_.missed_probability : params_.missed_at[point];
    if (core::SampleBernoulli(missed, probability)) pixels[point] = {};
  }
}

template <typename Place>
void StripeErrors::DrawMisplaced(core::TrialKey key, std::int64_t number, const Searched& searched,
                                 Place place) const {
  const int last_column = static_cast<int>(params_.columns / 2);
  core::RandomStream wrong(key, core::Purpose::kStripeWrongPlace, Substream(number));
  messages::StripeArray<bool> misplaced(searched.size());
  // The order of draws decides records: all lots first, then the columns of misplaced points.
  for (bool& point : misplaced.points()) {
    point = core::SampleBernoulli(wrong, params_.wrong_place_probability);
  }
  for (std::size_t point = 0; point < misplaced.points().size(); ++point) {
    const ColumnRange range = params_.wrong_place == WrongPlace::kSearchedPart
                                  ? searched.points()[point]
                                  : ColumnRange{-last_column, last_column};
    if (!misplaced.points()[point] || range.empty()) continue;
    // A whole column from first to last, all equally likely.
    place(point, std::floor(core::SampleUniform(wrong, range.first, range.last + 1.0)));
  }
}

void StripeErrors::Misplace(core::TrialKey key, const Searched& searched,
                            messages::StripeScan& scan) const {
  const auto pixels = scan.pixels.points();
  if (params_.outlier_persistence <= 0.0) {
    DrawMisplaced(key, scan.number, searched, [&](std::size_t point, double column) {
      pixels[point] = {.detected = true, .column_px = column};
    });
    return;
  }
  // Points whose lot was drawn in an earlier scan than those looked at so far.
  messages::StripeArray<bool> older(searched.size());
  for (bool& point : older.points()) point = true;
  std::size_t left = pixels.size();
  for (std::int64_t number = scan.number; left > 0; --number) {
    messages::StripeArray<bool> drawn_here(searched.size());
    const std::size_t left_before = left;
    core::RandomStream kept(key, core::Purpose::kStripePersistence, Substream(number));
    for (std::size_t point = 0; point < pixels.size(); ++point) {
      // Going back in time: a point that does not keep its lot in scan `number` had it drawn there.
      // Scan 0 always draws. Every point draws in every scan, so no point shifts another one's lot.
      const bool keeps = core::SampleBernoulli(kept, params_.outlier_persistence) && number > 0;
      if (keeps || !older.points()[point]) continue;
      drawn_here.points()[point] = true;
      older.points()[point] = false;
      --left;
    }
    if (left == left_before) continue;
    DrawMisplaced(key, number, searched, [&](std::size_t point, double column) {
      if (drawn_here.points()[point]) pixels[point] = {.detected = true, .column_px = column};
    });
  }
}

namespace {

using math::Vector3;

// Normal, in R, of the plane that a scanline sees: the camera's lateral axis lies in it, and it
// looks an angle below the optical axis, along (cos, 0, -sin) in C.
Vector3 ScanlineNormal(const messages::Camera& camera, double row_angle_rad) {
  return camera.X_RC.linear() * Vector3(math::Sin(row_angle_rad), 0.0, math::Cos(row_angle_rad));
}

// Distance along a falling line to a height in R, 0 where it starts below.
double DistanceDownTo(double z_m, const Vector3& start_R, const Vector3& direction_R) {
  return std::max(0.0, (start_R.z() - z_m) / -direction_R.z());
}

// Fills `out` with those of the given rocks whose bounding sphere meets the plane through p_W: a
// line in the plane meets no other rock.
void RocksMeetingPlane(const terrain::Terrain& terrain, std::span<const int> rocks,
                       const Vector3& p_W, const Vector3& normal_W, std::vector<int>& out) {
  out.clear();
  for (const int index : rocks) {
    const terrain::Rock& rock = terrain.rocks()[static_cast<std::size_t>(index)];
    const double reach_m = rock.semi_axes_m.maxCoeff() + rendering::kRounding_m;
    if (std::abs(normal_W.dot(rock.center_W - p_W)) <= reach_m) out.push_back(index);
  }
}

}  // namespace

LightStripe::LightStripe(const LightStripeParams& params)
    : params_(params),
      errors_(params),
      calibration_(TrueCalibration(params)),
      last_column_(static_cast<int>(params.columns / 2)),
      searched_(calibration_.size()) {
  Eigen::AlignedBox3d reach_R;
  for (const messages::Camera& camera : calibration_.cameras) {
    reach_R.extend(camera.X_RC.translation());
  }
  for (const messages::StripeLaser& laser : calibration_.lasers) {
    half_fan_cosine_.push_back(math::Cos(laser.half_fan_rad));
    reach_R.extend(laser.p_RoE_R);
  }
  if (params.lens == messages::Lens::kEquidistantRows) {
    AddLines(reach_R);
  } else {
    AddCurves(reach_R);
  }
  // Whatever a scan can meet lies near this ball: its rocks are gathered once.
  reach_center_R_ = 0.5 * (reach_R.min() + reach_R.max());
  reach_radius_m_ = 0.5 * (reach_R.max() - reach_R.min()).norm();
}

// Lenses that see rows as planes: each point is searched along a straight line, which is worked out
// once.
void LightStripe::AddLines(Eigen::AlignedBox3d& reach_R) {
  for (std::size_t row = 0; row < searched_.rows(); ++row) {
    for (std::size_t stripe = 0; stripe < searched_.stripes(); ++stripe) {
      const Line line = MakeLine(row, stripe);
      lines_.push_back(line);
      searched_[row][stripe] = SearchedColumns(CameraOf(stripe), line);
      reach_R.extend(line.start_R);
      reach_R.extend(line.start_R + line.length_m * line.direction_R);
    }
  }
}

// Lenses that bend rows: each point is searched along a curve that chords follow.
void LightStripe::AddCurves(Eigen::AlignedBox3d& reach_R) {
  for (std::size_t row = 0; row < searched_.rows(); ++row) {
    for (std::size_t stripe = 0; stripe < searched_.stripes(); ++stripe) {
      curves_.emplace_back(calibration_, row, stripe);
      searched_[row][stripe] = curves_.back().searched();
      for (const Vector3& vertex_R : curves_.back().vertices()) reach_R.extend(vertex_R);
    }
  }
}

LightStripe::Line LightStripe::MakeLine(std::size_t row, std::size_t stripe) const {
  const messages::StripeLaser& laser = calibration_.lasers[stripe];
  const messages::Camera& camera = CameraOf(stripe);
  const double row_angle_rad = calibration_.scanline_px[row] * camera.row_pitch_rad;
  const Vector3 scanline = ScanlineNormal(camera, row_angle_rad);
  Line line;
  // Two planes meet along the cross product of their normals; the line is followed downwards.
  line.direction_R = scanline.cross(laser.normal_R).normalized();
  if (line.direction_R.z() > 0.0) line.direction_R = -line.direction_R;
  EXPECT(line.direction_R.z() < 0.0);

  // The line starts where a path from the emitter e within the light plane, square to the line,
  // meets the scanline plane n . (p - o) = 0: p = e + g aside with g = n . (o - e) / n . aside. The
  // gap g vanishes where the emitter sits on the camera's lateral axis.
  const Vector3 aside = laser.normal_R.cross(line.direction_R);
  const double gap = scanline.dot(camera.X_RC.translation() - laser.p_RoE_R) / scanline.dot(aside);
  line.start_R = laser.p_RoE_R + gap * aside;
  // What is left of the gap by rounding where emitters are on the axis. Elsewhere the line is no
  // ray of light, and FindOnLine asks whether the way from the emitter is hidden.
  constexpr double kOnAxis_m = 1e-9;
  line.is_light_ray = std::abs(gap) < kOnAxis_m;

  // Down to the lowest searched elevation above the datum plane.
  line.length_m =
      DistanceDownTo(params_.search_low_m + params_.datum_z_m, line.start_R, line.direction_R);
  SetView(camera, row_angle_rad, line);
  // The whole line is one ray of the emitter: lit everywhere or nowhere.
  if (line.is_light_ray && !InFan(line.start_R + line.direction_R, stripe)) line.last_m = -1.0;
  return line;
}

void LightStripe::SetView(const messages::Camera& camera, double row_angle_rad, Line& line) const {
  const auto R_RC = camera.X_RC.linear();
  // Within the scanline plane: ahead of the camera, and to its right. Both are linear along the
  // line, which leaves the column angle atan(right / forward).
  const Vector3 forward_R =
      R_RC * Vector3(math::Cos(row_angle_rad), 0.0, -math::Sin(row_angle_rad));
  const Vector3 right_R = R_RC * -Vector3::UnitY();
  const Vector3 p_CS_R = line.start_R - camera.X_RC.translation();
  line.forward_m = forward_R.dot(p_CS_R);
  line.forward_slope = forward_R.dot(line.direction_R);
  line.right_m = right_R.dot(p_CS_R);
  line.right_slope = right_R.dot(line.direction_R);

  // |p + t d| <= max_range: t = -p . d +- sqrt((p . d)^2 - |p|^2 + max_range^2).
  const double middle_m = -p_CS_R.dot(line.direction_R);
  const double rest_m2 =
      params_.max_range_m * params_.max_range_m - p_CS_R.squaredNorm() + middle_m * middle_m;
  if (rest_m2 < 0.0) return;
  line.first_m = middle_m - std::sqrt(rest_m2);
  line.last_m = middle_m + std::sqrt(rest_m2);
}

messages::ColumnRange LightStripe::SearchedColumns(const messages::Camera& camera,
                                                   const Line& line) const {
  const double nearest_m =
      DistanceDownTo(params_.search_high_m + params_.datum_z_m, line.start_R, line.direction_R);
  // The column is monotonic along the line, so that the ends of the searched elevations are those
  // of the searched columns.
  const int a = ColumnAt(line, nearest_m, camera);
  const int b = ColumnAt(line, line.length_m, camera);
  return {std::max(std::min(a, b), -last_column_), std::min(std::max(a, b), last_column_)};
}

int LightStripe::ColumnAt(const Line& line, double distance_m, const messages::Camera& camera) {
  // Equidistant rows: the column is the angle within the scanline plane over the pitch.
  const double angle_rad = math::Atan((line.right_m + distance_m * line.right_slope) /
                                      (line.forward_m + distance_m * line.forward_slope));
  return static_cast<int>(std::lround(angle_rad / camera.column_pitch_rad));
}

bool LightStripe::InFan(const Vector3& p_R, std::size_t stripe) const {
  const messages::StripeLaser& laser = calibration_.lasers[stripe];
  const Vector3 ray = p_R - laser.p_RoE_R;
  // cos(angle to the fan's middle) >= cos(half fan).
  return laser.axis_R.dot(ray) >= half_fan_cosine_[stripe] * ray.norm();
}

messages::StripePixel LightStripe::FindOnLine(const terrain::Terrain& terrain,
                                              const math::Transform& X_WR, std::size_t row,
                                              std::size_t stripe, const Candidates& rocks) const {
  const Line& line = lines_[PointIndex(row, stripe)];
  const Vector3 start_W = X_WR * line.start_R;
  const Vector3 direction_W = X_WR.linear() * line.direction_R;
  // First surface from the emitter's side: what is beyond lies in its shadow.
  const auto distance_m = terrain.RayDistance(start_W, direction_W, line.length_m, rocks.lit);
  if (!distance_m) return {};

  const messages::StripeLaser& laser = calibration_.lasers[stripe];
  const messages::Camera& camera = CameraOf(stripe);
  if (*distance_m < line.first_m || *distance_m > line.last_m) return {};
  if (!line.is_light_ray && !InFan(line.start_R + *distance_m * line.direction_R, stripe)) {
    return {};
  }
  const int column = ColumnAt(line, *distance_m, camera);
  if (!searched_[row][stripe].Contains(column)) return {};

  const Vector3 point_W = start_W + *distance_m * direction_W;
  const auto hidden_from = [&](const Vector3& eye_R) {
    return terrain.Occluded(X_WR * eye_R, point_W, rendering::kOcclusionMargin_m, rocks.near);
  };
  if (!line.is_light_ray && hidden_from(laser.p_RoE_R)) return {};
  if (hidden_from(camera.X_RC.translation())) return {};
  return {.detected = true, .column_px = static_cast<double>(column)};
}

messages::StripePixel LightStripe::FindOnCurve(const terrain::Terrain& terrain,
                                               const math::Transform& X_WR, std::size_t row,
                                               std::size_t stripe, const Candidates& rocks) const {
  const auto point_W = curves_[PointIndex(row, stripe)].FirstHit(terrain, X_WR, rocks.lit);
  if (!point_W) return {};

  const messages::Camera& camera = CameraOf(stripe);
  const Vector3 point_R = X_WR.inverse() * *point_W;
  const Vector3 point_C = camera.X_RC.inverse() * point_R;
  if (point_C.norm() > params_.max_range_m || !InFan(point_R, stripe)) return {};
  // The chord was at most kChordError_m off the curve: the column is that of the point itself.
  const auto seen = vision::Project(camera, point_C);
  if (!seen) return {};
  const double column_px = std::round(seen->column_px);
  if (!searched_[row][stripe].Contains(column_px)) return {};

  const auto hidden_from = [&](const Vector3& eye_R) {
    return terrain.Occluded(X_WR * eye_R, *point_W, rendering::kOcclusionMargin_m, rocks.near);
  };
  if (hidden_from(calibration_.lasers[stripe].p_RoE_R)) return {};
  if (hidden_from(camera.X_RC.translation())) return {};
  return {.detected = true, .column_px = column_px};
}

messages::StripeScan LightStripe::Scan(const terrain::Terrain& terrain, const math::Transform& X_WR,
                                       core::TrialKey key, std::int64_t scan_number) const {
  EXPECT(scan_number >= 0);
  // Every line, eye and emitter lies in this ball: no rock outside of it can be lit, hide or be
  // seen.
  const Vector3 reach_W = X_WR * reach_center_R_;
  std::vector<int> near;
  terrain.RocksNear(reach_W.x(), reach_W.y(), reach_radius_m_, near);

  const messages::StripeArraySize size = calibration_.size();
  messages::StripeScan scan{scan_number, messages::StripeArray<messages::StripePixel>(size)};
  std::vector<int> lit;
  lit.reserve(near.size());
  for (std::size_t stripe = 0; stripe < size.stripes; ++stripe) {
    const messages::StripeLaser& laser = calibration_.lasers[stripe];
    // All points of a stripe lie in one light plane.
    RocksMeetingPlane(terrain, near, X_WR * laser.p_RoE_R, X_WR.linear() * laser.normal_R, lit);
    for (std::size_t row = 0; row < size.rows; ++row) {
      scan.pixels[row][stripe] = curves_.empty()
                                     ? FindOnLine(terrain, X_WR, row, stripe, {near, lit})
                                     : FindOnCurve(terrain, X_WR, row, stripe, {near, lit});
    }
  }
  errors_.Disturb(key, searched_, scan);
  return scan;
}

}  // namespace rockyard::sensing
