#include "app/command_text.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <set>

#include "app/commands.h"
#include "app/completion.h"
#include "app/examples.h"
#include "app/manual.h"
#include "core/says.h"

namespace rockyard::app {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::Not;

class CommandLine : public testing::Test {
 protected:
  CommandLine() {
    AddCommands(app_, exit_code_);
    // Called when all is parsed, before the callbacks of subcommands, which own their options.
    app_.parse_complete_callback([] { throw CLI::Success(); });
  }

  const CLI::App& Parsed(const std::string& name, std::vector<std::string> words) {
    const CLI::App* command = app_.get_subcommand(name);
    words.insert(words.begin(), name);
    std::reverse(words.begin(), words.end());  // as this parser wants them
    EXPECT_THROW(app_.parse(words), CLI::Success);
    return *command;
  }

 private:
  CLI::App app_{"test", "rockyard"};
  ExitCode exit_code_ = ExitCode::kDone;
};

TEST_F(CommandLine, IsWhatWasTyped) {
  EXPECT_EQ(CommandText(Parsed("run", {"--trials", "30", "a b.json", "--set", "a=1", "--set",
                                       "name='it'", "--quiet"})),
            "rockyard run 'a b.json' --trials 30 --set a=1 --set 'name='\\''it'\\''' --quiet");
}

TEST_F(CommandLine, NamesNoFileThatLooksLikeAnOption) {
  EXPECT_EQ(CommandText(Parsed("run", {"--quiet", "--out", "-o", "--set", "-p=1", "--", "-x"})),
            "rockyard run ./-x --set -p=1 --out -o --quiet");
  EXPECT_EQ(CommandText(Parsed("run", {"./-x", "--out", "-o", "--set", "-p=1", "--quiet"})),
            "rockyard run ./-x --set -p=1 --out -o --quiet")
      << "what was printed means the same";
}

TEST_F(CommandLine, ResumesWithoutSettingAside) {
  EXPECT_EQ(ResumeText(Parsed("sweep", {"s.json", "--force", "--out", "x"})),
            "rockyard sweep s.json --out x --resume");
  EXPECT_EQ(ResumeText(Parsed("run", {"s.json", "--resume", "--retry-faults"})),
            "rockyard run s.json --resume");
}

TEST(NextCommand, IsThePage) {
  EXPECT_EQ(NextCommand("runs/a b", Finished::kWhole), "rockyard report 'runs/a b'");
}

TEST(NextCommand, TakesNoFolderForAnOption) {
  const std::string command = NextCommand("-x", Finished::kWhole);
  EXPECT_NE(command.find(" ./-x"), std::string::npos) << command;
}

TEST(NextCommand, ShardsAreMerged) {
  EXPECT_EQ(NextCommand("runs/a", Finished::kShard), "rockyard merge SHARD... --out FOLDER");
}

TEST(NextLine, GoesOnWithWhatStopped) {
  EXPECT_EQ(NextLine("runs/a", Finished::kWhole, "rockyard run a.json --resume"),
            "  next: rockyard run a.json --resume\n");
  EXPECT_EQ(NextLine("runs/a", Finished::kShard, ""),
            "  next: rockyard merge SHARD... --out FOLDER\n");
}

// A parser with one of everything.
class Script : public testing::Test {
 protected:
  Script() {
    CLI::App* fly = app_.add_subcommand("fly", "It's a [test]: of quotes");
    fly->add_option("FILE", file_, "a file")->required();
    fly->add_option("--mode", mode_, "how")->check(CLI::IsMember({"fast", "slow"}));
    fly->add_option("--rank", count_, "as a word")
        ->transform(CLI::CheckedTransformer(std::map<std::string, int>{{"high", 1}, {"low", 2}}));
    fly->add_option("-n,--count", count_, "how many");
    fly->add_option("--out", out_, "the user's file");
    fly->add_flag("--dry", dry_, "don't");
  }

  CLI::App app_{"test", "rockyard"};

