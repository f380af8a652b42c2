#include "core/json_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <fstream>

#include "core/error.h"
#include "core/json_text.h"
#include "core/test_folder.h"

namespace rockyard::core {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class JsonFileTest : public testing::Test {
 protected:
  JsonFileTest() { fs::create_directories(folder_ / "sub"); }

  fs::path Write(const std::string& name, std::string_view text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  static Problem ProblemOf(const fs::path& path) {
    try {
      LoadJsonFile(path);
    } catch (const UserError& error) {
      return error.problems().front();
    }
    return {};
  }

  static void ExpectLoads(const fs::path& file, std::string_view json) {
    EXPECT_EQ(DumpJson(LoadJsonFile(file)), DumpJson(ParseJson(json, "test")));
  }
  static void ExpectProblem(const fs::path& file, std::string_view path, const char* reason) {
    const Problem problem = ProblemOf(file);
    EXPECT_EQ(problem.path, path);
    EXPECT_THAT(problem.reason, HasSubstr(reason));
  }

  TestFolder own_;
  const fs::path& folder_ = own_.path();
};

TEST_F(JsonFileTest, ExtendsIsRelativeToTheFileThatSaysIt) {
  Write("base.json", R"({"a": {"x": 1, "y": 2}, "b": 1})");
  Write("sub/middle.json", R"({"extends": "../base.json", "a": {"y": 3}})");
  ExpectLoads(Write("top.json", R"({"extends": "sub/middle.json", "b": 4})"),
              R"({"a": {"x": 1, "y": 3}, "b": 4})");
}

TEST_F(JsonFileTest, CyclesAreErrorsThatNameTheFiles) {
  Write("a.json", R"({"extends": "b.json"})");
  const fs::path b = Write("b.json", R"({"extends": "sub/../a.json"})");
  const Problem problem = ProblemOf(b);
  EXPECT_EQ(problem.path, "extends");
  EXPECT_THAT(problem.reason, HasSubstr("cycle: b.json -> a.json -> b.json"));
  EXPECT_THAT(problem.suggestion, HasSubstr("remove"));
  EXPECT_THAT(ProblemOf(Write("self.json", R"({"extends": "self.json"})")).reason,
              HasSubstr("cycle: self.json -> self.json"));
}

TEST_F(JsonFileTest, LongChainsAreErrors) {
  for (int i = 0; i < 20; ++i) {
    Write(std::to_string(i) + ".json", "{\"extends\": \"" + std::to_string(i + 1) + ".json\"}");
  }
  EXPECT_THAT(ProblemOf(folder_ / "0.json").reason, HasSubstr("more than 16 files"));
}

TEST_F(JsonFileTest, AnyObjectMayExtendAFile) {
  Write("sub/part.json", R"({"x": 1, "deep": {"extends": "deeper.json", "z": 3}})");
  Write("sub/deeper.json", R"({"y": 2, "z": 2})");
  ExpectLoads(Write("top.json", R"({"a": {"b": {"extends": "sub/part.json", "x": 5}},
                                             "list": [1, {"extends": "sub/deeper.json"}]})"),
              R"({"a": {"b": {"x": 5, "deep": {"y": 2, "z": 3}}},
                                   "list": [1, {"y": 2, "z": 2}]})");
}

// The part that the top file names replaces the values that it shares with the base's part.
TEST_F(JsonFileTest, PartsOfAFileLieOverThoseOfItsBase) {
  Write("one.json", R"({"x": 1, "y": 1})");
  Write("two.json", R"({"y": 2})");
  Write("base.json", R"({"part": {"extends": "one.json", "w": 0}})");
  ExpectLoads(
      Write("top.json", R"({"extends": "base.json", "part": {"extends": "two.json", "v": 3}})"),
      R"({"part": {"x": 1, "y": 2, "w": 0, "v": 3}})");
}

// The same part twice is no cycle.
TEST_F(JsonFileTest, OneFileMayBeExtendedTwice) {
  Write("part.json", R"({"x": 1})");
  ExpectLoads(
      Write("top.json", R"({"a": {"extends": "part.json"}, "b": {"extends": "part.json"}})"),
      R"({"a": {"x": 1}, "b": {"x": 1}})");
}

