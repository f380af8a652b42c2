// The whole imager of stripes, and where light and shadow fall in its images.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "core/archive.h"
#include "core/hash.h"
#include "core/json_text.h"
#include "core/random.h"
#include "image_kit.h"
#include "vision/lens.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;

// The whole imager: exposure control, saturation, choices of imager, repeatability, bad parameters.

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

// Where light and shadow fall in the image.

// Point of flat ground in the light plane of a laser whose image lies on a line.
Vector3 StripeOnLine(const LineView& line, const messages::StripeLaser& fan, int row_px) {
  const messages::Camera& camera = line.Camera(fan.camera);
  const Vector3 along(fan.normal_R.y(), -fan.normal_R.x(), 0.0);
  double near = 0.05, far = 2.0;
  Vector3 point;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (near + far);
    point = Vector3(fan.p_RoE_R.x(), fan.p_RoE_R.y(), 0.0) + middle * along;
    const auto pixel = vision::Project(camera, camera.X_RC.inverse() * point);
    (!pixel || pixel->row_px > row_px ? near : far) = middle;
  }
  return point;
}

// Column, counted from the first one, about which a line's light lies.
double Centroid(const std::vector<double>& rates) {
  double sum = 0.0, moment = 0.0;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    sum += rates[i];
    moment += rates[i] * static_cast<double>(i);
  }
  EXPECT_GT(sum, 0.0);
  return moment / sum;
}

// Centroid of a stripe on a line of flat ground, against the projection of the point.
TEST(StripeImage, LiesWhereTheLightPlaneMeetsTheGround) {
  for (const auto lens :
       {messages::Lens::kEquidistantRows, messages::Lens::kEquidistant, messages::Lens::kPinhole}) {
    LightStripeParams params = QuietParams();
    params.lens = lens;
    // A stripe narrower than a pixel has a centroid that leans towards the pixel's middle.
    params.laser.beam_width_rad = 0.006;
    if (lens == messages::Lens::kPinhole) params.focal_length_m = 0.003;
    const LineView line{params, Darkness()};
    for (std::size_t laser = 0; laser < line.calibration.lasers.size(); ++laser) {
      const messages::StripeLaser& fan = line.calibration.lasers[laser];
      for (const int row_px : line.calibration.scanline_px) {
        const auto rates =
            LampRates(line.Render(FlatWith({}), PoseAt(2.0, -1.0, 0.0, 0.7), fan.camera, row_px),
                      static_cast<int>(laser));
        const messages::Camera& camera = line.Camera(fan.camera);
        const auto pixel =
            vision::Project(camera, camera.X_RC.inverse() * StripeOnLine(line, fan, row_px));
        ASSERT_TRUE(pixel.has_value());
        // What is left is the perspective across a stripe of some pixels.
        EXPECT_NEAR(Centroid(rates) - 384.0, pixel->column_px, 0.02) << laser << " " << row_px;
      }
    }
  }
}

// A surface that is higher shifts the stripe by the parallax of the baseline.
TEST(StripeImage, ShiftsWithElevation) {
  const LineView line{QuietParams(), Darkness()};
  const int row_px = line.calibration.scanline_px[1];
  const auto centre = [&](double drop_m) {
    return Centroid(LampRates(line.Render(FlatWith({}), PoseAt(0, 0, drop_m), 0, row_px), 2));
  };
  // Depth s in the scanline plane, baseline b: the column angle is atan(b / s).
  const messages::Camera& camera = line.Camera(0);
  const double depression = line.params.camera_pitch_rad + row_px * camera.row_pitch_rad;
  const auto column = [&](double height) {
    return std::atan(0.06 / (height / std::sin(depression))) / camera.column_pitch_rad;
  };
  EXPECT_NEAR(centre(-0.05) - centre(0.0), column(0.20) - column(0.25), 0.05);
  EXPECT_GT(centre(-0.05) - centre(0.0), 5.0);
}

// With the sun behind it, the rover's shadow ends where the front edge of its panel throws it.
TEST(RoverBody, CastsAShadow) {
  const SunParams sun{.elevation_rad = math::DegToRad(60.0), .azimuth_rad = math::DegToRad(180.0)};
  const rendering::SunLight light = rendering::MakeSunLight(sun, 40e-9);
  const rendering::RoverBody body = MakeRoverBody(rover::RoverGeometryParams{});
  const terrain::Terrain terrain = FlatWith({});
  const rendering::ImageScene scene(terrain, PoseAt(0, 0, 0), light, sun, body, 4.0);
  const double end_m = 0.325 + 0.30 / std::tan(sun.elevation_rad);
  for (const double beyond_m : {-0.005, 0.005}) {
    rendering::SurfacePoint point = scene.Meet(Vector3(end_m + beyond_m, 0.1, 0.1),
                                               -Vector3::UnitZ(), rendering::RoverBody::kFree, {});
    scene.Light({}, point);
    EXPECT_NEAR(point.radiance_w_m2_sr,
                rendering::SunRadiance(light, sun.ground_albedo, Vector3::UnitZ(), beyond_m > 0.0),
                1e-12);
  }
}