 private:
  std::string file_;
  std::string mode_;
  int count_ = 0;
  std::string out_;
  bool dry_ = false;
};

TEST_F(Script, BashKnowsChoicesNumbersAndFiles) {
  const std::string text = CompletionScript(app_, Shell::kBash);
  EXPECT_THAT(text, core::Says("'fly --mode')\n      COMPREPLY=($(compgen -W 'fast slow'",
                               "'fly --rank')\n      COMPREPLY=($(compgen -W 'high low'",
                               "'fly --count' | 'fly -n') return ;;", "--dry"));
  EXPECT_THAT(text, Not(HasSubstr("'fly --out'"))) << "files, as everywhere else";
  EXPECT_THAT(text, HasSubstr("complete -o filenames -F _rockyard rockyard"));
}

TEST_F(Script, ZshEscapesWhatItReads) {
  const std::string text = CompletionScript(app_, Shell::kZsh);
  EXPECT_THAT(text, core::Says("'fly:It'\\''s a \\[test\\]\\: of quotes'",
                               "'*--mode[how]:word:(fast slow)'",
                               "'*--out[the user'\\''s file]:value:_files'"));
}

TEST_F(Script, FishEscapesWhatItReads) {
  EXPECT_THAT(CompletionScript(app_, Shell::kFish),
              core::Says("-a fly -d 'It\\'s a [test]: of quotes'",
                         " -l mode -x -a 'fast slow' -d 'how'", " -l count -s n -x -d 'how many'"));
}

// The parser of the command, whose subcommands do nothing.
class CommandExamples : public testing::Test {
 protected:
  CommandExamples() {
    AddCommands(app_, exit_code_);
    // Called when all is parsed, before the callbacks of subcommands, which own their options.
    app_.parse_complete_callback([] { throw CLI::Success(); });
  }

  // As a shell would hand it on: without what is around `rockyard ...`.
  static std::string Arguments(const CommandExample& example) {
    std::string line(example.line);
    line = line.substr(line.find("rockyard ") + 9);
    return line.substr(0, std::min(line.find(" > "), line.find(")\"")));
  }

  CLI::App app_{"test", "rockyard"};
  ExitCode exit_code_ = ExitCode::kDone;
};

TEST_F(CommandExamples, EachParses) {
  for (const CommandExample& example : Examples()) {
    SCOPED_TRACE(std::string(example.line));
    EXPECT_THROW(app_.parse(Arguments(example)), CLI::Success);
    EXPECT_EQ(app_.get_subcommands().front()->get_name(), example.command);
  }
  EXPECT_THROW(app_.parse("run a.json --no-such-option"), CLI::ExtrasError) << "the test can fail";
}

TEST_F(CommandExamples, EveryCommandHasOneToThreeThatItsHelpShows) {
  std::set<std::string> known;
  for (const CLI::App* command : app_.get_subcommands({})) {
    known.insert(command->get_name());
    const auto count = std::count_if(
        Examples().begin(), Examples().end(),
        [&](const CommandExample& example) { return example.command == command->get_name(); });
    EXPECT_GE(count, 1) << command->get_name();
    EXPECT_LE(count, 3) << command->get_name();
    EXPECT_NE(command->help().find("Examples:\n  "), std::string::npos) << command->get_name();
  }
  for (const CommandExample& example : Examples()) {
    EXPECT_TRUE(known.contains(std::string(example.command))) << example.command;
    EXPECT_LE(example.line.size(), 98u) << example.line;
    EXPECT_LE(example.what.size(), 94u) << example.what;
  }
}

// A parser with one option of each kind.
class Manual : public testing::Test {
 protected:
  Manual() {
    command_ = app_.add_subcommand("drive", "Drives a rover\nup a hill");
    command_->add_option("HILL", hill_, "which hill")->required();
    command_->add_option("STONES", names_, "on the way");
    auto* length = command_->add_option("--length", length_, "of the way <m>")
                       ->check(CLI::Range(1, 20))
                       ->capture_default_str();
    command_->add_option("--pace", pace_, "how")
        ->check(CLI::IsMember({"slow", "fast"}))
        ->excludes(length);
    command_->add_flag("-b,--brake", brake_, "to a stop")->needs(length);
    command_->add_option("--inner", pace_, "of scripts")->group("");
    app_.add_subcommand("plan", "Plans")
        ->add_subcommand("claim", "Claims")
        ->add_option("--rate", length_, "r");
  }