TEST_F(JsonFileTest, FilesOfAListLieOverEachOther) {
  Write("one.json", R"({"x": 1, "deep": {"y": 1, "z": 1}})");
  Write("two.json", R"({"x": 2, "deep": {"y": 2}})");
  ExpectLoads(Write("top.json", R"({"extends": ["one.json", "two.json"], "deep": {"z": 3}})"),
              R"({"x": 2, "deep": {"y": 2, "z": 3}})");
  ExpectProblem(Write("bad.json", R"({"extends": ["one.json", 3]})"), "extends",
                "is 3, not a file name");
}

TEST_F(JsonFileTest, ErrorsOfPartsNameTheirPath) {
  ExpectProblem(Write("type.json", R"({"a": [0, {"b": {"extends": 3}}]})"), "a[1].b.extends",
                "is 3, not a file name");
  Write("inner.json", R"({"c": {"extends": ""}})");
  EXPECT_EQ(ProblemOf(Write("in_part.json", R"({"a": {"extends": "inner.json"}})")).path,
            "a.c.extends");
  EXPECT_EQ(ProblemOf(Write("empty_key.json", R"({"a": {"": {"extends": 3}}})")).path,
            "a.\"\".extends");
  EXPECT_EQ(ProblemOf(Write("empty_keys.json", R"({"": {"extends": 3}})")).path, "\"\".extends");
  ExpectProblem(Write("loop.json", R"({"a": {"b": {"extends": "loop.json"}}})"), "a.b.extends",
                "cycle: loop.json -> loop.json");
}

TEST_F(JsonFileTest, OnlyObjectsCanBeExtended) {
  Write("list.json", "[1]");
  ExpectProblem(Write("top.json", R"({"a": {"extends": "list.json"}})"), "a.extends",
                "names list.json, which holds a list");
}

// 3^8 files if nothing stopped it.
TEST_F(JsonFileTest, FilesThatMultiplyAreErrors) {
  for (int i = 0; i < 8; ++i) {
    const std::string next = "{\"extends\": \"" + std::to_string(i + 1) + ".json\"}";
    Write(std::to_string(i) + ".json",
          "{\"a\": " + next + ", \"b\": " + next + ", \"c\": " + next + "}");
  }
  Write("8.json", "{}");
  EXPECT_THAT(ProblemOf(folder_ / "0.json").reason, HasSubstr("more than 64 files"));

  const auto with = [&](int files) {
    std::string list = "\"8.json\"";
    for (int i = 2; i < files; ++i) list += ", \"8.json\"";
    return Write("with.json", "{\"extends\": [" + list + "]}");
  };
  EXPECT_EQ(ProblemOf(with(64)).reason, "");
  EXPECT_THAT(ProblemOf(with(65)).reason, HasSubstr("more than 64 files"));
}

TEST_F(JsonFileTest, MissingAndWrongFilesAreErrors) {
  EXPECT_THAT(ProblemOf(folder_ / "none.json").reason, HasSubstr("does not exist"));
  EXPECT_THAT(ProblemOf(folder_).reason, HasSubstr("not a regular file"));
  const fs::path dangling = Write("a.json", R"({"extends": "none.json"})");
  EXPECT_EQ(ProblemOf(dangling).path, "extends");
  EXPECT_EQ(ProblemOf(dangling).reason,
            "names " + (folder_ / "none.json").string() + ", which does not exist");
  EXPECT_THAT(ProblemOf(Write("b.json", R"({"extends": 3})")).reason, HasSubstr("not a file name"));
  EXPECT_THAT(ProblemOf(Write("empty.json", "")).reason, HasSubstr("line 1"));
  const fs::path list = Write("list.json", R"([{"name": "x"}])");
  EXPECT_EQ(ProblemOf(list).path, list.string());
  EXPECT_EQ(ProblemOf(list).reason, "is a list, not an object");
  EXPECT_THAT(ProblemOf(Write("large.json", std::string((32 << 20) + 1, ' '))).reason,
              HasSubstr("more than the 33554432 allowed"));
}

