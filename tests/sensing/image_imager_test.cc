// The whole imager: exposure control, saturation, choices of imager, repeatability, bad parameters.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "core/archive.h"
#include "core/hash.h"
#include "core/json_text.h"
#include "core/random.h"
#include "image_kit.h"

namespace rockyard::sensing {
namespace {

constexpr core::TrialKey kKey{2, 9};

terrain::Terrain OneRock() { return FlatWith({EllipsoidRock(0.62, 0.05, 0.01, 0.1, 0.08, 0.07)}); }

StripeImager Make(const LightStripeParams& params, const SunParams& sun = {}) {
  return {params, sun, rover::RoverGeometryParams{}};
}

std::uint64_t HashOf(const messages::StripeImages& images) {
  core::Hasher hash;
  hash.Real(images.exposure_s).Real(images.electrons_per_count);
  for (const messages::StripeExposure& exposure : images.exposures) {
    hash.Integer(static_cast<std::uint64_t>(exposure.camera));
    hash.Integer(static_cast<std::uint64_t>(exposure.group));
    for (const auto* bands : {&exposure.lit, &exposure.dark}) {
      for (const messages::ImageBand& band : *bands) {
        for (const std::uint16_t count : band.counts) hash.Integer(count);
      }
    }
  }
  return hash.value();
}

TEST(StripeImager, ExposesTheDarkImageToTheTarget) {
  for (const double elevation_deg : {15.0, 60.0}) {
    const SunParams sun{.elevation_rad = math::DegToRad(elevation_deg)};
    const auto images = Make(QuietParams(), sun).Expose(FlatWith({}), PoseAt(0, 0, 0), kKey, 0);
    std::vector<std::uint16_t> counts;
    for (const messages::ImageBand& band : images.exposures[0].dark) {
      counts.insert(counts.end(), band.counts.begin(), band.counts.end());
    }
    const auto nth = counts.begin() + static_cast<std::ptrdiff_t>(0.99 * double(counts.size()));
    std::nth_element(counts.begin(), nth, counts.end());
    // 0.4 of the span above the black level; metering looks at one pixel in 40.
    EXPECT_NEAR((*nth / 65535.0 - 0.02) / 0.98, 0.4, 0.01) << elevation_deg;
  }
}

TEST(StripeImager, StripesStandOutOfTheDifference) {
  const auto images = Make(QuietParams()).Expose(FlatWith({}), PoseAt(0, 0, 0), kKey, 0);
  ASSERT_EQ(images.exposures.size(), 5U);  // groups {0, 3}, {1, 4}, {2}; stripe 2 is the left's
  for (const messages::StripeExposure& exposure : images.exposures) {
    for (std::size_t band = 0; band < 4; ++band) {
      const messages::ImageBand& lit = exposure.lit[band];
      const int row = lit.first_row + lit.rows / 2;
      int bright = 0;
      for (int column = -384; column < 384; ++column) {
        bright += lit.At(row, column) - exposure.dark[band].At(row, column) > 10000 ? 1 : 0;
      }
      EXPECT_GE(bright, exposure.group == 2 ? 1 : 2);
      EXPECT_LE(bright, 12);
    }
  }
}

TEST(StripeImager, SaturatesAtTheLargestCount) {
  LightStripeParams params;
  params.laser.input_power_w = 20.0;
  params.imager.ccd.adc_bits = 8;
  const auto images = Make(params).Expose(FlatWith({}), PoseAt(0, 0, 0), kKey, 0);
  std::uint16_t largest = 0;
  int at_largest = 0;
  for (const messages::ImageBand& band : images.exposures[0].lit) {
    for (const std::uint16_t count : band.counts) {
      largest = std::max(largest, count);
      at_largest += count == 255 ? 1 : 0;
    }
  }
  EXPECT_EQ(largest, 255);
  EXPECT_GT(at_largest, 20);
  EXPECT_NEAR(images.electrons_per_count * (255.0 - 0.02 * 255.0), 60000.0, 1e-9);
}

TEST(StripeImager, DarknessLeavesTheBlackLevel) {
  LightStripeParams params = QuietParams();
  const auto images = Make(params, Darkness()).Expose(OneRock(), PoseAt(0, 0, 0), kKey, 0);
  EXPECT_EQ(images.exposure_s, params.imager.exposure.longest_s);
  for (const messages::ImageBand& band : images.exposures[0].dark) {
    for (const std::uint16_t count : band.counts) ASSERT_EQ(count, 1311);  // 0.02 x 65535
  }
}

TEST(StripeImager, CmosImagerIsAnotherImager) {
  LightStripeParams ccd = QuietParams();
  LightStripeParams cmos = ccd;
  cmos.imager.kind = rendering::ImagerKind::kCmos;
  const auto a = Make(ccd).Expose(OneRock(), PoseAt(0, 0, 0), kKey, 0);
  const auto b = Make(cmos).Expose(OneRock(), PoseAt(0, 0, 0), kKey, 0);
  EXPECT_NEAR(b.electrons_per_count, 80000.0 / (255.0 * 0.98), 1e-9);
  // Target electrons over quantum efficiency times fill factor: 60000 / 0.06 and 80000 / 0.075,
  // but for the dark current.
  EXPECT_NEAR(b.exposure_s / a.exposure_s, (80000.0 / 0.075) / (60000.0 / 0.06), 0.01);
}

TEST(StripeImager, AllLasersAtOnceMakeOneGroup) {
  LightStripeParams params = QuietParams();
  params.lasers_per_image = 5;
  const auto images = Make(params).Expose(FlatWith({}), PoseAt(0, 0, 0), kKey, 0);
  ASSERT_EQ(images.exposures.size(), 2U);
  for (const messages::StripeExposure& exposure : images.exposures) {
    const messages::ImageBand& lit = exposure.lit[1];
    const messages::ImageBand& dark = exposure.dark[1];
    const int row = lit.first_row + lit.rows / 2;
    int stripes = 0;
    bool was_bright = false;
    for (int column = -384; column < 384; ++column) {
      const bool bright = lit.At(row, column) - dark.At(row, column) > 10000;
      stripes += bright && !was_bright ? 1 : 0;
      was_bright = bright;
    }
    EXPECT_EQ(stripes, 5);
  }
}

TEST(StripeImager, DenserArraysHaveMoreBands) {
  LightStripeParams params{.row_subdivision = 2, .stripe_subdivision = 2};
  const auto images = Make(params).Expose(FlatWith({}), PoseAt(0, 0, 0), kKey, 0);
  for (const messages::StripeExposure& exposure : images.exposures) {
    EXPECT_EQ(exposure.lit.size(), 7U);
  }
}

TEST(StripeImager, IsAPureFunction) {
  const StripeImager imager = Make(LightStripeParams{});
  const terrain::Terrain terrain = OneRock();
  const math::Transform X_WR = PoseAt(0.02, 0.01, 0.0, 0.05);
  const auto hash = [&](std::int64_t scan) {
    return HashOf(imager.Expose(terrain, X_WR, kKey, scan));
  };
  const std::uint64_t third = hash(3);
  EXPECT_NE(hash(4), third);
  std::vector<std::uint64_t> hashes(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < hashes.size(); ++i) {
    threads.emplace_back([&, i] { hashes[i] = hash(static_cast<std::int64_t>(i)); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(hashes[3], third);
  for (std::size_t i = 0; i < hashes.size(); ++i) {
    EXPECT_EQ(hashes[i], hash(static_cast<std::int64_t>(i)));
  }
  EXPECT_EQ(HashOf(Make(LightStripeParams{}).Expose(terrain, X_WR, kKey, 3)), third);
  EXPECT_NE(HashOf(imager.Expose(terrain, X_WR, {kKey.seed, kKey.trial + 1}, 3)), third);
}

// A rock far behind the rover or beyond sight changes nothing.
TEST(StripeImager, FarRocksChangeNothing) {
  const StripeImager imager = Make(LightStripeParams{});
  const auto hash = [&](std::vector<terrain::Rock> rocks) {
    rocks.push_back(EllipsoidRock(0.62, 0.05, 0.01, 0.1, 0.08, 0.07));
    return HashOf(imager.Expose(FlatWith(std::move(rocks)), PoseAt(0, 0, 0), kKey, 0));
  };
  EXPECT_EQ(hash({EllipsoidRock(-3.0, 0.0, 0.0, 0.2, 0.2, 0.2)}), hash({}));
  EXPECT_NE(hash({EllipsoidRock(0.55, -0.1, 0.0, 0.05, 0.05, 0.05)}), hash({}));
}

// Four metres are enough for the default; rows farther away take more.
TEST(StripeImager, SeesRocksAtTheFarthestRow) {
  LightStripeParams params = QuietParams();
  EXPECT_EQ(SightOf(params), 4.0);
  params.row_ahead_m = {3.0, 3.6, 4.3, 5.0};
  params.camera_pitch_rad = math::DegToRad(3.0);
  params.max_range_m = 6.0;
  EXPECT_GT(SightOf(params), 5.0 + 0.325);
  for (const BeamFan fan : {BeamFan::kFull, BeamFan::kThreeScanlines}) {
    params.laser.fan = fan;
    const StripeImager imager = Make(params);
    const auto expose = [&](std::vector<terrain::Rock> rocks) {
      return imager.Expose(FlatWith(std::move(rocks)), PoseAt(0, 0, 0), kKey, 0);
    };
    EXPECT_NE(HashOf(expose({EllipsoidRock(5.2, 0.0, 0.0, 0.2, 0.2, 0.2)})), HashOf(expose({})));
  }
  const messages::StripeCalibration calibration = TrueCalibration(params);
  const auto far_R = StripePoint(calibration, calibration.lasers[2], calibration.scanline_px[3]);
  ASSERT_TRUE(far_R);
  EXPECT_NEAR(far_R->x(), 5.325, 0.2);  // a row is 16 cm long there
}

// Whatever the pose: tilted, buried, in a rock, before a wall.
TEST(StripeImage, LightIsFiniteInAnyPose) {
  core::RandomStream stream({4, 0}, core::Purpose::kTest);
  std::vector<terrain::Rock> rocks;
  for (int i = 0; i < 40; ++i) {
    const double radius = core::SampleUniform(stream, 0.02, 0.4);
    const double x = core::SampleUniform(stream, -2.0, 2.0);
    const double y = core::SampleUniform(stream, -2.0, 2.0);
    rocks.push_back(EllipsoidRock(x, y, 0.1 * radius, radius, 0.7 * radius, 0.5 * radius));
  }
  const std::vector<terrain::Wall> walls{{math::Vector3::UnitX(), 0.8}};
  const terrain::Terrain flat = FlatWith(rocks, walls);
  terrain::GroundParams rough{.roughness_rms_m = 0.02};
  const terrain::Terrain hilly(terrain::Ground(rough, {4, 0}), rocks, walls);
  for (int i = 0; i < 60; ++i) {
    LineView line{LightStripeParams{}, SunParams{}};
    line.sun.elevation_rad = core::SampleUniform(stream, 0.0, math::DegToRad(90.0));
    line.params.lens = i % 2 == 0 ? messages::Lens::kEquidistant : messages::Lens::kEquidistantRows;
    line.params.laser.fan = i % 3 == 0 ? BeamFan::kThreeScanlines : BeamFan::kFull;
    line.calibration = TrueCalibration(line.params);
    math::Transform X_WR =
        PoseAt(core::SampleUniform(stream, -2.0, 0.7), core::SampleUniform(stream, -2.0, 2.0),
               core::SampleUniform(stream, -0.3, 0.5), core::SampleUniform(stream, -3.0, 3.0));
    X_WR.rotate(Eigen::AngleAxisd(core::SampleUniform(stream, -0.8, 0.8),
                                  math::Vector3(1.0, stream.Uniform(), 0.0).normalized()));
    const int row_px = static_cast<int>(core::SampleUniform(stream, -242.0, 241.0));
    const RenderedRow row = line.Render(i % 4 == 0 ? hilly : flat, X_WR, i % 2, row_px);
    for (const double rate : row.sun_e_s) ASSERT_TRUE(std::isfinite(rate) && rate >= 0.0) << i;
    for (const auto& laser : row.lamps) {
      ASSERT_TRUE(std::isfinite(laser.rate_e_s) && laser.rate_e_s >= 0.0) << i;
    }
  }
}

TEST(ImageParams, BadDescriptionsAreRefused) {
  ExpectRefused(R"({"laser": {"input_power_w": -0.66}})", "laser.input_power_w");
  ExpectRefused(R"({"laser": {"optical_efficiency": 0}})", "laser.optical_efficiency");
  ExpectRefused(R"({"laser": {"beam_width_rad": 0}})", "laser.beam_width_rad");
  ExpectRefused(R"({"laser": {"fan": "two_scanlines"}})", "laser.fan");
  ExpectRefused(R"({"imager": {"filter_width_m": 0}})", "imager.filter_width_m");
  ExpectRefused(R"({"imager": {"filter_transmission": 1.1}})", "imager.filter_transmission");
  ExpectRefused(R"({"imager": {"f_number": 0}})", "imager.f_number");
  ExpectRefused(R"({"imager": {"blur_px": -0.1}})", "imager.blur_px");
  ExpectRefused(R"({"imager": {"averaging_rows": 4}})", "imager.averaging_rows");
  ExpectRefused(R"({"imager": {"ccd": {"quantum_efficiency": 0}}})", "ccd.quantum_efficiency");
  ExpectRefused(R"({"imager": {"ccd": {"full_well_e": -1}}})", "ccd.full_well_e");
  ExpectRefused(R"({"imager": {"ccd": {"adc_bits": 0}}})", "ccd.adc_bits");
  ExpectRefused(R"({"imager": {"cmos": {"read_noise_e": -1}}})", "cmos.read_noise_e");
  ExpectRefused(R"({"imager": {"exposure": {"longest_s": 1e-5}}})", "exposure.longest_s");
  ExpectRefused(R"({"camera_separation_m": 0.011})", "camera_separation_m");
  // The geometric sensor reads no lines, and pictures of it what of them there is.
  ExpectRefused(R"({"fidelity": "image", "imager": {"margin_rows": 200}})", "fidelity");
  LightStripeParams geometric;
  core::ReadParams(core::ParseJson(R"({"imager": {"margin_rows": 200}})", "test"), geometric);
  EXPECT_EQ(geometric.imager.margin_rows, 200);
}

}  // namespace
}  // namespace rockyard::sensing
