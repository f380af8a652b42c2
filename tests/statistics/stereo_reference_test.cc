// The rows of stereo's speed: which of them hold, and that they compute with what was measured.
#include <gtest/gtest.h>

#include <fstream>
#include <initializer_list>
#include <set>
#include <stdexcept>
#include <string>

#include "core/json_file.h"
#include "report/comparison_reference.h"
#include "statistics/published_comparison.h"

namespace rockyard::report {
namespace {

using core::JsonValue;
using statistics::Verdict;

const std::string kResults = ROCKYARD_SOURCE_DIR "/results/";

statistics::PublishedReference ReferenceOf(const std::string& file) {
  return LoadReference(kResults + "reference/" + file);
}

// Of the computed rows: those of drives wait for trials.
std::set<std::string> RowsThatDiffer(const statistics::PublishedReference& reference) {
  std::set<std::string> ids;
  for (const auto& value : statistics::Compare(reference, {}).values) {
    if (!value.published.scenario.empty()) continue;
    if (value.verdict == Verdict::kDiffers) {
      ids.insert(value.published.id);
    } else {
      EXPECT_EQ(value.verdict, Verdict::kHolds) << value.published.id;
    }
  }
  return ids;
}

// The paper contradicts itself: its percentage, and its orders of magnitude against its table 2.
TEST(HowardReference, HoldsButForTheContradictionsOfThePaper) {
  EXPECT_EQ(RowsThatDiffer(ReferenceOf("howard2012.json")),
            (std::set<std::string>{"fpga.blocks_share", "stereo.fpga_over_mer"}));
}

// Its two drives leave three numbers each.
TEST(HowardReference, HasARowForEachNumberOfADrive) {
  std::set<std::string> ids;
  for (const auto& value : statistics::Compare(ReferenceOf("howard2012.json"), {}).values) {
    if (!value.published.scenario.empty()) ids.insert(value.published.id);
  }
  EXPECT_EQ(ids, (std::set<std::string>{"csad.distance", "csad.steering", "csad.time",
                                        "csod.distance", "csod.steering", "csod.time"}));
}

TEST(GoldbergStereoReference, APentiumOf2001IsNotReproduced) {
  EXPECT_EQ(RowsThatDiffer(ReferenceOf("goldberg2002_stereo.json")),
            (std::set<std::string>{"speedup.prepare_row", "speedup.inner_loop", "speedup.sub_pixel",
                                   "speedup.all", "speed.frames", "table2.box_filter", "table2.dog",
                                   "table2.rectification", "table2.blob"}));
}

const JsonValue& Named(const JsonValue& list, const std::string& name) {
  for (const JsonValue& item : list.list()) {
    if (item.Find("name")->text() == name) return item;
  }
  throw std::logic_error("nothing is called " + name);
}

// ms of some stages, by what the benchmark printed.
double Time(const std::string& test_case, const std::string& side,
            std::initializer_list<const char*> stages) {
  static const JsonValue document = core::LoadJsonFile(kResults + "studies/stereo_speedup.json");
  const JsonValue& found = Named(*Named(*document.Find("cases"), test_case).Find("sides"), side);
  double share = 0.0;
  for (const char* stage : stages) share += found.Find("share")->Find(stage)->number();
  return 1000.0 * share / found.Find("pairs_per_s")->number();
}

void ExpectInputs(const std::string& id, double first, double second) {
  static const statistics::PublishedReference reference = ReferenceOf("goldberg2002_stereo.json");
  for (const auto& value : reference.values) {
    if (value.id != id) continue;
    EXPECT_NEAR(value.inputs.at(0) / first, 1.0, 1e-3) << id;
    EXPECT_NEAR(value.inputs.at(1) / second, 1.0, 1e-3) << id;
    return;
  }
  ADD_FAILURE() << "no row " << id;
}

TEST(GoldbergStereoReference, SpeedupsAreThoseThatTheBenchmarkPrinted) {
  const auto expect = [](const std::string& id, std::initializer_list<const char*> stages) {
    ExpectInputs(id, Time("section_3", "optimized", stages), Time("section_3", "SSE4", stages));
  };
  expect("speedup.dog", {"reduce", "filter"});
  expect("speedup.prepare_row", {"prepare_row"});
  expect("speedup.inner_loop", {"compare"});
  expect("speedup.sub_pixel", {"decide"});
  expect("speedup.all", {"all"});
  ExpectInputs("speed.frames", 1000.0, Time("section_3", "SSE4", {"all"}));
}

TEST(GoldbergStereoReference, SharesAreThoseThatTheBenchmarkPrinted) {
  const double all = Time("table_2", "optimized", {"all", "rectify"});
  const auto expect = [all](const std::string& id, std::initializer_list<const char*> stages) {
    ExpectInputs(id, 100.0 * Time("table_2", "optimized", stages), all);
  };
  expect("table2.box_filter", {"reduce"});
  expect("table2.dog", {"filter"});
  expect("table2.rectification", {"rectify"});
  expect("table2.correlation", {"prepare_row", "compare", "decide"});
  expect("table2.blob", {"blob"});
}

TEST(GoldbergStereoReference, LevelsAreThoseThatTheBenchmarkPrinted) {
  const auto match = [](const std::string& level) {
    return Time(level, "optimized", {"all"}) - Time(level, "optimized", {"reduce"});
  };
  ExpectInputs("level.time_0_1", match("level_0"), match("level_1"));
  ExpectInputs("level.time_1_2", match("level_1"), match("level_2"));
  ExpectInputs("level.time_2_3", match("level_2"), match("level_3"));
}

// mm at a level, from 2 to 3 m.
double RangeError(int level) {
  std::ifstream file(kResults + "studies/pyramid_error.csv");
  const std::string row = std::to_string(level) + ",2,3,";
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(row)) return std::stod(line.substr(line.rfind(',') + 1));
  }
  throw std::logic_error("no row " + row);
}

TEST(GoldbergStereoReference, ErrorsAreThoseOfTheStudy) {
  ExpectInputs("level.error_0_1", RangeError(1), RangeError(0));
  ExpectInputs("level.error_1_2", RangeError(2), RangeError(1));
  ExpectInputs("level.error_2_3", RangeError(3), RangeError(2));
}

}  // namespace
}  // namespace rockyard::report
