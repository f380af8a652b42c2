// How much vectors save in the functions that Goldberg 2002 section 3 vectorized, how the time of
// stereo divides among the stages of its table 2, and what a level of a pyramid saves, as JSON.
// Ratios alone are of interest:
//
//   stereo_speedup_benchmark [ROUNDS]
//
// Both sides are timed one after the other in each round, by the clock of the thread, and the
// shortest time of a stage counts. A stage that cannot be run alone is the difference of two runs
// that share the others. Every side's disparities have one hash, or the program fails.
#include <hwy/targets.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "instruction_sets.h"
#include "scalar_pipeline.h"
#include "synthetic_pair.h"
#include "vision/each_pixel.h"
#include "vision/stereo/blob.h"
#include "vision/stereo/correlator.h"
#include "vision/stereo/dog.h"
#include "vision/stereo/pyramid.h"
#include "vision/stereo/rectification_table.h"

namespace rockyard::vision {
namespace {

// Section 3: 512 x 480 reduced once, 32 disparities, a window of 8 x 8. Table 2: 512 x 512 reduced
// twice; its disparities are not told, and its window is section 2's.
struct Case {
  const char* name;
  int width, height, level, side, disparities;
};
constexpr Case kSection3{"section_3", 512, 480, 1, 8, 32};
constexpr Case kTable2{"table_2", 512, 512, 2, 7, 32};
// Section 2: "an 8-fold decrease in computation" a level, as disparities are halved too.
constexpr std::array kLevels{
    Case{"level_0", 512, 512, 0, 7, 64}, Case{"level_1", 512, 512, 1, 7, 32},
    Case{"level_2", 512, 512, 2, 7, 16}, Case{"level_3", 512, 512, 3, 7, 8}};

enum Part { kReduce, kFilter, kRectify, kPrepare, kCompare, kDecide, kBlob, kAll, kParts };
constexpr std::array<const char*, kParts> kPartNames{"reduce",  "filter", "rectify", "prepare_row",
                                                     "compare", "decide", "blob",    "all"};
using Times = std::array<double, kParts>;

double ThreadTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <typename Work>
void Keep(double& best_s, const Work& work) {
  const double begin_s = ThreadTime();
  work();
  best_s = std::min(best_s, ThreadTime() - begin_s);
}

struct Images {
  GrayImage left, right;  // as taken
  GrayImage left_level, right_level;
  RectificationTable table;
};

Images MakeImages(const Case& c) {
  const double range_px = c.disparities * (1 << c.level);
  const Scene scene{.width = c.width,
                    .height = c.height,
                    .disparity = SteppedGround(c.width, c.height, range_px),
                    .shortest_wave_px = 2.5 * (1 << c.level),
                    .longest_wave_px = 24.0 * (1 << c.level)};
  const SyntheticPair pair = MakePair(scene);
  const int width = c.width >> c.level;
  const int height = c.height >> c.level;
  Image<SourcePosition> positions(width, height);
  ForEachPixel(width, height, [&](int x, int y) {
    positions.At(x, y) = {0.99 * x + 0.3, 0.98 * y + 0.5};
  });
  return {pair.left, pair.right, ReduceImage(pair.left, c.level), ReduceImage(pair.right, c.level),
          RectificationTable(positions, width, height)};
}

StereoPipelineParams ParamsOf(const Case& c) {
  StereoPipelineParams params = AsPrinted();
  params.correlator.window_side_px = c.side;
  params.correlator.disparities = c.disparities;
  return params;
}

// The stages of either side on one pair of images; times are differences of `runs` afterwards.
struct Runs {
  double reduce_s, filter_s, rectify_s, prepare_s, compare_s, decide_s, blob_s;
  std::string hash;
};
constexpr double kNever = std::numeric_limits<double>::infinity();
const Runs kNoRuns{kNever, kNever, kNever, kNever, kNever, kNever, kNever, ""};

void Rectify(const Images& images, GrayImage& out) {
  for (const GrayImage* image : {&images.left_level, &images.right_level}) {
    images.table.RectifyRows(*image, 0, out.height(), out);
  }
}

// CorrelateRows (correlator.cc) without its last stages.
void CorrelateFast(const GrayImage& left, const GrayImage& right,
                   const StereoPipelineParams& params, RowStage last) {
  CorrelatorState state(VectorLanes(), left.width(), params.correlator);
  const int slots = state.slots();
  for (int y = 0; y < left.height(); ++y) {
    const int out_slot = y - slots + 1 < 0 ? state.zero_slot() : (y + 1) % slots;
    LoadRow(left.Row(y), right.Row(y), y % slots, state);
    if (last == RowStage::kPrepare || y < state.layout.before + state.layout.after) {
      SlideRow(y % slots, out_slot, state);
      continue;
    }
    ScoreRow(y % slots, out_slot, state);
    GatherRightBest(state);
  }
}

// The fast code's stages by the names of ScalarPipeline.
struct FastPipeline {
  StereoPipelineParams params;

