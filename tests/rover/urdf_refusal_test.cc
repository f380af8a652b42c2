// URDF files that are refused: each with line, element and what would be right, all at once, and
// whatever somebody put into them.
#include <gmock/gmock.h>

#include <string>

#include "core/refusals.h"
#include "foreign_urdf.h"
#include "rover/urdf.h"
#include "rover/urdf_reader/urdf_reader.h"

namespace rockyard::rover {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::Contains;
using testing::Each;
using testing::Field;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

std::vector<core::Problem> ProblemsOf(const std::string& text) {
  return core::ProblemsIn([&] { ReadUrdf(text, "a.urdf"); });
}

auto Tells(const std::string& path, const std::string& reason) {
  return AllOf(Field("path", &core::Problem::path, StartsWith(path)),
               Field("reason", &core::Problem::reason, HasSubstr(reason)),
               Field("suggestion", &core::Problem::suggestion, Not(testing::IsEmpty())));
}

// A change of the rover of another style, and the first thing that is wrong with it.
struct Refused {
  const char* what;
  std::string from;
  std::string to;
  std::string path;
  std::string reason;
};

void PrintTo(const Refused& refused, std::ostream* out) { *out << refused.what; }

class UrdfRefused : public testing::TestWithParam<Refused> {};

TEST_P(UrdfRefused, WithItsPlace) {
  const auto& [what, from, to, path, reason] = GetParam();
  const auto problems = ProblemsOf(Replaced(ForeignUrdf(), from, to));
  ASSERT_FALSE(problems.empty());
  EXPECT_THAT(problems.front(), Tells(path, reason));
}

INSTANTIATE_TEST_SUITE_P(
    Text, UrdfRefused,
    testing::Values(
        Refused{"no_end", "</robot>", "", "a.urdf: line ", "is no XML that can be read"},
        Refused{"mismatch", "<link name=\"mast\">", "<lynk name=\"mast\">", "a.urdf: line ",
                "mismatched element"},
        Refused{"entity", "<robot", "<!DOCTYPE robot [<!ENTITY a \"b\">]><robot", "a.urdf: line 3",
                "has a document type"},
        Refused{"after_the_end", "</robot>", "</robot>\nend", "a.urdf: line ", "parsing text"},
        Refused{"two_roots", "</robot>", "</robot>\n<robot/>", "a.urdf: line ", "stands outside"},
        Refused{"latin", "other", "caf\xe9", "a.urdf: line 2", "byte 0xe9 is no text of UTF-8"},
        Refused{"zero", "other", std::string("oth\0er", 6), "a.urdf: line 2", "byte 0x00"},
        Refused{"twice", "<child link=\"mast\"/>", "<child link=\"mast\" link=\"tool\"/>",
                "a.urdf: line 22", "parsing attribute"},
        Refused{"long_tag", "<link name=\"mast\">",
                "<link name=\"mast\" a=\">" + std::string(5000, 'x') + "\">", "a.urdf: line 17",
                "has a tag of 5023 bytes"}),
    [](const auto& tested) { return std::string(tested.param.what); });

INSTANTIATE_TEST_SUITE_P(
    Elements, UrdfRefused,
    testing::Values(
        Refused{"macro", "<link name=\"mast\">", "<xacro:mast/><link name=\"mast\">",
                "a.urdf: line 17", "a macro that is not expanded"},
        Refused{"no_name", "<link name=\"mast\">", "<link>", "a.urdf: line 17: link",
                "has no name"},
        Refused{"same_name", "<link name=\"tool\">", "<link name=\"mast\">",
                "a.urdf: line 24: link \"mast\"", "has the name of an earlier one"},
        Refused{"unknown_link", "<child link=\"mast\"/>", "<child link=\"masst\"/>",
                "a.urdf: line 21: joint \"mast_weld\"", "the child \"masst\", which is no link"},
        Refused{"no_parent", "<parent link=\"base_link\"/><child link=\"mast\"/>",
                "<child link=\"mast\"/>", "a.urdf: line 21: joint \"mast_weld\"", "has no <parent"},
        Refused{"two_parents", "<child link=\"tool\"/>", "<child link=\"mast\"/>",
                "a.urdf: line 27: joint \"shoulder\"", "which another joint carries"},
        Refused{"two_roots", "<child link=\"base_link\"/>", "<child link=\"mast\"/>",
                "a.urdf: line 21", "which another joint carries"},
        Refused{"circle", "<parent link=\"base_footprint\"/><child link=\"base_link\"/>",
                "<parent link=\"tool\"/><child link=\"base_link\"/>", "a.urdf",
                "has joints that make a circle"},
        Refused{"type", "name=\"mast_weld\" type=\"fixed\"", "name=\"mast_weld\" type=\"fixd\"",
                "a.urdf: line 21: joint \"mast_weld\"", "has the type \"fixd\""},
        Refused{"word", "<mass value=\"30\"/>", "<mass value=\"30kg\"/>",
                "a.urdf: line 9: link \"base_link\"", "\"30kg\", which is no finite number"},
        Refused{"hexadecimal", "<mass value=\"30\"/>", "<mass value=\"0x1p3\"/>",
                "a.urdf: line 9: link \"base_link\"", "is no finite number"},
        Refused{"infinite", "<mass value=\"30\"/>", "<mass value=\"inf\"/>",
                "a.urdf: line 9: link \"base_link\"", "is no finite number"},
        Refused{"negative", "<mass value=\"30\"/>", "<mass value=\"-30\"/>",
                "a.urdf: line 9: link \"base_link\"", "has -30, which is not between 0 and 1e+06"},
        Refused{"expression", "<mass value=\"30\"/>", "<mass value=\"${m}\"/>",
                "a.urdf: line 9: link \"base_link\"", "is no finite number"},
        Refused{"two_numbers", "xyz=\"0.35 0 0.6\"", "xyz=\"0.35 0\"",
                "a.urdf: line 21: joint \"mast_weld\"", "has 2 numbers in place of 3"},
        Refused{"four_numbers", "xyz=\"0.35 0 0.6\"", "xyz=\"0.35 0 0 0.6\"",
                "a.urdf: line 21: joint \"mast_weld\"", "has more than 3 numbers"},
        Refused{"no_radius", "<cylinder radius=\"0.03\" length=\"0.8\"/>",
                "<cylinder length=\"0.8\"/>", "a.urdf: line 19: collision of link \"mast\"",
                "<cylinder> in line 19 has no radius"},
        Refused{"no_axis", "<axis xyz=\"0 0 1\"/><limit", "<axis xyz=\"0 0 0\"/><limit",
                "a.urdf: line 27: joint \"shoulder\"", "an axis without direction"},
        Refused{"mimic", "joint=\"l_main_pivot\"", "joint=\"left\"", "a.urdf: line ",
                "has a <mimic> of no joint"},
        Refused{"quaternion", "<origin xyz=\"0.35 0 0.6\" rpy=\"0 0 0.3\"/>",
                "<origin xyz=\"0.35 0 0.6\" quat_xyzw=\"0 0 0 1\"/>", "a.urdf: line 21",
                "has a quaternion"}),
    [](const auto& tested) { return std::string(tested.param.what); });

INSTANTIATE_TEST_SUITE_P(
    Build, UrdfRefused,
    testing::Values(
        Refused{"five_wheels", "name=\"l_front_roll\" type=\"continuous\"",
                "name=\"l_front_roll\" type=\"fixed\"", "a.urdf", "has 5 wheels"},
        Refused{"wheel_without_shape", "<cylinder radius=\"0.12\" length=\"0.1\"/>",
                "<sphere radius=\"0.12\"/>", "a.urdf", "has 5 wheels"},
        Refused{"wheel_about_x", "rpy=\"-1.5707963267948966 0 0\"",
                "rpy=\"0 1.5707963267948966 0\"", "a.urdf", "has 5 wheels"},
        Refused{"four_on_a_side", "xyz=\"0.225 0.12 -0.18\"", "xyz=\"0.225 -1.12 -0.18\"", "a.urdf",
                "has 2 wheels on the left and 4 on the right"},
        Refused{"wheel_with_a_joint", "</robot>",
                R"(<joint name="a" type="revolute"><parent link="l_front_tyre"/><child link="a"/>
                   </joint><link name="a"/></robot>)",
                "a.urdf", "has 5 wheels"},
        Refused{"fork_with_a_joint", "</robot>",
                R"(<joint name="a" type="revolute"><parent link="l_front_fork"/><child link="a"/>
                   </joint><link name="a"/></robot>)",
                "a.urdf: line ", "steers more than one wheel, or carries more"},
        Refused{"slider", "name=\"l_rear_pivot\" type=\"revolute\"",
                "name=\"l_rear_pivot\" type=\"prismatic\"", "a.urdf: line ",
                "carries two wheels and does not turn about y"},
        Refused{"no_bogie", "name=\"l_rear_pivot\" type=\"revolute\"",
                "name=\"l_rear_pivot\" type=\"fixed\"", "a.urdf: line ",
                "hangs on one link with the wheels before and behind it"},
        Refused{"bogie_on_the_chassis", "<parent link=\"l_main_arm\"/><child link=\"l_rear_arm\"/>",
                "<parent link=\"base_link\"/><child link=\"l_rear_arm\"/>", "a.urdf: line ",
                "does not hang on the link of the third wheel"},
        Refused{"three_apart", "<parent link=\"l_rear_arm\"/><child link=\"l_middle_tyre\"/>",
                "<parent link=\"base_link\"/><child link=\"l_middle_tyre\"/>", "a.urdf: line ",
                "shares its link with neither"},
        Refused{"five_steered", "name=\"l_front_steer\" type=\"revolute\"",
                "name=\"l_front_steer\" type=\"fixed\"", "a.urdf", "steers 3 wheels"},
        Refused{"rocker_about_z", "<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 0 1\"/>", "a.urdf: line ",
                "carries a rocker and does not turn about y"}),
    [](const auto& tested) { return std::string(tested.param.what); });

