// Elementary functions against the C library's in long double, whose 11 bits more make its own
// errors small, at their edges, and as bits that no processor may change.

#include "math/functions.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.h"

namespace rockyard::math {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeast = std::numeric_limits<double>::denorm_min();
constexpr double kMost = std::numeric_limits<double>::max();

static_assert(std::numeric_limits<long double>::digits >= 64);

// Returns the distance of a result from what is right, in units of its last place.
double ErrorOf(double result, long double right) {
  const auto rounded = static_cast<double>(right);
  if (std::isnan(right) || std::isinf(rounded) || right == 0.0L) {
    return std::isnan(right) ? (std::isnan(result) ? 0.0 : kInfinity)
                             : (result == rounded ? 0.0 : kInfinity);
  }
  const int exponent = std::max(std::ilogb(right), -1022) - 52;
  return static_cast<double>(std::abs(std::ldexp(result - right, -exponent)));
}

struct Argument {
  double x = 0.0;
  double y = 0.0;
};

// Draws arguments of all sizes and of those that trials have.
class Arguments {
 public:
  explicit Arguments(std::uint32_t number) : stream_({.seed = 5}, core::Purpose::kTest, number) {}

  double Within(double low, double high) { return core::SampleUniform(stream_, low, high); }
  // Either sign, sizes between powers of 2.
  double Sized(double low, double high) {
    const double size = std::exp2(Within(low, high));
    return core::SampleBernoulli(stream_, 0.5) ? size : -size;
  }