  CLI::App app_{"Test of pages", "rock"};
  CLI::App* command_ = nullptr;
  std::string hill_, pace_;
  std::vector<std::string> names_;
  int length_ = 7;
  bool brake_ = false;
};

TEST_F(Manual, HoldsWhatTheParserKnows) {
  const ManualPage page = ManualOf(*command_, "rock");
  EXPECT_EQ(page.name, "rock drive");
  EXPECT_EQ(page.summary, "Drives a rover up a hill");
  EXPECT_EQ(page.usage, "rock drive [OPTIONS] HILL [STONES]...");
  ASSERT_EQ(page.arguments.size(), 2U);
  EXPECT_EQ(page.arguments[1].text, "on the way; may be left out");
  EXPECT_THAT(
      page.options,
      ElementsAre(
          Field(&ManualOption::names, "-h, --help"),
          AllOf(Field(&ManualOption::names, "--length"),
                Field(&ManualOption::value, "INT, 1 to 20"), Field(&ManualOption::preset, "7"),
                Field(&ManualOption::text, "of the way <m>; not with --pace")),
          AllOf(Field(&ManualOption::value, "slow | fast"),
                Field(&ManualOption::text, "how; not with --length")),
          AllOf(Field(&ManualOption::names, "-b, --brake"), Field(&ManualOption::value, ""),
                Field(&ManualOption::text, "to a stop; only with --length"))));
}

TEST_F(Manual, MarkdownKeepsItsTables) {
  const std::string page = AsMarkdown(ManualOf(*command_, "rock"));
  EXPECT_THAT(
      page, testing::StartsWith("# rock drive\n\nDrives a rover up a hill.\n\n```\nrock drive ["));
  EXPECT_THAT(page, HasSubstr("\n| `--pace` | `slow \\| fast` |  | how; not with --length |\n"));
  EXPECT_THAT(page, HasSubstr("of the way &lt;m>;"));
  EXPECT_THAT(page, Not(HasSubstr("--inner")));
}

TEST_F(Manual, OfTheProgramLinksItsCommands) {
  const std::string page = AsMarkdown(ManualOf(app_));
  EXPECT_THAT(page, HasSubstr("| [drive](drive.md) | Drives a rover up a hill |\n"));
  EXPECT_THAT(page, Not(HasSubstr("## ")));
}

TEST_F(Manual, CommandsBelowACommandAreItsSections) {
  const ManualPage page = ManualOf(*app_.get_subcommand("plan"), "rock");
  EXPECT_EQ(page.usage, "rock plan [OPTIONS] COMMAND");
  EXPECT_THAT(AsMarkdown(page), HasSubstr("\n## rock plan claim\n\nClaims.\n"));
  EXPECT_THAT(AsMan(page, "rock 1"),
              HasSubstr(".SS rock plan claim [OPTIONS]\nClaims\n.TP\n\\fB\\-h, \\-\\-help\\fR\n"));
}

TEST_F(Manual, RoffShowsTextAsItStands) {
  ManualPage page = ManualOf(*command_, "rock");
  page.notes = {".a \\ and 'b'", "end"};
  const std::string text = AsMan(page, "rock 1");
  EXPECT_THAT(text,
              testing::StartsWith(".TH ROCK-DRIVE 1 \"\" \"rock 1\" \"User commands\"\n.SH NAME\n"
                                  "rock\\-drive \\- Drives a rover up a hill\n"));
  EXPECT_THAT(text, HasSubstr("\\fB\\-\\-length\\fR \\fIINT, 1 to 20\\fR\n"));
  EXPECT_THAT(text, HasSubstr("\n\\&.a \\e and 'b'\n.PP\nend\n"));
  EXPECT_THAT(AsMan(ManualOf(app_), "rock 1"),
              HasSubstr(".SH SEE ALSO\n\\fBrock\\-drive\\fR(1),\n\\fBrock\\-plan\\fR(1)\n"));
}

}  // namespace
}  // namespace rockyard::app
