#include "web/page.h"

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "web/gunzip.h"

namespace rockyard::web {
namespace {

class PageTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!PagesBuilt()) GTEST_SKIP() << "built without npm: see PageWithoutNpm";
  }
};

TEST_F(PageTest, HoldsItsDataWhole) {
  const std::string json = R"({"title":"narrow","values":[1,null,2.5]})";
  for (const Page page : {Page::kReport, Page::kReplay}) {
    EXPECT_EQ(test::PayloadOf(MakePage(page, "narrow", json)), json);
  }
}

TEST_F(PageTest, DataAndTitleAreNeverMarkup) {
  const std::string hostile = "</script><script>alert(1)</script><!-- payload -->";
  const std::string html = MakePage(Page::kReport, hostile, "{\"title\":\"" + hostile + "\"}");
  EXPECT_EQ(html.find("alert(1)</script>"), std::string::npos);
  EXPECT_NE(html.find("<title>&lt;/script&gt;"), std::string::npos);
  EXPECT_EQ(test::PayloadOf(html), "{\"title\":\"" + hostile + "\"}");
}

// A page that could fetch anything would not be self-contained.
TEST_F(PageTest, ForbidsTheNetwork) {
  for (const Page page : {Page::kReport, Page::kReplay}) {
    const std::string html = MakePage(page, "t", "{}");
    EXPECT_NE(
        html.find("Content-Security-Policy\" content=\"default-src 'none'; script-src 'sha256-"),
        std::string::npos);
    EXPECT_EQ(html.find("<script src"), std::string::npos);
    EXPECT_EQ(html.find("<link"), std::string::npos);
  }
}

TEST(PageWithoutNpm, SaysWhatIsMissing) {
  if (PagesBuilt()) {
    EXPECT_NO_THROW(MakePage(Page::kReport, "t", "{}"));
    return;
  }
  try {
    MakePage(Page::kReport, "t", "{}");
    FAIL() << "there is nothing to make a page of";
  } catch (const core::UserError& error) {
    ASSERT_EQ(error.problems().size(), 1U);
    EXPECT_NE(error.problems()[0].suggestion.find("npm"), std::string::npos);
  }
}

}  // namespace
}  // namespace rockyard::web
