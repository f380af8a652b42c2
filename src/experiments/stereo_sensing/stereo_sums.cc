#include "experiments/stereo_sensing/stereo_sums.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "core/check.h"
#include "navigation/navigator.h"

namespace rockyard::experiments {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Must have the order of kPixelKinds.
enum PixelKind : std::size_t { kPlain, kFront, kBehind, kShadow };

class RowErrors {
 public:
  RowErrors(const PixelLimits& limits, const sensing::StereoView& view, StereoSums& sums)
      : limits_(limits),
        view_(view),
        scale_px_m_(view.focal_px * view.baseline_m),
        sums_(sums),
        plain_px_(static_cast<std::size_t>(view.columns), kNone) {}

  void Add(const sensing::StereoTruth& truth, const sensing::DepthImage& matched_px, int row) {
    for (int column = 0; column < view_.columns; ++column) {
      plain_px_[static_cast<std::size_t>(column)] =
          PlainError(truth, matched_px(row, column), row, column);
    }
    for (std::size_t lag = 1; lag <= kLags; ++lag) AddPairs(lag);
  }

 private:
  // Counts a pixel. Returns its error of disparity where it is plain and good, else kNone.
  double PlainError(const sensing::StereoTruth& truth, double matched_px, int row, int column) {
    const double true_px = truth.left_px(row, column);
    if (true_px < limits_.min_disparity_px || true_px > limits_.max_disparity_px) return kNone;
    const double depth_m = scale_px_m_ / true_px;
    const double ray = view_.Ray(column, row).norm();
    const double range_m = ray * depth_m;
    if (range_m < limits_.nearest_m || range_m >= limits_.farthest_m) return kNone;
    if (truth.both_px(row, column) <= 0.0) {
      sums_.hidden_pixels += 1.0;
      if (matched_px > 0.0) sums_.hidden_matched += 1.0;
      return kNone;
    }
    if (truth.margin(row, column)) {
      sums_.margin.Add(true_px, matched_px);
      return kNone;
    }
    sums_.all.Add(true_px, matched_px);
    const int jump = truth.jumps(row, column);
    const bool behind = truth.behind(row, column);
    if (jump <= static_cast<int>(kEdgeDistances)) {
      auto& sides = behind ? sums_.behinds : sums_.fronts;
      sides[static_cast<std::size_t>(jump - 1)].Add(true_px, matched_px);
    }
    const PixelKind edge = behind ? kBehind : kFront;
    const PixelKind away = truth.shaded(row, column) ? kShadow : kPlain;
    const PixelKind kind = jump <= limits_.edge_reach_px ? edge : away;
    sums_.kinds[kind].Add(true_px, matched_px);
    const double error_px = matched_px - true_px;
    if (matched_px <= 0.0 || std::abs(error_px) >= kWrong_px) return kNone;
    AddRange(range_m, depth_m, ray * scale_px_m_ / matched_px - range_m);
    return kind == kPlain ? error_px : kNone;
  }

  // With Z = f B / d along the optical axis and r = |e| Z along the ray a pixel of disparity stands
  // for |dr/dd| = |e| Z^2 / (f B) = r Z / (f B); on the axis, where |e| = 1, for r^2 / (f B).
  void AddRange(double range_m, double depth_m, double error_m) {
    const double step_m = range_m * depth_m / scale_px_m_;
    const double axis_step_m = range_m * range_m / scale_px_m_;
    sums_.range_m += range_m;
    sums_.range_bias_m += error_m;
    sums_.range_error2_m2 += error_m * error_m;
    sums_.range_step2_m2 += step_m * step_m;
    sums_.axis_step2_m2 += axis_step_m * axis_step_m;
  }

  void AddPairs(std::size_t lag) {
    for (std::size_t column = lag; column < plain_px_.size(); ++column) {
      const double product = plain_px_[column] * plain_px_[column - lag];
      if (std::isnan(product)) continue;
      sums_.pairs[lag - 1] += 1.0;
      sums_.products_px2[lag - 1] += product;
    }
  }

  const PixelLimits& limits_;
  const sensing::StereoView& view_;
  double scale_px_m_;
  StereoSums& sums_;
  std::vector<double> plain_px_;
};

}  // namespace

void PixelSums::Add(double true_px, double matched_px) {
  pixels += 1.0;
  if (matched_px <= 0.0) return;
  const double error_px = matched_px - true_px;
  if (std::abs(error_px) >= kWrong_px) {
    wrong += 1.0;
    return;
  }
  good += 1.0;
  bias_px += error_px;
  error2_px2 += error_px * error_px;
}

void AddPixels(const sensing::StereoTruth& truth, const sensing::DepthImage& matched_px,
               const sensing::StereoView& view, const PixelLimits& limits, StereoSums& sums) {
  EXPECT(matched_px.rows() == truth.left_px.rows() && matched_px.cols() == truth.left_px.cols());
  EXPECT(matched_px.rows() == view.rows && matched_px.cols() == view.columns);
  RowErrors errors(limits, view, sums);
  for (int row = 0; row < view.rows; ++row) errors.Add(truth, matched_px, row);
}

