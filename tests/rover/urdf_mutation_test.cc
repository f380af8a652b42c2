// URDF files with random damage are read or refused, never more, and what is read can be written.
#include <gmock/gmock.h>

#include <array>
#include <random>
#include <string>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "foreign_urdf.h"
#include "rover/urdf.h"
#include "rover/urdf_reader/urdf_reader.h"

namespace rockyard::rover {
namespace {

constexpr std::uint64_t kSeed = 20261130;
constexpr int kMutations = 2000;

constexpr std::array<const char*, 22> kWords{
    "nan",        "inf",        "-0",    "0",         "1e308",   "-1e308",
    "5e-324",     "1e6",        "",      "0 0 0",     "0 1 0",   "3.14159",
    "-1.5708",    "continuous", "fixed", "prismatic", "chassis", "left_rocker",
    "l_main_arm", "base_link",  "&#0;",  "\xc3\xa9"};

class Mutator {
 public:
  std::size_t Below(std::size_t count) { return random_() % count; }

  std::string Damaged(std::string text) {
    const std::size_t changes = 1 + Below(2);
    for (std::size_t i = 0; i < changes; ++i) Change(text);
    return text;
  }

 private:
  // The place and length of a random attribute's value.
  std::pair<std::size_t, std::size_t> Value(const std::string& text) {
    const std::size_t start = text.find("=\"", Below(text.size()));
    if (start == std::string::npos) return {0, 0};
    const std::size_t end = text.find('"', start + 2);
    if (end == std::string::npos) return {0, 0};
    return {start + 2, end - start - 2};
  }

  // The place and length of a random line with its end.
  std::pair<std::size_t, std::size_t> Line(const std::string& text) {
    const std::size_t end = text.find('\n', Below(text.size()));
    if (end == std::string::npos || end == 0) return {0, 0};
    const std::size_t before = text.rfind('\n', end - 1);
    const std::size_t start = before == std::string::npos ? 0 : before + 1;
    return {start, end + 1 - start};
  }

  void Change(std::string& text) {
    if (text.empty()) return;
    switch (Below(8)) {
      case 0:
        text[Below(text.size())] = static_cast<char>(Below(256));
        return;
      case 1:
        text.erase(Below(text.size()), 1 + Below(20));
        return;
      case 2: {
        const auto [start, length] = Line(text);
        text.erase(start, length);
        return;
      }
      case 3: {
        const auto [start, length] = Line(text);
        text.insert(Below(text.size()), text.substr(start, length));
        return;
      }
      case 4:
      case 5: {
        const auto [start, length] = Value(text);
        text.replace(start, length, kWords[Below(kWords.size())]);
        return;
      }
      case 6: {  // one value in the place of another
        const auto [from, from_length] = Value(text);
        const std::string value = text.substr(from, from_length);
        const auto [to, to_length] = Value(text);
        text.replace(to, to_length, value);
        return;
      }
      default:
        if (Below(10) == 0) text.resize(Below(text.size()));
    }
  }

  std::mt19937_64 random_{kSeed};
};

TEST(UrdfMutations, AreReadOrRefused) {
  RoverParams rear;
  rear.geometry.bogie_end = BogieEnd::kRear;
  rear.geometry.steered_wheels = SteeredWheels::kAll;
  const std::array<std::string, 3> texts{WriteUrdf({}), WriteUrdf(rear), ForeignUrdf()};
  Mutator mutator;
  int read = 0;
  int refused = 0;
  for (int i = 0; i < kMutations; ++i) {
    const std::string text = mutator.Damaged(texts[static_cast<std::size_t>(i) % texts.size()]);
    try {
      const UrdfReading reading = ReadUrdf(text, "a.urdf");
      ++read;
      EXPECT_FALSE(core::DumpJson(reading.group).empty());  // finite, or it would throw
      EXPECT_LE(reading.not_taken.size(), 101U);
      RoverParams params;
      core::ReadParams(reading.group, params);  // may be out of bounds
      EXPECT_NO_THROW(ReadUrdf(WriteUrdf(params), "again"));
    } catch (const core::UserError& error) {
      ++refused;
      EXPECT_FALSE(error.problems().empty());
    } catch (const std::exception& error) {
      ADD_FAILURE() << "mutation " << i << ": " << error.what() << "\n" << text;
    }
  }
  // Both happen often, or the damage is none or all too much.
  EXPECT_GT(read, kMutations / 10);
  EXPECT_GT(refused, kMutations / 10);
}

}  // namespace
}  // namespace rockyard::rover
