#include "html_text.hpp"

#include <algorithm>

#include "figure.hpp"

namespace plumbline::reports {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

// Length of the well-formed UTF-8 sequence at the start of the text; 0 when there is none.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC2 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  }
  // Overlong forms, surrogates and what lies beyond U+10FFFF.
  if (length == 3 && lead == 0xE0 && byte(1) < 0xA0) return 0;
  if (length == 3 && lead == 0xED && byte(1) >= 0xA0) return 0;
  if (length == 4 && lead == 0xF0 && byte(1) < 0x90) return 0;
  if (length == 4 && lead == 0xF4 && byte(1) >= 0x90) return 0;
  return length;
}

std::string ascii_escaped(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    case '\n':
      return "\n";
    default:
      return std::string(1, static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c);
  }
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size() + text.size() / 8);
  while (!text.empty()) {
    const std::size_t length = sequence_length(text);
    if (length == 0) {
      out += kReplacement;
      text.remove_prefix(1);
      continue;
    }
    if (length == 1) {
      out += ascii_escaped(text.front());
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(length);
  }
  return out;
}

std::string link_to(std::string_view path) {
  constexpr std::string_view kPlain = "-._~/=,+";
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string out = "./";  // so that nothing in front of a colon can be taken for a protocol
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool alphanumeric = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    if (alphanumeric || kPlain.find(c) != kPlain.npos) {
      out += c;
    } else {
      out += {'%', kHex[byte >> 4U], kHex[byte & 15U]};
    }
  }
  return out;
}

std::string_view verdict_symbol(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPass:
      return "✓";
    case Verdict::kFail:
      return "✗";
    case Verdict::kExpectedFail:
      return "≈";
    case Verdict::kUnexpectedPass:
      return "!";
    case Verdict::kUnsupported:
      return "–";
    case Verdict::kDiverged:
      return "∞";
    case Verdict::kCrashed:
      return "†";
    case Verdict::kTimedOut:
      return "…";
    case Verdict::kNondeterministic:
      return "≠";
    case Verdict::kError:  // the selector behind the sign asks for text, not for a picture

      return "⚠\xEF\xB8\x8E";
  }
  return "?";
}

std::string verdict_class(Verdict verdict) { return "v-" + std::string(verdict_name(verdict)); }

std::string verdict_badge(Verdict verdict) {
  return "<span class=\"badge " + verdict_class(verdict) + "\" title=\"" + escaped(row_of(verdict).meaning) +
         "\"><span aria-hidden=\"true\">" + std::string(verdict_symbol(verdict)) + "</span> " +
         std::string(verdict_name(verdict)) + "</span>";
}

std::string number_cell(const RunResult& run, std::string_view metric) {
  if (!has_metric(run, metric)) return "<td class=\"n none\"><abbr title=\"not measured\">–</abbr></td>";
  return "<td class=\"n\">" + three_digits(run.metric(metric)) + "</td>";
}

}  // namespace plumbline::reports
