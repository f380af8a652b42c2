// What a URDF file says and rockyard's rover has not is named, and what counts in its stead.
#include <gmock/gmock.h>

#include <algorithm>

#include "core/json_text.h"
#include "foreign_urdf.h"
#include "rover/urdf_reader/urdf_reader.h"

namespace rockyard::rover {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::Not;

UrdfReading Read(const std::string& text) { return ReadUrdf(text, "a.urdf"); }

std::vector<std::string> LeftOut(const UrdfReading& reading) {
  std::vector<std::string> paths;
  for (const core::ParameterInfo& parameter : reading.left_out) paths.push_back(parameter.path);
  return paths;
}

auto Says(const std::string& place, const std::string& words) {
  return AllOf(Field("path", &core::Problem::path, HasSubstr(place)),
               Field("reason", &core::Problem::reason, HasSubstr(words)));
}

const std::string kRight = "<mimic joint=\"l_main_pivot\" multiplier=\"1\"/>";

TEST(UrdfNames, NamesWhatRockyardsRoverHasNot) {
  EXPECT_THAT(
      Read(ForeignUrdf()).not_taken,
      ElementsAre(Says("\"dynamics\"", "nor 5 more"), Says("\"gazebo\"", "nor 1 more"),
                  Says("line 4: element \"material\"", "nor 6 more"),
                  Says("\"mesh\"", "nor 5 more"), Says("\"transmission\"", "is not read"),
                  Says("collision of link \"mast\"", "neither of the two largest boxes"),
                  Says("fork\"", "makes mass.wheel_kg 1.9, where others make it 1.5"),
                  Says("link \"base_link\"",
                       "(1.18, 2.5, 2.32) kg m2: rockyard takes those of a solid box"),
                  Says("main_arm\"", "a flat bar"), Says("rear_arm\"", "a flat bar"),
                  Says("link \"l_",
                       "(0.0066, 0.0108, 0.0066) kg m2: rockyard takes those of a solid cylinder"),
                  Says("line 27: joint \"shoulder\"", "does not move in rockyard")));
}

// A change of the rover of another style, and what is then named, too.
struct Change {
  const char* what;
  std::string from;
  std::string to;
  std::string place;
  std::string words;
};

void PrintTo(const Change& change, std::ostream* out) { *out << change.what; }

class UrdfNamed : public testing::TestWithParam<Change> {};

TEST_P(UrdfNamed, IsNamed) {
  const auto& [what, from, to, place, words] = GetParam();
  const std::string text = Replaced(ForeignUrdf(), from, to);
  EXPECT_THAT(Read(text).not_taken, Contains(Says(place, words)));
  EXPECT_THAT(Read(ForeignUrdf()).not_taken, Not(Contains(Says(place, words))));
}

INSTANTIATE_TEST_SUITE_P(
    Changes, UrdfNamed,
    testing::Values(
        Change{"wheel_radius", "radius=\"0.12\"", "radius=\"0.125\"", "collision of link \"l_",
               "makes geometry.wheel_radius_m 0.125, where others make it 0.12"},
        Change{"wheel_place", "xyz=\"0.225 0.12 -0.18\"", "xyz=\"0.225 0.13 -0.17\"",
               "joint \"l_middle_roll\"", "has its wheel at ("},
        Change{"bogie_pivot", "xyz=\"-0.375 -0.03 -0.15\"", "xyz=\"-0.365 -0.03 -0.15\"",
               "joint \"r_rear_pivot\"", "has its pivot at (-0.2675"},
        Change{"arm_place", "xyz=\"-0.375 -0.03 -0.15\"", "xyz=\"-0.375 -0.04 -0.15\"",
               "joint \"r_rear_pivot\"",
               "makes geometry.arm_y_m 0.286667, where others make it 0.283333"},
        Change{"steering_axis", "<axis xyz=\"0 0 1\"/>\n    <limit lower=\"-1.2\"",
               "<axis xyz=\"0 0.02 1\"/>\n    <limit lower=\"-1.2\"", "joint \"l_front_steer\"",
               "leans by 1.1 deg"},
        Change{"scrub", "<child link=\"l_front_tyre\"/>\n    <origin xyz=\"0 0 -0.2\"",
               "<child link=\"l_front_tyre\"/>\n    <origin xyz=\"0 0.03 -0.2\"",
               "joint \"l_front_steer\"", "0.0300 m beside the middle of its wheel"},
        Change{"no_differential", kRight, "", "joint \"r_main_pivot\"", "by no <mimic>"},
        Change{"wrong_differential", kRight, "<mimic joint=\"l_main_pivot\" multiplier=\"-1\"/>",
               "joint \"r_main_pivot\"", "turns 1 times as fast about y"},
        Change{"differential_with_offset", kRight,
               "<mimic joint=\"l_main_pivot\" multiplier=\"1\" offset=\"0.1\"/>",
               "joint \"r_main_pivot\"", "with an offset"},
        Change{"other_stops", "lower=\"-0.8\" upper=\"0.8\"", "lower=\"-0.9\" upper=\"0.8\"",
               "joint \"l_rear_pivot\"", "counts with 0.8"},
        Change{"steering_torque", "effort=\"35\" velocity=\"0.6\"", "effort=\"9\" velocity=\"0.6\"",
               "joint \"l_front_steer\"", "has the effort 9 Nm"},
        Change{"no_motor", "effort=\"35\" velocity=\"1.5\"", "effort=\"0\" velocity=\"1.5\"",
               "joint \"l_front_roll\"", "the effort 0, which tells no motor"},
        Change{"com_of_an_arm", "<link name=\"l_rear_arm\">\n    <inertial>",
               "<link name=\"l_rear_arm\">\n    <inertial><origin xyz=\"0.1 0 0\"/>",
               "link \"l_rear_arm\"", "(0.1000, 0.0000, 0.0000) m off its pivot"},
        Change{"com_beside_the_middle", "xyz=\"-0.05 0 0.05\"/><mass",
               "xyz=\"-0.05 0.33 0.05\"/><mass", "link \"base_link\"",
               "(0.0000, 0.3000, 0.0000) m off the middle plane"},
        Change{"long_chassis", "size=\"0.7 0.4 0.2\"", "size=\"0.7 0.4 0.22\"",
               "collision of link \"base_link\"", "rockyard's chassis reaches from"},
        Change{"panel_and_wheels", "size=\"0.9 1.3 0.025\"", "size=\"0.9 1.2 0.025\"",
               "collision of link \"base_link\"", "ends before the wheels"},
        Change{"other_shapes", "<sphere radius=\"0.05\"/>", "<box size=\"0.1 0.1 0.1\"/>",
               "collision of link \"l_main_arm\"", "is no bar, strut, hub or rim"}),
    [](const auto& tested) { return std::string(tested.param.what); });

// A rocker that is fixed to the chassis.
std::string WithFixedPivot(std::string text, const std::string& side) {
  const std::string joint = "<joint name=\"" + side + "_main_pivot\" type=\"";
  text = Replaced(std::move(text), joint + "revolute", joint + "fixed");
  return side == "l" ? Replaced(std::move(text), kRight, "") : text;
}

TEST(UrdfNames, APivotOnOneSideIsThatOfTheOther) {
  for (const std::string side : {"l", "r"}) {
    const UrdfReading reading = Read(WithFixedPivot(ForeignUrdf(), side));
    EXPECT_NEAR(reading.params.geometry.rocker_pivot_x_m, 0.1, 1e-9);
    EXPECT_NEAR(reading.params.geometry.rocker_pivot_z_m, 0.45, 1e-9);
    EXPECT_NEAR(reading.params.mass.rocker_kg, 3.5, 1e-9);
    EXPECT_NEAR(reading.params.mass.total_kg, 54.6, 1e-9);
    EXPECT_THAT(reading.not_taken, Contains(Says(side + "_rear_pivot", "that of the other side")));
  }
}

TEST(UrdfNames, WithoutRockerPivotsTheirParametersAreLeftOut) {
  const UrdfReading reading = Read(WithFixedPivot(WithFixedPivot(ForeignUrdf(), "l"), "r"));
  const std::vector<std::string> paths = LeftOut(reading);
  for (const char* path : {"geometry.rocker_pivot_x_m", "geometry.rocker_pivot_z_m",
                           "geometry.rocker_limit_deg", "mass.rocker_kg"}) {
    EXPECT_THAT(paths, Contains(path));
  }
  EXPECT_THAT(reading.not_taken, Contains(Says("l_rear_pivot", "not told here")));
  EXPECT_THAT(core::DumpJson(reading.group), Not(HasSubstr("rocker")));
  EXPECT_NEAR(reading.params.mass.total_kg, 54.6, 1e-9);
}

// A differential bar that both rockers follow.
TEST(UrdfNames, BothRockersMayFollowABar) {
  std::string text =
      Replaced(ForeignUrdf(), kRight, "<mimic joint=\"bar_turns\" multiplier=\"0.5\"/>");
  text = Replaced(text, "<limit lower=\"-0.4\" upper=\"0.4\" effort=\"0\" velocity=\"5\"/>",
                  "<limit lower=\"-0.4\" upper=\"0.4\" effort=\"0\" velocity=\"5\"/>"
                  "<mimic joint=\"bar_turns\" multiplier=\"0.5\"/>");
  text = Replaced(text, "</robot>", R"(<link name="bar"/><joint name="bar_turns" type="revolute">
    <parent link="base_link"/><child link="bar"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="0" velocity="1"/></joint></robot>)");
  EXPECT_THAT(Read(text).not_taken, Not(Contains(Says("main_pivot", ""))));
  EXPECT_THAT(Read(text).not_taken, Contains(Says("bar_turns", "does not move")));
}

// The right rocker follows what follows the left one twice as fast.
TEST(UrdfNames, ADifferentialMayBeAChain) {
  const std::string bar = R"(<link name="bar"/><joint name="bar_turns" type="revolute">
    <parent link="base_link"/><child link="bar"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="0" velocity="1"/>
    <mimic joint="l_main_pivot" multiplier="2"/></joint></robot>)";
  const auto with_ratio = [&](const std::string& ratio) {
    const std::string text = Replaced(ForeignUrdf(), kRight,
                                      "<mimic joint=\"bar_turns\" multiplier=\"" + ratio + "\"/>");
    return Read(Replaced(text, "</robot>", bar)).not_taken;
  };
  EXPECT_THAT(with_ratio("0.5"), Not(Contains(Says("r_main_pivot", ""))));
  EXPECT_THAT(with_ratio("1"), Contains(Says("r_main_pivot", "turns -2 times as fast")));
}

