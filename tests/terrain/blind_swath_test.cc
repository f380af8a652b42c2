// The blind swath: kinematic first contacts in Poisson fields against the closed form, and the path
// swept by a straight front up to a rock, by hand and against walks around outlines.
#include "terrain/blind_swath.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "core/random.h"
#include "core/statistical_checks.h"
#include "terrain/field.h"
#include "terrain/placed_rocks.h"

namespace rockyard::terrain {
namespace {

constexpr double kRoverWidth_m = 0.48;
constexpr double kBig_m = 0.2;
constexpr double kNothing = std::numeric_limits<double>::infinity();

// Long enough that one swath in 10^4 meets nothing.
TerrainParams PoissonField() {
  TerrainParams params{.rocks = {.overlap = OverlapRule::kAllow, .clear_radius_m = 0.0},
                       .arena = {.kind = ArenaKind::kOpen, .length_m = 44.0}};
  params.rocks.k_reference_per_m2 = params.rocks.k_per_m2;
  return params;
}

std::vector<double> FirstContacts(const TerrainParams& params, const BlindSwath& swath,
                                  std::uint32_t fields) {
  std::vector<double> distances;
  for (std::uint32_t i = 0; i < fields; ++i) {
    const Field field = BuildField(params, {5, i}, {});
    const std::vector<Rock> rocks(field.terrain.rocks().begin(), field.terrain.rocks().end());
    distances.push_back(FirstContact_m(rocks, swath, 0.0, 0.0));
  }
  return distances;
}

double ExponentialP(const std::vector<double>& distances, double contacts_per_m) {
  return core::KolmogorovP(distances,
                           [&](double x_m) { return 1.0 - std::exp(-contacts_per_m * x_m); });
}

// The integral of eq. (1) of the header by a sum over thin slices of diameter, for round rocks.
double ByQuadrature(const RockFieldParams& rocks, const BlindSwath& swath) {
  constexpr int kSlices = 200000;
  const double low_m = std::max(swath.min_diameter_m, rocks.min_diameter_m);
  const double step_m = (rocks.max_diameter_m - low_m) / kSlices;
  double sum = 0.0;
  for (int i = 0; i < kSlices; ++i) {
    const double d_m = low_m + (i + 0.5) * step_m;
    const double q = 1.79 + 0.152 / rocks.cover;
    const double density =  // -dN/dD
        rocks.kind == RockFieldKind::kMoore
            ? rocks.k_per_m2 * kMooreExponent * std::pow(d_m, -kMooreExponent - 1.0)
            : 4.0 / std::numbers::pi * rocks.cover * q * std::exp(-q * d_m) / (d_m * d_m);
    sum += (swath.width_m + d_m) * density * step_m;
  }
  return sum;
}

Rock Ellipse(double x_m, double y_m, double a_m, double b_m, double yaw_rad) {
  return EllipsoidRock(x_m, y_m, 0.0, a_m, b_m, 0.1, yaw_rad);
}

// The least x of points of the outline with |y| up to 0.2 m; infinity where there are none.
double LeastX_m(const Rock& rock) {
  constexpr int kPoints = 40000;
  double least_m = kNothing;
  for (int i = 0; i < kPoints; ++i) {
    const double t = 2.0 * std::numbers::pi * i / kPoints;
    const double u = rock.semi_axes_m.x() * std::cos(t);
    const double v = rock.semi_axes_m.y() * std::sin(t);
    const double y = rock.center_W.y() + u * std::sin(rock.yaw_rad) + v * std::cos(rock.yaw_rad);
    if (std::abs(y) > 0.2) continue;
    const double x = rock.center_W.x() + u * std::cos(rock.yaw_rad) - v * std::sin(rock.yaw_rad);
    least_m = std::min(least_m, x);
  }
  return least_m;
}

TEST(BlindSwathTest, ClosedFormEqualsQuadrature) {
  RockFieldParams rocks{.min_width_ratio = 1.0, .max_width_ratio = 1.0};
  for (const RockFieldKind law : {RockFieldKind::kMoore, RockFieldKind::kGolombek}) {
    rocks.kind = law;
    for (const double min_m : {0.0, 0.1, 0.2, 0.5}) {
      const BlindSwath swath{kRoverWidth_m, min_m};
      const double expected = ByQuadrature(rocks, swath);
      EXPECT_NEAR(BlindContactsPerM(rocks, swath), expected, 1e-7 * expected) << min_m;
    }
    EXPECT_EQ(BlindContactsPerM(rocks, {kRoverWidth_m, 1.0}), 0.0);
  }
  rocks.kind = RockFieldKind::kListed;
  rocks.listed.rest = RestOfRocks::kGolombek;
  EXPECT_EQ(BlindContactsPerM(rocks, {kRoverWidth_m, 0.1}), 0.0);
}

TEST(BlindSwathTest, UniformRocksOfOneSizeNeedNoIntegral) {
  RockFieldParams rocks{.kind = RockFieldKind::kUniformCount,
                        .count = 10,
                        .uniform_min_diameter_m = 0.3,
                        .uniform_max_diameter_m = 0.3,
                        .min_width_ratio = 1.0};
  EXPECT_NEAR(BlindContactsPerM(rocks, {0.5, 0.2}), 10.0 / 17.6 * 0.8, 1e-12);
  EXPECT_EQ(BlindContactsPerM(rocks, {0.5, 0.31}), 0.0);
  rocks.kind = RockFieldKind::kNone;
  EXPECT_EQ(BlindContactsPerM(rocks, {0.5, 0.0}), 0.0);
}

// Needles: the mean extent of a segment of length 1 is 2 / pi (Buffon). The flattest ellipses that
// a field may have are 0.2, whose perimeter over pi is 0.6688 by Ramanujan's second approximation.
TEST(BlindSwathTest, FlatRocksAreMetByTheirMeanExtent) {
  RockFieldParams round{.min_width_ratio = 1.0};
  RockFieldParams flat{.min_width_ratio = 0.2, .max_width_ratio = 0.2};
  const double h = std::pow(0.8 / 1.2, 2.0);
  const double extent = 0.5 * 1.2 * (1.0 + 3.0 * h / (10.0 + std::sqrt(4.0 - 3.0 * h)));
  const double ratio = BlindContactsPerM(flat, {0.0, 0.1}) / BlindContactsPerM(round, {0.0, 0.1});
  EXPECT_NEAR(ratio, extent, 1e-4);
}

TEST(BlindSwathTest, ContactsOfKnownRocks) {
  const BlindSwath swath{0.4, 0.0};
  EXPECT_NEAR(FirstContact_m({Ellipse(2.0, 0.1, 0.3, 0.3, 0.0)}, swath, 0.0, 0.0), 1.7, 1e-12);
  // Beside the front's end by 0.18 of a radius of 0.3: touched at the end, 0.24 before the centre.
  EXPECT_NEAR(FirstContact_m({Ellipse(2.0, 0.38, 0.3, 0.3, 0.0)}, swath, 0.0, 0.0), 1.76, 1e-12);
  EXPECT_EQ(FirstContact_m({Ellipse(2.0, 0.51, 0.3, 0.3, 0.0)}, swath, 0.0, 0.0), kNothing);
  // Behind the start, and below the smallest obstacle.
  EXPECT_NEAR(FirstContact_m({Ellipse(0.1, 0.0, 0.3, 0.3, 0.0), Ellipse(3.0, 0.0, 0.3, 0.2, 0.0)},
                             swath, 0.0, 0.0),
              2.7, 1e-12);
  EXPECT_EQ(FirstContact_m({Ellipse(2.0, 0.0, 0.3, 0.3, 0.0)}, {0.4, 0.7}, 0.0, 0.0), kNothing);
  // Across, an ellipse is met by its short axis; turned by 90 deg a wide swath meets its end.
  EXPECT_NEAR(
      FirstContact_m({Ellipse(2.0, 0.0, 0.3, 0.1, 0.5 * std::numbers::pi)}, {1.0, 0.0}, 0.0, 0.0),
      1.9, 1e-12);
}

// Against points of the outline, at every yaw and offset.
TEST(BlindSwathTest, ContactsAgreeWithSampledOutlines) {
  const BlindSwath swath{0.4, 0.0};
  for (double yaw = -1.5; yaw < 1.6; yaw += 0.25) {
    for (double y_m = -0.45; y_m < 0.46; y_m += 0.15) {
      const Rock rock = Ellipse(2.0, y_m, 0.35, 0.2, yaw);
      const double expected_m = LeastX_m(rock);
      const double found_m = FirstContact_m({rock}, swath, 0.0, 0.0);
      if (std::isinf(expected_m)) continue;  // the outline's points may just miss the swath
      EXPECT_NEAR(found_m, expected_m, 1e-3) << yaw << " " << y_m;
    }
  }
}

// Kolmogorov and Smirnov at alpha = 0.001, 1500 fields, fixed seeds.
TEST(BlindSwathTest, DistancesInAPoissonFieldAreExponential) {
  const TerrainParams params = PoissonField();
  const BlindSwath swath{kRoverWidth_m, kBig_m};
  const std::vector<double> distances = FirstContacts(params, swath, 1500);
  EXPECT_GT(ExponentialP(distances, BlindContactsPerM(params.rocks, swath)), 0.001);
  // Negative controls: another width, another smallest obstacle.
  EXPECT_LT(ExponentialP(distances, BlindContactsPerM(params.rocks, {0.40, kBig_m})), 0.001);
  EXPECT_LT(ExponentialP(distances, BlindContactsPerM(params.rocks, {kRoverWidth_m, 0.15})), 1e-6);
}

TEST(SweptPathTest, FirstContactIsTheLeastXOfTheOutlineInThePath) {
  // A circle of 0.2 m ahead; beside the path but for its flank; out of reach.
  EXPECT_NEAR(FirstContact(Ellipse(1.0, 0.0, 0.2, 0.2, 0.3), 0.0, 0.24).value(), 0.8, 1e-12);
  // At y = 0.24 the circle around y = 0.34 begins at 1 - sqrt(0.2^2 - 0.1^2).
  EXPECT_NEAR(FirstContact(Ellipse(1.0, 0.34, 0.2, 0.2, 0.0), 0.0, 0.24).value(),
              1.0 - std::sqrt(0.03), 1e-12);
  EXPECT_FALSE(FirstContact(Ellipse(1.0, 0.45, 0.2, 0.2, 0.0), 0.0, 0.24).has_value());
}

// Any ellipse against a fine walk around its outline.
TEST(SweptPathTest, AgreesWithAWalkAroundTheOutline) {
  core::RandomStream stream({7, 0}, core::Purpose::kTest);
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const double a = 0.05 + 0.4 * stream.Uniform();
    const double b = a * (0.3 + 0.7 * stream.Uniform());
    const Rock rock = Ellipse(2.0, stream.Uniform() - 0.5, a, b, 3.0 * stream.Uniform());
    const double least_m = LeastX_m(rock);
    const auto contact = FirstContact(rock, 0.0, 0.2);
    ASSERT_EQ(contact.has_value(), std::isfinite(least_m)) << i;
    if (!contact) continue;
    ++met;
    EXPECT_NEAR(*contact, least_m, 2e-3) << i;
  }
  EXPECT_GT(met, 100);
}

}  // namespace
}  // namespace rockyard::terrain
