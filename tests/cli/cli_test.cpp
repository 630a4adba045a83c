// The program as its user meets it: exit codes, messages, files.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "usage_error.hpp"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  int code = -1;
  std::string out, err;
};

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Cli : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("plumbline-cli-" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Runs the program in the test's own folder.
  Outcome plumbline(const std::string& arguments, const std::string& environment = "") {
    const std::string command = "cd '" + folder_.string() + "' && " + environment + " '" PLUMBLINE_PROGRAM "' " +
                                arguments + " >out.txt 2>err.txt </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder_ / "out.txt"), text_of(folder_ / "err.txt")};
  }

  // Most fakes would fail the conformance kit, or keep it busy: runs go without it unless a test says otherwise.
  Outcome with_fakes(const std::string& arguments) {
    const bool runs = arguments.starts_with("run");
    return all_with_fakes(runs ? arguments + " --no-conformance" : arguments);
  }
  Outcome all_with_fakes(const std::string& arguments) {
    return plumbline(arguments, "PLUMBLINE_ENGINE_PATH='" PLUMBLINE_FAKES "'");
  }

  void write(const std::string& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }

  fs::path folder_;
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const std::string kFreeFall = R"(id = "my/fall"
about = "a fall"
source = "test"
duration = 1
gravity = [0, 0, -9.81]
[parameters]
h = 1
[scales]
length = 1
time = 1
mass = 1
[[body]]
name = "ball"
shape = { sphere = 0.1 }
mass = 1
[reference]
kind = "closed_form"
ball.z = "-9.81*t^2/2"
ball.vz = "-9.81*t"
[[gate]]
metric = "position.max"
limit = "dt*10"
reason = "first order"
)";

TEST_F(Cli, HelpTeaches) {
  const Outcome help = plumbline("--help");
  EXPECT_EQ(help.code, kExitPass);
  for (const char* word :
       {"run", "list", "certify", "compare", "doctor", "adapter", "Exit codes", "plumbline run -f"}) {
    EXPECT_TRUE(contains(help.out, word)) << word;
  }
  EXPECT_EQ(plumbline("run --help").code, kExitPass);
  EXPECT_EQ(plumbline("--version").code, kExitPass);
}

TEST_F(Cli, AWrongWordIsAUsageError) {
  for (const char* arguments :
       {"", "frobnicate", "run --frobnicate", "run --jobs 0", "run --dt 0", "run --dt 1/0", "run --dt -1",
        "run --profile best", "run -P v0", "run -P v0=x", "run -P nonsense=1", "run -e nonsense", "run -f '['",
        "run nonsense.toml", "compare a.json", "compare a.json b.json", "run --timeout 0", "certify nonsense.toml",
        "certify --tier quick"}) {
    const Outcome outcome = plumbline(arguments);
    EXPECT_EQ(outcome.code, kExitUsage) << arguments << '\n' << outcome.err;
    EXPECT_GT(outcome.err.size() + outcome.out.size(), 10u) << arguments << " says nothing";
  }
  EXPECT_TRUE(contains(plumbline("run -e nonsense").err, "there are "));
  EXPECT_TRUE(contains(plumbline("run -P nonsense=1").err, "they have "));
}

TEST_F(Cli, NothingMatchedHasItsOwnCode) {
  EXPECT_EQ(plumbline("run -f no_such_case").code, kExitNothingMatched);
  EXPECT_EQ(plumbline("list -f no_such_case").code, kExitNothingMatched);
  EXPECT_EQ(plumbline("certify -f no_such_case").code, kExitNothingMatched);
}

TEST_F(Cli, ListsScenariosAndEnginesForProgramsAndPeople) {
  const Outcome json = plumbline("list --json");
  ASSERT_EQ(json.code, kExitPass) << json.err;
  const auto listing = nlohmann::json::parse(json.out);
  EXPECT_GE(listing.at("scenarios").size(), 5u);
  EXPECT_GE(listing.at("engines").size(), 1u);
  const Outcome text = plumbline("list");
  for (const auto& s : listing["scenarios"]) EXPECT_TRUE(contains(text.out, s.at("id"))) << s;
}

TEST_F(Cli, DoctorTellsWhatWasFound) {
  const Outcome outcome = plumbline("doctor");
  EXPECT_EQ(outcome.code, kExitPass);
  EXPECT_TRUE(contains(outcome.out, "precision"));
  EXPECT_TRUE(contains(outcome.out, "compiler"));
  const Outcome broken = plumbline("doctor", "PLUMBLINE_ENGINE_PATH='" PLUMBLINE_BROKEN_WORKERS "'");
  EXPECT_TRUE(contains(broken.out, "MISSING  plumbline-engine-quitter")) << broken.out;
  EXPECT_TRUE(contains(broken.out, "cannot load libengine.so")) << broken.out;
}

