#include "vision/stereo/row_alignment.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/check.h"
#include "core/space_filling.h"

namespace rockyard::vision {
namespace {

constexpr std::size_t kTriples = 512;  // with half of the matches wrong, 64 have three right ones
constexpr int kRounds = 20;
constexpr double kTukey = 4.685;     // 95 % of the efficiency of least squares
constexpr double kToSigma = 1.4826;  // sigma of normal residuals over the median of their sizes
constexpr double kLeastScale_px = 0.05;
constexpr double kLeastArea = 0.2;  // of a triple's parallelogram; the whole image has 4

// One match as an equation: design . plane = moved_px. The middle is 0, the image's edges are at
// -1 and 1.
struct Equation {
  Eigen::Vector3d design;
  double moved_px;

  double Residual(const Eigen::Vector3d& plane) const { return moved_px - design.dot(plane); }
};

double Middle(int size) { return 0.5 * (size - 1); }

std::vector<Equation> Equations(const std::vector<RowMatch>& matches, int width, int height) {
  std::vector<Equation> equations;
  equations.reserve(matches.size());
  for (const RowMatch& match : matches) {
    equations.push_back(
        {{1.0, match.right_column / Middle(width) - 1.0, match.left_row / Middle(height) - 1.0},
         match.right_row - match.left_row});
  }
  return equations;
}

int CountAgreeing(const std::vector<Equation>& equations, const Eigen::Vector3d& plane,
                  double agree_px) {
  return static_cast<int>(std::count_if(equations.begin(), equations.end(), [&](const Equation& e) {
    return std::abs(e.Residual(plane)) <= agree_px;
  }));
}

// Returns the plane through three equations with which most others agree, or nothing where every
// triple lies along a line.
std::optional<Eigen::Vector3d> PlaneOfMost(const std::vector<Equation>& equations,
                                           double agree_px) {
  std::optional<Eigen::Vector3d> best;
  int most = 0;
  for (const std::vector<double>& point : core::SobolPoints(kTriples, 3, 1)) {
    Eigen::Matrix3d designs;
    Eigen::Vector3d moved_px;
    for (int i = 0; i < 3; ++i) {
      const double place =
          point[static_cast<std::size_t>(i)] * static_cast<double>(equations.size());
      const Equation& equation = equations[static_cast<std::size_t>(place)];
      designs.row(i) = equation.design.transpose();
      moved_px[i] = equation.moved_px;
    }
    if (std::abs(designs.determinant()) < kLeastArea) continue;
    const Eigen::Vector3d plane = designs.inverse() * moved_px;
    const int agreeing = CountAgreeing(equations, plane, agree_px);
    if (agreeing <= most) continue;
    most = agreeing;
    best = plane;
  }
  return best;
}

// Returns the s of the header.
double Scale(const std::vector<Equation>& equations, const Eigen::Vector3d& plane,
             double agree_px) {
  std::vector<double> sizes;
  for (const Equation& equation : equations) {
    const double size = std::abs(equation.Residual(plane));
    if (size <= agree_px) sizes.push_back(size);
  }
  if (sizes.empty()) return kLeastScale_px;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(kLeastScale_px, kToSigma * *middle);
}

// Iterates least squares, each round with the weights that the last plane gives.
Eigen::Vector3d Refine(const std::vector<Equation>& equations, Eigen::Vector3d plane,
                       double agree_px) {
  for (int round = 0; round < kRounds; ++round) {
    const double reach = kTukey * Scale(equations, plane, agree_px);
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d moved = Eigen::Vector3d::Zero();
    for (const Equation& equation : equations) {
      const double ratio = equation.Residual(plane) / reach;
      if (std::abs(ratio) >= 1.0) continue;
      const double root = 1.0 - ratio * ratio;
      const double weight = root * root;
      normal += weight * equation.design * equation.design.transpose();
      moved += weight * equation.moved_px * equation.design;
    }
    plane = normal.ldlt().solve(moved);
  }
  return plane;
}

double Rms(const std::vector<Equation>& equations, const Eigen::Vector3d& plane, double agree_px) {
  double sum_px2 = 0.0;
  int count = 0;
  for (const Equation& equation : equations) {
    const double residual_px = equation.Residual(plane);
    if (std::abs(residual_px) > agree_px) continue;
    sum_px2 += residual_px * residual_px;
    ++count;
  }
  return count == 0 ? 0.0 : std::sqrt(sum_px2 / count);
}

std::string Advice(const RowAlignmentOptions& options) {
  return fmt::format(
      "use two images of one textured scene whose rows are less than {} px apart, or give "
      "--cameras",
      options.search.max_rows_px);
}

std::vector<core::Problem> TooFewMatches(int matches, const RowAlignmentOptions& options) {
  return {{"right image",
           fmt::format("has {} points that are found in the left image too, fewer than the {} that "
                       "are needed",
                       matches, options.min_agreeing),
           Advice(options)}};
}

std::vector<core::Problem> TooFewAgree(int agreeing, int matches,
                                       const RowAlignmentOptions& options) {
  return {{"right image",
           fmt::format("has {} points that are found in the left image too, of which {} agree on "
                       "how the rows lie; {} are needed, and {:.0f} % of all",
                       matches, agreeing, options.min_agreeing, 100.0 * options.min_share),
           Advice(options)}};
}

}  // namespace

double RowCorrection::RightRow(double x, double y, int width, int height) const {
  return y + offset_px + per_column * (x - Middle(width)) + per_row * (y - Middle(height));
}

core::Result<RowAlignment> FindRowAlignment(const GrayImage& left, const GrayImage& right,
                                            const RowAlignmentOptions& options) {
  EXPECT(options.agree_px > 0.0 && options.min_agreeing >= 3);
  if (left.width() != right.width() || left.height() != right.height()) {
    return std::vector<core::Problem>{
        {"right image",
         fmt::format("is {} x {} pixels, the left one {} x {}", right.width(), right.height(),
                     left.width(), left.height()),
         "use two images of one size"}};
  }
  const std::vector<RowMatch> found = FindRowMatches(left, right, options.search);
  const auto matches = static_cast<int>(found.size());
  if (matches < options.min_agreeing) return TooFewMatches(matches, options);
  const std::vector<Equation> equations = Equations(found, left.width(), left.height());
  const std::optional<Eigen::Vector3d> start = PlaneOfMost(equations, options.agree_px);
  if (!start) {
    return std::vector<core::Problem>{{"right image",
                                       "has points in common with the left one along a line only",
                                       "use images that overlap more, or give --cameras"}};
  }
  const Eigen::Vector3d plane = Refine(equations, *start, options.agree_px);
  const int agreeing = CountAgreeing(equations, plane, options.agree_px);
  if (agreeing < options.min_agreeing || agreeing < options.min_share * matches) {
    return TooFewAgree(agreeing, matches, options);
  }
  return RowAlignment{{plane[0], plane[1] / Middle(left.width()), plane[2] / Middle(left.height())},
                      matches,
                      agreeing,
                      Rms(equations, plane, options.agree_px)};
}

RectificationTable MakeRowTable(const RowCorrection& correction, int width, int height) {
  Image<SourcePosition> positions(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      positions.At(x, y) = {static_cast<double>(x), correction.RightRow(x, y, width, height)};
    }
  }
  return {positions, width, height};
}

}  // namespace rockyard::vision