  static GrayImage Reduce(const GrayImage& image, int level) { return ReduceImage(image, level); }
  void Filter(const GrayImage& image, GrayImage& out) const {
    DifferenceOfGaussiansRows(image, params.dog, 0, image.height(), out);
  }
  void Correlate(const GrayImage& left, const GrayImage& right, RowStage last,
                 DisparityImage& out) const {
    if (last == RowStage::kDecide) {
      CorrelateRows(left, right, params, 0, left.height(), out);
    } else {
      CorrelateFast(left, right, params, last);
    }
  }
};

template <typename Pipeline>
void TimeStages(Pipeline pipeline, const Case& c, const Images& images, Runs& runs) {
  const StereoFilterParams filters = ParamsOf(c).filters;
  GrayImage left(images.left_level.width(), images.left_level.height());
  GrayImage right = left;
  DisparityImage out(left.width(), left.height());
  if (c.level == 0) runs.reduce_s = 0.0;
  Keep(runs.reduce_s, [&] {
    left = pipeline.Reduce(images.left, c.level);
    right = pipeline.Reduce(images.right, c.level);
  });
  Keep(runs.rectify_s, [&] { Rectify(images, left); });
  Keep(runs.filter_s, [&] {
    pipeline.Filter(images.left_level, left);
    pipeline.Filter(images.right_level, right);
  });
  const auto correlate = [&](RowStage last) { pipeline.Correlate(left, right, last, out); };
  Keep(runs.prepare_s, [&] { correlate(RowStage::kPrepare); });
  Keep(runs.compare_s, [&] { correlate(RowStage::kCompare); });
  Keep(runs.decide_s, [&] { correlate(RowStage::kDecide); });
  Keep(runs.blob_s, [&] { FilterBlobs(filters, out); });
  runs.hash = HashOf(out);
}

Times TimesOf(const Runs& runs) {
  return {runs.reduce_s,
          runs.filter_s,
          runs.rectify_s,
          runs.prepare_s,
          runs.compare_s - runs.prepare_s,
          runs.decide_s - runs.compare_s,
          runs.blob_s,
          runs.reduce_s + runs.filter_s + runs.decide_s + runs.blob_s};
}

struct Side {
  std::string name;
  std::int64_t set;  // of the fast code; 0: scalar
  const ScalarStages* stages;
  Runs runs = kNoRuns;
};

std::vector<Side> Sides() {
  std::vector<Side> sides{{"unoptimized", 0, &UnoptimizedStages()},
                          {"optimized", 0, &OptimizedStages()}};
  for (const std::int64_t set : {HWY_SSE4, HWY_AVX2, HWY_AVX3}) {
    if ((hwy::SupportedTargets() & HWY_TARGETS & set) == 0) continue;
    sides.push_back({hwy::TargetName(set), set, nullptr});
  }
  return sides;
}

// What each part took over what another one took; null where there is no such part.
void PrintRatios(const Times& times, const Times& over) {
  for (std::size_t part = 0; part < kParts; ++part) {
    std::cout << (part > 0 ? ", " : "") << '"' << kPartNames[part] << "\": ";
    if (over[part] > 0.0) {
      std::cout << times[part] / over[part];
    } else {
      std::cout << "null";
    }
  }
}

Times Each(double value) {
  Times times;
  times.fill(value);
  return times;
}

void PrintCase(const Case& c, const std::vector<Side>& sides) {
  std::cout << "{\"name\": \"" << c.name << "\", \"hash\": \"" << sides.front().runs.hash
            << "\", \"sides\": [";
  for (const Side& side : sides) {
    const Times times = TimesOf(side.runs);
    std::cout << (&side == sides.data() ? "\n  " : ",\n  ") << "{\"name\": \"" << side.name
              << "\", \"pairs_per_s\": " << 1.0 / times[kAll] << ", \"share\": {";
    PrintRatios(times, Each(times[kAll]));
    for (std::size_t other = 0; other < 2 && side.set != 0; ++other) {
      std::cout << "}, \"faster_than_" << sides[other].name << "\": {";
      PrintRatios(TimesOf(sides[other].runs), times);
    }
    std::cout << "}}";
  }
  std::cout << "]}";
}

void Measure(const Case& c, int rounds) {
  const Images images = MakeImages(c);
  std::vector<Side> sides = Sides();
  for (int round = 0; round < rounds; ++round) {
    for (Side& side : sides) {
      if (side.stages != nullptr) {
        const int width = images.left_level.width();
        TimeStages(ScalarPipeline(*side.stages, width, ParamsOf(c)), c, images, side.runs);
        continue;
      }
      const UseInstructionSet use(side.set);
      TimeStages(FastPipeline{ParamsOf(c)}, c, images, side.runs);
    }
  }
  for (const Side& side : sides) {
    if (side.runs.hash != sides.front().runs.hash) {
      throw std::runtime_error(side.name + " has other disparities");
    }
  }
  PrintCase(c, sides);
}

void Run(int rounds) {
  std::cout << "{\"rounds\": " << rounds << ", \"cases\": [\n ";
  Measure(kSection3, rounds);
  std::cout << ",\n ";
  Measure(kTable2, rounds);
  for (const Case& level : kLevels) {
    std::cout << ",\n ";
    Measure(level, 1 + rounds / 5);  // twenty times the work of the others
  }
  std::cout << "]}\n";
}

}  // namespace
}  // namespace rockyard::vision

int main(int argc, char** argv) {
  try {
    rockyard::vision::Run(argc > 1 ? std::max(1, std::atoi(argv[1])) : 200);
  } catch (const std::exception& error) {
    std::cerr << "stereo_speedup_benchmark: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