TEST_F(Cli, CrashHangAndNaNCostTheirOwnCellsOnly) {
  const Outcome outcome = with_fakes(
      "run -e fake-honest,fake-aborts,fake-hangs,fake-nan --timeout 1 -f falling_box --dt 0.02 --profile matched");
  EXPECT_EQ(outcome.code, kExitEngineError) << outcome.err;
  const auto results = nlohmann::json::parse(text_of(folder_ / "plumbline-results/results.json"));
  std::map<std::string, std::string> verdicts;
  for (const auto& run : results.at("runs")) verdicts[run.at("engine")] = run.at("verdict");
  EXPECT_EQ(
      verdicts,
      (std::map<std::string, std::string>{
          {"fake-honest", "pass"}, {"fake-aborts", "crashed"}, {"fake-hangs", "timed_out"}, {"fake-nan", "diverged"}}));
}

TEST_F(Cli, AFailedGateIsExitCodeOneAndAllSkippedIs77) {
  EXPECT_EQ(with_fakes("run -e fake-lies -f falling_box").code, kExitGateFailed);
  EXPECT_EQ(with_fakes("run -e fake-honest -f falling_box --dt 0.02").code, kExitPass);
  EXPECT_EQ(with_fakes("run -e fake-honest -f box_drop").code, kExitAllSkipped);
}

TEST_F(Cli, WritesTheFilesThatOthersRead) {
  const Outcome outcome = with_fakes("run -e fake-honest -f falling_box --profile matched --dt 0.02 -o out");
  ASSERT_EQ(outcome.code, kExitPass) << outcome.err;
  const std::string csv = text_of(folder_ / "out/trajectories/particle/falling_box/fake-honest.matched.dt=0.02.csv");
  EXPECT_TRUE(csv.starts_with("t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n0,")) << csv.substr(0, 100);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 101);
  EXPECT_TRUE(contains(text_of(folder_ / "out/report.html"), "falling_box"));
  const Outcome json = with_fakes("run -e fake-honest -f falling_box --dt 0.02 --json");
  EXPECT_EQ(nlohmann::json::parse(json.out).at("runs").size(), 2u);
}

TEST_F(Cli, LeavesFoldersAloneThatItDidNotWrite) {
  write("mine/trajectories/precious.csv", "a year of measurements");
  EXPECT_EQ(with_fakes("run -e fake-honest -f falling_box --dt 0.02 -o mine").code, kExitUsage);
  EXPECT_EQ(text_of(folder_ / "mine/trajectories/precious.csv"), "a year of measurements");
}

TEST_F(Cli, ParametersStepsAndFiltersSelect) {
  const auto lines = [&](const std::string& arguments) {
    const Outcome o = with_fakes("run --dry-run -e fake-honest " + arguments);
    EXPECT_EQ(o.code, kExitPass) << o.err;
    return std::count(o.out.begin(), o.out.end(), '\n');
  };
  EXPECT_EQ(lines("-f drag_ship -P v0=0,10,30 --dt 0.02 --profile matched"), 3);
  EXPECT_EQ(lines("-f drag_ship -P v0=7 --dt 0.02,1/60"), 4);
  EXPECT_EQ(lines("-f particle/f -f particle/drag -f -drag_ship --dt 0.02 --profile default"), 1);
}

TEST_F(Cli, AParameterThatSpoilsAnotherScenarioDoesNoHarm) {
  write("a/ok.toml", kFreeFall);
  std::string fragile = kFreeFall;  // its duration is negative for h < 1
  fragile.replace(fragile.find("my/fall"), 7, "a/fragile");
  fragile.replace(fragile.find("duration = 1"), 12, "duration = \"h - 1\"");
  fragile.replace(fragile.find("h = 1"), 5, "h = 2");
  write("a/fragile.toml", fragile);
  std::string ok = kFreeFall;
  ok.replace(ok.find("my/fall"), 7, "a/ok");
  write("a/ok.toml", ok);
  EXPECT_EQ(with_fakes("run a -e fake-honest -P h=0.5 -f a/ok").code, kExitPass);
  EXPECT_EQ(with_fakes("run a -e fake-honest -P h=0.5").code, kExitUsage);
}

