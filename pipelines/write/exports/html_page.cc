#include "pipelines/write/exports/html_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

#include "pipelines/base/files/whole_file.h"
#include "pipelines/base/names/typography.h"
#include "pipelines/write/exports/markup.h"

namespace pipelines {
namespace {

constexpr const char* style = R"(
body { font: 15px/1.45 sans-serif; color: #222; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.6rem; margin-bottom: .2rem; } h2 { border-bottom: 1px solid #bbb; margin-top: 2.2rem; }
table { border-collapse: collapse; margin: .6rem 0 1.2rem; }
th, td { padding: .2rem .8rem .2rem 0; text-align: left; vertical-align: top; } th { border-bottom: 1px solid #888; }
tr:nth-child(even) td { background: #f5f5f5; } .number { text-align: right; font-variant-numeric: tabular-nums; }
.warning { background: #fff3d6; border-left: 4px solid #d69e00; padding: .4rem .8rem; }
.verdict { font-size: 1.2rem; font-weight: bold; padding: .4rem .8rem; }
.ok { background: #dff2df; border-left: 6px solid #2c8a2c; } .not-ok { background: #fbdcdc; border-left: 6px solid #c02020; }
.not-judged { background: #fff3d6; border-left: 6px solid #d69e00; } summary { cursor: pointer; }
pre { overflow-x: auto; background: #f5f5f5; padding: .6rem; font-size: 12px; line-height: 1.35; }
@media print { body { font-size: 11px; } h1 { font-size: 1.3rem; } .verdict { font-size: 1rem; } }
img { max-width: 100%; } figure { margin: 1rem 0; } figcaption { color: #555; }
)";

/// "8 h of 20000 h" is a text.
bool is_number(const std::string& cell) {
  return !cell.empty() && (std::isdigit(static_cast<unsigned char>(cell[0])) || cell[0] == '-') &&
         std::none_of(cell.begin(), cell.end(), [](unsigned char c) { return std::isalpha(c) && c != 'e'; });
}

std::string shown(const std::string& text) {
  return escaped(typographic(text));
}

}  // namespace

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) result += k <= n ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return result;
}

void HtmlPage::heading(int level, const std::string& text) {
  body_ += fmt::format("<h{0}>{1}</h{0}>\n", level, shown(text));
}

void HtmlPage::paragraph(const std::string& text) {
  body_ += "<p>" + shown(text) + "</p>\n";
}

void HtmlPage::warning(const std::string& text) {
  body_ += "<p class=\"warning\">" + shown(text) + "</p>\n";
}

void HtmlPage::verdict(const std::string& judgement, const std::string& text) {
  const char* colour = judgement == "OK" ? "ok" : judgement == "NOT OK" ? "not-ok" : "not-judged";
  body_ += fmt::format("<p class=\"verdict {}\">{}</p>\n", colour, shown(text));
}

void HtmlPage::folded(const std::string& title, const std::function<void()>& add) {
  auto before = std::move(body_);
  body_.clear();
  add();
  if (!body_.empty()) before += "<details><summary>" + shown(title) + "</summary>\n" + body_ + "</details>\n";
  body_ = std::move(before);
}

void HtmlPage::preformatted(const std::string& text) {
  body_ += "<pre>" + shown(text) + "</pre>\n";
}

void HtmlPage::table(const ShownRows& table) {
  const auto& [titles, rows] = table;
  if (rows.empty()) return;
  body_ += "<table>\n<tr>";
  for (std::size_t i = 0; i < titles.size(); ++i)
    body_ +=
        fmt::format("<th{}>{}</th>", i < rows[0].size() && is_number(rows[0][i]) ? " class=\"number\"" : "",
                    shown(titles[i]));
  body_ += "</tr>\n";
  for (const auto& row : rows) {
    if (row.empty()) continue;
    body_ += "<tr>";
    for (const auto& cell : row)
      body_ += fmt::format("<td{}>{}</td>", is_number(cell) ? " class=\"number\"" : "", shown(cell));
    body_ += "</tr>\n";
  }
  body_ += "</table>\n";
}

void HtmlPage::picture(const std::filesystem::path& png, const std::string& what_it_shows) {
  const auto bytes = whole_file(png);
  if (!bytes) return;
  body_ += fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
      shown(what_it_shows), base64(*bytes));
}

std::string HtmlPage::text() const {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{}</title>\n<style>{}"
      "</style>\n</head>\n<body>\n{}</body>\n</html>\n",
      escaped(title_), style, body_);
}

}  // namespace pipelines