TEST(UrdfRefusals, AreToldAllAtOnce) {
  std::string text = Replaced(ForeignUrdf(), "<mass value=\"30\"/>", "<mass value=\"much\"/>");
  text = Replaced(text, "size=\"0.7 0.4 0.2\"", "size=\"0.7 0.4\"");
  text = Replaced(text, "<child link=\"tool\"/>", "<child link=\"tol\"/>");
  EXPECT_THAT(ProblemsOf(text),
              testing::ElementsAre(Tells("a.urdf: line 9: link \"base_link\"", "much"),
                                   Tells("a.urdf: line 14: collision of link \"base_link\"",
                                         "has 2 numbers in place of 3"),
                                   Tells("a.urdf: line 27: joint \"shoulder\"", "\"tol\"")));
  // The wheels that lack their cylinder are named beside the count.
  std::string bare = ForeignUrdf();
  for (int i = 0; i < 6; ++i) {
    bare =
        Replaced(bare, "<cylinder radius=\"0.12\" length=\"0.1\"/>", "<sphere radius=\"0.12\"/>");
  }
  EXPECT_THAT(ProblemsOf(bare), AllOf(SizeIs(7), Contains(Tells("a.urdf: line ", "no cylinder"))));
}

TEST(UrdfRefusals, BogiesAtDifferentEndsAreNoRoverOfRockyards) {
  // Left arms change places: the one in front gets a wheel more, the other one less.
  std::string text =
      Replaced(ForeignUrdf(), "<parent link=\"l_main_arm\"/><child link=\"l_front_fork\"/>",
               "<parent link=\"l_rear_arm\"/><child link=\"l_front_fork\"/>");
  text = Replaced(text, "<parent link=\"l_rear_arm\"/><child link=\"l_rear_fork\"/>",
                  "<parent link=\"l_main_arm\"/><child link=\"l_rear_fork\"/>");
  text = Replaced(text, "xyz=\"0.4 0.15 -0.13\"", "xyz=\"0.775 0.12 0.02\"");
  text = Replaced(text, "xyz=\"-0.225 0.12 0.02\"", "xyz=\"-0.6 0.15 -0.13\"");
  EXPECT_THAT(ProblemsOf(text), testing::ElementsAre(Tells("a.urdf: line ", "at another end")));
}

