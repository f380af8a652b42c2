#include "vision/cylinder/wall_colours.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "math/functions.h"

namespace rockyard::vision {
namespace {

constexpr double kQuadrant_rad = 0.5 * std::numbers::pi;

// Returns the image of the wall's line in a direction from the axis (of length 1).
std::optional<WallLine> LineAt(const CameraModel& camera, const CylinderPlace& place,
                               const math::Vector3& direction, const math::Vector3& half_axis_m) {
  const math::Vector3 middle = place.p_LT_L + place.radius_m * direction;
  const auto upper = Project(camera, middle + half_axis_m);
  const auto lower = Project(camera, middle - half_axis_m);
  if (!upper || !lower) return std::nullopt;
  const double rows = lower->y() - upper->y();
  if (std::abs(rows) < 1e-9) return std::nullopt;
  const Pixel mean = 0.5 * (*upper + *lower);
  return WallLine{mean.x(), mean.y(), (lower->x() - upper->x()) / rows};
}

// Quadrants seen at once, and the terms of each.
constexpr int kMostParts = 3;
constexpr int kWallTerms = 3;
constexpr int kWallUnknowns = kMostParts * kWallTerms;
constexpr int kPrimaries = 3;
// The standard deviation of a quadrant's level, over the level of the whole.
constexpr double kLevelSpread = 3.0;
// The blur of an edge ends at so many standard deviations.
constexpr double kBlurEnd = 4.0;

using WallTerms = Eigen::Vector3d;
// A row for each term of each part. Must stay row-major, as WallVector holds the primaries of each
// term side by side.
using WallUnknowns = Eigen::Matrix<double, kWallUnknowns, kPrimaries, Eigen::RowMajor>;
constexpr int kAllUnknowns = kWallUnknowns * kPrimaries;  // kPriors of fit_problem.cc
using WallVector = Eigen::Matrix<double, kAllUnknowns, 1>;
using WallNormal = Eigen::Matrix<double, kAllUnknowns, kAllUnknowns>;

// Returns the share of a pixel to the right of an edge that lies `right_px` left of the pixel's
// middle.
double ShareBeyond(double right_px, double blur_px) {
  const double x = right_px / blur_px;
  if (x <= -kBlurEnd) return 0.0;
  if (x >= kBlurEnd) return 1.0;
  return 0.5 * math::Erfc(-x / std::numbers::sqrt2);
}

WallTerms TermsAt(double t) {
  const double inside = std::clamp(t, -1.0, 1.0);
  return {1.0, inside, std::sqrt(1.0 - inside * inside) - 0.25 * std::numbers::pi};
}

// The shares of quadrants and backgrounds in a column of a band.
struct Mixture {
  std::array<double, kMostParts> parts{};
  double left = 1.0;  // the background on the left
  double right = 0.0;
  WallTerms terms = WallTerms::UnitX();
};

// The columns of a view's lines at a band.
class BandView {
 public:
  BandView(const WallView& view, double row, double blur_px)
      : parts_(static_cast<int>(view.quadrants.size())), blur_px_(blur_px) {
    for (std::size_t i = 0; i < view.lines.size(); ++i) {
      columns_.at(i) = view.lines[i].ColumnAt(row);
    }
  }

  Mixture At(double column) const {
    Mixture mixture;
    double beyond = ShareBeyond(column - columns_[0], blur_px_);
    mixture.left = 1.0 - beyond;
    for (int i = 0; i < parts_; ++i) {
      const auto part = static_cast<std::size_t>(i);
      const double next = ShareBeyond(column - columns_.at(part + 1), blur_px_);
      mixture.parts.at(part) = std::max(beyond - next, 0.0);
      beyond = next;
    }
    mixture.right = beyond;
    mixture.terms = TermsAt(AcrossOf(column));
    return mixture;
  }

  // Returns t of the middle of a part.
  double MiddleOfPart(int part) const {
    const auto i = static_cast<std::size_t>(part);
    return AcrossOf(0.5 * (columns_.at(i) + columns_.at(i + 1)));
  }

 private:
  double AcrossOf(double column) const {
    const double last = columns_.at(static_cast<std::size_t>(parts_));
    const double half = std::max(0.5 * (last - columns_[0]), 1e-6);
    return (column - 0.5 * (columns_[0] + last)) / half;
  }

