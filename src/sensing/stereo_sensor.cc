#include "sensing/stereo_sensor.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "core/random.h"
#include "math/functions.h"
#include "rendering/image_readout.h"
#include "sensing/stereo_depth.h"
#include "sensing/stereo_view.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;
using messages::LookDirection;

// Returns the number below which a standard normal number lies with the given probability.
// PixelNoise has 2^16 numbers: chances are met to 1/65536, and chances of less than half of that
// never happen.
float Quantile(double probability) {
  if (probability <= 0.0) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(core::NormalQuantile(probability));
}

// Returns how many cells of PixelNoise stand for numbers below the quantile of a chance.
std::uint32_t CellsBelow(double probability) {
  const auto numbers = rendering::PixelNoise::NumbersOfCells();
  const auto first = std::lower_bound(numbers.begin(), numbers.end(), Quantile(probability));
  return static_cast<std::uint32_t>(first - numbers.begin());
}

// Returns the cells of a chance p in the sun, and in shadow, where an independent chance q is
// added: 1 - (1 - p)(1 - q). It must stay written so that q = 0 leaves the bits of p.
std::array<std::uint32_t, 2> ByLight(double lit, double in_shadow) {
  return {CellsBelow(lit), CellsBelow(lit + in_shadow * (1.0 - lit))};
}

// Returns sums over windows of w x w independent numbers of variance 1, divided by w: they have
// variance 1 again. Pixels (i, j) apart share (w - i)(w - j) of the numbers, so they correlate by
// (1 - i/w)(1 - j/w).
DepthImage MeanOfWindows(const DepthImage& numbers, Eigen::Index window) {
  const Eigen::Index rows = numbers.rows() - window + 1;
  const Eigen::Index columns = numbers.cols() - window + 1;
  DepthImage along_rows = numbers.leftCols(columns);
  for (Eigen::Index i = 1; i < window; ++i) along_rows += numbers.middleCols(i, columns);
  DepthImage sums = along_rows.topRows(rows);
  for (Eigen::Index i = 1; i < window; ++i) sums += along_rows.middleRows(i, rows);
  return sums / static_cast<double>(window);
}

// Asks for all numbers of noise in their order, before they are looked up at random: what a trial
// does between two looks drives them out of fast memory.
void FetchNumbers() {
  constexpr std::size_t kLine = 64 / sizeof(float);
  const auto numbers = rendering::PixelNoise::NumbersOfCells();
  for (std::size_t i = 0; i < numbers.size(); i += kLine) __builtin_prefetch(&numbers[i]);
}

// Returns the numbers of a look's pixels, averaged over windows.
DepthImage WindowNoise(const rendering::PixelNoise& noise, Eigen::Index rows, Eigen::Index columns,
                       Eigen::Index window) {
  // w - 1 more numbers on each axis, so that every pixel has a full window.
  DepthImage numbers(rows + window - 1, columns + window - 1);
  for (int row = 0; row < numbers.rows(); ++row) {
    rendering::ForEachPixelNoise(noise, row, 0, static_cast<int>(numbers.cols()),
                                 [&](int column, float number) { numbers(row, column) = number; });
  }
  return MeanOfWindows(numbers, window);
}

}  // namespace

StereoMatcher::StereoMatcher(const StereoParams& params)
    : params_(params),
      mismatch_quantile_(Quantile(params.mismatch_probability)),
      edge_mismatch_quantile_(
          Quantile(params.mismatch_probability +
                   params.edge_mismatch_probability * (1.0 - params.mismatch_probability))),
      dropout_cells_{
          {ByLight(params.dropout_probability, params.shadow_dropout_probability),
           ByLight(params.edge_dropout_probability, params.shadow_dropout_probability)}} {}

// What a look draws, and the room for a row of it.
class StereoMatcher::Draws {
 public:
  Draws(core::TrialKey key, std::uint32_t look, Eigen::Index columns)
      : disparity(key, core::Purpose::kStereoDisparity, look),
        mismatch(key, core::Purpose::kStereoMismatch, look),
        dropout(key, core::Purpose::kStereoDropout, look),
        blocks_(static_cast<std::size_t>(columns) / rendering::PixelNoise::kBlock + 1) {}

  rendering::PixelNoise disparity;
  rendering::PixelNoise mismatch;
  rendering::PixelNoise dropout;
  DepthImage window_noise;  // empty where windows are single pixels

  // Returns the cells of `count` pixels of a row; they stay until the next call.
  const std::uint16_t* Cells(const rendering::PixelNoise& noise, int row, std::size_t count) const {
    constexpr std::size_t kBlock = rendering::PixelNoise::kBlock;
    const std::span cells(blocks_.front().data(), (count + kBlock - 1) / kBlock * kBlock);
    noise.Cells(row, 0, cells);
    return cells.data();
  }

