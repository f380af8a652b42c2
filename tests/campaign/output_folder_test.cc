#include "campaign/output_folder.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/json_file.h"
#include "core/refusals.h"
#include "core/says.h"
#include "core/test_folder.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;
using core::Says;

using Contents = std::map<std::string, std::string>;

class OutputFolderTest : public testing::Test {
 protected:
  const fs::path& top() const { return own_.path(); }
  fs::path out() const { return own_.path() / "out"; }

  static OutputPlan Plan(const std::string& command = "stereo",
                         const std::vector<fs::path>& inputs = {}) {
    return {.command = command, .names = {"points.ply", "map.png", "eyes"}, .inputs = inputs};
  }
  static OutputPlan Long(std::int64_t seed = 1) {
    OutputPlan plan = Plan("vo");
    plan.request = core::JsonValue::Object({{"seed", seed}, {"pairs", 8}});
    return plan;
  }

  void Fill(const OutputPlan& plan, ExistingFiles existing = ExistingFiles::kRefuse,
            const std::string& bytes = "new", bool finished = true) const {
    OutputFolder folder(out(), existing, plan);
    if (plan.request.Is(core::JsonValue::Type::kObject)) folder.WriteNow("eyes/0.png", bytes);
    folder.Write("points", "points.ply", bytes);
    folder.Finish(finished);
  }

  std::string Refusal(const OutputPlan& plan,
                      ExistingFiles existing = ExistingFiles::kRefuse) const {
    const Contents before = All();
    const std::string reason =
        core::RefusalOf([&] { const OutputFolder folder(out(), existing, plan); });
    EXPECT_EQ(All(), before) << reason;
    return reason;
  }

  // What lies in the test's folder, folders by an empty text.
  Contents All() const {
    Contents all;
    for (const auto& entry : fs::recursive_directory_iterator(top())) {
      std::ifstream file(entry.path(), std::ios::binary);
      all[entry.path().lexically_relative(top())] =
          entry.is_directory() ? "" : std::string(std::istreambuf_iterator<char>(file), {});
    }
    return all;
  }

  void Put(const fs::path& name, const std::string& bytes) const {
    fs::create_directories((top() / name).parent_path());
    std::ofstream(top() / name) << bytes;
  }

 private:
  core::TestFolder own_;
};

TEST_F(OutputFolderTest, IsFilledWhenAllIsThereAndSaysByWhom) {
  {
    OutputFolder folder(top() / "a/b", ExistingFiles::kRefuse, Plan());
    folder.Write("points", "points.ply", "xyz");
    EXPECT_FALSE(fs::exists(top() / "a/b/points.ply"));
    folder.Finish();
    ASSERT_EQ(folder.files().size(), 1u);
    EXPECT_EQ(folder.files()[0].path, top() / "a/b/points.ply");
  }
  const Contents all = All();
  EXPECT_EQ(all.size(), 4u);
  EXPECT_EQ(all.at("a/b/points.ply"), "xyz");
  EXPECT_THAT(all.at("a/b/made_by.json"),
              Says("\"command\": \"stereo\"", "\"program\": \"rockyard ", "\"finished\": true"));
}

TEST_F(OutputFolderTest, NothingIsLeftOfWorkThatThrows) {
  {
    OutputFolder folder(top() / "a/b", ExistingFiles::kSetAside, Long());
    folder.Write("points", "points.ply", "xyz");
  }
  EXPECT_THAT(All(), testing::IsEmpty());
}

TEST_F(OutputFolderTest, WhatNobodyKnowsIsRefusedAndKeptByForce) {
  Put("out/points.ply", "old");
  Put("out/photograph.png", "mine");
  EXPECT_THAT(Refusal(Plan()), Says(out().string(),
                                    "is not empty and holds nothing of `rockyard "
                                    "stereo`",
                                    "--force"));
  EXPECT_NE(Refusal(Long(), ExistingFiles::kResume), "");
  Fill(Plan(), ExistingFiles::kSetAside);
  Contents all = All();
  EXPECT_EQ(all["out/points.ply"], "new");
  EXPECT_EQ(all["out/old-1/points.ply"], "old");
  EXPECT_EQ(all["out/photograph.png"], "mine");
}

TEST_F(OutputFolderTest, WhatTheSameCommandFinishedIsSetAsideWhole) {
  Fill(Plan(), ExistingFiles::kRefuse, "first");
  Put("out/map.png", "only of the first");
  Fill(Plan(), ExistingFiles::kRefuse, "second");
  Fill(Plan());
  Contents all = All();
  EXPECT_EQ(all["out/points.ply"], "new");
  EXPECT_EQ(all["out/old-1/points.ply"], "first");
  EXPECT_EQ(all["out/old-1/map.png"], "only of the first");
  EXPECT_FALSE(all.contains("out/map.png"));
  EXPECT_EQ(all["out/old-2/points.ply"], "second");
  EXPECT_THAT(Refusal(Plan("cylinder")), Says("holds what `rockyard stereo` made", "--force"));
}