TEST(UrdfNames, AChassisOfOneBoxGetsAPanel) {
  const UrdfReading reading =
      Read(Replaced(ForeignUrdf(), "<box size=\"0.9 1.3 0.025\"/>", "<sphere radius=\"0.1\"/>"));
  EXPECT_NEAR(reading.params.geometry.height_m, 0.55, 1e-9);
  EXPECT_NEAR(reading.params.geometry.belly_clearance_m, 0.35, 1e-9);
  EXPECT_NEAR(reading.params.geometry.length_m, 1.24, 1e-9);  // that of the wheels
  EXPECT_THAT(reading.not_taken, Contains(Says("base_link", "chassis and panel in one")));
}

TEST(UrdfNames, WithoutShapesOfTheBodyTheWheelsGiveTheLength) {
  std::string text = ForeignUrdf();
  for (const char* size : {"0.7 0.4 0.2", "0.9 1.3 0.025"}) {
    text =
        Replaced(text, "<box size=\"" + std::string(size) + "\"/>", "<mesh filename=\"a.stl\"/>");
  }
  const UrdfReading reading = Read(text);
  EXPECT_NEAR(reading.params.geometry.length_m, 1.24, 1e-9);
  EXPECT_THAT(LeftOut(reading),
              AllOf(Contains("geometry.height_m"), Contains("geometry.belly_clearance_m"),
                    Contains("geometry.belly_length_m"), Contains("geometry.belly_width_m")));
  EXPECT_THAT(reading.not_taken, Contains(Says("base_footprint", "has no box")));
}

}  // namespace
}  // namespace rockyard::rover
