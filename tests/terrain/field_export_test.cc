#include "terrain/field_export.h"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>
#include <vector>

#include "core/count_of.h"
#include "core/json_text.h"

namespace rockyard::terrain {
namespace {

class FieldExportTest : public testing::Test {
 protected:
  const TerrainParams params_;
  const Course course_;
  const Field field_ = BuildField(params_, {21, 0}, course_);
};

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The rock at the goal stands behind all others, and is the image of none.
TEST(FieldExport, TheGoalRockIsNoMirrorImage) {
  Course course;
  course.goal_rock = {.diameter_m = 0.4, .height_m = 0.3};
  const Field field = BuildField({}, {21, 0}, course);
  ASSERT_GT(field.audit.mirror_images, 0);
  const std::vector<std::string> lines = Lines(ToCsv(field));
  EXPECT_THAT(lines.back(), testing::ContainsRegex("^[0-9]+,0,"));
  EXPECT_THAT(lines[lines.size() - 2], testing::ContainsRegex("^[0-9]+,1,"));
  const core::JsonValue json = core::ParseJson(ToJson(field, {}, course), "field");
  EXPECT_FALSE(json.Find("rocks")->list().back().Find("mirror_image")->boolean());
}

TEST_F(FieldExportTest, CsvReadsBackToTheSameBits) {
  const std::vector<std::string> lines = Lines(ToCsv(field_));
  ASSERT_EQ(lines.size(), field_.terrain.rocks().size() + 1);
  for (std::size_t i = 0; i < field_.terrain.rocks().size(); ++i) {
    const Rock& rock = field_.terrain.rocks()[i];
    std::vector<double> numbers;
    std::istringstream line(lines[i + 1]);
    for (std::string cell; std::getline(line, cell, ',');) numbers.push_back(std::stod(cell));
    ASSERT_EQ(numbers.size(), 12u);
    EXPECT_EQ(numbers[0], static_cast<double>(i));
    EXPECT_EQ(numbers[1], static_cast<int>(i) < field_.audit.placed ? 0.0 : 1.0);
    EXPECT_EQ(numbers[2], rock.center_W.x());
    EXPECT_EQ(numbers[7], rock.semi_axes_m.z());
    EXPECT_EQ(numbers[8], math::RadToDeg(rock.yaw_rad));
    EXPECT_EQ(numbers[10], rock.height_m);
    EXPECT_EQ(numbers[11], rock.cap_growth);
  }
}

TEST_F(FieldExportTest, JsonHoldsRocksAndAudit) {
  const core::JsonValue json = core::ParseJson(ToJson(field_, params_, course_), "field");
  ASSERT_EQ(json.Find("rocks")->list().size(), field_.terrain.rocks().size());
  EXPECT_EQ(json.Find("rocks")->list()[3].Find("diameter_m")->number(),
            field_.terrain.rocks()[3].diameter_m);
  EXPECT_EQ(json.Find("audit")->Find("placed")->integer(), field_.audit.placed);
  EXPECT_EQ(json.Find("goal_m")->list()[0].number(), 7.6);
  EXPECT_NEAR(json.Find("mirror_lines_y_m")->list()[1].number(), 1.1, 1e-12);
  EXPECT_EQ(json.Find("waypoints_m"), nullptr);
}

TEST_F(FieldExportTest, WaypointsAreExportedAndDrawn) {
  Course course{.waypoints = {{3.0, 0.5}, {5.0, -0.25}}};
  const core::JsonValue json = core::ParseJson(ToJson(field_, params_, course), "field");
  ASSERT_EQ(json.Find("waypoints_m")->list().size(), 2u);
  EXPECT_EQ(json.Find("waypoints_m")->list()[1].list()[1].number(), -0.25);
  const std::string svg = ToSvg(field_, params_, course, {});
  const std::size_t first = svg.find("<title>waypoint</title>");
  ASSERT_NE(first, std::string::npos);
  EXPECT_NE(svg.find("<title>waypoint</title>", first + 1), std::string::npos);
}

// The volume of each group of an OBJ file by the divergence theorem, positive where its faces look
// outwards.
std::vector<double> VolumesOf(const std::string& obj) {
  std::vector<math::Vector3> vertices;
  std::vector<double> volumes;
  for (const std::string& line : Lines(obj)) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "g") volumes.push_back(0.0);
    if (kind == "v") {
      math::Vector3 p;
      words >> p.x() >> p.y() >> p.z();
      vertices.push_back(p);
    }
    if (kind == "f") {
      std::vector<std::size_t> corners;
      for (std::size_t i = 0; words >> i;) corners.push_back(i - 1);
      for (std::size_t i = 2; i < corners.size(); ++i) {
        volumes.back() += vertices.at(corners[0])
                              .dot(vertices.at(corners[i - 1]).cross(vertices.at(corners[i]))) /
                          6.0;
      }
    }
  }
  return volumes;
}