TEST_F(OutputFolderTest, InputsAreNeverReplaced) {
  Put("out/points.ply", "an input");
  fs::create_directory_symlink(out(), top() / "link");
  for (const auto existing : {ExistingFiles::kRefuse, ExistingFiles::kSetAside}) {
    for (const fs::path& input : {out() / "points.ply", top() / "link/points.ply",
                                  out() / "eyes/3.png", top() / "out/../out/made_by.json"}) {
      EXPECT_THAT(Refusal(Plan("stereo", {"", input}), existing),
                  Says("--out: would replace ", "which is read"));
    }
    EXPECT_THAT(Refusal(Plan("vo", {out()}), existing), Says("which is read"));
  }
  // Another name, or another folder of that name.
  Fill(Plan("stereo", {out() / "left.png", top() / "points.ply", top()}), ExistingFiles::kSetAside);
}

TEST_F(OutputFolderTest, UnfinishedWorkIsGoneOnWithByTheSameRequest) {
  Fill(Long(), ExistingFiles::kRefuse, "half", false);
  EXPECT_THAT(Refusal(Long()), Says("`rockyard vo` began and did not finish", "--resume"));
  EXPECT_THAT(Refusal(Long(2), ExistingFiles::kResume), Says("was begun with other seed"));
  EXPECT_THAT(Refusal(Plan("render"), ExistingFiles::kResume), Says("`rockyard vo` made"));
  {
    OutputFolder folder(out(), ExistingFiles::kResume, Long());
    EXPECT_TRUE(folder.resumes());
    EXPECT_EQ(All().at("out/eyes/0.png"), "half");
    folder.Finish();
  }
  EXPECT_THAT(All().at("out/made_by.json"), Says("\"finished\": true"));
  Put("out/made_by.json",
      R"({"command": "vo", "program": "rockyard 9", "finished": false, "request": {}})");
  EXPECT_THAT(Refusal(Long(), ExistingFiles::kResume), Says("was begun by rockyard 9, this is "));
  Put("out/made_by.json", "{");
  EXPECT_THAT(Refusal(Long(), ExistingFiles::kResume), Says("made_by.json"));
  Fill(Long(), ExistingFiles::kSetAside);
  EXPECT_EQ(All().at("out/old-1/eyes/0.png"), "half");
}

TEST_F(OutputFolderTest, ResumingWhatHasNotBegunBegins) {
  Put("out/points.ply.tmp-0123456789abcdef", "of one that was killed");
  OutputFolder folder(out(), ExistingFiles::kResume, Long());
  EXPECT_FALSE(folder.resumes());
}

TEST_F(OutputFolderTest, IsOfOneCommandAtATime) {
  const OutputFolder folder(out(), ExistingFiles::kRefuse, Plan());
  EXPECT_THAT(Refusal(Plan()), Says("is in use"));
}

// A limit on file sizes stands for a full disk: both come up as bytes are written.
TEST_F(OutputFolderTest, AFullDiskIsTheMachinesFaultAndChangesNothing) {
  Fill(Plan());
  const Contents before = All();
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
  const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1 << 16, limit.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_THROW(Fill(Plan(), ExistingFiles::kRefuse, std::string(1 << 17, 'x')), core::MachineError);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::signal(SIGXFSZ, ignored);
  EXPECT_EQ(All(), before);
}

class OutputFile : public testing::Test {
 protected:
  std::string At(const std::string& name) const { return (folder_ / name).string(); }

  // Empty where it is accepted.
  static std::string Reason(const std::string& file) {
    try {
      CheckOutputFile("--csv", file);
    } catch (const core::UserError& error) {
      return error.problems().at(0).path + " " + error.problems().at(0).reason;
    }
    return "";
  }

 private:
  core::TestFolder own_;
  const fs::path& folder_ = own_.path();
};

TEST_F(OutputFile, MayBeNewOrThere) {
  std::ofstream(At("old.csv")) << "1";
  fs::create_symlink(At("old.csv"), At("link.csv"));
  fs::create_symlink(At("none.csv"), At("dangling.csv"));
  for (const char* name : {"new.csv", "old.csv", "link.csv", "dangling.csv"}) {
    EXPECT_EQ(Reason(At(name)), "") << name;
  }
}

// What is renamed onto a device takes its place: as root even that of /dev/null.
TEST_F(OutputFile, IsNoDeviceAndNoPipe) {
  ASSERT_EQ(mkfifo(At("pipe").c_str(), 0600), 0);
  fs::create_symlink(At("pipe"), At("link"));
  for (const std::string& file : {At("pipe"), At("link"), std::string("/dev/null")}) {
    EXPECT_EQ(Reason(file), "--csv is there and is no regular file: " + file);
  }
}

// A file is written under a longer name first, with 21 more bytes; most file systems know 255.
TEST_F(OutputFile, HasANameThatLeavesRoomForAnother) {
  const std::string longest(255 - 21, 'x');
  EXPECT_EQ(Reason(At(longest)), "");
  EXPECT_EQ(Reason(At(longest + "x")), "--csv has too long a name: " + At(longest + "x"));
}

TEST_F(OutputFile, IsNoFolderAndInOneThatIsThere) {
  EXPECT_EQ(Reason(At("")), "--csv is a folder: " + At(""));
  EXPECT_EQ(Reason(At("none/a.csv")),
            "--csv is in a folder that does not exist: " + At("none/a.csv"));
}

}  // namespace
}  // namespace rockyard::campaign
