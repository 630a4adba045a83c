#include "plumbline/adapters/knob_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace plumbline {
namespace {

enum class Law { kCone, kPyramid };

struct Knobs {
  double erp;
  int iterations;
  bool sleeping;
  Law law;
  double stiffness;
};

const KnobTable<Knobs>& table() {
  static const KnobTable<Knobs> kTable =
      KnobTable<Knobs>()
          .add(&Knobs::erp, "erp", 0.2, 0.4, "1", "share of the penetration that a step corrects")
          .add(&Knobs::iterations, "iterations", 10, 50, "", "sweeps")
          .add(&Knobs::sleeping, "sleeping", true, false, "", "stops slow bodies")
          .choose(&Knobs::law, "law", {{"cone", Law::kCone}, {"pyramid", Law::kPyramid}}, "pyramid", "cone", "friction")
          .add(&Knobs::stiffness, "stiffness", 2, 3, "N/m", "how hard")
          .at_least(0.5);
  return kTable;
}

Settings settings(Profile profile) {
  EngineInfo info;
  info.settings = table().rows();
  return settings_of(info, profile);
}

std::string refusal(const std::string& name, const SettingValue& value) {
  Settings changed = settings(Profile::kDefault);
  changed[name] = value;
  try {
    table().read(changed);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(KnobTable, ReadsTheValuesOfEitherProfileIntoTheAdaptersOwnStruct) {
  const Knobs usual = table().read(settings(Profile::kDefault)), matched = table().read(settings(Profile::kMatched));
  EXPECT_EQ(usual.erp, 0.2);
  EXPECT_EQ(usual.iterations, 10);
  EXPECT_TRUE(usual.sleeping);
  EXPECT_EQ(usual.law, Law::kPyramid);
  EXPECT_EQ(matched.erp, 0.4);
  EXPECT_EQ(matched.iterations, 50);
  EXPECT_FALSE(matched.sleeping);
  EXPECT_EQ(matched.law, Law::kCone);
}

TEST(KnobTable, TellsPeopleEverythingOnce) {
  ASSERT_EQ(table().rows().size(), 5U);
  EXPECT_EQ(table().rows()[0].unit, "1");
  EXPECT_EQ(std::get<double>(table().rows()[1].matched_value), 50);
  EXPECT_EQ(std::get<std::string>(table().rows()[3].default_value), "pyramid");
  EXPECT_EQ(table().rows()[3].meaning, "friction");
}

TEST(KnobTable, RefusesWhatAKnobDoesNotTake) {
  EXPECT_EQ(refusal("erp", std::numeric_limits<double>::infinity()), "") << "an infinite limit is a limit";
  EXPECT_EQ(refusal("erp", std::nan("")), "setting 'erp' must be a number, is NaN");
  EXPECT_EQ(refusal("erp", true), "setting 'erp' must be a number");
  for (const double value : {0.5, -1.0, 2e9, std::nan("")}) {
    EXPECT_NE(refusal("iterations", value).find("whole number"), std::string::npos) << value;
  }
  for (const double value : {0.4, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_NE(refusal("stiffness", value).find("'stiffness' must be a finite number, at least 0.5"), std::string::npos);
  }
  EXPECT_EQ(refusal("stiffness", 0.5), "");
  EXPECT_EQ(refusal("sleeping", std::string("yes")), "setting 'sleeping' must be true or false");
  EXPECT_EQ(refusal("law", std::string("box")), "setting 'law' must be one of cone, pyramid, is 'box'");
}

}  // namespace
}  // namespace plumbline
