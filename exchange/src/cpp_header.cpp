#include <array>
#include <cmath>
#include <cstdio>

#include "output_file.hpp"
#include "plumbline/exchange/motion_export.hpp"

namespace plumbline {
namespace {

// Exact, and a literal of C++17; what is not finite has no literal.
std::string literal(double x) {
  if (std::isnan(x)) return "std::numeric_limits<double>::quiet_NaN()";
  if (std::isinf(x)) return std::string(x < 0 ? "-" : "") + "std::numeric_limits<double>::infinity()";
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%a", x);
  return text.data();
}

std::string string_literal(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20) {
      result += '?';
    } else {
      if (c == '"' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result + '"';
}

// Within a comment to the end of the line: no line break, and no backslash at its end, may carry it on.
std::string in_comment(const std::string& text) {
  std::string result;
  for (const char c : text) result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c == '\\' ? '/' : c;
  return result;
}

// "particle/drag_ship/v0=0" -> "particle_drag_ship_v0_0"
std::string identifier(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'), digit = c >= '0' && c <= '9';
    if (letter || digit) {
      result += c;
    } else if (!result.empty() && result.back() != '_') {
      result += '_';
    }
  }
  while (!result.empty() && result.back() == '_') result.pop_back();
  return "motion_" + result;
}

}  // namespace

void write_cpp_header(const Motion& motion, const std::filesystem::path& file) {
  const std::string counts = std::to_string(motion.times.size()), bodies = std::to_string(motion.names.size());
  std::string text =
      "// " + in_comment(motion.title) + "\n// Source: " + in_comment(motion.source) +
      "\n"
      "// Data computed by Plumbline, under the Apache License 2.0 as Plumbline itself. Written by plumbline "
      "export; do not edit.\n"
      "// SI units, world frame, z up; attitudes w x y z. samples[k * body_count + b] is body b at times[k].\n"
      "#pragma once\n\n#include <cstddef>\n#include <limits>\n\nnamespace plumbline_data::" +
      identifier(motion.title) +
      " {\n\n"
      "struct Sample {\n  double position[3];\n  double attitude[4];\n  double velocity[3];\n  double "
      "angular_velocity[3];\n};\n\n"
      "inline constexpr std::size_t sample_count = " +
      counts + ";\ninline constexpr std::size_t body_count = " + bodies +
      ";\n\ninline constexpr const char* names[] = {";
  for (const std::string& name : motion.names) text += string_literal(name) + ", ";
  text += "};\n\ninline constexpr double times[] = {\n";
  for (const double t : motion.times) text += "    " + literal(t) + ",\n";
  text += "};\n\ninline constexpr Sample samples[] = {\n";
  for (const BodyState& s : motion.states) {
    const auto three = [](const Vec3& v) {
      return "{" + literal(v.x()) + ", " + literal(v.y()) + ", " + literal(v.z()) + "}";
    };
    text += "    {" + three(s.p_WB) + ", {" + literal(s.q_WB.w()) + ", " + literal(s.q_WB.x()) + ", " +
            literal(s.q_WB.y()) + ", " + literal(s.q_WB.z()) + "}, " + three(s.v_WB) + ", " + three(s.w_WB) + "},\n";
  }
  text += "};\n\n}  // namespace plumbline_data::" + identifier(motion.title) + "\n";
  exchange::write_file(file, text);
}

}  // namespace plumbline
