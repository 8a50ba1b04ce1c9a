/// A page of HTML that stands on its own: text, tables, pictures and script inside it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pipelines/base/fields/field_outputs.h"

namespace pipelines {

/// Bytes as text, RFC 4648 section 4.
std::string base64(const std::string& bytes);

class HtmlPage {
public:
  /// @param style, script  of the page itself. No other may run in it, and it may load nothing but the
  ///                       pictures inside it: a policy of its own forbids the rest
  explicit HtmlPage(std::string title, std::string style = "", std::string script = "")
      : title_(std::move(title)), style_(std::move(style)), script_(std::move(script)) {}

  /// Adds markup as it stands.
  void markup(const std::string& html) { body_ += html; }

  /// @param level  1: the page's title, 2, 3
  void heading(int level, const std::string& text);
  void paragraph(const std::string& text);
  void warning(const std::string& text);
  /// A box that is green, yellow or red.
  /// @param judgement  "OK", "NOT JUDGED", "NOT OK"
  void verdict(const std::string& judgement, const std::string& text);
  /// What `add` adds, behind a line that opens it; nothing if it adds nothing. In print it stays as it is.
  void folded(const std::string& title, const std::function<void()>& add);
  /// Adds a text as it stands, in letters of one width.
  void preformatted(const std::string& text);
  /// Cells that begin with a digit or sign and have no words stand to the right. Rows without cells are left
  /// out.
  void table(const ShownRows& rows);
  /// The bytes of a PNG file become part of the page; nothing if there is no such file.
  void picture(const std::filesystem::path& png, const std::string& what_it_shows);

  std::string text() const;

private:
  std::string title_, style_, script_, body_;
};

}  // namespace pipelines
