#include "web/page.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "core/base64.h"
#include "web/gunzip.h"

namespace rockyard::web {
namespace {

void Fill(std::string& text, std::string_view mark, const std::string& value) {
  const std::size_t at = text.find(mark);
  ASSERT_NE(at, std::string::npos) << mark;
  text.replace(at, mark.size(), value);
}

TEST(Page, HoldsItsDataWhole) {
  const std::string json = R"({"title":"narrow","values":[1,null,2.5]})";
  for (const Page page : {Page::kReport, Page::kReplay, Page::kBench}) {
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
  for (const Page page : {Page::kReport, Page::kReplay, Page::kBench}) {
    const std::string html = MakePage(page, "t", "{}");
    EXPECT_NE(
        html.find("Content-Security-Policy\" content=\"default-src 'none'; script-src 'sha256-"),
        std::string::npos);
    EXPECT_EQ(html.find("<script src"), std::string::npos);
    EXPECT_EQ(html.find("<link"), std::string::npos);
  }
}

// Beside its title and its data a page is what was bundled, byte for byte.
TEST(Page, IsTheShippedOne) {
  for (const auto& [page, file] :
       {std::pair{Page::kReport, "report"}, {Page::kReplay, "replay"}, {Page::kBench, "bench"}}) {
    const std::string path = std::string(ROCKYARD_PAGES) + "/" + file + ".html";
    std::ifstream stream(path, std::ios::binary);
    std::string shipped((std::istreambuf_iterator<char>(stream)), {});
    ASSERT_GT(shipped.size(), 20000U) << path;
    const std::string made = MakePage(page, "t", "{}");
    Fill(shipped, "<!-- title -->", "t");
    Fill(shipped, "<!-- payload -->", core::Base64(Gzip("{}")));
    EXPECT_TRUE(made == shipped) << path;  // too long to be shown
  }
}

// The licences of the bundled packages ask for it.
TEST(Page, CarriesTheNoticesOfItsPackages) {
  const std::string report = MakePage(Page::kReport, "t", "{}");
  for (const char* words : {"Mike Bostock", "Oli Folkerd", "Permission to use, copy, modify",
                            "Permission is hereby granted"}) {
    EXPECT_NE(report.find(words), std::string::npos) << words;
  }
  EXPECT_NE(MakePage(Page::kReplay, "t", "{}").find("three.js authors"), std::string::npos);
}

}  // namespace
}  // namespace rockyard::web
