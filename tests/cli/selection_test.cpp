#include "selection.hpp"

#include <gtest/gtest.h>

#include "usage_error.hpp"

namespace plumbline {
namespace {

TEST(ParseStep, ReadsDecimalsAndFractions) {
  EXPECT_EQ(parse_step("0.02"), 0.02);
  EXPECT_EQ(parse_step("1/60"), 1.0 / 60);
  EXPECT_EQ(parse_step("1e-3"), 1e-3);
  for (const char* bad : {"", "0", "-1", "1/0", "x", "1/2/3", "1 ", "nan", "inf"}) {
    EXPECT_THROW(parse_step(bad), UsageError) << bad;
  }
}

TEST(ParseParameters, ReadsListsOfValues) {
  const Overrides o = parse_parameters({"v0=0,10,1/2", "e=1"});
  EXPECT_EQ(o.at("v0"), (std::vector<double>{0, 10, 0.5}));
  EXPECT_EQ(o.at("e"), std::vector<double>{1});
  for (const char* bad : {"v0", "=1", "v0=", "v0=1,,2", "v0=nan"}) {
    EXPECT_THROW(parse_parameters({bad}), UsageError) << bad;
  }
}

TEST(NameFilter, AnyPatternSelectsAndAMinusLeavesOut) {
  const std::string slow = "particle/drag_ship/v0=0/row.matched.dt=0.02",
                    box = "particle/falling_box/row.matched.dt=0.02";
  EXPECT_TRUE(name_filter({})(slow));
  EXPECT_TRUE(name_filter({"ship"})(slow));
  EXPECT_FALSE(name_filter({"ship"})(box));
  EXPECT_TRUE(name_filter({"ship", "box"})(box));
  EXPECT_TRUE(name_filter({"-v0=30"})(slow));
  EXPECT_FALSE(name_filter({"ship", "-v0=0"})(slow));
  EXPECT_TRUE(name_filter({"^particle/.*dt=0.02$"})(box));
  EXPECT_THROW(name_filter({"("}), UsageError);
}

TEST(SelectsEngine, ByWholeNameOrByTheLibraryPart) {
  EXPECT_TRUE(selects_engine("lib", "lib-row"));
  EXPECT_TRUE(selects_engine("lib-row", "lib-row"));
  EXPECT_FALSE(selects_engine("li", "lib-row"));
  EXPECT_FALSE(selects_engine("lib-row", "lib"));
}

}  // namespace
}  // namespace plumbline