TEST_F(Cli, ComparesTwoResults) {
  ASSERT_EQ(with_fakes("run -e fake-honest -f falling_box -o a").code, kExitPass);
  ASSERT_EQ(with_fakes("run -e fake-honest -f falling_box -o b").code, kExitPass);
  EXPECT_EQ(plumbline("compare a/results.json b/results.json").code, kExitPass);
  const std::string worse = text_of(folder_ / "a/results.json");
  nlohmann::json edited = nlohmann::json::parse(worse);
  edited["runs"][0]["verdict"] = "fail";
  write("c.json", edited.dump());
  EXPECT_EQ(plumbline("compare a/results.json c.json").code, kExitGateFailed);
  EXPECT_EQ(plumbline("compare c.json a/results.json").code, kExitPass);
  write("d.json", "{\"schema\": \"plumbline-results/99\"}");
  const Outcome future = plumbline("compare a/results.json d.json");
  EXPECT_EQ(future.code, kExitUsage);
  EXPECT_TRUE(contains(future.err, "d.json")) << future.err;
}

TEST_F(Cli, ABrokenScenarioFileIsNamedWithItsPlace) {
  write("my/fall.toml", kFreeFall);
  EXPECT_EQ(with_fakes("run my/fall.toml -e fake-honest").code, kExitPass);

  const auto complaint = [&](const std::string& from, const std::string& to) {
    std::string text = kFreeFall;
    text.replace(text.find(from), from.size(), to);
    write("my/fall.toml", text);
    const Outcome outcome = with_fakes("run my/fall.toml -e fake-honest");
    EXPECT_EQ(outcome.code, kExitUsage);
    return outcome.err;
  };
  // A typing error, a wrong count, an unknown key, an undefined symbol: each with line and column.
  EXPECT_TRUE(contains(complaint("duration = 1", "duration = = 1"), "my/fall.toml:4:"));
  EXPECT_TRUE(contains(complaint("[0, 0, -9.81]", "[0, -9.81]"), "my/fall.toml:5:11"));
  EXPECT_TRUE(contains(complaint("mass = 1\n[reference]", "mas = 1\n[reference]"), "my/fall.toml:15:"));
  const std::string undefined = complaint("dt*10", "dt*g");
  EXPECT_TRUE(contains(undefined, "my/fall.toml:22:9")) << undefined;
  EXPECT_TRUE(contains(undefined, "'g'")) << undefined;
}

TEST_F(Cli, AdapterTestHasAnExitCodeForEveryEnd) {
  const std::string gravity = "adapter test -q -f gravity --timeout 1 ";
  EXPECT_EQ(all_with_fakes(gravity + "fake-honest").code, kExitPass);
  EXPECT_EQ(all_with_fakes(gravity + "fake-honest fake-gains-energy").code, kExitGateFailed);
  EXPECT_EQ(all_with_fakes(gravity + "fake-honest,fake-aborts").code, kExitEngineError);
  EXPECT_EQ(all_with_fakes(gravity + "fake-hangs").code, kExitEngineError);
  EXPECT_EQ(all_with_fakes(gravity + "nonsense").code, kExitUsage);
  EXPECT_EQ(all_with_fakes("adapter test fake-honest -f no_such_check").code, kExitNothingMatched);
  EXPECT_EQ(all_with_fakes("adapter test --profile best").code, kExitUsage);
  EXPECT_EQ(all_with_fakes("adapter").code, kExitUsage);
}

TEST_F(Cli, AdapterTestTellsWhatItSawAndWritesItDown) {
  const Outcome outcome = all_with_fakes("adapter test fake-honest fake-aborts -f gravity_pulls -o out");
  EXPECT_TRUE(contains(outcome.out, "fake-aborts.matched gravity_pulls_where_it_is_stated")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "signal 6")) << outcome.out;
  const auto results = nlohmann::json::parse(text_of(folder_ / "out/conformance.json"));
  EXPECT_EQ(results.at("conformance").size(), 4u);
  EXPECT_TRUE(results.at("runs").empty());
  EXPECT_TRUE(contains(text_of(folder_ / "out/conformance.html"), "gravity_pulls_where_it_is_stated"));
  EXPECT_TRUE(contains(all_with_fakes("adapter test --list").out, "hinge_moves_as_stated"));
}

TEST_F(Cli, ARunPutsItsEnginesBeforeTheKitUnlessToldNotTo) {
  // This fake has no rotation: the scenario does not notice, the kit does.
  const std::string run = "run -e fake-honest -f falling_box --dt 0.02";
  const Outcome whole = all_with_fakes(run);
  EXPECT_EQ(whole.code, kExitGateFailed);
  EXPECT_TRUE(contains(whole.out, "torque_echoes_the_inertia")) << whole.out;
  const auto results = nlohmann::json::parse(text_of(folder_ / "plumbline-results/results.json"));
  EXPECT_GT(results.at("conformance").size(), 40u);
  EXPECT_TRUE(contains(text_of(folder_ / "plumbline-results/report.html"), "./conformance.html"));
  EXPECT_TRUE(fs::exists(folder_ / "plumbline-results/conformance.html"));
  EXPECT_EQ(all_with_fakes(run + " --no-conformance").code, kExitPass);
  EXPECT_FALSE(fs::exists(folder_ / "plumbline-results/conformance.html")) << "the page of another run was left";
}

