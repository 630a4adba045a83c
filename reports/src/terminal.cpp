#include "terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>

namespace plumbline {
namespace {

bool set(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

// The locale that the environment asks for, whether or not the program called setlocale.
bool locale_is_utf8() {
  for (const char* variable : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* const found = std::getenv(variable);
    if (found == nullptr || *found == '\0') continue;
    const std::string_view value = found;
    return value.find("UTF-8") != value.npos || value.find("utf8") != value.npos || value.find("utf-8") != value.npos;
  }
  return false;
}

}  // namespace

ConsoleStyle console_style_for(int file_descriptor) {
  ConsoleStyle style;
  style.unicode = locale_is_utf8();
  if (::isatty(file_descriptor) == 0) {
    style.width = 140;  // a log or a file: room for what explains each row
    return style;
  }
  const char* const term = std::getenv("TERM");
  const bool dumb = term == nullptr || std::string_view(term) == "dumb";
  style.color = !dumb && !set("NO_COLOR");
  winsize size{};
  if (::ioctl(file_descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) style.width = size.ws_col;
  return style;
}

namespace reports {

std::size_t columns(std::string_view text) {
  std::size_t count = 0;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) ++count;
  }
  return count;
}

std::string pad_right(std::string text, std::size_t width) {
  const std::size_t used = columns(text);
  if (used < width) text.append(width - used, ' ');
  return text;
}

std::string pad_left(std::string text, std::size_t width) {
  const std::size_t used = columns(text);
  if (used < width) text.insert(0, width - used, ' ');
  return text;
}

std::string shorten(std::string_view text, std::size_t width) {
  if (columns(text) <= width) return std::string(text);
  if (width <= 2) return std::string(width, '.');
  std::string cut;
  std::size_t used = 0;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U && ++used > width - 2) break;
    cut += c;
  }
  return cut + "..";
}

std::string safe_line(std::string_view text, bool unicode) {
  std::string line;
  line.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool continuation = (c & 0xC0U) == 0x80U;
    if (c < 0x20 || c == 0x7F) {
      line += ' ';
    } else if (c == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0) {
      line += ' ';  // U+0080..U+009F: control characters as well
      ++i;
    } else if (unicode || c < 0x80) {
      line += text[i];
    } else if (!continuation) {
      line += '?';  // one for a character, not one for each of its bytes
    }
  }
  return line;
}

std::string wrapped(const std::string& first, std::string_view text, std::size_t width) {
  const std::size_t indent = columns(first);
  std::string out = first;
  std::size_t used = indent;
  bool fresh = true;  // nothing but the indent stands on this line
  while (!text.empty()) {
    const std::size_t space = text.find(' ');
    const std::string_view word = text.substr(0, space);
    text.remove_prefix(space == text.npos ? text.size() : space + 1);
    if (word.empty()) continue;
    if (!fresh && used + 1 + columns(word) > width) {
      out += '\n' + std::string(indent, ' ');
      used = indent;
      fresh = true;
    }
    if (!fresh) out += ' ';
    out += word;
    used += columns(word) + (fresh ? 0 : 1);
    fresh = false;
  }
  return out + '\n';
}

std::string Paint::wrap(std::string_view code, std::string_view text) const {
  if (!color_ || text.empty()) return std::string(text);
  return "\x1b[" + std::string(code) + "m" + std::string(text) + "\x1b[0m";
}

std::string Paint::verdict(Verdict verdict, std::string_view text) const {
  switch (verdict) {
    case Verdict::kPass:
      return wrap("32", text);
    case Verdict::kExpectedFail:
      return wrap("33", text);
    case Verdict::kUnexpectedPass:
      return wrap("35", text);
    case Verdict::kUnsupported:
      return wrap("2", text);
    case Verdict::kFail:
    case Verdict::kDiverged:
    case Verdict::kNondeterministic:
      return wrap("31", text);
    case Verdict::kCrashed:
    case Verdict::kTimedOut:
    case Verdict::kError:
      return wrap("1;31", text);
  }
  return std::string(text);
}

}  // namespace reports
}  // namespace plumbline