 private:
  core::RandomStream stream_;
};

template <typename Function, typename Reference, typename Draw>
double WorstError(Function function, Reference reference, Draw draw, int count = 4000) {
  Arguments arguments(static_cast<std::uint32_t>(count));
  double worst = 0.0;
  for (int i = 0; i < count; ++i) {
    const Argument a = draw(arguments);
    worst = std::max(worst, ErrorOf(function(a), reference(a)));
  }
  return worst;
}

// Expects errors of a function of one argument to stay below `limit` where arguments are drawn
// between two numbers and between two powers of 2.
template <typename Function, typename Reference>
void ExpectClose(Function function, Reference reference, double limit, double low, double high,
                 double least_power, double most_power, bool negative = true) {
  const auto f = [&](const Argument& a) { return function(a.x); };
  const auto g = [&](const Argument& a) { return reference(static_cast<long double>(a.x)); };
  EXPECT_LT(WorstError(f, g, [&](Arguments& a) { return Argument{a.Within(low, high)}; }), limit);
  EXPECT_LT(WorstError(f, g,
                       [&](Arguments& a) {
                         const double x = a.Sized(least_power, most_power);
                         return Argument{negative ? x : std::abs(x)};
                       }),
            limit);
}

TEST(FunctionsTest, SineCosineAndTangent) {
  const auto sine = [](long double x) { return std::sin(x); };
  const auto cosine = [](long double x) { return std::cos(x); };
  ExpectClose(Sin, sine, 0.85, -7.0, 7.0, -1074.0, 1024.0);
  ExpectClose(Cos, cosine, 0.85, -7.0, 7.0, -1074.0, 1024.0);
  ExpectClose(
      Tan, [](long double x) { return std::tan(x); }, 1.1, -7.0, 7.0, -1074.0, 1024.0);
  ExpectClose([](double x) { return SinCos(x).sin; }, sine, 0.85, -7.0, 7.0, -30.0, 25.0);
  ExpectClose([](double x) { return SinCos(x).cos; }, cosine, 0.85, -7.0, 7.0, -30.0, 25.0);
}

// Next to multiples of pi/2 all leading bits cancel.
TEST(FunctionsTest, AnglesNextToMultiplesOfTheRightAngle) {
  const auto draw = [](Arguments& a) {
    const double multiple = std::floor(a.Within(-1e5, 1e5)) * (std::numbers::pi / 2.0);
    return Argument{multiple * (1.0 + std::floor(a.Within(-4.0, 5.0)) * 0x1p-53)};
  };
  const auto wide = [](const Argument& a) { return static_cast<long double>(a.x); };
  EXPECT_LT(WorstError([](const Argument& a) { return Sin(a.x); },
                       [&](const Argument& a) { return std::sin(wide(a)); }, draw),
            0.85);
  EXPECT_LT(WorstError([](const Argument& a) { return Cos(a.x); },
                       [&](const Argument& a) { return std::cos(wide(a)); }, draw),
            0.85);
  // Of all doubles, this one comes closest to a multiple (Muller 2016, Elementary Functions,
  // section 11.1).
  const double closest = std::ldexp(6381956970095103.0, 797);
  EXPECT_NEAR(Cos(closest) * 0x1p61, -4.68716592425462761112e-19 * 0x1p61, 1e-15);
}

TEST(FunctionsTest, Arcs) {
  ExpectClose(
      Asin, [](long double x) { return std::asin(x); }, 0.75, -1.0, 1.0, -1074.0, 0.0);
  ExpectClose(
      Acos, [](long double x) { return std::acos(x); }, 0.75, -1.0, 1.0, -60.0, 0.0);
  ExpectClose(
      Atan, [](long double x) { return std::atan(x); }, 1.5, -3.0, 3.0, -1074.0, 1024.0);
  const auto f = [](const Argument& a) { return Atan2(a.y, a.x); };
  const auto g = [](const Argument& a) {
    return std::atan2(static_cast<long double>(a.y), static_cast<long double>(a.x));
  };
  EXPECT_LT(WorstError(f, g,
                       [](Arguments& a) {
                         return Argument{a.Within(-1, 1), a.Within(-1, 1)};
                       }),
            1.5);
  EXPECT_LT(WorstError(f, g,
                       [](Arguments& a) {
                         return Argument{a.Sized(-1074, 1024), a.Sized(-1074, 1024)};
                       }),
            1.5);
}

TEST(FunctionsTest, Exponentials) {
  ExpectClose(
      Exp, [](long double x) { return std::exp(x); }, 0.8, -745.5, 709.7, -70.0, 3.0);
  ExpectClose(
      Exp2, [](long double x) { return std::exp2(x); }, 0.8, -1075.0, 1023.9, -70.0, 3.0);
  ExpectClose(
      Expm1, [](long double x) { return std::expm1(x); }, 0.8, -3.0, 3.0, -1074.0, 9.4);
}

TEST(FunctionsTest, Logarithms) {
  const auto all = [](auto f, auto g) {
    ExpectClose(f, g, 0.52, 0.5, 2.0, -1074.0, 1024.0, false);
  };
  all(Log, [](long double x) { return std::log(x); });
  all(Log2, [](long double x) { return std::log2(x); });
  all(Log10, [](long double x) { return std::log10(x); });
  ExpectClose(
      Log1p, [](long double x) { return std::log1p(x); }, 0.52, -0.999, 2.0, -70.0, -0.01);
  for (int i = -1074; i < 1024; ++i) ASSERT_EQ(Log2(std::ldexp(1.0, i)), i);
  double power = 1.0;
  for (int i = 0; i <= 22; ++i, power *= 10.0) ASSERT_EQ(Log10(power), i);
}

TEST(FunctionsTest, Powers) {
  const auto f = [](const Argument& a) { return Pow(a.x, a.y); };
  const auto g = [](const Argument& a) {
    return std::pow(static_cast<long double>(a.x), static_cast<long double>(a.y));
  };
  const auto worst = [&](auto draw) { return WorstError(f, g, draw); };
  EXPECT_LT(worst([](Arguments& a) {
              return Argument{a.Within(0.001, 20), a.Within(-20, 20)};
            }),
            0.6);
  EXPECT_LT(worst([](Arguments& a) {
              return Argument{std::abs(a.Sized(-1074, 1024)), a.Sized(-12, 3)};
            }),
            0.8);
  EXPECT_LT(worst([](Arguments& a) {
              return Argument{1.0 + a.Sized(-40, -3), a.Sized(3, 12)};
            }),
            0.6);
  EXPECT_EQ(Pow(3.0, 7.0), 2187.0);
  EXPECT_EQ(Pow(10.0, -3.0), 0.001);
}

TEST(FunctionsTest, ExponentialIntegral) {
  Arguments arguments(3);
  double worst = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double x = std::abs(arguments.Sized(-30.0, 6.4));  // beyond 100 libstdc++ errs
    const long double right = -std::expint(-static_cast<long double>(x));
    worst = std::max(worst, static_cast<double>(std::abs(ExponentialIntegral(x) / right - 1.0L)));
  }
  EXPECT_LT(worst, 2e-15);
  EXPECT_EQ(ExponentialIntegral(0.0), kInfinity);
  EXPECT_TRUE(std::isnan(ExponentialIntegral(-1.0)));
}