TEST(UrdfRefusals, AnotherRootThanARobotIsNamed) {
  EXPECT_THAT(ProblemsOf("<sdf version=\"1.6\"><model/></sdf>"),
              testing::ElementsAre(Tells("a.urdf: line 1", "the element \"sdf\"")));
}

std::string Repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

// What somebody might put into a file to bring the program down.
TEST(UrdfRefusals, HostileFilesAreRefusedOrRead) {
  const std::string head = "<robot name=\"a\">";
  EXPECT_THAT(ProblemsOf(""), SizeIs(1));
  EXPECT_THAT(ProblemsOf(std::string(kMostUrdfBytes + 1, ' ')), SizeIs(1));
  EXPECT_THAT(ProblemsOf(Repeated("<a>", 100000)), Each(Tells("a.urdf: line 1", "depth exceeded")));
  EXPECT_THAT(ProblemsOf(head + "<link name=\"" + std::string(4000, 'x') + "\"/></robot>"),
              Contains(Tells("a.urdf", "has 0 wheels")));
  EXPECT_THAT(ProblemsOf(head + Repeated("<link/>", 20000) + "</robot>"), SizeIs(101));
  std::string attributes;
  for (int i = 0; i < 100000; ++i) attributes += fmt::format(" a{}=\">\"", i);
  EXPECT_THAT(ProblemsOf(head + "<link" + attributes + "/></robot>"),
              Contains(Tells("a.urdf: line 1", "has a tag of")));
  EXPECT_THAT(ProblemsOf(head + "<!-- <link" + attributes + "/> --></robot>"),
              Contains(Tells("a.urdf", "has no links")));
  // A chain of links, each on the next.
  std::string chain = head + "<link name=\"0\"/>";
  for (int i = 1; i < 5000; ++i) {
    chain += fmt::format(
        "<link name=\"{0}\"/><joint name=\"{0}\" type=\"continuous\"><parent "
        "link=\"{1}\"/><child link=\"{0}\"/><mimic joint=\"{2}\"/></joint>",
        i, i - 1, 1 + i % 4999);
  }
  EXPECT_THAT(ProblemsOf(chain + "</robot>"), Contains(Tells("a.urdf", "has 0 wheels")));
  // Entities are not expanded, so that a number of them is none.
  EXPECT_THAT(ProblemsOf(Replaced(ForeignUrdf(), "value=\"30\"", "value=\"&lol;\"")),
              Contains(Tells("a.urdf: line 9", "no finite number")));
}

// More than a hundred kinds of elements are not read: as many are named, and how many more.
TEST(UrdfRefusals, WhatIsNotTakenIsNamedUpToAHundred) {
  std::string others;
  for (int i = 0; i < 150; ++i) others += fmt::format("<sensor_{} />", i);
  const auto not_taken =
      ReadUrdf(Replaced(ForeignUrdf(), "</robot>", others + "</robot>"), "a.urdf").not_taken;
  EXPECT_THAT(not_taken, SizeIs(101));
  EXPECT_THAT(not_taken.back().reason, HasSubstr("62 more are not taken"));
}

}  // namespace
}  // namespace rockyard::rover