 private:
  mutable std::vector<std::array<std::uint16_t, rendering::PixelNoise::kBlock>> blocks_;
};

// The order of steps decides records: noise, rounding, wrong matches, the searched range, margins,
// dropouts. A pixel of 0 stays 0. Each step draws from a stream of its own, by pixel, so that a
// step that is off shifts the numbers of no other.
void StereoMatcher::Match(core::TrialKey key, std::uint32_t look, const DepthImage& all,
                          DepthImage& seen, const PixelFlags& shaded) const {
  Draws draws(key, look, seen.cols());
  if (params_.disparity_noise_px > 0.0 && params_.noise_window_px > 1) {
    draws.window_noise =
        WindowNoise(draws.disparity, seen.rows(), seen.cols(), params_.noise_window_px);
  }
  if (params_.disparity_noise_px > 0.0) FetchNumbers();
  for (int row = 0; row < seen.rows(); ++row) {
    if ((seen.row(row) == 0.0).all()) continue;
    MatchRow(draws, row, all, seen, shaded);
  }
}

void StereoMatcher::MatchRow(const Draws& draws, int row, const DepthImage& all, DepthImage& seen,
                             const PixelFlags& shaded) const {
  const auto columns = static_cast<std::size_t>(seen.cols());
  const std::span<const double> all_px(&all(row, 0), columns);
  const std::span<double> row_px(&seen(row, 0), columns);
  auto pixels = seen.row(row);
  if (params_.disparity_noise_px > 0.0) AddNoise(draws, row, row_px);
  const double step_px = params_.disparity_step_px;
  if (step_px > 0.0) pixels = step_px * (pixels / step_px).round();
  if (params_.mismatch_probability > 0.0 || params_.edge_mismatch_probability > 0.0) {
    Mismatch(draws, row, all_px, row_px);
  }
  const double min_px = params_.min_disparity_px;
  const double max_px = params_.max_disparity_px;
  for (double& pixel : row_px) pixel = pixel >= min_px && pixel <= max_px ? pixel : 0.0;
  if (params_.margin_px > 0) {
    DropMargins(row < params_.margin_px || row >= seen.rows() - params_.margin_px, row_px);
  }
  if (params_.dropout_probability > 0.0 || params_.edge_dropout_probability > 0.0 ||
      shaded.size() > 0) {
    DropOut(draws, row, all_px,
            shaded.size() > 0 ? std::span(&shaded(row, 0), columns) : std::span<const bool>(),
            row_px);
  }
}

// Column c of the left image with disparity d is column c - d of the right one, in which margins
// end half a column before the first pixel beside them.
void StereoMatcher::DropMargins(bool edge_row, std::span<double> row_px) const {
  const auto margin = static_cast<std::size_t>(params_.margin_px);
  constexpr double kHalf_px = 0.5;
  for (std::size_t column = 0; column < row_px.size(); ++column) {
    const double right_px = static_cast<double>(column) - row_px[column];
    if (edge_row || column + margin >= row_px.size() ||
        right_px < static_cast<double>(margin) - kHalf_px) {
      row_px[column] = 0.0;
    }
  }
}

void StereoMatcher::AddNoise(const Draws& draws, int row, std::span<double> row_px) const {
  const double noise_px = params_.disparity_noise_px;
  const auto add = [&](std::size_t column, double number) {
    double& pixel = row_px[column];
    pixel = pixel > 0.0 ? pixel + noise_px * number : 0.0;
  };
  if (draws.window_noise.size() > 0) {
    for (std::size_t column = 0; column < row_px.size(); ++column) {
      add(column, draws.window_noise(row, static_cast<Eigen::Index>(column)));
    }
    return;
  }
  const std::uint16_t* cells = draws.Cells(draws.disparity, row, row_px.size());
  const auto numbers = rendering::PixelNoise::NumbersOfCells();
  for (std::size_t column = 0; column < row_px.size(); ++column) {
    add(column, numbers[cells[column]]);
  }
}

// One normal number z a pixel decides. Where Phi(z) < p the pixel is a mismatch: Phi(z) / p is then
// uniform in [0, 1), and says where in the searched range the match lies. Beside a jump the pixel
// matches the other surface where Phi(z) lies from p to p + q (1 - p).
void StereoMatcher::Mismatch(const Draws& draws, int row, std::span<const double> all_px,
                             std::span<double> row_px) const {
  const double searched_px = params_.max_disparity_px - params_.min_disparity_px;
  std::vector<int> jumps(row_px.size(), kNoJump);
  if (params_.edge_mismatch_probability > 0.0) {
    JumpDistances(all_px, params_.edge_disparity_px, jumps);
  }
  const std::uint16_t* cells = draws.Cells(draws.mismatch, row, row_px.size());
  const auto numbers = rendering::PixelNoise::NumbersOfCells();
  for (std::size_t column = 0; column < row_px.size(); ++column) {
    const float number = numbers[cells[column]];
    double& pixel = row_px[column];
    if (number >= edge_mismatch_quantile_ || pixel == 0.0) continue;
    if (number >= mismatch_quantile_) {
      MismatchEdge(all_px, column, jumps[column], pixel);
      continue;
    }
    const double share =
        0.5 * math::Erfc(-number / std::numbers::sqrt2) / params_.mismatch_probability;
    pixel = params_.min_disparity_px + std::min(share, 1.0) * searched_px;
  }
}

