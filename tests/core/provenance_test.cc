#include "core/provenance.h"

#include <gmock/gmock.h>

namespace rockyard::core {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

TEST(ProvenanceTest, EverythingIsFilled) {
  const Provenance provenance = CurrentProvenance();
  EXPECT_THAT(provenance.version, MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_THAT(provenance.commit, MatchesRegex("unknown|[0-9a-f]+(-dirty)?"));
  EXPECT_FALSE(provenance.compiler.empty());
  EXPECT_FALSE(provenance.host.empty());
  EXPECT_FALSE(provenance.cpu_model.empty());
  EXPECT_FALSE(provenance.cpu_level.empty());
  EXPECT_GE(provenance.cpu_threads, 0);
}

TEST(ProvenanceTest, FlagsTellHowFloatingPointIsCompiled) {
  EXPECT_THAT(CurrentProvenance().flags, HasSubstr("-ffp-contract=off"));
}

TEST(ProvenanceTest, VersionLineNamesVersionAndCommit) {
  const Provenance provenance = CurrentProvenance();
  EXPECT_THAT(VersionLine(), HasSubstr("rockyard " + provenance.version));
  EXPECT_THAT(VersionLine(), HasSubstr(provenance.commit));
}

}  // namespace
}  // namespace rockyard::core
