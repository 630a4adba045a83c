#include "plumbline/reports/trajectory_csv.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "text_file.hpp"

namespace plumbline {
namespace {

constexpr std::string_view kHeader = "t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n";

// The longest shortest double has 24 characters ("-2.2250738585072014e-308").
constexpr std::size_t kNumberRoom = 24;

std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"') text += '"';
    text += c;
  }
  return text + '"';
}

class Rows {
 public:
  Rows(std::size_t rows, std::size_t longest_name) {
    buffer_.resize(kHeader.size() + rows * (14 * (kNumberRoom + 1) + longest_name + 1));
    put(kHeader);
  }
  void put(std::string_view text) {
    text.copy(buffer_.data() + size_, text.size());
    size_ += text.size();
  }
  void put(double value, char after) {
    if (std::isnan(value)) {
      put("nan");  // to_chars would tell "-nan" from "nan", which says nothing
    } else {
      char* const begin = buffer_.data() + size_;
      size_ += static_cast<std::size_t>(std::to_chars(begin, begin + kNumberRoom, value).ptr - begin);
    }
    buffer_[size_++] = after;
  }
  std::string_view text() const { return {buffer_.data(), size_}; }

 private:
  std::string buffer_;
  std::size_t size_ = 0;
};

}  // namespace

void write_trajectory(const Trajectory& trajectory, const Scenario& scenario, const std::filesystem::path& path) {
  if (trajectory.bodies() != scenario.bodies.size()) {
    throw std::invalid_argument(path.string() + ": the trajectory has " + std::to_string(trajectory.bodies()) +
                                " bodies, the scenario " + scenario.id + " has " +
                                std::to_string(scenario.bodies.size()));
  }
  std::vector<std::string> names;
  std::size_t longest = 0;
  for (const Body& body : scenario.bodies) {
    names.push_back(quoted(body.name) + ',');
    longest = std::max(longest, names.back().size());
  }

  Rows rows(trajectory.states().size(), longest);
  for (std::size_t k = 0; k < trajectory.samples(); ++k) {
    for (std::size_t b = 0; b < trajectory.bodies(); ++b) {
      const BodyState& s = trajectory.at(k, b);
      rows.put(trajectory.time(k), ',');
      rows.put(names[b]);
      const std::array<double, 13> values = {s.p_WB.x(), s.p_WB.y(), s.p_WB.z(), s.q_WB.w(), s.q_WB.x(),
                                             s.q_WB.y(), s.q_WB.z(), s.v_WB.x(), s.v_WB.y(), s.v_WB.z(),
                                             s.w_WB.x(), s.w_WB.y(), s.w_WB.z()};
      for (std::size_t i = 0; i < values.size(); ++i) rows.put(values[i], i + 1 < values.size() ? ',' : '\n');
    }
  }
  reports::write_file(path, rows.text());
}

}  // namespace plumbline
