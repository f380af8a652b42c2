#include "vision/cylinder/published_finder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>
#include <variant>

#include "core/check.h"
#include "math/angles.h"
#include "vision/cylinder/colour_regions.h"
#include "vision/cylinder/cylinder_equations.h"

namespace rockyard::vision {
namespace {

// What one eye sees of the cylinder.
struct CylinderInEye {
  ColourRegion whole;
  ColourRegion middle;
  std::optional<ColourRegion> left;
  std::optional<ColourRegion> right;
  double orientation_rad = 0.0;
};

using EyeResult = std::variant<CylinderInEye, CylinderFinding>;

std::string BoxText(const ColourRegion& region) {
  return fmt::format("columns {} to {}, rows {} to {}", region.left, region.right, region.top,
                     region.bottom);
}

bool TouchesBorder(const ColourRegion& region, const ClassImage& classes, int first_row) {
  return region.left == 0 || region.right == classes.width() - 1 || region.top == first_row ||
         region.bottom == classes.height() - 1;
}

// Returns the largest region that lies to one side (-1 left, 1 right) of the middle one and has
// another colour.
std::optional<ColourRegion> LargestBeside(const std::vector<ColourRegion>& regions,
                                          const ColourRegion& middle, int side, int least_px) {
  std::vector<ColourRegion> beside;
  for (const ColourRegion& region : regions) {
    const double offset_px = region.centroid.x() - middle.centroid.x();
    if (region.colour != middle.colour && side * offset_px > 0.0 && region.pixels >= least_px) {
      beside.push_back(region);
    }
  }
  return LargestOf(beside);
}

double QuantityOf(const std::optional<ColourRegion>& region, QuadrantMeasure measure) {
  if (!region) return 0.0;
  return measure == QuadrantMeasure::kPixels ? region->pixels : region->Width();
}

std::optional<CylinderColour> ColourOf(const std::optional<ColourRegion>& region) {
  if (!region) return std::nullopt;
  return region->colour;
}

std::string OrderText(const ColourOrder& order) {
  const auto name = [](std::optional<CylinderColour> colour) {
    return colour ? core::EnumNames<CylinderColour>::kNames.at(static_cast<std::size_t>(*colour))
                  : std::string_view("nothing");
  };
  return fmt::format("{}, {}, {}", name(order.left), name(order.middle), name(order.right));
}

// Finds the quadrants in the bounding box of the whole, and the orientation by equation 14.
EyeResult QuadrantsIn(const ClassImage& classes, const ColourRegion& whole,
                      const PublishedFinderParams& params) {
  CylinderInEye eye;
  eye.whole = whole;
  const ImagePart box{whole.left, whole.top, whole.right, whole.bottom};
  const std::vector<ColourRegion> regions = FindRegions(classes, box, RegionColours::kSingle);
  const int least_px = static_cast<int>(params.least_quadrant_px);
  eye.middle = *LargestOf(regions);
  eye.left = LargestBeside(regions, eye.middle, -1, least_px);
  eye.right = LargestBeside(regions, eye.middle, 1, least_px);
  const ColourOrder order{ColourOf(eye.left), *eye.middle.colour, ColourOf(eye.right)};
  const RowChoice row = ChooseRow(order);
  if (!row.absent) {
    if (row.doubt == OrderDoubt::kAnyPink) {
      return NotFound(CylinderMiss::kTooFewRegions,
                      "only a pink quadrant is seen, and the cylinder has two of them");
    }
    return NotFound(
        CylinderMiss::kUnlikeOrder,
        fmt::format("no view of the cylinder has from left to right {}", OrderText(order)));
  }
  eye.orientation_rad = OrientationOf(
      *row.absent, {QuantityOf(eye.middle, params.measure), QuantityOf(eye.right, params.measure),
                    QuantityOf(eye.left, params.measure)});
  return eye;
}

EyeResult LookWith(const ColourImage& image, const PublishedFinderParams& params) {
  const int first_row = static_cast<int>(params.sky_share * image.height());
  ClassImage classes = ClassifyColours(image, first_row, params.classes);
  FillGaps(static_cast<int>(params.longest_gap_px), classes);
  const std::optional<ColourRegion> whole =
      LargestOf(FindRegions(classes, WholeOf(classes), RegionColours::kAny));
  if (!whole || whole->pixels < params.least_whole_px) {
    return NotFound(CylinderMiss::kNothing,
                    fmt::format("the largest region of the colours has {} pixels, {} are needed",
                                whole ? whole->pixels : 0, params.least_whole_px));
  }
  if (TouchesBorder(*whole, classes, first_row)) {
    return NotFound(
        CylinderMiss::kClipped,
        fmt::format("the largest region of the colours, {}, ends at the border", BoxText(*whole)));
  }
  return QuadrantsIn(classes, *whole, params);
}

bool AreAlike(int a, int b, int scale_px, const PublishedFinderParams& params) {
  return std::abs(a - b) <= params.box_difference_px + params.box_difference_share * scale_px;
}

// Returns why both eyes do not show the same, or nothing where they do.
std::string UnlikeEyes(const CylinderInEye& left, const CylinderInEye& right, bool aligned,
                       const PublishedFinderParams& params) {
  const ColourRegion& a = left.whole;
  const ColourRegion& b = right.whole;
  const int width_px = std::max(a.Width(), b.Width());
  const int height_px = std::max(a.Height(), b.Height());
  const bool rows_alike =
      AreAlike(a.top, b.top, height_px, params) && AreAlike(a.bottom, b.bottom, height_px, params);
  if (!AreAlike(a.Width(), b.Width(), width_px, params) ||
      !AreAlike(a.Height(), b.Height(), height_px, params) || (aligned && !rows_alike)) {
    return fmt::format("the left image has it in {}, the right one in {}", BoxText(a), BoxText(b));
  }
  const double turn_rad = std::abs(math::WrapAngle(left.orientation_rad - right.orientation_rad));
  if (turn_rad <= params.largest_turn_between_eyes_rad) return {};
  return fmt::format("the left image has it at {:.0f} deg, the right one at {:.0f} deg",
                     math::RadToDeg(left.orientation_rad), math::RadToDeg(right.orientation_rad));
}

std::vector<ColourRegion> RegionsOf(const CylinderInEye& eye) {
  std::vector<ColourRegion> regions = {eye.whole};
  const auto add = [&](ColourRegion region, RegionRole role) {
    region.role = role;
    regions.push_back(region);
  };
  if (eye.left) add(*eye.left, RegionRole::kLeft);
  add(eye.middle, RegionRole::kMiddle);
  if (eye.right) add(*eye.right, RegionRole::kRight);
  return regions;
}

// Returns the covariance of position (m) and theta (rad): the changes by one pixel (A.2) times
// pixel_error_px.
Eigen::Matrix4d PublishedCovariance(const EyeGeometry& eyes, const SeenPoint& point, double m_px,
                                    double pixel_error_px) {
  const math::Vector3 sight_m = point.p_L - eyes.centre_L;
  // |dd| / d = d / (f b) is equation 23 with tan(phi / 2) = M / (2 f).
  const double relative = pixel_error_px * point.depth_m / (eyes.focal_px * eyes.baseline_m);
  const double across_m = pixel_error_px * point.depth_m / eyes.focal_px;
  const math::Vector3 along_m = relative * sight_m;
  const math::Vector3 direction = sight_m.normalized();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  covariance.topLeftCorner<3, 3>() =
      along_m * along_m.transpose() +
      across_m * across_m * (Eigen::Matrix3d::Identity() - direction * direction.transpose());
  const double turn_rad = pixel_error_px * CoarsestTurn(m_px);
  covariance(3, 3) = turn_rad * turn_rad;
  return covariance;
}

CylinderFinding PutTogether(const ColourPair& pair, const EyeGeometry& eyes,
                            const CylinderInEye& left, const CylinderInEye& right,
                            const ColourCylinder& cylinder, const PublishedFinderParams& params) {
  const auto point = PointSeenAt(pair, eyes, left.whole.centroid, right.whole.centroid);
  if (!point) {
    return NotFound(CylinderMiss::kSwappedEyes,
                    fmt::format("the left image has it at column {:.1f}, the right one at {:.1f}: "
                                "no point is seen so; are the images swapped?",
                                left.whole.centroid.x(), right.whole.centroid.x()));
  }
  std::string unlike = UnlikeEyes(left, right, eyes.aligned.has_value(), params);
  if (!unlike.empty()) return NotFound(CylinderMiss::kUnlikeEyes, std::move(unlike));
  CylinderFinding finding;
  CylinderSighting& sighting = finding.sighting.emplace();
  const double turn_rad = math::WrapAngle(right.orientation_rad - left.orientation_rad);
  sighting.orientation_rad = math::WrapAngle(left.orientation_rad + 0.5 * turn_rad);
  sighting.p_LT_L = point->p_L;
  sighting.distance_by_stereo_m = point->depth_m;
  const double m_px = 0.5 * (left.whole.Width() + right.whole.Width());
  sighting.distance_by_size_m = DistanceBySizeNear(eyes.focal_px, 0.5 * cylinder.diameter_m, m_px);
  sighting.covariance = PublishedCovariance(eyes, *point, m_px, params.pixel_error_px);
  sighting.regions = {RegionsOf(left), RegionsOf(right)};
  return finding;
}

}  // namespace

CylinderFinding FindCylinderAsPublished(const ColourPair& pair, const ColourCylinder& cylinder,
                                        const PublishedFinderParams& params) {
  EXPECT(HasSizeOf(pair.left, pair.left_camera) && HasSizeOf(pair.right, pair.right_camera));
  const std::optional<EyeGeometry> eyes = GeometryOf(pair);
  if (!eyes)
    return NotFound(CylinderMiss::kNothing, "the left camera images nothing in its middle");
  EyeResult left = LookWith(pair.left, params);
  if (auto* miss = std::get_if<CylinderFinding>(&left)) {
    miss->reason = "left image: " + miss->reason;
    return std::move(*miss);
  }
  EyeResult right = LookWith(pair.right, params);
  if (auto* miss = std::get_if<CylinderFinding>(&right)) {
    miss->reason = "right image: " + miss->reason;
    return std::move(*miss);
  }
  return PutTogether(pair, *eyes, std::get<CylinderInEye>(left), std::get<CylinderInEye>(right),
                     cylinder, params);
}

}  // namespace rockyard::vision