  std::array<double, kMostParts + 1> columns_{};
  int parts_;
  double blur_px_;
};

// Returns the residuals of a prior per unit of a colour: 1 / along_sd along a direction, 1 /
// across_sd across it.
Eigen::Matrix3d PriorRoot(const Eigen::Vector3d& direction, double along_sd, double across_sd) {
  return Eigen::Matrix3d::Identity() / across_sd +
         (1.0 / along_sd - 1.0 / across_sd) * direction * direction.transpose();
}

// The linear least squares of a profile for one view.
class WallProblem {
 public:
  WallProblem(const EyeProfile& profile, const WallView& view, const QuadrantDirections& directions,
              double blur_px, const CylinderFitParams& params)
      : profile_(profile), view_(view), parts_(static_cast<int>(view.quadrants.size())) {
    EXPECT(parts_ >= 1 && parts_ <= kMostParts);
    const double level = std::max(profile.level, 1.0);
    level_root_ = 1.0 / (kLevelSpread * level);
    for (std::size_t part = 0; part < view.quadrants.size(); ++part) {
      const auto quadrant = static_cast<std::size_t>(view.quadrants[part]);
      slope_roots_.at(part) =
          PriorRoot(directions.at(quadrant), params.shading_sd * level, params.tint_sd * level);
    }
    for (const ProfileBand& band : profile.bands) {
      bands_.emplace_back(view, band.row, blur_px);
    }
    Solve();
  }

  void AppendResiduals(std::vector<double>& residuals) const {
    auto next = mixtures_.begin();
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      const ProfileBand& band = profile_.bands[b];
      for (std::size_t i = 0; i < band.colours.size(); ++i) {
        const Mixture& mixture = *next++;
        Eigen::Vector3d left = WithoutBackground(band, i, mixture);
        for (int part = 0; part < parts_; ++part) {
          const double share = mixture.parts.at(static_cast<std::size_t>(part));
          if (share == 0.0) continue;
          left -= share * unknowns_.middleRows<kWallTerms>(kWallTerms * part).transpose() *
                  mixture.terms;
        }
        left = band.whitening[i] * left;
        residuals.insert(residuals.end(), left.data(), left.data() + kPrimaries);
      }
    }
    for (int i = 0; i < kWallUnknowns; ++i) {
      const Eigen::Vector3d left = RootOf(i) * unknowns_.row(i).transpose();
      residuals.insert(residuals.end(), left.data(), left.data() + kPrimaries);
    }
  }

  std::vector<QuadrantColour> Colours() const {
    std::vector<QuadrantColour> colours;
    const BandView& band = bands_[bands_.size() / 2];
    for (int part = 0; part < parts_; ++part) {
      const WallTerms terms = TermsAt(band.MiddleOfPart(part));
      QuadrantColour colour;
      colour.quadrant = view_.quadrants[static_cast<std::size_t>(part)];
      colour.colour = unknowns_.middleRows<kWallTerms>(kWallTerms * part).transpose() * terms;
      colour.covariance = CovarianceOf(part, terms);
      colours.push_back(colour);
    }
    return colours;
  }

 private:
  // Returns the residuals per unit of an unknown's prior.
  Eigen::Matrix3d RootOf(int unknown) const {
    if (unknown % kWallTerms == 0) return level_root_ * Eigen::Matrix3d::Identity();
    return slope_roots_.at(static_cast<std::size_t>(unknown / kWallTerms));
  }

  double ColumnOf(std::size_t i) const { return profile_.first_column + static_cast<double>(i); }

  static Eigen::Vector3d WithoutBackground(const ProfileBand& band, std::size_t i,
                                           const Mixture& mixture) {
    return band.colours[i] - mixture.left * band.left_background -
           mixture.right * band.right_background;
  }

  // Returns the covariance of a part's colour, the sum of its terms.
  Eigen::Matrix3d CovarianceOf(int part, const WallTerms& terms) const {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (int a = 0; a < kWallTerms; ++a) {
      for (int b = 0; b < kWallTerms; ++b) {
        covariance +=
            terms[a] * terms[b] *
            covariance_.block<kPrimaries, kPrimaries>(kPrimaries * (kWallTerms * part + a),
                                                      kPrimaries * (kWallTerms * part + b));
      }
    }
    return covariance;
  }

  void Solve() {
    WallNormal normal = WallNormal::Zero();
    WallVector moments = WallVector::Zero();
    for (int i = 0; i < kWallUnknowns; ++i) {
      const Eigen::Matrix3d root = RootOf(i);
      normal.block<kPrimaries, kPrimaries>(kPrimaries * i, kPrimaries * i) = root * root;
    }
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      for (std::size_t i = 0; i < profile_.bands[b].colours.size(); ++i) {
        mixtures_.push_back(bands_[b].At(ColumnOf(i)));
        AddSample(profile_.bands[b], i, mixtures_.back(), normal, moments);
      }
    }
    const Eigen::LLT<WallNormal> factors(normal);
    Eigen::Map<WallVector>(unknowns_.data()) = factors.solve(moments);
    covariance_ = factors.solve(WallNormal::Identity());
  }

