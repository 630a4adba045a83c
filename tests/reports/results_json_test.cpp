#include "plumbline/reports/results_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "approved.hpp"
#include "literal_report.hpp"

namespace plumbline {
namespace {

using testing::file_text;
using testing::fresh_folder;
using ::testing::HasSubstr;
using testing::literal_report;

// The message of the error that reading the text gives; a failure when it is read.
std::string error_of(const std::string& text) {
  const auto path = fresh_folder() / "broken.json";
  std::ofstream(path, std::ios::binary) << text;
  try {
    read_results(path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  ADD_FAILURE() << "was read: " << text.substr(0, 200);
  return "";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what << " is not in the document: the test would prove nothing";
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

TEST(ResultsJson, IsAsApproved) {
  EXPECT_TRUE(testing::matches_approved(results_json(literal_report()), "results.json"));
}

TEST(ResultsJson, ReadAndWrittenAgainGivesTheSameBytes) {
  for (const Report& report : {literal_report(), testing::large_report(), Report{}}) {
    const auto path = fresh_folder() / "deep" / "results.json";
    write_results(report, path);
    EXPECT_EQ(file_text(path), results_json(report));
    EXPECT_EQ(results_json(read_results(path)), file_text(path));
  }
}

TEST(ResultsJson, KeepsConformanceAndReadsFilesFromBeforeIt) {
  const auto path = fresh_folder() / "results.json";
  const Report written = literal_report();
  write_results(written, path);
  const Report read = read_results(path);
  ASSERT_EQ(read.conformance_checks.size(), written.conformance_checks.size());
  EXPECT_EQ(read.conformance_checks[2].tolerance, written.conformance_checks[2].tolerance);
  EXPECT_TRUE(read.conformance_checks[2].matched_only);
  ASSERT_EQ(read.conformance.size(), written.conformance.size());
  for (std::size_t i = 0; i < read.conformance.size(); ++i) {
    const ConformanceResult &a = written.conformance[i], &b = read.conformance[i];
    EXPECT_EQ(a.engine, b.engine);
    EXPECT_EQ(a.profile, b.profile);
    EXPECT_EQ(a.check, b.check);
    EXPECT_EQ(a.verdict, b.verdict);
    EXPECT_EQ(a.text, b.text);
    EXPECT_EQ(a.why, b.why);
  }
  const std::string text = file_text(path);
  std::ofstream(path, std::ios::binary) << text.substr(0, text.find(",\n \"conformance_checks\"")) << "\n}\n";
  const Report older = read_results(path);
  EXPECT_TRUE(older.conformance.empty());
  EXPECT_EQ(older.runs.size(), written.runs.size());
}

TEST(ResultsJson, KeepsEveryFieldOfARun) {
  const auto path = fresh_folder() / "results.json";
  const Report written = literal_report();
  write_results(written, path);
  const Report read = read_results(path);
  ASSERT_EQ(read.runs.size(), written.runs.size());
  for (std::size_t i = 0; i < read.runs.size(); ++i) {
    const RunResult &a = written.runs[i], &b = read.runs[i];
    EXPECT_EQ(a.case_name, b.case_name);
    EXPECT_EQ(a.parameters, b.parameters);
    EXPECT_EQ(a.engine, b.engine);
    EXPECT_EQ(a.profile, b.profile);
    EXPECT_EQ(a.dt, b.dt);
    EXPECT_EQ(a.verdict, b.verdict);
    EXPECT_EQ(a.settings, b.settings);
    ASSERT_EQ(a.metrics.size(), b.metrics.size());
    for (std::size_t k = 0; k < a.metrics.size(); ++k) {
      EXPECT_EQ(a.metrics[k].first, b.metrics[k].first);
      EXPECT_TRUE(a.metrics[k].second == b.metrics[k].second ||
                  (std::isnan(a.metrics[k].second) && std::isnan(b.metrics[k].second)));
    }
    ASSERT_EQ(a.gates.size(), b.gates.size());
    for (std::size_t k = 0; k < a.gates.size(); ++k) {
      EXPECT_EQ(a.gates[k].passed, b.gates[k].passed);
      EXPECT_EQ(a.gates[k].deviation, b.gates[k].deviation);
      EXPECT_EQ(a.gates[k].place.line, b.gates[k].place.line);
    }
    EXPECT_EQ(a.curve.size(), b.curve.size());
    EXPECT_EQ(a.explanation.share, b.explanation.share);
  }
  EXPECT_EQ(read.engines[0].features, written.engines[0].features);
  EXPECT_EQ(read.engines[2].features, written.engines[2].features);
}

TEST(ResultsJson, LeavesNoTemporaryFileBehind) {
  const auto folder = fresh_folder();
  write_results(literal_report(), folder / "results.json");
  write_results(literal_report(), folder / "results.json");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST(ResultsJson, AFailedWriteNamesTheFileAndKeepsTheOldOne) {
  const auto folder = fresh_folder();
  std::ofstream(folder / "file") << "old";
  try {
    write_results(literal_report(), folder / "file" / "results.json");
    FAIL() << "a file was taken for a folder";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr((folder / "file").string()));
  }
  EXPECT_EQ(file_text(folder / "file"), "old");
}

TEST(ResultsJson, RefusesWhatItCannotReadAndNamesTheWayOut) {
  const std::string good = results_json(literal_report());
  EXPECT_THAT(error_of("{}"), HasSubstr("is no results file"));
  EXPECT_THAT(error_of("[]"), HasSubstr("is no results file"));
  EXPECT_THAT(error_of(""), HasSubstr("is not JSON"));
  EXPECT_THAT(error_of(good.substr(0, good.size() / 2)), HasSubstr("cut short at byte"));
  const std::string future = error_of(replaced(good, "plumbline-results/1", "plumbline-results/2"));
  EXPECT_THAT(future, HasSubstr("plumbline-results/2"));
  EXPECT_THAT(future, HasSubstr("plumbline run -o DIR"));
  EXPECT_THAT(error_of(replaced(good, "\"verdict\":\"fail\"", "\"verdict\":\"maybe\"")), HasSubstr("/runs/"));
  EXPECT_THAT(error_of(replaced(good, "\"verdict\":\"fail\",", "")), HasSubstr("/verdict is missing"));
  EXPECT_THAT(error_of(replaced(good, "\"dt\":0.02", "\"dt\":\"soon\"")), HasSubstr("/runs/0/dt: a number"));
  EXPECT_THAT(error_of(replaced(good, "\"interrupted\": false", "\"interrupted\": 0")), HasSubstr("true or false"));
  EXPECT_THAT(error_of(replaced(good, "\"gates\":[{\"metric\"", "\"gates\":[{\"meter\"")),
              HasSubstr("/runs/0/gates/0/metric is missing"));
}

TEST(ResultsJson, AMissingFileIsNamed) {
  const auto path = fresh_folder() / "nothing.json";
  try {
    read_results(path);
    FAIL() << "a missing file was read";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(path.string()));
    EXPECT_THAT(error.what(), HasSubstr("No such file"));
  }
}

}  // namespace
}  // namespace plumbline
