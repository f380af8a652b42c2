// rockyard list
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "app/command.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class CliList : public CommandTest {
 protected:
  // What a terminal of 60 columns is told; little, since nobody reads it meanwhile.
  std::string OnTerminal(const std::vector<std::string>& words) const {
    setenv("NO_COLOR", "1", 1);
    const int screen = posix_openpt(O_RDWR | O_NOCTTY);
    grantpt(screen);
    unlockpt(screen);
    const int line = open(ptsname(screen), O_RDWR | O_NOCTTY);
    const winsize size{.ws_row = 24, .ws_col = 60, .ws_xpixel = 0, .ws_ypixel = 0};
    ioctl(line, TIOCSWINSZ, &size);
    EXPECT_EQ(RunInto(line, words).exit_code, 0);
    std::string text(4096, '\0');
    const ssize_t count = read(screen, text.data(), text.size());
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    close(line);
    close(screen);
    unsetenv("NO_COLOR");
    EXPECT_NO_THROW(json(text).dump()) << "no code point was cut";
    return text;
  }

  static std::string Scenarios() { return std::string(ROCKYARD_SOURCE_DIR) + "/scenarios"; }
};

TEST_F(CliList, PartsAreLeftOutUnlessAskedFor) {
  const CommandResult some = RunTo(0, {"list", Scenarios()});
  EXPECT_THAT(some.out, HasSubstr("/pathfinder\n"));
  EXPECT_THAT(some.out, testing::ContainsRegex("  nominal.json +Rocky 3.2 over"));
  EXPECT_THAT(some.out, Not(HasSubstr("mfex.json ")));
  EXPECT_THAT(some.out, HasSubstr("are left out: --all"));
  const CommandResult all = Run({"list", Scenarios(), "--all"});
  EXPECT_THAT(all.out, testing::ContainsRegex("  mfex.json +part of a scenario"));
  EXPECT_THAT(all.out, Not(HasSubstr("left out")));
  EXPECT_THAT(all.out, Not(HasSubstr("not valid")));
}

TEST_F(CliList, GroupsAndFilesAreInOrder) {
  fs::create_directories(work() / "s" / "b");
  fs::create_directories(work() / "s" / "a");
  const std::string nominal = Run({"defaults"}).out;
  for (const char* name : {"b/1", "a/2", "a/1", "z"}) {
    WriteFile(work() / "s" / (std::string(name) + ".json"), nominal);
  }
  const std::string text = Run({"list", "s"}).out;
  std::vector<std::string> firsts;
  std::istringstream lines(text);
  for (std::string line, first; std::getline(lines, line);) {
    std::istringstream(line) >> first;
    firsts.push_back(first);
  }
  EXPECT_THAT(firsts,
              testing::ElementsAre("s/", "z.json", "s/a", "1.json", "2.json", "s/b", "1.json"));
}

// Names come from files of others: they may hold anything.
TEST_F(CliList, OddTextStaysInItsLine) {
  fs::create_directories(work() / "s");
  json scenario = json::parse(Run({"defaults"}).out);
  scenario["name"] = "odd";
  std::string wide;
  for (int i = 0; i < 200; ++i) wide += "\u00e9";
  scenario["description"] = "\x1b[31mred\nsecond line " + wide;
  WriteFile(work() / "s" / "odd.json", scenario.dump());
  WriteFile(work() / "s" / "broken.json", "{");
  const CommandResult result = RunTo(0, {"list", "s"});
  EXPECT_THAT(result.out, HasSubstr(wide + "\n")) << "whole where it is piped";
  EXPECT_THAT(result.out, Not(HasSubstr("\x1b")));
  EXPECT_THAT(result.out, Says("?[31mred second line", "not valid"));
  bool cut = false;
  std::istringstream lines(OnTerminal({"list", "s"}));
  for (std::string line; std::getline(lines, line);) {
    line.erase(line.find_last_not_of('\r') + 1);
    const auto columns =
        std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; });
    EXPECT_LE(columns, 60) << line;
    cut = cut || columns == 60;
  }
  EXPECT_TRUE(cut);
}

TEST_F(CliList, Json) {
  const json list = json::parse(Run({"list", Scenarios(), "--json", "--all"}).out);
  EXPECT_EQ(list["schema_version"], 1);
  std::map<std::string, json> files;
  for (const json& file : list["files"]) files[file["file"]] = file;
  EXPECT_EQ(files.at("pathfinder/nominal.json")["kind"], "scenario");
  EXPECT_EQ(files.at("pathfinder/nominal.json")["name"], "nominal");
  EXPECT_EQ(files.at("sweeps/abundance.json")["kind"], "sweep");
  EXPECT_GT(files.at("sweeps/abundance.json")["cells"], 1);
  EXPECT_EQ(files.at("rovers/mfex.json")["kind"], "part");
  const json ablations = json::parse(Run({"list", "--ablations", "--json"}).out);
  EXPECT_FALSE(ablations["ablations"].empty());
  EXPECT_FALSE(ablations["ablations"][0]["settings"].empty());
}

}  // namespace
}  // namespace rockyard::app
