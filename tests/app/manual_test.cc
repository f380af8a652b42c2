#include "app/manual.h"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <string>

namespace rockyard::app {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::Not;

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
