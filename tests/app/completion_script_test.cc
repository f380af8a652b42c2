#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "app/completion.h"
#include "core/says.h"

namespace rockyard::app {
namespace {

using testing::HasSubstr;
using testing::Not;

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
  const std::string text = CompletionScript(app_, Shell::kFish);
  EXPECT_THAT(text,
              core::Says("-a fly -d 'It\\'s a [test]: of quotes'",
                         " -l mode -x -a 'fast slow' -d 'how'", " -l count -s n -x -d 'how many'"));
}

}  // namespace
}  // namespace rockyard::app
