// Text for a terminal: columns, colours, safe characters.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "plumbline/core/verdict.hpp"
#include "plumbline/reports/console.hpp"

namespace plumbline::reports {

// Columns that a UTF-8 text takes (one per code point).
std::size_t columns(std::string_view text);
std::string pad_right(std::string text, std::size_t width);
std::string pad_left(std::string text, std::size_t width);
// At most that many columns; what is cut shows as "..".
std::string shorten(std::string_view text, std::size_t width);

// One line without control characters: what an engine or a file says must not move the cursor. Without Unicode,
// bytes beyond ASCII become '?'.
std::string safe_line(std::string_view text, bool unicode);

// Wraps at spaces; the first line starts with `first`, the others are indented as far.
std::string wrapped(const std::string& first, std::string_view text, std::size_t width);

// Escape sequences, or nothing at all when the style has no colour.
class Paint {
 public:
  explicit Paint(const ConsoleStyle& style) : color_(style.color) {}
  std::string bold(std::string_view text) const { return wrap("1", text); }
  std::string dim(std::string_view text) const { return wrap("2", text); }
  std::string good(std::string_view text) const { return wrap("32", text); }
  std::string bad(std::string_view text) const { return wrap("31", text); }
  std::string verdict(Verdict verdict, std::string_view text) const;

 private:
  std::string wrap(std::string_view code, std::string_view text) const;
  bool color_;
};

}  // namespace plumbline::reports
