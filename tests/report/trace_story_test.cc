#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "core/count_of.h"
#include "core/says.h"
#include "report/trace_view.h"
#include "sample_trace.h"

namespace rockyard::report {
namespace {

using core::CountOf;
using testing::HasSubstr;
using testing::Not;

std::ptrdiff_t LinesOf(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

TEST(TraceStory, TellsTurnsAndDrivesBetweenFoldedEvents) {
  const std::string story = TraceStory(SampleTrial(), StoryLength::kFolded);
  EXPECT_THAT(story, core::Says("seed 7, trial 12: no_path (nowhere to go)", "drove 2.00 m",
                                "start, drove 1.00 m\n",
                                "3 hazard scans ..#.. to #...., turned right 30 deg\n",
                                "reflection", "end nowhere to go\n"));
  // Pose, belief and believed distance to the goal of the first scan.
  EXPECT_THAT(story, HasSubstr("  1.00   0.00     0    1.50   0.00     0    2.00  3 hazard"));
}

TEST(TraceStory, LeavesOutATurnOfLessThanATenthOfTheOther) {
  const auto turned = [](double left_deg, double right_deg) {
    truth::TracedTrial trial = SampleTrial();
    const double left_rad = math::DegToRad(left_deg);
    trial.trace.samples = {SampleOf(0.0, 0.0, 0.0, 0.0, "drive"),
                           SampleOf(1.0, 0.0, 0.0, left_rad, "turn"),
                           SampleOf(2.0, 0.0, 0.0, left_rad - math::DegToRad(right_deg), "turn")};
    trial.trace.events = {{0.0, {}, "hazard", "..#.."}, {2.0, {}, "end", ""}};
    return TraceStory(trial, StoryLength::kAll);
  };
  EXPECT_THAT(turned(20.0, 40.0), HasSubstr("..#.., turned left 20 deg, turned right 40 deg\n"));
  EXPECT_THAT(turned(40.0, 20.0), HasSubstr("..#.., turned left 40 deg, turned right 20 deg\n"));
  EXPECT_THAT(turned(3.9, 40.0), HasSubstr("..#.., turned right 40 deg\n"));
  EXPECT_THAT(turned(40.0, 3.9), HasSubstr("..#.., turned left 40 deg\n"));
}

TEST(TraceStory, FoldsLooksChoicesAndFeltHazards) {
  truth::TracedTrial trial = SampleTrial();
  trial.trace.events = {{1.0, {}, "look", "ahead, 900 points"},
                        {1.0, {}, "chosen", "forward left 0.55/m: vote 200"},
                        {1.1, {}, "felt", "tilt ahead"},
                        {1.2, {}, "look", "ahead, 800 points"},
                        {1.2, {}, "chosen", "backward straight: vote 190"}};
  EXPECT_THAT(TraceStory(trial, StoryLength::kFolded),
              HasSubstr("  2 choices forward left 0.55/m to backward straight, 1 felt hazard tilt "
                        "ahead"));
  trial.trace.events.resize(1);
  trial.trace.events.push_back({1.05, {}, "look", "behind, 700 points"});
  EXPECT_THAT(TraceStory(trial, StoryLength::kFolded),
              HasSubstr("  2 looks ahead, 900 points to behind, 700 points"));
}

TEST(TraceStory, AWaypointHasALineOfItsOwnAndTheTrackerSharesOne) {
  truth::TracedTrial trial = SampleTrial();
  trial.trace.events = {{1.0, {}, "chosen", "forward straight"},
                        {1.1, {}, "waypoint", "1 of 2, 0.31 m from it"},
                        {1.2, {}, "tracker", "goal in view"},
                        {1.3, {}, "tracker", "goal out of view"}};
  const std::string story = TraceStory(trial, StoryLength::kFolded);
  EXPECT_THAT(story, core::Says("  waypoint 1 of 2, 0.31 m from it",
                                "  2 tracker changes goal in view to goal out of view"));
}

// Motions that were seen stand behind everything else, and an alarm of slip is never dropped.
TEST(TraceStory, MotionsAreToldWhereNothingElseHappened) {
  truth::TracedTrial trial = SampleTrial();
  const auto story = [&](const std::string& between) {
    trial.trace.events = {{1.0, {}, "vision", "0.101 m, 0.2 deg"},
                          {1.1, {}, between, "70 % +- 5 % of the way"},
                          {1.2, {}, "vision", "0.099 m, 0.1 deg"}};
    return TraceStory(trial, StoryLength::kFolded);
  };
  EXPECT_THAT(story("slip"), HasSubstr("  1 slip alarm 70 % +- 5 % of the way"));
  EXPECT_THAT(story("look"), HasSubstr("  1 look 70 %"));
  EXPECT_THAT(story("vision"), HasSubstr("  3 motions seen 0.101 m, 0.2 deg to 0.099 m, 0.1 deg"));
}

TEST(TraceStory, EveryEventOnALineOfItsOwn) {
  const truth::TracedTrial trial = SampleTrial();
  const std::string all = TraceStory(trial, StoryLength::kAll);
  EXPECT_THAT(all, HasSubstr("hazard ..#.., turned right 10 deg\n"));
  EXPECT_THAT(all, Not(HasSubstr("hazard scans ")));
  EXPECT_EQ(LinesOf(all) - LinesOf(TraceStory(trial, StoryLength::kFolded)), 2);
}

TEST(TraceStory, StaysShortHoweverMuchHappens) {
  truth::TracedTrial trial = SampleTrial();
  trial.trace = {};
  for (int i = 0; i < 3000; ++i) {
    trial.trace.samples.push_back(SampleOf(i, 0.02 * i, 0.0, 0.0, "drive"));
    trial.trace.events.push_back(
        {i + 0.5, {0.02 * i, 0.0, 0.0}, i % 3 == 0 ? "reflection" : "hazard", ""});
  }
  EXPECT_GT(LinesOf(TraceStory(trial, StoryLength::kAll)), 3000);
  EXPECT_LE(LinesOf(TraceStory(trial, StoryLength::kFolded)), kMaxStoryLines);
}

TEST(TraceStory, AFaultBeforeTheFirstTickHasNoFigures) {
  truth::TracedTrial trial;
  trial.record.detail = "blew up";
  const std::string story = TraceStory(trial, StoryLength::kFolded);
  EXPECT_THAT(story, HasSubstr("simulator_fault (blew up)"));
  EXPECT_THAT(story, Not(HasSubstr("nan")));
}

TEST(RecordDifferences, ComparesBits) {
  const truth::TracedTrial trial = SampleTrial();
  EXPECT_TRUE(RecordDifferences(trial.schema, trial.record, trial.record).empty());
  truth::Record other = trial.record;
  other.values[1] = std::nextafter(other.values[1], 100.0);
  const auto differences = RecordDifferences(trial.schema, trial.record, other);
  ASSERT_EQ(differences.size(), 1U);
  EXPECT_THAT(differences.front(), HasSubstr("scans: stored 9, now 9.000000000000002"));

  truth::Record zero = trial.record;
  truth::Record negative_zero = trial.record;
  zero.values[0] = 0.0;
  negative_zero.values[0] = -0.0;
  EXPECT_EQ(RecordDifferences(trial.schema, zero, negative_zero).size(), 1U);

  other = trial.record;
  other.outcome = truth::TrialOutcome::kJammed;
  other.detail = "stuck";
  other.values.clear();
  EXPECT_EQ(RecordDifferences(trial.schema, trial.record, other).size(), 3U);
}

constexpr DrawnArea kPlan{-2.0, 10.0, -2.0, 2.0};

TEST(TraceCsv, SamplesAndEventsInOrderOfTime) {
  const truth::TracedTrial trial = SampleTrial();
  std::istringstream lines(TraceCsv(trial.trace));
  std::string line;
  std::getline(lines, line);
  const int columns = CountOf(line, ",");
  EXPECT_EQ(columns, 11U);
  double last_s = 0.0;
  std::size_t rows = 0;
  for (; std::getline(lines, line); ++rows) {
    EXPECT_EQ(CountOf(line, ","), columns) << line;
    const double time_s = std::stod(line.substr(line.find(',') + 1));
    EXPECT_GE(time_s, last_s);
    last_s = time_s;
  }
  EXPECT_EQ(rows, trial.trace.samples.size() + trial.trace.events.size());
  EXPECT_THAT(TraceCsv(trial.trace), HasSubstr("\nevent,20,hazard,1,0,0,0.1,1.5,0,0,1,..#..\n"));
}

TEST(TraceDrawing, PathsBreakAtReflectionsAndMarksLieOnBoth) {
  const TraceDrawing drawing = DrawTrace(SampleTrial(), kPlan);
  EXPECT_EQ(CountOf(drawing.elements, "<polyline"), 4);  // two pieces of two paths
  EXPECT_THAT(drawing.elements, HasSubstr("points=\"0.000,-0.000 0.100,-0.000 "));
  // Three scans at one place: one circle on each path, and one in the key.
  EXPECT_EQ(CountOf(drawing.elements, "<circle"), 3);
  EXPECT_THAT(drawing.elements, HasSubstr("scrape  at 67 s"));
  EXPECT_THAT(drawing.elements, HasSubstr("sample&lt;&amp;&gt;, seed 7, trial 12: no_path"));
  EXPECT_LT(drawing.area.y_min_m, kPlan.y_min_m);
  EXPECT_EQ(drawing.area.x_max_m, kPlan.x_max_m);
}

TEST(TraceDrawing, LongPathsAreThinnedAndKeepTheirEnds) {
  truth::TracedTrial trial = SampleTrial();
  trial.trace.samples.clear();
  for (int i = 0; i <= 40000; ++i) {
    trial.trace.samples.push_back(
        SampleOf(100.0 + i, 12.5 * i / 40000.0, std::sin(0.01 * i), 0.0, "drive"));
  }
  trial.trace.events.clear();
  const TraceDrawing drawing = DrawTrace(trial, kPlan);
  const std::size_t points = CountOf(drawing.elements, ",") - 2;  // two in the title
  EXPECT_LE(points, 2 * kMaxDrawnPoints);
  EXPECT_GT(points, kMaxDrawnPoints);
  EXPECT_THAT(drawing.elements, HasSubstr("points=\"0.000,-0.000 "));
  EXPECT_THAT(drawing.elements, HasSubstr("12.500,"));
  EXPECT_DOUBLE_EQ(drawing.area.x_max_m, 13.0);  // the believed path is 0.5 m ahead
}

}  // namespace
}  // namespace rockyard::report
