#include "sensing/stereo_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "rendering/occlusion.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;

constexpr double kEverywhere = std::numeric_limits<double>::infinity();

// Whole columns of a span within the image.
struct Columns {
  int first;
  int last;  // inclusive

  Columns(const ColumnSpan& span, int columns)
      : first(static_cast<int>(std::ceil(std::clamp(span.first, 0.0, double(columns))))),
        last(static_cast<int>(std::floor(std::clamp(span.last, -1.0, columns - 1.0)))) {}

  int count() const { return std::max(last - first + 1, 0); }
};

// The four planes through the eyes within which a pair sees, a pixel beyond its outermost ones. A
// plane's normal points inwards.
class FieldOfView {
 public:
  explicit FieldOfView(const StereoView& view_W) : view_W_(view_W) {
    const auto corner = [&](double column, double row) { return view_W.Ray(column, row); };
    const double right = view_W.columns;
    const double bottom = view_W.rows;
    const std::array<Vector3, 4> corners = {corner(-1.0, -1.0), corner(right, -1.0),
                                            corner(right, bottom), corner(-1.0, bottom)};
    const Vector3 middle = corner(0.5 * (right - 1.0), 0.5 * (bottom - 1.0));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector3 normal = corners[i].cross(corners[(i + 1) % corners.size()]).normalized();
      normals_[i] = normal.dot(middle) > 0.0 ? normal : Vector3(-normal);
    }
  }

  // Returns false where neither eye can see anything of a ball.
  bool MayHold(const Vector3& center_W, double radius_m) const {
    return std::all_of(normals_.begin(), normals_.end(), [&](const Vector3& normal) {
      return std::max(normal.dot(center_W - view_W_.eye),
                      normal.dot(center_W - view_W_.right_eye)) >= -radius_m;
    });
  }

 private:
  const StereoView& view_W_;
  std::array<Vector3, 4> normals_;
};

}  // namespace

double RowCut::InverseDepth(double column) const {
  const double discriminant = Discriminant(column);
  const double approach = Approach(column);
  if (!(discriminant >= 0.0 && approach > 0.0)) return 0.0;
  return (approach + std::sqrt(discriminant)) * inverse_outside_1;
}

double RowCut::NearestInverseDepth() const {
  const double approach = std::max(Approach(span.first), Approach(span.last));
  // Each term takes its largest value over the row: the discriminant a c^2 + 2 l c + k with a < 0
  // has the peak k - l^2 / a, and the linear B is largest at an end of the span.
  const double peak = std::max(constant - linear * linear / quadratic, 0.0);
  return (approach + std::sqrt(peak)) * inverse_outside_1;
}

RockOutline::RockOutline(const terrain::RockShape& shape, const Vector3& center_W,
                         const StereoView& view_W, const Vector3& eye_W) {
  // B = -q . e = b0 + c b1 + r b2, and the discriminant B^2 - K |e|^2 expands to
  //   a c^2 + 2 (d0 + d1 r) c + f0 + 2 f1 r + f2 r^2.
  const Vector3 q = shape.Map(eye_W - center_W);
  const Vector3 e0 = shape.Map(view_W.first);
  const Vector3 e1 = shape.Map(view_W.along_row);
  const Vector3 e2 = shape.Map(view_W.along_column);
  outside_1_ = q.squaredNorm() - 1.0;
  inverse_outside_1_ = 1.0 / outside_1_;
  b0_ = -q.dot(e0);
  b1_ = -q.dot(e1);
  b2_ = -q.dot(e2);
  a_ = b1_ * b1_ - outside_1_ * e1.squaredNorm();
  d0_ = b0_ * b1_ - outside_1_ * e0.dot(e1);
  d1_ = b2_ * b1_ - outside_1_ * e2.dot(e1);
  f0_ = b0_ * b0_ - outside_1_ * e0.squaredNorm();
  f1_ = b0_ * b2_ - outside_1_ * e0.dot(e2);
  f2_ = b2_ * b2_ - outside_1_ * e2.squaredNorm();
  if (!ContainsEye()) FindRows(view_W.rows);
}

