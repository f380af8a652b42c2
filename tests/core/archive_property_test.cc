// What is written reads back to the same bits, for random values of every kind.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "core/archive.h"
#include "core/json_text.h"
#include "core/random.h"
#include "core/test_params.h"
#include "core/units.h"

namespace rockyard::core {
namespace {

constexpr std::uint64_t kSeed = 77;
constexpr std::uint32_t kCases = 3000;

double AnyFinite(RandomStream& stream) {
  while (true) {
    const double value = std::bit_cast<double>(stream.NextU64());
    if (std::isfinite(value)) return value;
  }
}

std::string AnyText(RandomStream& stream) {
  std::string text;
  const std::uint64_t length = stream.NextU64() % 20;
  for (std::uint64_t i = 0; i < length; ++i) text += static_cast<char>(stream.NextU32() % 128);
  return text;
}

TestParams AnyParams(std::uint32_t number) {
  RandomStream s({kSeed, number}, Purpose::kTest);
  TestParams params;
  params.radius_m = SampleUniform(s, 0.01, 2.0);
  // Degrees of up to six decimals, as people write them.
  params.heading_rad = math::DegToRad(std::round(SampleUniform(s, -180.0, 180.0) * 1e6) / 1e6);
  params.count = static_cast<std::int64_t>(s.NextU64() % 1001);
  params.enabled = SampleBernoulli(s, 0.5);
  params.label = AnyText(s);
  params.weights.resize(s.NextU64() % 8);
  for (double& weight : params.weights) weight = SampleUniform(s, 0.0, 100.0);
  for (double& axis : params.axes_m) axis = s.Uniform();
  params.stripes.assign(s.NextU64() % 6, static_cast<std::int64_t>(s.NextU64() % 5));
  params.unbounded = AnyFinite(s);
  params.inner.low_m = SampleUniform(s, 0.0, 5.0);
  params.inner.high_m = SampleUniform(s, 5.0, 10.0);
  params.inner.colour = static_cast<Colour>(s.NextU64() % 3);
  return params;
}

TestParams RoundTrip(const TestParams& params) {
  TestParams read;
  ReadParams(ParseJson(DumpJson(WriteParams(params)), "round trip"), read);
  return read;
}

bool SameBits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

TEST(ArchivePropertyTest, WritingAndReadingKeepsEveryBit) {
  for (std::uint32_t i = 0; i < kCases; ++i) {
    const TestParams before = AnyParams(i);
    const TestParams after = RoundTrip(before);
    ASSERT_TRUE(SameBits(before.radius_m, after.radius_m)) << i;
    ASSERT_TRUE(SameBits(before.heading_rad, after.heading_rad)) << i;
    ASSERT_EQ(before.count, after.count) << i;
    ASSERT_EQ(before.enabled, after.enabled) << i;
    ASSERT_EQ(before.label, after.label) << i;
    ASSERT_EQ(before.weights, after.weights) << i;
    ASSERT_EQ(before.axes_m, after.axes_m) << i;
    ASSERT_EQ(before.stripes, after.stripes) << i;
    ASSERT_TRUE(SameBits(before.unbounded, after.unbounded)) << i;
    ASSERT_TRUE(SameBits(before.inner.low_m, after.inner.low_m)) << i;
    ASSERT_TRUE(SameBits(before.inner.high_m, after.inner.high_m)) << i;
    ASSERT_EQ(before.inner.colour, after.inner.colour) << i;
  }
}

TEST(ArchivePropertyTest, ExtremeDoublesKeepEveryBit) {
  using Limits = std::numeric_limits<double>;
  for (const double value : {0.0, -0.0, Limits::min(), Limits::denorm_min(), Limits::max(),
                             Limits::lowest(), Limits::epsilon(), 1e15, 1e16, 1e17, 1e22, 0.1}) {
    TestParams params;
    params.unbounded = value;
    EXPECT_TRUE(SameBits(RoundTrip(params).unbounded, value)) << value;
  }
}

TEST(ArchivePropertyTest, AnyAngleIsKeptToAnUlpAndFixedAfterOneTrip) {
  for (std::uint32_t i = 0; i < kCases; ++i) {
    RandomStream s({kSeed, i}, Purpose::kTest, 1);
    const double angle_rad = SampleUniform(s, -3.0, 3.0);
    const double once = math::DegToRad(ExactDegrees(angle_rad));
    ASSERT_LE(std::fabs(once - angle_rad), 4e-16 * std::fabs(angle_rad)) << i;
    ASSERT_TRUE(SameBits(math::DegToRad(ExactDegrees(once)), once)) << i;
  }
}

}  // namespace
}  // namespace rockyard::core
