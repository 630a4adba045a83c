// The picture of a case: error against time, every engine, one dt.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "plumbline/core/run_result.hpp"

namespace plumbline::reports {

// An engine looks the same in every picture of the page: its place in the report picks colour and marker.
class CurveLooks {
 public:
  explicit CurveLooks(const Report& report);
  std::size_t index(std::string_view engine) const;

 private:
  std::vector<std::string> engines_;
};

// Inline SVG with a logarithmic error axis. Errors of exactly zero lie on a floor line below the smallest decade; a
// curve that stops being finite ends in a cross at the upper edge. A sentence instead of a picture when there is no
// curve.
std::string error_chart(const std::vector<const RunResult*>& runs, const CurveLooks& looks, const std::string& title);

// One entry per engine that has a curve, with colour and marker, and what solid and dashed mean.
std::string chart_legend(const std::vector<const RunResult*>& runs, const CurveLooks& looks);

}  // namespace plumbline::reports
