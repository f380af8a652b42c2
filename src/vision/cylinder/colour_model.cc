#include "vision/cylinder/colour_model.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "math/functions.h"

namespace rockyard::vision {
namespace {

constexpr double kHalfLevel = 0.5;  // grey levels
constexpr int kLevels = 256;

// Returns ln of every grey level.
std::array<float, kLevels> LogTable() {
  std::array<float, kLevels> table{};
  for (std::size_t level = 0; level < table.size(); ++level) {
    table[level] = static_cast<float>(math::Log(std::max(static_cast<double>(level), kHalfLevel)));
  }
  return table;
}

// Ratios lie between ln(0.5 / 255) and its negative, 6.24, and are counted in cells of kStep.
// kSteps must cover -kLargestRatio to kLargestRatio.
constexpr double kLargestRatio = 6.3;
constexpr double kStep = 0.1;
constexpr int kSteps = 126;

int CellOf(float ratio) {
  return static_cast<int>((ratio + static_cast<float>(kLargestRatio)) / static_cast<float>(kStep));
}

double MiddleOfCell(int cell) { return (cell + 0.5) * kStep - kLargestRatio; }

// Returns the median of counted ratios, interpolated within its cell.
double MedianOf(const std::array<std::int64_t, kSteps>& counts) {
  std::int64_t all = 0;
  for (const std::int64_t count : counts) all += count;
  std::int64_t below = 0;
  int cell = 0;
  while (2 * (below + counts[static_cast<std::size_t>(cell)]) < all) {
    below += counts[static_cast<std::size_t>(cell)];
    ++cell;
  }
  const double within =
      (0.5 * static_cast<double>(all) - static_cast<double>(below)) /
      static_cast<double>(std::max<std::int64_t>(counts[static_cast<std::size_t>(cell)], 1));
  return MiddleOfCell(cell) + (within - 0.5) * kStep;
}

int BrightestOf(const Rgb& pixel) { return std::max({pixel.red, pixel.green, pixel.blue}); }

// Ratios of pixels, counted.
struct RatioCounts {
  std::array<std::int64_t, kSteps> red{};
  std::array<std::int64_t, kSteps> blue{};
  std::int64_t pixels = 0;

  void Count(const ColourImage& image, double darkest, const std::array<float, kLevels>& logs) {
    constexpr int kEvery = 3;  // rows and columns: a ninth of the pixels tells the median
    for (int y = 0; y < image.height(); y += kEvery) {
      for (int x = 0; x < image.width(); x += kEvery) {
        const Rgb& pixel = image.At(x, y);
        if (BrightestOf(pixel) < darkest) continue;
        const float green = logs[pixel.green];
        ++red[static_cast<std::size_t>(CellOf(logs[pixel.red] - green))];
        ++blue[static_cast<std::size_t>(CellOf(logs[pixel.blue] - green))];
        ++pixels;
      }
    }
  }
};

// The label of each cell of ratios.
class LabelTable {
 public:
  LabelTable(const LogRatios& light, const SurfaceColourParams& surfaces,
             const ColourModelParams& params)
      : labels_(kSteps, kSteps) {
    for (int y = 0; y < kSteps; ++y) {
      for (int x = 0; x < kSteps; ++x) {
        labels_.At(x, y) = LabelAt({MiddleOfCell(x), MiddleOfCell(y)}, light, surfaces, params);
      }
    }
  }

  std::uint8_t operator()(float red, float blue) const {
    return labels_.At(CellOf(red), CellOf(blue));
  }

 private:
  // Returns the label of the largest of normal densities in two dimensions: that of the least
  // |c - mean|^2 / sd^2 + 4 ln(sd).
  static std::uint8_t LabelAt(const LogRatios& ratios, const LogRatios& light,
                              const SurfaceColourParams& surfaces,
                              const ColourModelParams& params) {
    const auto cost = [&](const LogRatios& surface, double sd) {
      return (ratios - light - params.saturation * surface).squaredNorm() / (sd * sd) +
             4.0 * math::Log(sd);
    };
    constexpr double kFarthest = 9.0;  // three standard deviations
    std::uint8_t label = kBackground;
    double least = std::min({cost(GroundOf(surfaces), params.ground_sd),
                             cost(LogRatios::Zero(), params.neutral_sd),
                             kFarthest + 4.0 * math::Log(params.pixel_sd)});
    for (int i = 0; i < kCylinderColours; ++i) {
      const auto colour = static_cast<CylinderColour>(i);
      const double of_class = cost(SurfaceOf(colour, surfaces), params.pixel_sd);
      if (of_class >= least) continue;
      least = of_class;
      label = LabelOf(colour);
    }
    return label;
  }