// A row r meets the rock where its quadratic in the column, a c^2 + 2 l c + k with a < 0, has
// roots: l^2 - a k >= 0. That is g2 r^2 + 2 g1 r + g0 >= 0 with g2 < 0, which holds between the
// roots (-g1 +- sqrt(g1^2 - g2 g0)) / g2.
void RockOutline::FindRows(int rows) {
  first_row_ = 0;
  last_row_ = rows - 1;
  const double g2 = d1_ * d1_ - a_ * f2_;
  if (a_ >= 0.0 || g2 >= 0.0) return;  // no ellipse: any row
  const double g1 = d0_ * d1_ - a_ * f1_;
  const double g0 = d0_ * d0_ - a_ * f0_;
  const double root = g1 * g1 - g2 * g0;
  if (root < 0.0) {
    last_row_ = -1;
    return;
  }
  // One row more on both sides, for rounding; Row says what is in it.
  const double middle = -g1 / g2;
  const double half = -std::sqrt(root) / g2 + 1.0;
  first_row_ = static_cast<int>(std::clamp(middle - half, 0.0, static_cast<double>(rows)));
  last_row_ = static_cast<int>(std::clamp(middle + half, -1.0, rows - 1.0));
}

RowCut RockOutline::Row(double row) const {
  RowCut cut{{.quadratic = a_,
              .linear = d0_ + d1_ * row,
              .constant = f0_ + (2.0 * f1_ + f2_ * row) * row,
              .approach_0 = b0_ + b2_ * row,
              .approach_1 = b1_,
              .inverse_outside_1 = inverse_outside_1_},
             {},
             true};
  // The quadratic opens upwards: the columns that meet the rock have no two ends.
  if (a_ >= 0.0) {
    cut.span = {-kEverywhere, kEverywhere};
    cut.exact = false;
    return cut;
  }
  const double root = cut.linear * cut.linear - a_ * cut.constant;
  const double middle = -cut.linear / a_;
  // B <= 0: the rock lies behind the eye. The default span is empty.
  if (root < 0.0 || cut.Approach(middle) <= 0.0) return cut;
  const double half = -std::sqrt(root) / a_;
  cut.span = {middle - half, middle + half};
  return cut;
}

StereoScene::StereoScene(const terrain::Terrain& terrain, const StereoView& view_W,
                         double max_range_m)
    : terrain_(terrain),
      view_W_(view_W),
      max_range_m_(max_range_m),
      columns_(Eigen::ArrayXd::LinSpaced(view_W.columns, 0.0, view_W.columns - 1.0)) {
  std::vector<int> near;
  // Both eyes are served by the rocks around the left one.
  terrain.RocksNear(view_W.eye.x(), view_W.eye.y(), max_range_m, near);
  const FieldOfView sides(view_W);
  for (const int index : near) {
    const terrain::Rock& rock = terrain.rocks()[static_cast<std::size_t>(index)];
    if (!sides.MayHold(rock.center_W, rock.semi_axes_m.maxCoeff())) continue;
    rocks_.push_back({terrain::RockShape(rock), rock.center_W});
  }
}

// Returns whether an eye is buried, in a rock or beyond a wall.
bool StereoScene::SeesNothing(const Vector3& eye_W) const {
  if (eye_W.z() <= terrain_.ground().Height(eye_W.x(), eye_W.y())) return true;
  const auto beyond = [&eye_W](const terrain::Wall& wall) {
    return wall.normal_W.dot(eye_W) >= wall.offset_m;
  };
  const auto within = [&eye_W](const Candidate& rock) {
    return rock.shape.Map(eye_W - rock.center_W).squaredNorm() <= 1.0;
  };
  return std::any_of(terrain_.walls().begin(), terrain_.walls().end(), beyond) ||
         std::any_of(rocks_.begin(), rocks_.end(), within);
}

DepthImage StereoScene::InverseDepths() const {
  DepthImage image = DepthImage::Zero(view_W_.rows, view_W_.columns);
  if (SeesNothing(view_W_.eye)) return image;
  AddPlanes(image);
  for (const Candidate& rock : rocks_) {
    AddRock({rock.shape, rock.center_W, view_W_, view_W_.eye}, image);
  }
  // Rough ground is marched no farther than what is met by then.
  DropFarther(image);
  if (!terrain_.ground().IsPlane()) AddRoughGround(image);
  return image;
}