TEST_F(Cli, CertifiesReferencesAndNamesWhatFails) {
  write("fall.toml", kFreeFall);
  const Outcome sound = plumbline("certify fall.toml");
  EXPECT_EQ(sound.code, kExitPass) << sound.out << sound.err;
  EXPECT_TRUE(contains(sound.out, "ok    my/fall")) << sound.out;
  EXPECT_TRUE(contains(sound.out, "1 references, 1 without a failure")) << sound.out;

  std::string text = kFreeFall;
  write("slow.toml", text.replace(text.find("-9.81*t^2/2"), 5, "-9.8"));
  const Outcome slow = plumbline("certify slow.toml");
  EXPECT_EQ(slow.code, kExitGateFailed) << slow.out;
  EXPECT_TRUE(contains(slow.out, "FAIL  slow.toml:16: my/fall: motion: place against")) << slow.out;

  text = kFreeFall +
         "[[certificate]]\nquantity = \"ball_z + 4.9\"\nequals = 0\ntime = 1\nwithin = 1e-3\nsource = \"a slip\"\n";
  write("stated.toml", text);
  const Outcome stated = plumbline("certify stated.toml");
  EXPECT_EQ(stated.code, kExitGateFailed);
  EXPECT_TRUE(contains(stated.out,
                       "FAIL  stated.toml:25: my/fall: certificate: ball_z + 4.9 = 0 (a slip): is 0.005, "
                       "may be 0.001"))
      << stated.out;
}

TEST_F(Cli, CertifiesForPrograms) {
  write("fall.toml", kFreeFall);
  ASSERT_EQ(plumbline("certify fall.toml --json -o rows.json").code, kExitPass);
  const auto document = nlohmann::json::parse(text_of(folder_ / "rows.json"));
  EXPECT_EQ(document.at("holds"), true);
  const auto& row = document.at("cases").at(0).at("rows").at(0);
  EXPECT_LE(row.at("figure").get<double>(), row.at("bound").get<double>());
  EXPECT_EQ(plumbline("certify fall.toml -o no/such/folder").code, kExitUsage);
}

TEST_F(Cli, CtrlCKeepsWhatThereIs) {
  // fake-hangs blocks the campaign, so that the signal surely arrives while it runs.
  const Outcome outcome = plumbline(
      "run -e fake-honest,fake-hangs -f falling_box --dt 0.02 --profile matched --timeout 60 & "
      "pid=$!; for i in $(seq 100); do grep -qs fake-honest plumbline-results/results.json && break; sleep 0.1; done; "
      "kill -INT $pid; wait $pid",
      "PLUMBLINE_ENGINE_PATH='" PLUMBLINE_FAKES "'");
  EXPECT_EQ(outcome.code, kExitInterrupted) << outcome.err;
  const auto results = nlohmann::json::parse(text_of(folder_ / "plumbline-results/results.json"));
  EXPECT_TRUE(results.at("interrupted"));
  EXPECT_EQ(results.at("runs").size(), 1u);
}

TEST_F(Cli, SweepsAnEnginesSettingAsRowsOfTheirOwn) {
  const Outcome o = with_fakes(
      "run -q -e fake-honest -f falling_box --dt 0.02 --profile matched "
      "--set fake.damping=0.25,1/2 -o out");
  ASSERT_EQ(o.code, kExitPass) << o.out << o.err;
  const auto results = nlohmann::json::parse(text_of(folder_ / "out/results.json"));
  ASSERT_EQ(results.at("runs").size(), 2U);
  EXPECT_EQ(results["runs"][0]["engine"], "fake-honest@damping=0.25");
  EXPECT_EQ(results["runs"][0]["settings"]["damping"], 0.25);  // as the worker says it applied it
  EXPECT_EQ(results["runs"][1]["engine"], "fake-honest@damping=1/2");
  EXPECT_EQ(results["runs"][1]["settings"]["damping"], 0.5);
  EXPECT_TRUE(fs::exists(folder_ / "out" / results["runs"][1]["trajectory"].get<std::string>()));
}

TEST_F(Cli, ListsTheSettingsThatCanBeChanged) {
  const Outcome o = with_fakes("list --settings -e fake-honest");
  EXPECT_EQ(o.code, kExitPass);
  EXPECT_NE(o.out.find("fake-honest.damping = 0.1, matched 0  [1/s]\n      not used by fakes"), std::string::npos)
      << o.out;
  const auto json = nlohmann::json::parse(with_fakes("list --json -e fake-honest").out);
  EXPECT_EQ(json.at("engines").at(0).at("settings").at(0).at("default"), 0.1);
}

}  // namespace
}  // namespace plumbline
