#include "campaign/site/rock_catalogue.h"

#include <gmock/gmock.h>

#include "campaign/site/site_files.h"

namespace rockyard::campaign {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Optional;

class RockCatalogueTest : public SiteTest {
 protected:
  RockCatalogue Read(const std::string& text, const std::string& columns = "",
                     bool needs_places = true) const {
    return ReadCatalogue(
        {.file = Write("rocks.csv", text), .columns = columns, .needs_places = needs_places});
  }
  std::vector<core::Problem> Problems(const std::string& text,
                                      const std::string& columns = "") const {
    return ProblemsOf([&] { Read(text, columns); });
  }
};

TEST_F(RockCatalogueTest, OurOwnNames) {
  const RockCatalogue found = Read(
      "x_m,y_m,diameter_m,height_m,burial,yaw_deg\n1,2,0.5,0.25,0.4,30\n-3,4.5,1e-1,,perched,\n");
  EXPECT_TRUE(found.placed);
  EXPECT_FALSE(found.geographic);
  ASSERT_EQ(found.rocks.size(), 2U);
  const CatalogueRock& first = found.rocks[0];
  EXPECT_EQ(first.x, 1.0);
  EXPECT_EQ(first.y, 2.0);
  EXPECT_EQ(first.diameter_m, 0.5);
  EXPECT_THAT(first.height_m, Optional(0.25));
  EXPECT_THAT(first.buried_share, Optional(0.4));
  EXPECT_THAT(first.yaw_deg, Optional(30.0));
  EXPECT_EQ(found.rocks[1].x, -3.0);
  EXPECT_FALSE(found.rocks[1].height_m.has_value());
  EXPECT_FALSE(found.rocks[1].yaw_deg.has_value());
  EXPECT_THAT(found.rocks[1].buried_share, Optional(0.0));
  EXPECT_THAT(found.notes, ElementsAre(HasSubstr("assumed")));
}

TEST_F(RockCatalogueTest, UnitsOfNames) {
  for (const char* header :
       {"East_m,North_m,D_cm", "east (m);north (m);Diameter [cm]", "x_cm\ty_mm\td_mm"}) {
    const std::string text = std::string(header) + "\n";
    const char delimiter = text.find(';') != std::string::npos    ? ';'
                           : text.find('\t') != std::string::npos ? '\t'
                                                                  : ',';
    const RockCatalogue found =
        Read(delimiter == '\t' ? text + "100\t2000\t300\n"
                               : text + "1" + delimiter + "2" + delimiter + "30\r\n");
    EXPECT_THAT(found.rocks[0].x, DoubleEq(1.0)) << header;
    EXPECT_THAT(found.rocks[0].y, DoubleEq(2.0)) << header;
    EXPECT_THAT(found.rocks[0].diameter_m, DoubleEq(0.3)) << header;
  }
}

TEST_F(RockCatalogueTest, DeclaredColumns) {
  const RockCatalogue found =
      Read("id,A,B,\"C, of it\",D\n\"one, two\",1,2,7,90\n", "x=A,y=B,diameter=D:mm");
  EXPECT_EQ(found.rocks[0].x, 1.0);
  EXPECT_THAT(found.rocks[0].diameter_m, DoubleEq(0.09));
}

// As PDS .TAB files are: no header, blanks between.
TEST_F(RockCatalogueTest, ColumnsByNumber) {
  const std::string text = "# made by hand\n  7  1.5   -2.5  40 20\n  8  0 0  25 20\n";
  const RockCatalogue found = Read(text, "x=2,y=3,length=4:cm,width=5:cm");
  ASSERT_EQ(found.rocks.size(), 2U);
  EXPECT_EQ(found.rocks[0].y, -2.5);
  EXPECT_THAT(found.rocks[0].diameter_m, DoubleEq(0.4));
  EXPECT_THAT(found.rocks[0].width_ratio, Optional(DoubleEq(0.5)));
}

TEST_F(RockCatalogueTest, LengthAndWidthInEitherOrder) {
  const RockCatalogue found = Read("x,y,length,width\n0,0,0.2,0.5\n0,0,0.5,0.01\n");
  EXPECT_EQ(found.rocks[0].diameter_m, 0.5);
  EXPECT_THAT(found.rocks[0].width_ratio, Optional(DoubleEq(0.4)));
  EXPECT_THAT(found.rocks[1].width_ratio, Optional(DoubleEq(0.2))) << "the narrowest";
}

TEST_F(RockCatalogueTest, GeoJson) {
  const RockCatalogue found = Read(R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "geometry": {"type": "Point", "coordinates": [137.4, -4.6]},
     "properties": {"diameter_cm": 40, "burial": "Partially buried"}},
    {"type": "Feature", "geometry": {"type": "Point", "coordinates": [137.5, -4.5, 7]},
     "properties": {"height_m": 0.1, "diameter_cm": "20"}}]})");
  EXPECT_TRUE(found.geographic);
  ASSERT_EQ(found.rocks.size(), 2U);
  EXPECT_EQ(found.rocks[0].x, 137.4);
  EXPECT_EQ(found.rocks[0].y, -4.6);
  EXPECT_THAT(found.rocks[0].diameter_m, DoubleEq(0.4));
  EXPECT_THAT(found.rocks[0].buried_share, Optional(DoubleEq(1.0 / 3.0)));
  EXPECT_THAT(found.rocks[1].diameter_m, DoubleEq(0.2));
  EXPECT_THAT(found.rocks[1].height_m, Optional(0.1));
}

