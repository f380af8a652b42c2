#include "web/page.h"

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "web/gunzip.h"

namespace rockyard::web {
namespace {

#ifdef ROCKYARD_HAS_PAGES  // from CMake, so that pages that got lost are noticed

TEST(Page, HoldsItsDataWhole) {
  const std::string json = R"({"title":"narrow","values":[1,null,2.5]})";
  for (const Page page : {Page::kReport, Page::kReplay}) {
    EXPECT_EQ(test::PayloadOf(MakePage(page, "narrow", json)), json);
  }
}

TEST(Page, DataAndTitleAreNeverMarkup) {
  const std::string hostile = "</script><script>alert(1)</script><!-- payload -->";
  const std::string html = MakePage(Page::kReport, hostile, "{\"title\":\"" + hostile + "\"}");
  EXPECT_EQ(html.find("alert(1)</script>"), std::string::npos);
  EXPECT_NE(html.find("<title>&lt;/script&gt;"), std::string::npos);
  EXPECT_EQ(test::PayloadOf(html), "{\"title\":\"" + hostile + "\"}");
}

// A page that could fetch anything would not be self-contained.
TEST(Page, ForbidsTheNetwork) {
  for (const Page page : {Page::kReport, Page::kReplay}) {
    const std::string html = MakePage(page, "t", "{}");
    EXPECT_NE(
        html.find("Content-Security-Policy\" content=\"default-src 'none'; script-src 'sha256-"),
        std::string::npos);
    EXPECT_EQ(html.find("<script src"), std::string::npos);
    EXPECT_EQ(html.find("<link"), std::string::npos);
  }
}

TEST(Page, IsThere) { EXPECT_TRUE(PagesBuilt()); }

// The licences of the bundled packages ask for it.
TEST(Page, CarriesTheNoticesOfItsPackages) {
  const std::string report = MakePage(Page::kReport, "t", "{}");
  for (const char* words : {"Mike Bostock", "Oli Folkerd", "Permission to use, copy, modify",
                            "Permission is hereby granted"}) {
    EXPECT_NE(report.find(words), std::string::npos) << words;
  }
  EXPECT_NE(MakePage(Page::kReplay, "t", "{}").find("three.js authors"), std::string::npos);
}

#else

TEST(PageWithoutNpm, SaysWhatIsMissing) {
  EXPECT_FALSE(PagesBuilt());
  try {
    MakePage(Page::kReport, "t", "{}");
    FAIL() << "there is nothing to make a page of";
  } catch (const core::UserError& error) {
    ASSERT_EQ(error.problems().size(), 1U);
    EXPECT_NE(error.problems()[0].suggestion.find("npm"), std::string::npos);
  }
}

#endif

}  // namespace
}  // namespace rockyard::web
