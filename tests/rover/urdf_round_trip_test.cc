// Random rovers through a URDF file and back.
#include <gmock/gmock.h>

#include "core/archive.h"
#include "random_rovers.h"
#include "rover/urdf.h"
#include "rover/urdf_reader/urdf_reader.h"

namespace rockyard::rover {
namespace {

constexpr int kRovers = 200;

// Compares numbers that both have, and returns how many there are.
int ExpectNear(const core::JsonValue& read, const core::JsonValue& written,
               const std::string& path) {
  int numbers = 0;
  for (const core::JsonMember& member : read.members()) {
    const core::JsonValue* const other = written.Find(member.key);
    if (other == nullptr) {
      ADD_FAILURE() << path << member.key;
    } else if (member.value.IsNumber()) {
      EXPECT_NEAR(member.value.number(), other->number(), 1e-9) << path << member.key;
      ++numbers;
    } else if (member.value.Is(core::JsonValue::Type::kText)) {
      EXPECT_EQ(member.value.text(), other->text()) << path << member.key;
    } else {
      numbers += ExpectNear(member.value, *other, path + member.key + ".");
    }
  }
  return numbers;
}

TEST(UrdfRoundTrip, RandomRoversComeBack) {
  RandomRovers rovers;
  for (int i = 0; i < kRovers; ++i) {
    const RoverParams rover = rovers.Next();
    const UrdfReading reading = ReadUrdf(WriteUrdf(rover), "a.urdf");
    EXPECT_EQ(ExpectNear(reading.group, core::WriteParams(rover), ""), 29) << i;
    EXPECT_THAT(reading.not_taken, testing::IsEmpty()) << i;
    EXPECT_EQ(reading.left_out.size(), 17U) << i;
  }
}

}  // namespace
}  // namespace rockyard::rover