namespace {

using math::Vector3;

// What both eyes see of a rock.
struct VisiblePart {
  std::int64_t pixels = 0;
  Vector3 sum_R = Vector3::Zero();
  double range_sum_m = 0.0;
};

std::vector<VisiblePart> VisibleParts(std::size_t rocks, const sensing::StereoTruth& truth,
                                      const sensing::StereoView& view_R) {
  std::vector<VisiblePart> parts(rocks);
  const double scale_px_m = view_R.focal_px * view_R.baseline_m;
  for (int row = 0; row < view_R.rows; ++row) {
    for (int column = 0; column < view_R.columns; ++column) {
      const int rock = truth.rocks(row, column);
      const double disparity_px = truth.both_px(row, column);
      if (rock < 0 || disparity_px <= 0.0) continue;
      const Vector3 p_EP_R = view_R.Ray(column, row) * (scale_px_m / disparity_px);
      VisiblePart& part = parts[static_cast<std::size_t>(rock)];
      ++part.pixels;
      part.sum_R += view_R.eye + p_EP_R;
      part.range_sum_m += p_EP_R.norm();
    }
  }
  return parts;
}

// Returns the class of a height, in halves of the hazard's (kRockHeights); none below one half.
RockSums* ClassOf(double height_m, double hazard_height_m, StereoSums& sums) {
  const auto halves = static_cast<std::int64_t>(std::floor(2.0 * height_m / hazard_height_m));
  if (halves < 1) return nullptr;
  const auto last = static_cast<std::int64_t>(kRockHeights.size());
  return &sums.rocks[static_cast<std::size_t>(std::min(halves, last) - 1)];
}

}  // namespace

void AddRocksInView(const StereoSensingParams& params, const terrain::Terrain& terrain,
                    const sensing::StereoTruth& truth, const sensing::StereoView& view_R,
                    const LookMaps& maps, const DistanceBin& bin, StereoSums& sums) {
  const auto rocks = terrain.rocks();
  const std::vector<VisiblePart> parts = VisibleParts(rocks.size(), truth, view_R);
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    if (parts[i].pixels < params.min_rock_pixels) continue;
    RockSums* counted = ClassOf(rocks[i].height_m, params.hazard_height_m, sums);
    const auto pixels = static_cast<double>(parts[i].pixels);
    if (counted == nullptr || !bin.Holds(parts[i].range_sum_m / pixels)) continue;
    const Vector3 middle_R = parts[i].sum_R / pixels;
    const auto finds = [&](const messages::MapView& map) {
      return VerdictAt(map, middle_R.x(), middle_R.y(), params.hazard_goodness) == Verdict::kHazard;
    };
    counted->rocks += 1.0;
    if (finds(maps.perfect)) counted->perfect += 1.0;
    if (finds(maps.seen)) counted->found += 1.0;
  }
}

void AddCellsOfMap(const StereoSensingParams& params, const sensing::StereoView& view_R,
                   const LookMaps& maps, const DistanceBin& bin, StereoSums& sums) {
  const messages::MapView& grid = maps.perfect;
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      const Vector3 middle_R(grid.x0_m + (ix + 0.5) * grid.xstep_m,
                             grid.y0_m + (iy + 0.5) * grid.ystep_m, 0.0);
      if (!bin.Holds((middle_R - view_R.eye).norm())) continue;
      const auto verdict = [&](const messages::MapView& map) {
        return VerdictAt(map, middle_R.x(), middle_R.y(), params.hazard_goodness);
      };
      const Verdict perfect = verdict(maps.perfect);
      if (perfect == Verdict::kUnknown) continue;
      const Verdict seen = verdict(maps.seen);
      if (perfect == Verdict::kHazard) {
        sums.hazard_cells += 1.0;
        if (seen == Verdict::kHazard) sums.hazard_found += 1.0;
        continue;
      }
      sums.clear_cells += 1.0;
      if (seen != Verdict::kUnknown) sums.clear_known += 1.0;
      if (seen == Verdict::kHazard) sums.imagined += 1.0;
    }
  }
}

namespace {

using messages::LookDirection;

// A goal so far ahead that no map reaches it.
constexpr double kGoalAhead_m = 100.0;

messages::LookMoment FirstMoment(const messages::PointCloud& cloud) {
  messages::LookMoment moment;
  moment.number = cloud.number;
  return moment;
}

messages::PointCloud NothingBehind() {
  return {.number = 1, .direction = LookDirection::kBehind, .points_R = {}};
}

}  // namespace

messages::MapView MapOfLook(const navigation::NavigatorKind& navigator,
                            const messages::PointCloud& cloud) {
  const std::unique_ptr<navigation::Navigator> driver =
      navigator.Make({.goal = {kGoalAhead_m, 0.0}});
  navigation::NavigatorInput input;
  navigation::NavigatorDecision decision = driver->Decide(input);
  const messages::LookMoment moment = FirstMoment(cloud);
  if (decision.looks()) {
    input.cloud = &cloud;
    input.look = &moment;
    decision = driver->Decide(input);
  }
  const messages::PointCloud behind = NothingBehind();
  const messages::LookMoment later = FirstMoment(behind);
  if (decision.looks() && *decision.look == LookDirection::kBehind) {
    input.cloud = &behind;
    input.look = &later;
    driver->Decide(input);
  }
  const messages::NavigationView* view = driver->view();
  if (view == nullptr) {
    throw std::runtime_error("the navigator shows no map of its first look");
  }
  return view->map;
}

Verdict VerdictAt(const messages::MapView& map, double x_m, double y_m, double hazard_goodness) {
  const double column = std::floor((x_m - map.x0_m) / map.xstep_m);
  const double row = std::floor((y_m - map.y0_m) / map.ystep_m);
  if (!(column >= 0.0 && column < map.nx && row >= 0.0 && row < map.ny)) return Verdict::kUnknown;
  const messages::MapCellView& cell = map.Cell(static_cast<int>(column), static_cast<int>(row));
  if (!cell.known) return Verdict::kUnknown;
  return static_cast<double>(cell.goodness) <= hazard_goodness ? Verdict::kHazard : Verdict::kClear;
}

}  // namespace rockyard::experiments
