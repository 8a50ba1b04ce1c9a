#include <gtest/gtest.h>

#include "pipelines/files/html_page.h"
#include "pipelines/report/html_report.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;

// RFC 4648, section 10.
TEST(HtmlPage, Base64MeetsTheTestVectors) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\x00\xfb", 3)), "/wD7");  // bytes have no sign, and zero is one
}

// A title of the user's is text, wherever it stands.
TEST(HtmlPage, TextIsNoMarkup) {
  HtmlPage page("a < b & \"c\"");
  page.heading(1, "<script>");
  page.paragraph("x > 'y'");
  page.table({"<b>"}, {{"<i>"}});
  const auto text = page.text();
  EXPECT_NE(text.find("<title>a &lt; b &amp; &quot;c&quot;</title>"), std::string::npos);
  EXPECT_NE(text.find("<h1>&lt;script&gt;</h1>"), std::string::npos);
  EXPECT_NE(text.find("<p>x &gt; &#39;y&#39;</p>"), std::string::npos);
  EXPECT_NE(text.find("<th>&lt;b&gt;</th>"), std::string::npos);
  EXPECT_NE(text.find("<td>&lt;i&gt;</td>"), std::string::npos);
}

TEST(HtmlPage, PicturesAreInsideIt) {
  const results_test::Directory directory;
  std::ofstream(directory / "p.png", std::ios::binary) << "foobar";
  HtmlPage page("t");
  page.picture(directory / "p.png", "what");
  EXPECT_NE(page.text().find("src=\"data:image/png;base64,Zm9vYmFy\""), std::string::npos);
  const auto before = page.text();
  page.picture(directory / "missing.png", "what");
  EXPECT_EQ(page.text(), before);
}

TEST(HtmlReport, NeedsASummary) {
  const results_test::Directory directory;
  const auto message = [&] {
    try {
      write_html_report(directory.path, directory / "accuracy");
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message().find("there is no such file"), std::string::npos) << message();
  std::ofstream(directory / "summary.json") << "{\"input\": 3";
  EXPECT_NE(message().find("summary.json: is no summary of a run"), std::string::npos) << message();
  std::ofstream(directory / "summary.json") << "{\"input\": {}}";
  EXPECT_NE(message().find("run the scene again"), std::string::npos) << message();
  EXPECT_FALSE(std::filesystem::exists(directory / "report.html"));
}
