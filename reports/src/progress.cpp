#include "plumbline/reports/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ostream>

#include "figure.hpp"
#include "terminal.hpp"

namespace plumbline {
namespace {

constexpr double kRedrawInterval = 0.1;  // [s]
constexpr double kLineInterval = 10;     // [s]
constexpr std::string_view kWipe = "\r\x1b[K";

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Progress::Mode Progress::mode_for(int file_descriptor) {
  const char* const term = std::getenv("TERM");
  const bool dumb = term == nullptr || std::string_view(term) == "dumb";
  return ::isatty(file_descriptor) != 0 && !dumb ? Mode::kRedraw : Mode::kLines;
}

Progress::Progress(std::ostream& out, Mode mode, int width, std::function<double()> seconds)
    : out_(out),
      mode_(mode),
      width_(static_cast<std::size_t>(std::max(width, 20))),
      seconds_(seconds ? std::move(seconds) : steady_seconds) {}

Progress::~Progress() { end(); }

void Progress::begin(std::size_t total) {
  end();
  total_ = total;
  start_ = seconds_();
  // A terminal shows the first update at once; a log gets its first line after the interval.
  last_ = mode_ == Mode::kRedraw ? start_ - kRedrawInterval : start_;
  active_ = true;
}

std::string Progress::line(std::size_t done, std::string_view current, const VerdictCounts& counts) const {
  const std::string total = std::to_string(total_);
  std::size_t failed = 0;
  for (const VerdictRow& row : verdict_table()) {
    if (row.breaks_build) failed += counts[static_cast<std::size_t>(row.verdict)];
  }
  std::string tail = " ...";
  if (failed > 0) tail += fmt::format(" {} failed,", failed);
  const double elapsed = seconds_() - start_;
  if (done > 0 && done < total_) {
    // The runs that are left take as long as those that are done took, on average.
    const double left = elapsed / static_cast<double>(done) * static_cast<double>(total_ - done);
    const double seconds = std::max(1.0, std::ceil(left));
    tail += " ETA " + (seconds < 10 ? fmt::format("{:.0f} s", seconds) : reports::duration(seconds));
  } else {
    tail += " " + reports::duration(elapsed);
  }
  const std::string head = fmt::format("[{:>{}}/{}] ", done, total.size(), total);
  const std::size_t taken = head.size() + tail.size();
  const std::size_t room = width_ > taken + 1 ? width_ - taken - 1 : 0;  // the last column stays free: no wrapping
  return head + reports::shorten(reports::safe_line(current, true), room) + tail;
}

void Progress::update(std::size_t done, std::string_view current, const VerdictCounts& counts) {
  if (!active_ || mode_ == Mode::kSilent) return;
  const double now = seconds_();
  if (now - last_ < (mode_ == Mode::kRedraw ? kRedrawInterval : kLineInterval)) return;
  last_ = now;
  if (mode_ == Mode::kRedraw) {
    out_ << kWipe << line(done, current, counts) << std::flush;
    drawn_ = true;
  } else {
    out_ << line(done, current, counts) << std::endl;
  }
}

void Progress::end() {
  if (drawn_) out_ << kWipe << std::flush;
  drawn_ = false;
  active_ = false;
}

}  // namespace plumbline