  ClassImage labels_;
};

Eigen::Vector3d PrimariesOf(const SurfaceColour& colour) {
  // The factor keeps primaries far above half a grey level, at which LogRatiosOf cuts.
  return 255.0 * Eigen::Vector3d(colour[0], colour[1], colour[2]);
}

}  // namespace

LogRatios LogRatiosOf(const Eigen::Vector3d& primaries) {
  const Eigen::Array3d logs =
      primaries.array().max(kHalfLevel).unaryExpr([](double level) { return math::Log(level); });
  return {logs[0] - logs[1], logs[2] - logs[1]};
}

LogRatios SurfaceOf(CylinderColour colour, const SurfaceColourParams& surfaces) {
  if (colour == CylinderColour::kBlue) return LogRatiosOf(PrimariesOf(surfaces.blue));
  if (colour == CylinderColour::kMagenta) return LogRatiosOf(PrimariesOf(surfaces.magenta));
  return LogRatiosOf(PrimariesOf(surfaces.third));
}

Eigen::Vector3d DirectionOf(CylinderColour colour, const LogRatios& light,
                            const SurfaceColourParams& surfaces, const ColourModelParams& params) {
  const LogRatios ratios = light + params.saturation * SurfaceOf(colour, surfaces);
  return Eigen::Vector3d(math::Exp(ratios[0]), 1.0, math::Exp(ratios[1])).normalized();
}

LogRatios GroundOf(const SurfaceColourParams& surfaces) {
  return LogRatiosOf(PrimariesOf(surfaces.ground));
}

LogRatios LightOf(const ColourImage& left, const ColourImage& right,
                  const SurfaceColourParams& surfaces, const ColourModelParams& params) {
  const std::array<float, kLevels> logs = LogTable();
  RatioCounts counts;
  counts.Count(left, params.darkest, logs);
  counts.Count(right, params.darkest, logs);
  if (counts.pixels == 0) return LogRatios::Zero();
  const LogRatios median(MedianOf(counts.red), MedianOf(counts.blue));
  const LogRatios light = median - params.saturation * GroundOf(surfaces);
  const double limit = 2.0 * params.light_sd;
  return light.cwiseMax(-limit).cwiseMin(limit);
}

ClassImage LabelSurfaces(const ColourImage& image, const LogRatios& light,
                         const SurfaceColourParams& surfaces, const ColourModelParams& params) {
  const std::array<float, kLevels> logs = LogTable();
  const LabelTable table(light, surfaces, params);
  ClassImage labels(image.width(), image.height(), kBackground);
  for (int y = 0; y < image.height(); ++y) {
    const std::span<const Rgb> pixels = image.Row(y);
    std::transform(pixels.begin(), pixels.end(), labels.Row(y).begin(), [&](const Rgb& pixel) {
      if (BrightestOf(pixel) < params.darkest) return kBackground;
      const float green = logs[pixel.green];
      return table(logs[pixel.red] - green, logs[pixel.blue] - green);
    });
  }
  return labels;
}

Eigen::Matrix2d WhiteningOf(const Eigen::Matrix2d& covariance) {
  // A 2 x 2 matrix is tridiagonal already; computeFromTridiagonal spares the compiler ten seconds
  // of Householder's templates. Records depend on the scaling, which is that of
  // SelfAdjointEigenSolver::compute.
  const double largest = std::max(
      {std::abs(covariance(0, 0)), std::abs(covariance(1, 0)), std::abs(covariance(1, 1))});
  const double scale = largest == 0.0 ? 1.0 : largest;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeFromTridiagonal(Eigen::Vector2d(covariance.diagonal() / scale),
                                Eigen::Matrix<double, 1, 1>(covariance(1, 0) / scale));
  const Eigen::Vector2d values = scale * solver.eigenvalues();
  return solver.eigenvectors() * values.cwiseInverse().cwiseSqrt().asDiagonal() *
         solver.eigenvectors().transpose();
}

std::vector<double> ColourResiduals(const std::vector<SeenColour>& seen, const LogRatios& light,
                                    const SurfaceColourParams& surfaces,
                                    const ColourModelParams& params) {
  // Unknowns: the light's two ratios and the saturation, less their priors.
  const Eigen::Vector3d prior_root(1.0 / params.light_sd, 1.0 / params.light_sd,
                                   1.0 / params.saturation_sd);
  const auto rows = static_cast<Eigen::Index>(2 * seen.size() + 3);
  Eigen::MatrixXd by_unknown = Eigen::MatrixXd::Zero(rows, 3);
  Eigen::VectorXd residuals = Eigen::VectorXd::Zero(rows);
  const Eigen::Matrix2d surface =
      params.surface_sd * params.surface_sd * Eigen::Matrix2d::Identity();
  Eigen::Index row = 0;
  for (const SeenColour& colour : seen) {
    const LogRatios ratios = SurfaceOf(colour.colour, surfaces);
    const Eigen::Matrix2d whitening = WhiteningOf(surface + colour.covariance);
    by_unknown.block<2, 2>(row, 0) = whitening;
    by_unknown.block<2, 1>(row, 2) = whitening * ratios;
    residuals.segment<2>(row) = whitening * (colour.ratios - light - params.saturation * ratios);
    row += 2;
  }
  by_unknown.bottomRows<3>() = prior_root.asDiagonal();
  const Eigen::Matrix3d normal = by_unknown.transpose() * by_unknown;
  residuals -= by_unknown * normal.llt().solve(by_unknown.transpose() * residuals);
  return {residuals.data(), residuals.data() + rows};
}

}  // namespace rockyard::vision
