// Readers of images of a shared library: what they say of themselves, what they get, what comes of
// it, and how they fail.
#include "plugin/library_reader.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "asking.h"
#include "core/refusals.h"
#include "plugin/library.h"
#include "plugin/plugin_use.h"
#include "whole_messages.h"

namespace rockyard::plugin {
namespace {

using math::Vector3;
using navigation::FaultKind;
using testing::ElementsAre;
using testing::IsEmpty;

const std::string kFile = std::string(PLUGIN_FOLDER) + "/readers.so";

OpenedLibrary Readers() { return OpenLibrary(kFile, HashOfLibrary(kFile)); }

// A reader of the library, with the parameters that the JSON states.
std::unique_ptr<perception::PointReader> Reader(std::size_t place, const std::string& json = "{}",
                                                const perception::PointReaderSetup& setup = {}) {
  ForeignReaderKind kind(Readers().readers.at(place));
  core::ReadParams(core::ParseJson(json, "test"), kind);
  return kind.Make(setup);
}

std::unique_ptr<perception::PointReader> Faulty(int way,
                                                const perception::PointReaderSetup& setup = {}) {
  return Reader(1, "{\"way\": " + std::to_string(way) + "}", setup);
}

TEST(LibraryReaderTest, StandBesideNavigators) {
  const OpenedLibrary opened = Readers();
  ASSERT_EQ(opened.readers.size(), 2U);
  EXPECT_EQ(opened.readers[0]->description().name, "told");
  EXPECT_EQ(opened.readers[0]->description().doc, "shows what it was told");
  EXPECT_EQ(opened.readers[1]->description().name, "faulty");
  ASSERT_EQ(opened.navigators.size(), 1U);
  EXPECT_EQ(opened.navigators[0]->description().name, "idle");
  EXPECT_THAT(opened.estimators, IsEmpty());
}

// Each number that it was told is a point, in the order of the paths.
TEST(LibraryReaderTest, ImagesArriveWholeAndPointsComeBack) {
  const WholeInput whole;
  const perception::PointReaderSetup setup{.rover = WholeSetup().rover, .max_range_m = 4.25};
  MemberList list;
  AddImages(whole.images, list);
  AddRover(setup.rover, list);
  list.Add("setup.max_range_m", 4.25);
  list.Add("shift_m", -1.5);
  const auto reader = Reader(0, R"({"shift_m": -1.5})", setup);
  for (int look = 0; look < 2; ++look) {
    const std::vector<Vector3> points = reader->Points(whole.images);
    ASSERT_EQ(points.size(), list.values().size());
    std::size_t place = 0;
    for (const auto& [path, value] : list.values()) {
      EXPECT_EQ(points[place], Vector3(value, static_cast<double>(place), 0.0)) << path;
      ++place;
    }
  }
}

TEST(LibraryReaderTest, ALookMayShowNothing) {
  EXPECT_THAT(Faulty(4)->Points(messages::LookImages{}), IsEmpty());
  EXPECT_THAT(Faulty(0)->Points(messages::LookImages{}), ElementsAre(Vector3(1.0, 2.0, 3.0)));
}

TEST(LibraryReaderTest, ConditionsAcrossParametersAreThePlugins) {
  ForeignReaderKind kind(Readers().readers[0]);
  EXPECT_THAT(core::ProblemsIn(
                  [&] { core::ReadParams(core::ParseJson(R"({"shift_m": 3})", "test"), kind); }),
              core::OneProblem("shift_m", "is beyond reach_m", "use less"));
}

TEST(LibraryReaderTest, FailuresAreFaultsThatNameTheReader) {
  const messages::LookImages images;
  EXPECT_THAT(FaultOf([&] { Faulty(1)->Points(images); }),
              IsFault(FaultKind::kThrew, "reader faulty: it rains"));
  EXPECT_THAT(FaultOf([&] { Faulty(2)->Points(images); }),
              IsFault(FaultKind::kNonsense, "reader faulty: point 1 is no place"));
  EXPECT_THAT(FaultOf([&] { Faulty(5); }), IsFault(FaultKind::kThrew, "it sleeps"));
  const perception::PointReaderSetup hasty{.look_cpu_s = 0.01};
  EXPECT_THAT(FaultOf([&] { Faulty(3, hasty)->Points(images); }),
              IsFault(FaultKind::kCpuTime, "more than 0.01 s for one answer"));
}

TEST(LibraryReaderTest, AScenarioMayNameThemBesideStereo) {
  navigation::NavigatorSet navigators;
  localization::EstimatorSet estimators;
  perception::PointReaderSet readers;
  const PluginSets sets{navigators, estimators, readers};
  const auto use = OpenPlugins(core::ParseJson("[\"" + kFile + "\"]", "test"), "/");
  AddKinds(use, sets);
  AddKinds(use, sets);  // those of a copy are there already
  EXPECT_THAT(readers.names(), ElementsAre("stereo", "told", "faulty"));
}

// A stored scenario is read without anybody's code: groups of perception that are no readers stay.
TEST(LibraryReaderTest, StandInsTakeTheirPlaceWhereNothingIsOpened) {
  navigation::NavigatorSet navigators;
  localization::EstimatorSet estimators;
  perception::PointReaderSet readers;
  AddStandIns(core::ParseJson(R"({"perception": {"reader": "told", "stereo": {}, "hazard": {"x": 1},
                                  "told": {"shift_m": 1.5}}})",
                              "test"),
              {navigators, estimators, readers});
  EXPECT_THAT(readers.names(), ElementsAre("stereo", "told"));
  EXPECT_THROW(readers.Named("told").Make({}), core::UserError);
}

}  // namespace
}  // namespace rockyard::plugin