// On the plane n . p = k the ray eye + Z e has 1/Z = n . e / (k - n . eye), linear in the column
// because e is. The nearest surface is the one with the largest 1/Z, so planes combine by maximum;
// planes behind the eye have 1/Z < 0 and lose against the zero of an empty pixel.
void StereoScene::AddPlanes(DepthImage& image) const {
  const auto add = [&](const Vector3& toward_W, double distance_m) {
    const Vector3 scaled_W = toward_W / distance_m;
    const double across = scaled_W.dot(view_W_.along_row);
    for (int row = 0; row < view_W_.rows; ++row) {
      const double start = scaled_W.dot(view_W_.Ray(0.0, row));
      image.row(row) = image.row(row).max((start + across * columns_).transpose());
    }
  };
  for (const terrain::Wall& wall : terrain_.walls()) {
    add(wall.normal_W, wall.offset_m - wall.normal_W.dot(view_W_.eye));
  }
  const terrain::Ground& ground = terrain_.ground();
  if (!ground.IsPlane()) return;
  const Vector3& eye_W = view_W_.eye;
  const Vector3 normal_W = ground.Normal(eye_W.x(), eye_W.y());
  // The ground's own normal points up: looked at from above, its plane lies towards -n, at the
  // eye's height over it times the cosine of the slope.
  add(-normal_W, normal_W.z() * (eye_W.z() - ground.Height(eye_W.x(), eye_W.y())));
}

void StereoScene::AddRock(const RockOutline& outline, DepthImage& image) const {
  for (int row = outline.first_row(); row <= outline.last_row(); ++row) {
    const RowCut cut = outline.Row(row);
    const Columns seen(cut.span, view_W_.columns);
    if (seen.count() == 0) continue;
    double* pixels = &image(row, 0);
    // The outline is no ellipse in this row, and its span no bound: pixel by pixel.
    if (!cut.exact) {
      for (int column = seen.first; column <= seen.last; ++column) {
        pixels[column] = std::max(pixels[column], cut.InverseDepth(column));
      }
      continue;
    }
    // 1/Z = (B + sqrt(B^2 - K |e|^2)) / K, the larger of the two roots: where the ray enters the
    // rock. B is linear in the column, the discriminant quadratic (RockOutline).
    RaiseToRock(cut, static_cast<std::size_t>(seen.first), static_cast<std::size_t>(seen.count()),
                pixels);
  }
}

// The distance is |e| Z, so a surface stays where (1/Z)^2 >= |e|^2 / max_range^2; |e|^2 is
// quadratic in the column.
void StereoScene::DropFarther(DepthImage& image) const {
  const double nearest = 1.0 / (max_range_m_ * max_range_m_);
  const double step2 = view_W_.along_row.squaredNorm();
  for (int row = 0; row < view_W_.rows; ++row) {
    const Vector3 start = view_W_.Ray(0.0, row);
    const double linear = 2.0 * start.dot(view_W_.along_row);
    const double constant = start.squaredNorm();
    auto pixels = image.row(row).transpose();
    pixels = (pixels.square() >= ((step2 * columns_ + linear) * columns_ + constant) * nearest)
                 .select(pixels, 0.0);
  }
}

// Each ray marches over the ground, no farther than to the wall or rock that it meets.
void StereoScene::AddRoughGround(DepthImage& image) const {
  for (int row = 0; row < view_W_.rows; ++row) {
    for (int column = 0; column < view_W_.columns; ++column) {
      double& pixel = image(row, column);
      const Vector3 ray_W = view_W_.Ray(column, row);
      const double length = ray_W.norm();
      const double farthest_m = pixel > 0.0 ? length / pixel : max_range_m_;
      const auto distance_m = terrain_.ground().CastRay(view_W_.eye, ray_W / length, farthest_m);
      if (distance_m && *distance_m > 0.0) pixel = length / *distance_m;
    }
  }
}