  void AddSample(const ProfileBand& band, std::size_t i, const Mixture& mixture, WallNormal& normal,
                 WallVector& moments) const {
    const Eigen::Matrix3d weight = band.whitening[i] * band.whitening[i];
    const Eigen::Vector3d colour = weight * WithoutBackground(band, i, mixture);
    Eigen::Matrix<double, kWallUnknowns, 1> shares;
    for (int part = 0; part < kMostParts; ++part) {
      shares.segment<kWallTerms>(kWallTerms * part) =
          mixture.parts.at(static_cast<std::size_t>(part)) * mixture.terms;
    }
    for (int a = 0; a < kWallUnknowns; ++a) {
      if (shares[a] == 0.0) continue;
      moments.segment<kPrimaries>(kPrimaries * a) += shares[a] * colour;
      for (int b = 0; b < kWallUnknowns; ++b) {
        if (shares[b] == 0.0) continue;
        normal.block<kPrimaries, kPrimaries>(kPrimaries * a, kPrimaries * b) +=
            shares[a] * shares[b] * weight;
      }
    }
  }

  const EyeProfile& profile_;
  const WallView& view_;
  int parts_;
  std::vector<BandView> bands_;
  std::vector<Mixture> mixtures_;  // of all samples, band by band
  double level_root_ = 1.0;
  // PriorRoot of the slopes of each part; for parts that are not seen any positive weight serves.
  std::array<Eigen::Matrix3d, kMostParts> slope_roots_ = {
      Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity()};
  WallUnknowns unknowns_ = WallUnknowns::Zero();
  WallNormal covariance_ = WallNormal::Zero();
};

}  // namespace

std::optional<WallView> WallSeen(const CameraModel& camera, const EyeGeometry& eyes,
                                 const CylinderPlace& place, double height_m) {
  const math::Vector3& up = place.axis_L;
  // Azimuths count from the direction to the middle between the eyes, whose azimuth in T is theta.
  const math::Vector3 to_middle = AcrossAxis(eyes.middle_L - place.p_LT_L, up).normalized();
  const math::Vector3 to_side = up.cross(to_middle);
  const math::Vector3 to_eye = AcrossAxis(CentreOf(camera) - place.p_LT_L, up);
  const double distance_m = to_eye.norm();
  if (!(distance_m > place.radius_m)) return std::nullopt;
  const double eye_rad = math::Atan2(to_eye.dot(to_side), to_eye.dot(to_middle));
  const double half_rad = math::Acos(place.radius_m / distance_m);
  const math::Vector3 half_axis_m = 0.5 * height_m * (up + place.roll_rad * eyes.right_L);
  WallView view;
  const auto add_line = [&](double azimuth_rad) {
    const math::Vector3 direction =
        math::Cos(azimuth_rad) * to_middle + math::Sin(azimuth_rad) * to_side;
    const auto line = LineAt(camera, place, direction, half_axis_m);
    if (line) view.lines.push_back(*line);
    return line.has_value();
  };
  // Counter-clockwise seen from above is from left to right in the image.
  const double first_rad = eye_rad - half_rad;
  const double last_rad = eye_rad + half_rad;
  if (!add_line(first_rad)) return std::nullopt;
  int quadrant = static_cast<int>(std::floor((place.orientation_rad + first_rad) / kQuadrant_rad));
  while ((quadrant + 1) * kQuadrant_rad - place.orientation_rad < last_rad) {
    ++quadrant;
    view.quadrants.push_back((quadrant + 3) & 3);
    if (!add_line(quadrant * kQuadrant_rad - place.orientation_rad)) return std::nullopt;
  }
  view.quadrants.push_back(quadrant & 3);
  if (!add_line(last_rad)) return std::nullopt;
  return view;
}

int ResidualsOf(const EyeProfile& profile) {
  std::size_t samples = 0;
  for (const ProfileBand& band : profile.bands) samples += band.colours.size();
  return kPrimaries * (static_cast<int>(samples) + kWallUnknowns);
}

std::vector<QuadrantColour> FitWallColours(const EyeProfile& profile, const WallView& view,
                                           const QuadrantDirections& directions, double blur_px,
                                           const CylinderFitParams& params,
                                           std::vector<double>& residuals) {
  const WallProblem problem(profile, view, directions, blur_px, params);
  problem.AppendResiduals(residuals);
  return problem.Colours();
}

}  // namespace rockyard::vision