// Every tessellated rock is a closed surface, oriented outwards: its volume is near, but below,
// that of the ellipsoid.
TEST_F(FieldExportTest, ObjRocksAreClosedAndOrientedOutwards) {
  const std::vector<double> volumes = VolumesOf(ToObj(field_, params_));
  ASSERT_EQ(volumes.size(), field_.terrain.rocks().size() + 1);
  for (std::size_t i = 0; i < field_.terrain.rocks().size(); ++i) {
    const double ellipsoid = 4.0 / 3.0 * M_PI * field_.terrain.rocks()[i].semi_axes_m.prod();
    EXPECT_LT(volumes[i + 1], ellipsoid);
    EXPECT_GT(volumes[i + 1], 0.9 * ellipsoid);
  }
}

// The same for caps: pi a b h times the mean of rho^2 = A s + (1 - A) s^2, (2 + A) / 6.
TEST_F(FieldExportTest, PointedRocksAreExportedAsCaps) {
  TerrainParams params = params_;
  params.rocks.pointedness = 0.87;
  const Field field = BuildField(params, {21, 0}, course_);
  const std::vector<double> volumes = VolumesOf(ToObj(field, params));
  ASSERT_EQ(volumes.size(), field.terrain.rocks().size() + 1);
  const core::JsonValue json = core::ParseJson(ToJson(field, params, course_), "field");
  for (std::size_t i = 0; i < field.terrain.rocks().size(); ++i) {
    const Rock& rock = field.terrain.rocks()[i];
    const double cap = M_PI * rock.semi_axes_m.prod() * (2.0 + rock.cap_growth) / 6.0;
    EXPECT_LT(volumes[i + 1], cap);
    EXPECT_GT(volumes[i + 1], 0.9 * cap);
    EXPECT_EQ(json.Find("rocks")->list()[i].Find("cap_growth")->number(), rock.cap_growth);
  }
}

TEST_F(FieldExportTest, ObjGroundFollowsRoughness) {
  TerrainParams rough = params_;
  rough.rocks.kind = RockFieldKind::kNone;
  rough.ground.roughness_rms_m = 0.05;
  const Field field = BuildField(rough, {21, 1}, course_);
  int vertices = 0;
  for (const std::string& line : Lines(ToObj(field, rough))) {
    std::istringstream words(line);
    std::string kind;
    double x = 0.0, y = 0.0, z = 0.0;
    words >> kind >> x >> y >> z;
    if (kind != "v") continue;
    ++vertices;
    EXPECT_NEAR(z, field.terrain.ground().Height(x, y), 1e-5);
  }
  EXPECT_GT(vertices, 4000);
}

TEST_F(FieldExportTest, SvgDrawsEveryRockAsAnOctagonWithinTheView) {
  const std::string svg = ToSvg(field_, params_, course_);
  EXPECT_EQ(core::CountOf(svg, "<polygon"), static_cast<int>(field_.terrain.rocks().size()));
  EXPECT_EQ(core::CountOf(svg, "stroke-dasharray"), 2);  // mirror lines
  EXPECT_THAT(svg, testing::HasSubstr("<title>start</title>"));
  EXPECT_THAT(svg, testing::HasSubstr("<title>goal</title>"));
  EXPECT_THAT(svg, testing::StartsWith("<svg"));
  EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
  const auto polygon = svg.find("points=\"");
  const auto end = svg.find('"', polygon + 8);
  EXPECT_EQ(core::CountOf(svg.substr(polygon, end - polygon), ","), 8);
}

}  // namespace
}  // namespace rockyard::terrain
