// Labels of planetary images, and what a program without GDAL says: the same in every build.
#include "image_files/planetary.h"

#include <gmock/gmock.h>

#include <optional>
#include <string>

#include "image_files/pds_bytes.h"
#include "image_files/refusals.h"

namespace rockyard::image_files {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A stand-in for GDAL: a row of two pixels in three colours.
template <int bits>
Raster Colours(const std::filesystem::path& path, const char* driver, const ImageLimits&) {
  EXPECT_TRUE(path.is_absolute());
  EXPECT_STREQ(driver, "PDS");
  Raster raster;
  raster.bits = bits;
  raster.negative = 5;
  raster.planes.assign(3, SamplePlane(2, 1, 9));
  return raster;
}

RawImage Read(const std::string& label, RasterReader reader) {
  return ReadPlanetary("a.img", label, PlanetaryKind::kPds3, {}, {reader, ""});
}

TEST(Planetary, KindsAreKnownByTheirLabels) {
  EXPECT_EQ(PlanetaryKindOf(Pds3Bytes({})), PlanetaryKind::kPds3);
  EXPECT_EQ(PlanetaryKindOf("CCSD3ZF0000100000001NJPL3IF0PDS2\r\nODL_VERSION_ID = ODL3\r\n"),
            PlanetaryKind::kPds3);
  EXPECT_EQ(PlanetaryKindOf(VicarBytes({})), PlanetaryKind::kVicar);
  EXPECT_EQ(PlanetaryKindOf(Pds4Label({}, "a.img")), PlanetaryKind::kPds4);
  EXPECT_EQ(PlanetaryKindOf("\xef\xbb\xbf" + Pds4Label({}, "a.img")), PlanetaryKind::kPds4);
  EXPECT_EQ(PlanetaryKindOf("<svg xmlns=\"http://www.w3.org/2000/svg\"/>"), std::nullopt);
  EXPECT_EQ(PlanetaryKindOf("a text about http://pds.nasa.gov/pds4/"), std::nullopt);
  EXPECT_EQ(PlanetaryKindOf(std::string(2000, ' ') + "PDS_VERSION_ID"), std::nullopt);
  EXPECT_EQ(PlanetaryKindOf(""), std::nullopt);
}

TEST(Planetary, TheBitMaskOfTheLabel) {
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK                 = 2#0000111111111111#"), 4095);
  EXPECT_EQ(SampleBitMask("x SAMPLE_BIT_MASK='2#0000000011111111#'  y"), 255);
  EXPECT_EQ(SampleBitMask("<img:sample_bit_mask>2#0000111111111111</img:sample_bit_mask>"), 4095);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = 16#0FFF#"), 4095);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = 2047"), 2047);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = 2#1111111111111111#"), 65535);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = 2#11111111111111111#"), std::nullopt);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = 2#0#"), std::nullopt);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = 17#1#"), std::nullopt);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = 1#1#"), std::nullopt);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = N/A"), std::nullopt);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK"), std::nullopt);
  EXPECT_EQ(SampleBitMask("SAMPLE_BITS = 16"), std::nullopt);
}

TEST(Planetary, FullScaleIsThatOfTheMaskWhereItFits) {
  const RawImage masked = Read("SAMPLE_BIT_MASK = 2#111111111111#", Colours<15>);
  EXPECT_EQ(masked.format, "PDS3");
  EXPECT_EQ(masked.bits, 12);
  EXPECT_EQ(masked.full_scale, 4095);
  EXPECT_THAT(masked.full_scale_from, HasSubstr("SAMPLE_BIT_MASK of the label"));
  EXPECT_EQ(masked.negative, 5);
  EXPECT_EQ(masked.planes.size(), 3U);
  EXPECT_THAT(masked.planes[2].values(), ElementsAre(9, 9));
  const RawImage plain = Read("no mask", Colours<15>);
  EXPECT_EQ(plain.full_scale, 32767);
  EXPECT_EQ(plain.bits, 15);
  EXPECT_THAT(plain.full_scale_from, HasSubstr("the label has no SAMPLE_BIT_MASK"));
  EXPECT_EQ(Read("SAMPLE_BIT_MASK = 2#111111111#", Colours<8>).full_scale, 255)
      << "a mask of more bits than samples have";
  EXPECT_EQ(Read("SAMPLE_BIT_MASK = 255", Colours<8>).full_scale, 255);
}

TEST(Planetary, WithoutGdalTheRemedyIsNamed) {
  for (const PlanetaryKind kind :
       {PlanetaryKind::kPds3, PlanetaryKind::kPds4, PlanetaryKind::kVicar}) {
    const core::Problem problem = RefusalOf([&] {
      ReadPlanetary("a.img", "", kind, {}, {nullptr, "get it"});
    });
    EXPECT_EQ(problem.path, "a.img");
    EXPECT_EQ(problem.reason, std::string("is a ") + NameOf(kind) +
                                  " image, which this rockyard cannot read without GDAL");
    EXPECT_EQ(problem.suggestion, "get it");
  }
  const RasterSupport gdal = FindGdal();
  if (gdal.reader == nullptr) {
    EXPECT_THAT(gdal.remedy, HasSubstr("libgdal"));
  } else {
    EXPECT_EQ(gdal.remedy, "");
  }
}

}  // namespace
}  // namespace rockyard::image_files