TEST(FunctionsTest, ErrorFunctionAndHypotenuse) {
  ExpectClose(
      Erfc, [](long double x) { return std::erfc(x); }, 4.0, -6.0, 26.0, -60.0, 4.5);
  EXPECT_EQ(Hypot(3.0, -4.0), 5.0);
  EXPECT_EQ(Hypot(0.0, -0.25), 0.25);
}

std::uint64_t BitsOf(double x) { return std::bit_cast<std::uint64_t>(x); }

// All that C's annex F says of the arguments below, signs of zeros included.
TEST(FunctionsTest, EdgesAreAnsweredAsByTheLibrary) {
  const std::vector<double> edges = {0.0,    -0.0,    1.0,       -1.0,       0.5,    -0.5,  2.0,
                                     -2.0,   3.0,     -3.0,      1e300,      -1e300, kMost, -kMost,
                                     kLeast, -kLeast, kInfinity, -kInfinity, kNaN,   1e19,  -1e19};
  const auto same = [](double ours, double theirs) {
    if (std::isnan(theirs)) return std::isnan(ours);
    if (theirs == 0.0 || std::isinf(theirs)) return BitsOf(ours) == BitsOf(theirs);
    return std::abs(ours - theirs) <= 1e-15 * std::abs(theirs);
  };
  using One = double (*)(double);
  const std::vector<std::pair<One, One>> ones = {
      {Sin, std::sin},     {Cos, std::cos},     {Tan, std::tan},     {Asin, std::asin},
      {Acos, std::acos},   {Atan, std::atan},   {Exp, std::exp},     {Exp2, std::exp2},
      {Log, std::log},     {Expm1, std::expm1}, {Log1p, std::log1p}, {Log2, std::log2},
      {Log10, std::log10}, {Erfc, std::erfc}};
  for (std::size_t i = 0; i < ones.size(); ++i) {
    for (const double x : edges) {
      EXPECT_TRUE(same(ones[i].first(x), ones[i].second(x)))
          << "function " << i << " of " << x << ": " << ones[i].first(x);
    }
  }
  for (const double x : edges) {
    EXPECT_EQ(BitsOf(SinCos(x).sin), BitsOf(Sin(x)));
    EXPECT_EQ(BitsOf(SinCos(x).cos), BitsOf(Cos(x)));
    for (const double y : edges) {
      EXPECT_TRUE(same(Pow(x, y), std::pow(x, y))) << x << " to the " << y << ": " << Pow(x, y);
      EXPECT_TRUE(same(Atan2(x, y), std::atan2(x, y))) << x << " over " << y;
    }
  }
}

// The C library's functions fail this on processors without fused operations, or with them.
TEST(FunctionsTest, EveryProcessorGivesTheseBits) {
  Arguments arguments(1);
  std::uint64_t hash = 0;
  const auto add = [&](double value) { hash = (hash ^ BitsOf(value)) * 0x9e3779b97f4a7c15; };
  for (int i = 0; i < 3000; ++i) {
    const double x = arguments.Within(-20.0, 20.0);
    const double y = arguments.Within(-1.0, 1.0);
    for (const auto f : {Sin, Cos, Tan, Atan, Exp, Exp2, Expm1, Erfc}) add(f(x));
    for (const auto f : {Log, Log2, Log10, Log1p}) add(f(std::abs(x)));
    add(Asin(y));
    add(Acos(y));
    add(Atan2(y, x));
    add(Pow(std::abs(x), y));
    add(Hypot(x, y));
    add(ExponentialIntegral(std::abs(x)));
    add(Sin(x * 1e12));
  }
  EXPECT_EQ(hash, 0xab7d1dbe96c12180u);
}

}  // namespace
}  // namespace rockyard::math
