// rockyard vo on what rockyard render takes: files, errors, and what is said of broken input.

#include "app/command.h"

namespace rockyard::app {
namespace {

class CliVo : public CommandTest {
 protected:
  static Words RenderWords(const std::string& folder) {
    return {"render",   Source("scenarios/gestalt/abundance.json"),
            "--out",    folder,
            "--pairs",  "5",
            "--step-m", "0.1",
            "--set",    "sensors.stereo.columns=160",
            "--set",    "sensors.stereo.rows=128",
            "--set",    "sensors.stereo.images.pyramid_level=0",
            "--set",    "sensors.stereo.max_disparity_px=40"};
  }

  CliVo() {
    const CommandResult rendered = RunTo(0, RenderWords("way"));
    EXPECT_THAT(rendered.out, Says("5 of 5 pairs of 160 x 128 pixels, over 0.4",
                                   "next: rockyard vo way --cameras way/cameras.json"));
  }

  static Words VoWords(const Words& more = {}) {
    return With({"vo", "way", "--cameras", "way/cameras.json", "--out", "path"}, more);
  }

  // Exit code 2, these words, and nothing written.
  void ExpectRefused(const Words& words, const Words& said) const {
    const CommandResult result = RunTo(2, words);
    for (const std::string& word : said) EXPECT_THAT(result.err, HasSubstr(word));
    EXPECT_FALSE(fs::exists(work() / "path"));
  }
};

TEST_F(CliVo, ARenderedSequenceAndItsErrors) {
  const CommandResult result =
      RunTo(0, VoWords({"--truth", "way/poses.txt", "--lengths", "0.2,0.3"}));
  EXPECT_THAT(result.out,
              Says("5 of 5 pairs of way, folders left and right",
                   "160 x 128 pixels, aligned as they are: focal length 56.0 px",
                   "4 of 4 pairs have a motion\n", "against the truth, 5 pairs over 0.4",
                   "segments of 0.2, 0.3 m", "errors in path/errors.csv"));
  EXPECT_THAT(result.err, HasSubstr("5/5 pairs, 0 without a motion"));
  const json summary = json::parse(ReadFile(work() / "path/vo.json"));
  EXPECT_EQ(summary["pairs"], 5);
  EXPECT_LT(summary["errors"]["end_percent"], 2.0);
  EXPECT_EQ(summary["errors"]["segments"]["lengths_m"], json::parse("[0.2, 0.3]"));
  EXPECT_EQ(summary["files"]["tum"], "trajectory_tum.txt");
}

// As editors of other systems save them.
TEST_F(CliVo, MarksBeforeTextAndEndsOfLinesMeanNothing) {
  const auto resaved = [&](const std::string& from, const std::string& to) {
    std::string text = "\xef\xbb\xbf";
    for (const char c : ReadFile(work() / from)) text += c == '\n' ? "\r\n" : std::string(1, c);
    WriteFile(work() / to, text);
  };
  resaved("way/poses.txt", "poses.txt");
  resaved("way/cameras.json", "cameras.json");
  WriteFile(work() / "plain.txt",
            "way/left/000000.png way/right/000000.png\n"
            "way/left/000001.png way/right/000001.png\n");
  resaved("plain.txt", "list.txt");
  RunTo(0, VoWords({"--truth", "way/poses.txt"}));
  RunTo(0, {"vo", "way", "--cameras", "cameras.json", "--truth", "poses.txt", "--out", "same"});
  EXPECT_EQ(ReadFile(work() / "same/errors.csv"), ReadFile(work() / "path/errors.csv"));
  RunTo(0, {"vo", "list.txt", "--cameras", "cameras.json", "--out", "two"});
  WriteFile(work() / "latin.txt", "way/left/caf\xe9.png way/right/000000.png\n");
  EXPECT_THAT(RunTo(2, {"vo", "latin.txt", "--cameras", "cameras.json", "--out", "none"}).err,
              HasSubstr("latin.txt: line 1: byte 0xe9 is no text of UTF-8"));
}

TEST_F(CliVo, JsonIsThatOfItsFileAndQuietSaysNothing) {
  const CommandResult result = RunTo(0, VoWords({"--json"}));
  json printed = json::parse(result.out);
  EXPECT_TRUE(printed["errors"].is_null());
  EXPECT_EQ(printed["gaps"], 0);
  json written = json::parse(ReadFile(work() / "path/vo.json"));
  printed.erase("files");
  written.erase("files");
  EXPECT_EQ(printed, written);
  const CommandResult quiet = RunTo(0, VoWords({"--quiet"}));
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(CliVo, SettingsChangeWhatIsFound) {
  EXPECT_THAT(RunTo(0, {"vo", "--parameters"}).out, HasSubstr("keyframe.max_way_m"));
  RunTo(0, VoWords({"--param", "keyframe.max_way_m=0"}));
  EXPECT_THAT(ReadFile(work() / "path/trajectory.csv"), HasSubstr("\n4,4,3,1,1,,"));
  fs::remove_all(work() / "path");
  ExpectRefused(VoWords({"--param", "keyframe.max_wey_m=0"}), {"keyframe.max_wey_m"});
  ExpectRefused(VoWords({"--param", "detector.regions_across=0"}), {"detector.regions_across"});
}

TEST_F(CliVo, WhatIsMissingIsNamed) {
  ExpectRefused({"vo"}, {"SEQUENCE: is missing"});
  ExpectRefused({"vo", "way"}, {"--out: is missing"});
  ExpectRefused({"vo", "way", "--out", "path"}, {"--cameras: is missing"});
  ExpectRefused({"vo", "nowhere", "--out", "path"}, {"nowhere: does not exist"});
  ExpectRefused(VoWords({"--first", "9"}), {"way: leaves 0 of its 5 pairs"});
  ExpectRefused(VoWords({"--truth", "way/times.txt"}), {"times.txt: line 1: has 1 numbers"});
  WriteFile(work() / "short.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  ExpectRefused(VoWords({"--truth", "short.txt"}), {"has 1 poses, the sequence 5 pairs"});
  ExpectRefused(VoWords({"--predict", "short.txt"}), {"has 1 poses, there are 5 pairs"});
  ExpectRefused(VoWords({"--lengths", "0"}), {"--lengths"});
}

TEST_F(CliVo, BrokenSequencesAreRefusedBeforeAnythingIsWritten) {
  fs::rename(work() / "way/left/000003.png", work() / "third.png");
  ExpectRefused(VoWords(), {"way/right/000003.png: has no partner way/left/000003.png"});
  fs::copy_file(work() / "third.png", work() / "way/left/000003.png");
  const std::string good = ReadFile(work() / "way/left/000000.png");
  WriteFile(work() / "way/left/000000.png", good.substr(0, good.size() / 2));
  ExpectRefused(VoWords(), {"way/left/000000.png: "});
  fs::copy_file(work() / "way/right/000000.png", work() / "way/left/000000.png",
                fs::copy_options::overwrite_existing);
  ExpectRefused(VoWords(), {"000000.png: shows the same as the left image"});
}

// Of one image that is cut and one of another size.
TEST_F(CliVo, ImagesThatCannotBeReadAreGaps) {
  const std::string good = ReadFile(work() / "way/left/000003.png");
  WriteFile(work() / "way/left/000003.png", good.substr(0, good.size() / 2));
  WriteFile(work() / "way/right/000001.png", "P5\n2 2\n255\n....");
  EXPECT_THAT(RunTo(0, VoWords()).out,
              Says("2 of 4 pairs have a motion, 2 no_images",
                   "note: images of 2 pairs cannot be read, the first of pair 1: ",
                   "000001.png: has 2 x 2 pixels, the first image of the sequence 160"));
}

TEST_F(CliVo, CamerasOfOtherImagesAreRefused) {
  std::string cameras = ReadFile(work() / "way/cameras.json");
  json document = json::parse(cameras);
  std::swap(document["left"], document["right"]);
  WriteFile(work() / "swapped.json", document.dump());
  ExpectRefused({"vo", "way", "--cameras", "swapped.json", "--out", "path"}, {"swapped.json: "});
  WriteFile(work() / "way/left_free.png", "P5\n2 2\n255\n....");
  ExpectRefused(VoWords(), {"left_free.png: has 2 x 2 pixels"});
}

// A list that would take minutes: the path as far as it came of a process that was asked to end,
// and of one that was killed what it takes to go on.
TEST_F(CliVo, InterruptedLeavesAPathAndKilledGoesOn) {
  std::string list;
  for (int i = 0; i < 200000; ++i) {
    const std::string name = i % 2 == 0 ? "000000.png" : "000001.png";
    list += "way/left/" + name + " way/right/" + name + "\n";
  }
  WriteFile(work() / "list.txt", list);
  const Words words{"vo", "list.txt", "--cameras", "way/cameras.json", "--out", "path"};
  const fs::path journal = work() / "path/journal.jsonl";
  const auto has = [&](std::uintmax_t bytes) {
    return core::WaitUntil([&] {
      std::error_code none;
      return fs::file_size(journal, none) > bytes && !none;
    });
  };
  const pid_t killed = Start(words);
  ASSERT_TRUE(has(1000));
  kill(killed, SIGKILL);
  EXPECT_EQ(Wait(killed).exit_code, -SIGKILL);
  EXPECT_THAT(RunTo(2, words).err, Says("path: holds what `rockyard vo` began and did not finish",
                                        "try: go on with it by --resume"));
  const std::string done = ReadFile(journal);

  const pid_t ended = Start(With(words, {"--resume"}));
  ASSERT_TRUE(has(done.size() + 1000));
  kill(ended, SIGINT);
  EXPECT_THAT(WaitTo(130, ended).out, HasSubstr(" of 200000 pairs of list.txt, a list of files"));
  EXPECT_TRUE(json::parse(ReadFile(work() / "path/vo.json"))["interrupted"]);
  EXPECT_TRUE(ReadFile(journal).starts_with(done.substr(0, done.rfind('\n') + 1)));
}

TEST_F(CliVo, OptionsOfSequencesThatMakeNoSense) {
  const auto refused = [&](const Words& more, const std::string& said) {
    Words words = RenderWords("path");
    words.insert(words.end(), more.begin(), more.end());
    ExpectRefused(words, {said});
  };
  refused({"--route", "--step-m", "0"}, "--step-m");
  refused({"--route", "--x", "1"}, "--route: begins at the start of the course");
  refused({"--pairs", "0"}, "--pairs");
  ExpectRefused({"render", RenderWords("path")[1], "--out", "path", "--route"},
                {"--pairs: is missing"});
}

}  // namespace
}  // namespace rockyard::app