TEST_F(RockCatalogueTest, GeoJsonWithPlacesAmongItsProperties) {
  const RockCatalogue found = Read(R"({"features": [
    {"geometry": null, "properties": {"E": 1, "N": 2, "d": 0.3}}]})",
                                   "x=E,y=N");
  EXPECT_FALSE(found.geographic);
  EXPECT_EQ(found.rocks[0].y, 2.0);
}

TEST_F(RockCatalogueTest, EveryWrongLineIsTold) {
  const auto problems = Problems("x,y,d\n1,2,0.3\n1,oops,0.3\n\n1,2\n1,2,-4\n1,2,nan\n1,2,1e9\n");
  ASSERT_EQ(problems.size(), 5U);
  EXPECT_THAT(problems[0].path, HasSubstr("rocks.csv: line 3"));
  EXPECT_THAT(problems[0].reason, HasSubstr("\"oops\" is no number for y"));
  EXPECT_THAT(problems[1].path, HasSubstr("line 5"));
  EXPECT_THAT(problems[1].reason, HasSubstr("has 2 columns"));
  EXPECT_THAT(problems[2].reason, HasSubstr("diameter is -4 m"));
  EXPECT_THAT(problems[3].path, HasSubstr("line 7"));
  EXPECT_THAT(problems[4].reason, HasSubstr("1e+09"));
  std::string many = "x,y,d\n";
  for (int i = 0; i < 100; ++i) many += "a,b,c\n";
  EXPECT_EQ(Problems(many).size(), 20U);
}

TEST_F(RockCatalogueTest, WrongColumnsAreTold) {
  EXPECT_THAT(Problems("a,b\n1,2\n")[0].reason, HasSubstr("no column of diameters"));
  EXPECT_THAT(Problems("x,d\n1,2\n")[0].reason, HasSubstr("half of its places"));
  EXPECT_THAT(Problems("d\n1\n")[0].reason, HasSubstr("where its rocks lie"));
  EXPECT_EQ(Read("d\n1\n", "", false).rocks.size(), 1U);
  EXPECT_THAT(Problems("x,y,d_px\n1,2,3\n")[0].reason, HasSubstr("is in px"));
  EXPECT_THAT(Problems("x,y,D\n1,2,3\n", "diameter=D:px")[0].suggestion, HasSubstr("pixels"));
  EXPECT_THAT(Problems("x,y,Size\n1,2,3\n", "diameter=Sise")[0].suggestion, HasSubstr("\"Size\""));
  EXPECT_THAT(Problems("x,y,d\n1,2,3\n", "girth=d")[0].suggestion, HasSubstr("diameter"));
  EXPECT_THAT(Problems("x,y,d\n1,2,3\n", "d")[0].path, "--columns");
  EXPECT_THAT(Problems("1 2 3\n", "x=1,y=2,diameter=4")[0].reason, HasSubstr("column 4"));
  EXPECT_THAT(Problems("x,y,d,burial\n1,2,3,half\n")[0].reason, HasSubstr("no burial"));
}

TEST_F(RockCatalogueTest, WhatIsNoCatalogueIsRefused) {
  EXPECT_THAT(Problems("")[0].reason, HasSubstr("is empty"));
  EXPECT_THAT(Problems("x,y,d\n")[0].reason, HasSubstr("has no rocks"));
  EXPECT_THAT(Problems("{\"type\": \"Point\"}")[0].reason, HasSubstr("no FeatureCollection"));
  EXPECT_THAT(Problems(R"({"features": [{"geometry": {"type": "LineString"},
                          "properties": {"d": 1}}]})")[0]
                  .path,
              HasSubstr("features[0]"));
  EXPECT_THAT(Problems("x,y,d\n1,2,\xff\n")[0].reason, HasSubstr("UTF-8"));
  EXPECT_THAT(ProblemsOf([&] { ReadCatalogue({.file = own_.path() / "none"}); })[0].reason,
              HasSubstr("does not exist"));
}

TEST_F(RockCatalogueTest, TooManyRocksAreRefused) {
  std::string text = "x,y,d\n";
  for (std::size_t i = 0; i < kMostCatalogueRocks; ++i) text += "1,2,3\n";
  EXPECT_EQ(Read(text).rocks.size(), kMostCatalogueRocks);
  EXPECT_THAT(Problems(text + "1,2,3\n")[0].path, HasSubstr("line 100002"));
}

}  // namespace
}  // namespace rockyard::campaign
