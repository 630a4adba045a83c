#include "variants.hpp"

#include <gtest/gtest.h>

#include "usage_error.hpp"

namespace plumbline {
namespace {

EngineInventory inventory() {
  EngineInventory engines;
  EngineInfo one;
  one.name = "lib-one";
  one.settings = {{"erp", 0.2, 0.0, "1", "correction"}, {"sleeping", true, false, "", "sleeps"}};
  EngineInfo two = one;
  two.name = "lib-two";
  two.settings.push_back({"law", std::string("cone"), std::string("cone"), "", "friction"});
  Deviation for_all, for_one;
  for_one.engines = {"lib-one"};
  engines.rows = {{one, 0, {for_all, for_one}}, {two, 0, {}}};
  return engines;
}

std::vector<std::string> names(const EngineInventory& engines) {
  std::vector<std::string> result;
  for (const EngineRow& row : engines.rows) result.push_back(row.info.name);
  return result;
}

std::string refusal(const std::vector<std::string>& arguments) {
  EngineInventory engines = inventory();
  try {
    vary_settings(engines, parse_settings(arguments));
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(Variants, AreOneRowForEachCombinationOfValues) {
  EngineInventory engines = inventory();
  vary_settings(engines, parse_settings({"lib.erp=0,1/4", "lib-two.law=pyramid"}));
  EXPECT_EQ(names(engines), (std::vector<std::string>{"lib-one@erp=0", "lib-one@erp=1/4", "lib-two@erp=0,law=pyramid",
                                                      "lib-two@erp=1/4,law=pyramid"}));
  const EngineRow& row = engines.rows[3];
  EXPECT_EQ(row.worker_name, "lib-two");
  EXPECT_EQ(row.changed.at("erp"), SettingValue(0.25));
  EXPECT_EQ(row.changed.at("law"), SettingValue(std::string("pyramid")));
  for (const Profile profile : {Profile::kDefault, Profile::kMatched}) {
    EXPECT_EQ(settings_of(row.info, profile).at("erp"), SettingValue(0.25));
    EXPECT_EQ(settings_of(row.info, profile).at("sleeping"), SettingValue(profile == Profile::kDefault));
  }
}

TEST(Variants, LeaveRowsAloneThatAreNotMeant) {
  EngineInventory engines = inventory();
  vary_settings(engines, parse_settings({"lib.law=box"}));
  EXPECT_EQ(names(engines), (std::vector<std::string>{"lib-one", "lib-two@law=box"}));
  EXPECT_TRUE(engines.rows[0].changed.empty());
}

TEST(Variants, KeepTheDeviationsOfTheirRow) {
  EngineInventory engines = inventory();
  vary_settings(engines, parse_settings({"lib-one.sleeping=false"}));
  EXPECT_TRUE(engines.rows[0].deviations[0].engines.empty());
  EXPECT_EQ(engines.rows[0].deviations[1].engines, (std::vector<std::string>{"lib-one@sleeping=false"}));
}

TEST(Variants, SayWhatIsWrongAndTheWayOut) {
  for (const char* form : {"lib", "lib.erp", "lib.erp=", "=1", ".erp=1", "lib.=1", "liberp=1.5"}) {
    EXPECT_EQ(refusal({form}),
              std::string("--set ") + form + ": write ENGINE.OPTION=VALUE or ENGINE.OPTION=VALUE,VALUE,...");
  }
  EXPECT_EQ(refusal({"lib.erp=1,,2"}), "--set lib.erp=1,,2: a value is empty; write VALUE,VALUE,...");
  EXPECT_EQ(refusal({"lib.erp=1,1"}), "--set lib.erp=1,1: the value 1 is there twice");
  EXPECT_EQ(refusal({"lib.erp=1", "lib.erp=2"}), "--set lib.erp=2: lib.erp is set twice; give all its values at once");
  EXPECT_EQ(refusal({"other.erp=1"}), "--set other.erp=1: no engine 'other' is selected; there are lib-one, lib-two");
  EXPECT_EQ(refusal({"lib.erq=1"}),
            "--set lib.erq=1: lib has no setting 'erq'; it has erp, sleeping, law (plumbline list --settings)");
  EXPECT_EQ(refusal({"lib.erp=fast"}), "--set lib.erp=fast: 'fast' is no number");
  EXPECT_EQ(refusal({"lib.sleeping=1"}), "--set lib.sleeping=1: '1' is neither true nor false");
}

}  // namespace
}  // namespace plumbline
