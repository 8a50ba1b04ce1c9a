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

/// Nothing is loaded and nothing is sent, whatever a scene's texts hold.
constexpr const char* policy =
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
    "style-src 'unsafe-inline'; img-src data: blob:\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<link rel=\"icon\" href=\"data:,\">";

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
  body_ += "<table>\n<thead><tr>";  // which every printed page repeats
  for (std::size_t i = 0; i < titles.size(); ++i)
    body_ +=
        fmt::format("<th{}>{}</th>", i < rows[0].size() && is_number(rows[0][i]) ? " class=\"number\"" : "",
                    shown(titles[i]));
  body_ += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    if (row.empty()) continue;
    body_ += "<tr>";
    for (const auto& cell : row)
      body_ += fmt::format("<td{}>{}</td>", is_number(cell) ? " class=\"number\"" : "", shown(cell));
    body_ += "</tr>\n";
  }
  body_ += "</tbody>\n</table>\n";
}

void HtmlPage::picture(const std::filesystem::path& png, const std::string& what_it_shows) {
  const auto bytes = whole_file(png);
  if (!bytes) return;
  body_ += fmt::format(
      "<figure><img alt=\"{0}\" "
      "src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
      shown(what_it_shows), base64(*bytes));
}

std::string HtmlPage::text() const {
  const auto script = script_.empty() ? "" : "<script>\n" + script_ + "</script>\n";
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta "
      "charset=\"utf-8\">\n<title>{}</title>\n{}\n<style>\n{}"
      "</style>\n</head>\n<body>\n{}{}</body>\n</html>\n",
      escaped(title_), policy, style_, body_, script);
}

}  // namespace pipelines
