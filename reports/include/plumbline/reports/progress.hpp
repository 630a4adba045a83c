// One line that says how far a comparison is.
#pragma once

#include <array>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

#include "plumbline/core/verdict.hpp"

namespace plumbline {

// How many runs ended with each verdict, indexed by Verdict.
using VerdictCounts = std::array<std::size_t, kVerdictCount>;

// Not thread-safe: one thread reports.
class Progress {
 public:
  enum class Mode {
    kRedraw,  // a terminal: one line, drawn anew at most ten times a second
    kLines,   // no terminal: a plain line every ten seconds
    kSilent,
  };
  // kRedraw when the file descriptor is a terminal that can redraw, kLines otherwise.
  static Mode mode_for(int file_descriptor);

  // `seconds` tells the time [s] from any fixed point on; by default it is the steady clock.
  Progress(std::ostream& out, Mode mode, int width = 80, std::function<double()> seconds = {});
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();  // ends the display, so that an exception leaves a clean line

  void begin(std::size_t total);
  // `current` is what has just ended or is running, as "collision/two_sphere bullet-f32".
  void update(std::size_t done, std::string_view current, const VerdictCounts& counts);
  // Wipes the line. Calling it twice does no harm.
  void end();

 private:
  std::string line(std::size_t done, std::string_view current, const VerdictCounts& counts) const;

  std::ostream& out_;
  Mode mode_;
  std::size_t width_;
  std::function<double()> seconds_;
  std::size_t total_ = 0;
  double start_ = 0;    // [s]
  double last_ = 0;     // when the last line was written [s]
  bool drawn_ = false;  // something stands on the terminal's line
  bool active_ = false;
};

}  // namespace plumbline
