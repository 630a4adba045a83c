// The page's style sheet.
#pragma once

#include <cstddef>
#include <string>

namespace plumbline::reports {

// Colours of curves: Okabe and Ito's, as the variables --c0 .. --c7, adapted to light and dark ground.
inline constexpr std::size_t kCurveColors = 8;

// `tabs` is the largest number of dt's that a case has: each needs a rule that shows its panel.
std::string style_sheet(std::size_t tabs);

}  // namespace plumbline::reports