// A failure of the machine, which the command line tells apart from a mistake in the file.
TEST_F(JsonFileTest, TooManyOpenFilesAreNoMistakeOfTheFile) {
  const fs::path path = Write("a.json", "{}");
  rlimit former{};
  getrlimit(RLIMIT_NOFILE, &former);
  const int next = open("/dev/null", O_RDONLY | O_CLOEXEC);
  close(next);
  const rlimit small{static_cast<rlim_t>(next), former.rlim_max};
  setrlimit(RLIMIT_NOFILE, &small);
  std::exception_ptr failure;
  try {
    LoadJsonFile(path);
  } catch (...) {
    failure = std::current_exception();
  }
  setrlimit(RLIMIT_NOFILE, &former);
  // Sanitizers open files when they look at an exception.
  ASSERT_TRUE(failure);
  try {
    std::rethrow_exception(failure);
  } catch (const MachineError& error) {
    const Problem& problem = error.problems().front();
    EXPECT_EQ(problem.path, path.string());
    EXPECT_EQ(problem.reason, std::string("cannot be read: ") + std::strerror(EMFILE));
    EXPECT_THAT(problem.suggestion, HasSubstr("ulimit -n"));
  }
}

TEST_F(JsonFileTest, ErrorsNameTheFileThatIsWrong) {
  Write("broken.json", "{\"a\": }");
  const fs::path top = Write("top.json", R"({"extends": "broken.json"})");
  EXPECT_THAT(ProblemOf(top).path, HasSubstr("broken.json"));
}

JsonValue Overridden(std::string_view assignment) {
  JsonValue document = ParseJson(R"({"a": {"b": 1}, "s": "t"})", "test");
  ApplyOverride(document, assignment);
  return document;
}

TEST(OverrideTest, ValuesAreJsonOrElseText) {
  EXPECT_EQ(Overridden("a.b=2.5").Find("a")->Find("b")->number(), 2.5);
  EXPECT_TRUE(Overridden("a.b=true").Find("a")->Find("b")->boolean());
  EXPECT_EQ(Overridden("s=plain words").Find("s")->text(), "plain words");
  EXPECT_EQ(Overridden("s=\"5\"").Find("s")->text(), "5");
  EXPECT_EQ(Overridden("s=").Find("s")->text(), "");
  EXPECT_EQ(Overridden("s=x=y").Find("s")->text(), "x=y");
  EXPECT_EQ(Overridden("a.c=[1, 2]").Find("a")->Find("c")->list().size(), 2u);
  EXPECT_EQ(Overridden("a.b=NaN").Find("a")->Find("b")->text(), "NaN");
}

TEST(OverrideTest, PathsMakeTheGroupsOnTheWay) {
  EXPECT_EQ(Overridden("n.e.w=1").Find("n")->Find("e")->Find("w")->integer(), 1);
}

TEST(OverrideTest, WhatIsNoObjectIsNotReplaced) {
  for (const auto& [text, path, reason] :
       {std::array{R"([{"a": 1}])", "(root)", "is a list, not an object"},
        std::array{R"({"a": 5})", "a", "is 5, not an object"},
        std::array{R"({"a": {"b": null}})", "a.b", "is null, not an object"}}) {
    JsonValue document = ParseJson(text, "test");
    const std::string before = DumpJson(document);
    try {
      ApplyOverride(document, "a.b.c=1");
      ADD_FAILURE() << text;
    } catch (const UserError& error) {
      EXPECT_EQ(error.problems().front().path, path);
      EXPECT_EQ(error.problems().front().reason, reason);
    }
    EXPECT_EQ(DumpJson(document), before);
  }
}

TEST(OverrideTest, BadAssignmentsAreErrors) {
  for (const std::string_view assignment :
       {"no_equals", "=1", "a..b=1", ".a=1", "a.=1", "a.b=[1", "a.b={\"x\"}", "s=\"open"}) {
    EXPECT_THROW(Overridden(assignment), UserError) << assignment;
  }
  EXPECT_THROW(Overridden(std::string(100000, '.') + "=1"), UserError);
  std::string deep = "a";
  for (int i = 0; i < 1000; ++i) deep += ".a";
  EXPECT_THROW(Overridden(deep + "=1"), UserError);
}

}  // namespace
}  // namespace rockyard::core
