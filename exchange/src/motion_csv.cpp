#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "output_file.hpp"
#include "plumbline/exchange/motion_export.hpp"

namespace plumbline {
namespace {

constexpr std::string_view kHeader = "t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz";
constexpr std::size_t kColumns = 15;

std::array<double, 13> numbers_of(const BodyState& s) {
  return {s.p_WB.x(), s.p_WB.y(), s.p_WB.z(), s.q_WB.w(), s.q_WB.x(), s.q_WB.y(), s.q_WB.z(),
          s.v_WB.x(), s.v_WB.y(), s.v_WB.z(), s.w_WB.x(), s.w_WB.y(), s.w_WB.z()};
}

BodyState state_from(const std::array<double, 13>& n) {
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5], n[6]}, {n[7], n[8], n[9]}, {n[10], n[11], n[12]}};
}

// A name with a comma, a quote or a line break is quoted as in RFC 4180.
std::string quoted_name(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"') text += '"';
    text += c;
  }
  return text + '"';
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file), in_(file, std::ios::binary) {
    if (!in_) throw std::invalid_argument(file.string() + ": cannot be read");
  }

  Motion read() {
    Motion motion;
    motion.title = file_.stem().string();
    motion.source = file_.filename().string();
    if (!next_row() || joined_row() != kHeader)
      fail("is no trajectory: its first line must be " + std::string(kHeader));
    while (next_row()) add_row(motion);
    if (motion.times.empty()) fail("has no rows");
    if (body_ != motion.names.size()) fail("ends within a sample: the last one lacks bodies");
    return motion;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::invalid_argument(file_.string() + ":" + std::to_string(line_) + ": " + what);
  }

  // One record, which may span lines where a name has line breaks.
  bool next_row() {
    cells_.assign(1, "");
    bool in_quotes = false, any = false;
    ++line_;
    for (int c = in_.get(); c != std::ifstream::traits_type::eof(); c = in_.get()) {
      any = true;
      const char letter = static_cast<char>(c);
      if (in_quotes) {
        if (letter == '"' && in_.peek() == '"') {
          cells_.back() += static_cast<char>(in_.get());
        } else if (letter == '"') {
          in_quotes = false;
        } else {
          cells_.back() += letter;
        }
      } else if (letter == '"') {
        in_quotes = true;
      } else if (letter == ',') {
        cells_.emplace_back();
      } else if (letter == '\n') {
        return true;
      } else if (letter != '\r') {
        cells_.back() += letter;
      }
    }
    if (in_quotes) fail("ends within a quoted name");
    return any;
  }
  std::string joined_row() const {
    std::string text;
    for (const std::string& cell : cells_) text += (text.empty() ? "" : ",") + cell;
    return text;
  }

  double number(std::size_t column) const {
    const std::string& text = cells_[column];
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
      fail("'" + text + "' in column " + std::to_string(column + 1) + " is no number");
    }
    return value;
  }

  void add_row(Motion& motion) {
    if (cells_.size() != kColumns) {
      fail("has " + std::to_string(cells_.size()) + " columns instead of " + std::to_string(kColumns));
    }
    const double t = number(0);
    // The first sample names the bodies; every other repeats them.
    if (motion.times.size() <= 1 && (motion.times.empty() || t == motion.times.front())) {
      if (motion.times.empty()) motion.times.push_back(t);
      motion.names.push_back(cells_[1]);
      body_ = motion.names.size();
    } else {
      if (body_ == motion.names.size()) {
        if (!(t > motion.times.back())) fail("goes back in time");
        motion.times.push_back(t);
        body_ = 0;
      }
      if (t != motion.times.back() || cells_[1] != motion.names[body_]) {
        fail("should be body '" + motion.names[body_] + "' of the sample before the next one begins");
      }
      ++body_;
    }
    std::array<double, 13> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = number(i + 2);
    motion.states.push_back(state_from(numbers));
  }

  std::filesystem::path file_;
  std::ifstream in_;
  std::size_t line_ = 0, body_ = 0;
  std::vector<std::string> cells_;
};

}  // namespace

Motion read_motion_csv(const std::filesystem::path& file) { return Reader(file).read(); }

void write_csv(const Motion& motion, const std::filesystem::path& file) {
  std::string text(kHeader);
  text += '\n';
  for (std::size_t k = 0; k < motion.times.size(); ++k) {
    for (std::size_t b = 0; b < motion.names.size(); ++b) {
      text += shortest(motion.times[k]) + ',' + quoted_name(motion.names[b]);
      for (const double x : numbers_of(motion.at(k, b))) text += ',' + shortest(x);
      text += '\n';
    }
  }
  exchange::write_file(file, text);
}

}  // namespace plumbline