// A rock between an outer emitter and its stripe takes the light away, though the camera sees the
// ground beyond.
TEST(StripeImage, RockHidesTheEmitter) {
  const LineView line{QuietParams(), Darkness()};
  const messages::StripeLaser& fan = line.calibration.lasers[0];
  const int row_px = line.calibration.scanline_px[3];
  const Vector3 target = StripeOnLine(line, fan, row_px);
  const Vector3 between = fan.p_RoE_R + 0.6 * (target - fan.p_RoE_R);
  const terrain::Rock rock = EllipsoidRock(between.x(), between.y(), between.z(), 0.02, 0.02, 0.02);
  const auto lit_pixels = [&](const terrain::Terrain& terrain) {
    const auto rates = LampRates(line.Render(terrain, PoseAt(0, 0, 0), 0, row_px), 0);
    const auto pixel = vision::Project(line.Camera(0), line.Camera(0).X_RC.inverse() * target);
    const auto middle = static_cast<std::size_t>(std::lround(pixel->column_px) + 384);
    return rates[middle - 1] + rates[middle] + rates[middle + 1];
  };
  EXPECT_EQ(lit_pixels(FlatWith({rock})), 0.0);
  EXPECT_GT(lit_pixels(FlatWith({})), 0.0);
  // The camera still sees that ground.
  const Vector3 eye = line.Camera(0).X_RC.translation();
  EXPECT_FALSE(FlatWith({rock}).Occluded(eye, target, 0.001));
}

TEST(RoverBody, DistancesToItsParts) {
  const rover::RoverGeometryParams geometry;  // panel at 0.275 .. 0.30 m, wheels of 6.5 cm radius
  const rendering::RoverBody body = MakeRoverBody(geometry);
  EXPECT_NEAR(body.Distance({0.3, 0.0, 1.0}, -Vector3::UnitZ()), 0.7, 1e-12);
  EXPECT_NEAR(body.Normal({0.3, 0.0, 1.0}, -Vector3::UnitZ()).z(), 1.0, 1e-12);
  EXPECT_NEAR(body.Distance({0.3, 0.0, 0.2}, Vector3::UnitZ()), 0.075, 1e-12);
  // Front left wheel: centre at x = 0.26, y = 0.20, z = 0.065.
  EXPECT_NEAR(body.Distance({1.0, 0.2, 0.065}, -Vector3::UnitX()), 1.0 - 0.325, 1e-12);
  EXPECT_NEAR(body.Distance({0.26, 1.0, 0.065}, -Vector3::UnitY()), 0.76, 1e-12);
  EXPECT_EQ(body.Distance({1.0, 0.0, 0.05}, Vector3::UnitX()), rendering::RoverBody::kFree);
  // Out of a part that holds the origin.
  EXPECT_EQ(body.Distance({0.3, 0.0, 0.29}, Vector3::UnitX()), rendering::RoverBody::kFree);
}

// The default layout loses none of its scanlines to the rover's own parts, and no emitter is hidden
// from any point that it measures; a camera lower and further back does lose some.
TEST(RoverBody, LeavesTheDefaultLayoutFree) {
  const auto hidden_edges = [](const LightStripeParams& params) {
    const LineView line{params, Darkness()};
    int hidden = 0;
    for (int camera = 0; camera < 2; ++camera) {
      for (const int row_px : line.calibration.scanline_px) {
        for (const double distance_m : line.View(camera, row_px).body_m) {
          hidden += distance_m < rendering::RoverBody::kFree ? 1 : 0;
        }
      }
    }
    return hidden;
  };
  EXPECT_EQ(hidden_edges(LightStripeParams{}), 0);
  LightStripeParams low{.camera_x_m = 0.22, .camera_height_m = 0.17};
  EXPECT_GT(hidden_edges(low), 0);

  const LineView line{LightStripeParams{}, Darkness()};
  for (const messages::StripeLaser& fan : line.calibration.lasers) {
    for (const int row_px : line.calibration.scanline_px) {
      const Vector3 away = StripeOnLine(line, fan, row_px) - fan.p_RoE_R;
      EXPECT_EQ(line.body.Distance(fan.p_RoE_R, away.normalized()), rendering::RoverBody::kFree);
    }
  }
}

}  // namespace
}  // namespace rockyard::sensing