void StereoScene::HideFromRightEye(DepthImage& inverse_depths) const {
  if (SeesNothing(view_W_.right_eye)) {
    inverse_depths.setZero();
    return;
  }
  if (!terrain_.ground().IsPlane()) HideBehindGround(inverse_depths);
  const double slack_m = OcclusionSlack_m();
  for (const Candidate& rock : rocks_) {
    HideBehind({rock.shape, rock.center_W, view_W_, view_W_.right_eye}, slack_m, inverse_depths);
  }
  // d = f b / Z columns further left in the right image, whose pixels end half a column before 0.
  const double scale_px_m = view_W_.focal_px * view_W_.baseline_m;
  for (int row = 0; row < view_W_.rows; ++row) {
    auto pixels = inverse_depths.row(row).transpose();
    pixels = (scale_px_m * pixels <= columns_ + 0.5).select(pixels, 0.0);
  }
}

// The left image's column c of disparity d is the right image's column c - d. A rock with the span
// [a, b] there can therefore hide columns from a to b + f b / Z of its own nearest point: what it
// hides is farther, with smaller d. Distances along the right eye's ray are compared, |e| Z.
void StereoScene::HideBehind(const RockOutline& outline_right, double slack_m,
                             DepthImage& image) const {
  const double scale_px_m = view_W_.focal_px * view_W_.baseline_m;
  std::vector<int>& columns = found_columns_;
  columns.resize(static_cast<std::size_t>(view_W_.columns) + 8);
  for (int row = outline_right.first_row(); row <= outline_right.last_row(); ++row) {
    const RowCut cut = outline_right.Row(row);
    const double shift_px = cut.exact ? scale_px_m * cut.NearestInverseDepth() : 0.0;
    const Columns behind({cut.span.first, cut.span.last + shift_px}, view_W_.columns);
    if (behind.count() == 0) continue;
    const std::size_t found =
        FindBehindRock(cut, scale_px_m, slack_m, static_cast<std::size_t>(behind.first),
                       static_cast<std::size_t>(behind.count()), &image(row, 0), columns.data());
    for (const int column : std::span(columns).first(found)) {
      double& pixel = image(row, column);
      const double column_right = column - scale_px_m * pixel;
      const double rock = cut.InverseDepth(column_right);
      const double length = view_W_.Ray(column_right, row).norm();
      // 1/Z of the rock against that of the point, as distances along the ray.
      if (length / rock <= length / pixel - rendering::kOcclusionMargin_m) pixel = 0.0;
    }
  }
}

// Inverse depths p behind a rock of inverse depth k have |e| / k <= |e| / p - margin, hence
//   k - p >= margin k p / |e| > margin p^2 / |e|.
// |e| is largest in a corner of the image; half of the margin leaves room for rounding. Columns of
// the right image outside of it are dropped afterwards, whatever is found for them.
double StereoScene::OcclusionSlack_m() const {
  double longest = 0.0;
  for (const double row : {0.0, view_W_.rows - 1.0}) {
    for (const double column : {-1.0, static_cast<double>(view_W_.columns)}) {
      longest = std::max(longest, view_W_.Ray(column, row).norm());
    }
  }
  return 0.5 * rendering::kOcclusionMargin_m / longest;
}

// What hides a point from the right eye, if the left eye sees it, lies to the right of the point in
// the left image, and not so in the right image: where columns of the right image are out of order,
// rays are cast.
void StereoScene::HideBehindGround(DepthImage& image) const {
  constexpr double kSlack_px = 0.5;
  const double scale_px_m = view_W_.focal_px * view_W_.baseline_m;
  for (int row = 0; row < view_W_.rows; ++row) {
    double leftmost_px = std::numeric_limits<double>::infinity();
    for (int column = view_W_.columns - 1; column >= 0; --column) {
      double& pixel = image(row, column);
      if (pixel <= 0.0) continue;
      const double column_right = column - scale_px_m * pixel;
      const bool may_be_hidden = column_right + kSlack_px >= leftmost_px;
      leftmost_px = std::min(leftmost_px, column_right);
      if (!may_be_hidden) continue;
      const Vector3 p_W = view_W_.eye + view_W_.Ray(column, row) / pixel;
      if (terrain_.Occluded(view_W_.right_eye, p_W, rendering::kOcclusionMargin_m, {})) pixel = 0.0;
    }
  }
}

}  // namespace rockyard::sensing
