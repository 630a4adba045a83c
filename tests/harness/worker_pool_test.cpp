// Real worker processes that misbehave: each costs its own run and nothing else.
#include "plumbline/harness/worker_pool.hpp"

#include <gtest/gtest.h>

#include <map>

#include "free_flight.hpp"

namespace plumbline {
namespace {

using testing_support::free_flight;
using End = RunOutcome::End;

class WorkerPoolTest : public ::testing::Test {
 protected:
  RunRequest request(const std::string& engine) {
    return {0, engine, Profile::kMatched, 0.01, &input_.scenario, input_.text.get(), input_.file};
  }

  std::map<std::size_t, RunOutcome> run(const std::vector<std::string>& engines, double limit_seconds, unsigned jobs) {
    std::vector<RunRequest> requests;
    for (const auto& engine : engines) requests.push_back(request(engine));
    std::map<std::size_t, RunOutcome> outcomes;
    pool_.run(
        requests, jobs, WorkerPool::Seconds(limit_seconds),
        [&](std::size_t i, RunOutcome outcome) {
          EXPECT_FALSE(outcomes.contains(i)) << "request " << i << " was answered twice";
          outcomes[i] = std::move(outcome);
        },
        stop_);
    return outcomes;
  }

  CaseInput input_ = free_flight();
  WorkerPool pool_{{PLUMBLINE_FAKE_WORKER}};
  std::atomic<bool> stop_ = false;
};

TEST_F(WorkerPoolTest, KnowsTheEnginesOfEveryProgram) {
  ASSERT_EQ(pool_.programs().size(), 1u);
  EXPECT_EQ(pool_.programs()[0].problem, "");
  EXPECT_GT(pool_.programs()[0].engines.size(), 5u);
}

TEST_F(WorkerPoolTest, AWorkerThatDiesCostsItsOwnRunOnly) {
  const auto outcomes =
      run({"fake-honest", "fake-aborts", "fake-honest", "fake-segfaults", "fake-exits", "fake-honest"}, 30, 2);
  ASSERT_EQ(outcomes.size(), 6u);
  for (std::size_t i : {0u, 2u, 5u}) EXPECT_EQ(outcomes.at(i).end, End::kAnswered) << outcomes.at(i).reason;
  EXPECT_EQ(outcomes.at(1).end, End::kCrashed);
  EXPECT_NE(outcomes.at(1).reason.find("signal 6"), std::string::npos) << outcomes.at(1).reason;
  EXPECT_EQ(outcomes.at(4).end, End::kCrashed);
  EXPECT_EQ(outcomes.at(4).reason, "exited with status 5");
  EXPECT_EQ(outcomes.at(3).end, End::kCrashed);
}

TEST_F(WorkerPoolTest, AWorkerThatHangsIsStoppedAtTheLimit) {
  const auto outcomes = run({"fake-hangs", "fake-honest"}, 0.5, 1);
  EXPECT_EQ(outcomes.at(0).end, End::kTimedOut);
  EXPECT_EQ(outcomes.at(0).reason, "no answer within 0.5 s");
  EXPECT_EQ(outcomes.at(1).end, End::kAnswered);
}

TEST_F(WorkerPoolTest, AnExceptionIsAnErrorWithItsText) {
  const auto outcomes = run({"fake-throws", "fake-honest"}, 30, 1);
  EXPECT_EQ(outcomes.at(0).end, End::kError);
  EXPECT_EQ(outcomes.at(0).reason, "the solver lost its matrix");
  EXPECT_EQ(outcomes.at(1).end, End::kAnswered);
}

TEST_F(WorkerPoolTest, NaNArrivesAndEndsTheRecording) {
  const auto outcomes = run({"fake-nan"}, 30, 1);
  ASSERT_EQ(outcomes.at(0).end, End::kAnswered);
  EXPECT_EQ(outcomes.at(0).recording.not_finite_at, 3u);
  EXPECT_TRUE(std::isnan(outcomes.at(0).recording.trajectory.at(3, 0).v_WB.x()));
}

TEST_F(WorkerPoolTest, WhatAnEnginePrintsIsKeptAndDoesNoHarm) {
  const auto outcomes = run({"fake-chatty"}, 30, 1);
  ASSERT_EQ(outcomes.at(0).end, End::kAnswered) << outcomes.at(0).reason;
  EXPECT_NE(outcomes.at(0).messages.find("banner on standard output"), std::string::npos);
  EXPECT_NE(outcomes.at(0).messages.find("warning on standard error"), std::string::npos);
}

TEST_F(WorkerPoolTest, TheSameBitsComeThroughThePipeAsInThisProcess) {
  const auto outcomes = run({"fake-honest", "fake-honest"}, 30, 2);
  const auto &a = outcomes.at(0).recording.trajectory, &b = outcomes.at(1).recording.trajectory;
  ASSERT_EQ(a.samples(), 101u);
  for (std::size_t k = 0; k < a.samples(); ++k) EXPECT_EQ(a.at(k, 0).p_WB, b.at(k, 0).p_WB);
}

TEST_F(WorkerPoolTest, StopsHandingOutWorkWhenAsked) {
  std::vector<RunRequest> requests(50, request("fake-honest"));
  std::size_t done = 0;
  pool_.run(
      requests, 1, WorkerPool::Seconds(30), [&](std::size_t, RunOutcome) { stop_ = ++done == 3; }, stop_);
  EXPECT_EQ(done, 3u);
}

TEST_F(WorkerPoolTest, CallsGoTheWayOfRunsAndCostTheirOwnAnswerOnly) {
  const auto check = [](const std::string& engine, const std::string& name) {
    return CallRequest{0, "conformance.run", {{"engine", engine}, {"profile", "matched"}, {"check", name}}};
  };
  const std::string gravity = "gravity_pulls_where_it_is_stated";
  const std::vector<CallRequest> requests = {{0, "conformance.list", nlohmann::json::object()},
                                             check("fake-honest", gravity),
                                             check("fake-aborts", gravity),
                                             check("fake-honest", "no_such_check"),
                                             check("fake-throws", gravity),
                                             {0, "no.such.method", {}},
                                             check("fake-honest", gravity)};
  std::map<std::size_t, CallOutcome> outcomes;
  pool_.call(
      requests, 2, WorkerPool::Seconds(30),
      [&](std::size_t i, CallOutcome outcome) { outcomes[i] = std::move(outcome); }, stop_);
  ASSERT_EQ(outcomes.size(), requests.size());
  EXPECT_GT(outcomes[0].result.at("checks").size(), 20u);
  EXPECT_EQ(outcomes[1].result.at("outcome"), "holds") << outcomes[1].result;
  EXPECT_EQ(outcomes[2].end, End::kCrashed);
  EXPECT_EQ(outcomes[3].end, End::kError);
  EXPECT_NE(outcomes[3].reason.find("no_such_check"), std::string::npos) << outcomes[3].reason;
  EXPECT_EQ(outcomes[4].end, End::kError);
  EXPECT_EQ(outcomes[4].reason, "the solver lost its matrix");
  EXPECT_EQ(outcomes[5].end, End::kError);
  EXPECT_EQ(outcomes[6].end, End::kAnswered);
}

TEST(WorkerPool, AProgramThatIsNoWorkerIsNamedAndLeftOut) {
  const std::string folder = PLUMBLINE_BROKEN_WORKERS "/plumbline-engine-";
  const WorkerPool pool(
      {folder + "garbage", folder + "greedy", folder + "quitter", folder + "absent", PLUMBLINE_FAKE_WORKER},
      WorkerPool::Seconds(20));
  const auto& programs = pool.programs();
  ASSERT_EQ(programs.size(), 5u);
  EXPECT_NE(programs[0].problem, "");
  EXPECT_NE(programs[1].problem.find("larger block"), std::string::npos) << programs[1].problem;
  EXPECT_NE(programs[2].problem.find("status 127"), std::string::npos) << programs[2].problem;
  EXPECT_NE(programs[2].problem.find("cannot load libengine.so"), std::string::npos) << programs[2].problem;
  EXPECT_NE(programs[3].problem, "");
  EXPECT_EQ(programs[4].problem, "");
}

}  // namespace
}  // namespace plumbline