// The window around the pixel holds both surfaces, and may match by the contrast of either. The
// pixel keeps its noise; where nothing is seen across the jump it keeps its disparity.
void StereoMatcher::MismatchEdge(std::span<const double> row_px, std::size_t column, int jump,
                                 double& pixel) const {
  if (jump > params_.edge_reach_px) return;
  const double across_px = row_px[AcrossJump(row_px, params_.edge_disparity_px, column, jump)];
  if (across_px > 0.0) pixel += across_px - row_px[column];
}

// Jumps are taken from what the left camera sees (`all`), whether the right one sees it or not: the
// window that is matched is cut out of the left image.
void StereoMatcher::DropOut(const Draws& draws, int row, std::span<const double> all_px,
                            std::span<const bool> shaded, std::span<double> row_px) const {
  std::vector<std::uint8_t> beside(row_px.size());
  MarkJumps(all_px, params_.edge_disparity_px, params_.edge_reach_px, beside);
  const std::uint16_t* cells = draws.Cells(draws.dropout, row, row_px.size());
  for (std::size_t column = 0; column < row_px.size(); ++column) {
    const bool dark = !shaded.empty() && shaded[column];
    const bool drops = cells[column] < dropout_cells_[beside[column]][dark ? 1 : 0];
    row_px[column] = drops ? 0.0 : row_px[column];
  }
}

StereoSensor::StereoSensor(const StereoParams& params)
    : params_(params),
      matcher_(params),
      ahead_R_(MakeStereoView(params, LookDirection::kAhead)),
      behind_R_(MakeStereoView(params, LookDirection::kBehind)) {}

StereoSensor::StereoSensor(const StereoParams& params, const SunShade& shade)
    : StereoSensor(params) {
  if (params.shadow_dropout_probability > 0.0) shade_ = shade;
}

PixelFlags StereoSensor::Shaded(const terrain::Terrain& terrain, const math::Transform& X_WR,
                                const StereoView& view_W, const DepthImage& seen) const {
  PixelFlags shaded = PixelFlags::Constant(seen.rows(), seen.cols(), false);
  for (int row = 0; row < view_W.rows; ++row) {
    for (int column = 0; column < view_W.columns; ++column) {
      if (seen(row, column) <= 0.0) continue;
      const Vector3 ray_W = view_W.Ray(column, row).normalized();
      const auto hit = terrain.CastRay(view_W.eye, ray_W, params_.max_range_m);
      shaded(row, column) = hit && shade_->IsShaded(terrain, X_WR, *hit);
    }
  }
  return shaded;
}

DepthImage StereoSensor::InverseDepths(const terrain::Terrain& terrain, const math::Transform& X_WR,
                                       core::TrialKey key, std::int64_t look_number,
                                       LookDirection direction) const {
  const StereoView view_W = view_R(direction).From(X_WR);
  const StereoScene scene(terrain, view_W, params_.max_range_m);
  DepthImage all = scene.InverseDepths();
  // The ideal sensor stops here: one eye, no matching.
  if (params_.fidelity == StereoFidelity::kIdeal) return all;
  DepthImage seen = all;
  scene.HideFromRightEye(seen);
  const double scale_px_m = params_.focal_columns_px() * params_.baseline_m;
  // Goldberg 2002, section 2: d = f b / Z. Noise acts on the disparity; back to depth on the same
  // ray.
  all *= scale_px_m;
  seen *= scale_px_m;
  const PixelFlags shaded = shade_ ? Shaded(terrain, X_WR, view_W, seen) : PixelFlags();
  matcher_.Match(key, static_cast<std::uint32_t>(look_number), all, seen, shaded);
  seen /= scale_px_m;
  return seen;
}

messages::PointCloud StereoSensor::Look(const terrain::Terrain& terrain,
                                        const math::Transform& X_WR, core::TrialKey key,
                                        std::int64_t look_number, LookDirection direction) const {
  return PointsOf(params_, view_R(direction),
                  InverseDepths(terrain, X_WR, key, look_number, direction), look_number,
                  direction);
}

}  // namespace rockyard::sensing
