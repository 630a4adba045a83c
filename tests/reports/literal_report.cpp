#include "literal_report.hpp"

#include <cmath>
#include <limits>

namespace plumbline::testing {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr const char* kHostile = "<b>&\"'";

EngineInfo exact_engine() {
  EngineInfo e;
  e.name = "alpha";
  e.library = "Alpha Dynamics";
  e.version = "1.2.3";
  e.scheme = "semi-implicit Euler";
  e.features = FeatureSet::all();
  return e;
}

EngineInfo rough_engine() {
  EngineInfo e;
  e.name = "beta-f32";
  e.library = "Beta";
  e.version = "0.9+dfsg-1";
  e.precision = Precision::kSingle;
  e.scheme = "leapfrog";
  e.velocity_offset = 0.5;
  e.features = FeatureSet::all();
  e.settings = {{"sleeping", true, false, "", "lets slow bodies rest; the scenario has no such thing"},
                {"speed_cap", 100.0, kInfinity, "m/s", "largest speed"},
                {"solver", std::string("fast"), std::string("fast"), "", "the only one there is"}};
  return e;
}

EngineInfo hostile_engine() {
  EngineInfo e;
  e.name = kHostile;
  e.library = "</script><script>alert(1)</script>";
  e.version = "\xC3\xA9t\xC3\xA9 2D";
  e.dimension = 2;
  e.scheme = "explicit Euler";
  e.features = {Feature::kForce, Feature::kSphereSphere};
  e.settings = {{kHostile, 0.0, 1e-3, "1/s", "a < b && c > \"d\""}};
  return e;
}

RunResult run_of(const std::string& scenario, const std::string& engine, Profile profile, double dt, Verdict verdict) {
  RunResult r;
  r.scenario = scenario;
  r.case_name = scenario;
  r.engine = engine;
  r.profile = profile;
  r.dt = dt;
  r.verdict = verdict;
  r.wall_seconds = 0.0125;
  return r;
}

std::vector<CurvePoint> linear_curve(double slope, std::size_t points) {
  std::vector<CurvePoint> curve;
  for (std::size_t k = 0; k < points; ++k) {
    const double t = 2.0 * static_cast<double>(k) / static_cast<double>(points - 1);
    curve.push_back({t, slope * t});
  }
  return curve;
}

// g t dt/2, the error of semi-implicit Euler in free fall, at t = 2 s.
RunResult falling_run(const std::string& engine, Profile profile, double dt, Verdict verdict) {
  RunResult r = run_of("particle/falling_box", engine, profile, dt, verdict);
  const double error = 9.8 * dt;
  r.parameters = {{"g", 9.8}, {"m", 1}};
  r.metrics = {{"position.max", error}, {"position.rms", 0.6 * error}, {"velocity.max", 0}, {"energy.max", -9.6e-3}};
  r.gates = {{"position.max", error, 9.9 * dt, true, "first order in dt", "", {"particle/falling_box.toml", 31, 1}}};
  r.explanation = {"semi-implicit Euler", 3.6e-15, 1 - 3.6e-15 / error};
  r.curve = linear_curve(4.9 * dt, 9);
  r.trajectory = "trajectories/particle/falling_box/" + engine + "." + std::string(profile_name(profile)) +
                 ".dt=" + shortest(dt) + ".csv";
  return r;
}

void add_falling_box(Report& report) {
  for (const double dt : {0.02, 1.0 / 60}) {
    for (const Profile p : {Profile::kDefault, Profile::kMatched}) {
      report.runs.push_back(falling_run("alpha", p, dt, Verdict::kPass));
      report.runs.push_back(falling_run("beta-f32", p, dt, Verdict::kPass));
    }
    RunResult planar = falling_run(kHostile, Profile::kMatched, dt, Verdict::kPass);
    planar.notes = {"planar projection"};
    report.runs.push_back(planar);
  }
  // Zero error all along, and an engine that stops at the list of deviations.
  RunResult& exact = report.runs.front();
  exact.metrics[0].second = 0;
  exact.gates[0].value = 0;
  exact.explanation = {};
  for (CurvePoint& p : exact.curve) p.error = 0;
  RunResult listed = falling_run(kHostile, Profile::kDefault, 0.02, Verdict::kUnexpectedPass);
  listed.reason = "listed in deviations.toml:7 as failing, yet it passes";
  report.runs.push_back(listed);
  RunResult unstable = falling_run(kHostile, Profile::kDefault, 1.0 / 60, Verdict::kNondeterministic);
  unstable.reason = "sample 17 differs between two runs";
  report.runs.push_back(unstable);
}

void add_collision(Report& report) {
  const std::string id = "collision/two_sphere";
  const auto add = [&](const std::string& engine, Profile p, Verdict v) -> RunResult& {
    RunResult r = run_of(id, engine, p, 1.0 / 240, v);
    r.case_name = id + "/e=1";
    r.parameters = {{"e", 1}};
    report.runs.push_back(r);
    return report.runs.back();
  };
  RunResult& known = add("beta-f32", Profile::kDefault, Verdict::kExpectedFail);
  known.metrics = {{"position.max", 0.25}, {"energy.max", 0.44}, {"event_time.max", kInfinity}};
  known.gates = {{"position.max", 0.25, 0.3, true, "a step of travel", "", {"collision/two_sphere.toml", 40, 1}},
                 {"energy.max",
                  0.44,
                  1e-6,
                  false,
                  "elastic: energy is kept",
                  "penetration is corrected with a velocity that stays",
                  {"collision/two_sphere.toml", 44, 1}}};
  known.curve = {{0, 0}, {0.5, 1e-7}, {1, 0.1}, {1.5, 0.2}, {2, 0.25}};

  RunResult& failing = add("alpha", Profile::kDefault, Verdict::kFail);
  failing.metrics = {{"position.max", 0.5}, {"energy.max", -0.02}};
  failing.gates = {
      {"energy.max", -0.02, 1e-6, false, "elastic: energy is kept", "", {"collision/two_sphere.toml", 44, 1}}};
  failing.reason = "|energy.max| 0.02 > 1e-06";
  failing.curve = {{0, 1e-16}, {1, 1e-3}, {2, 0.5}};

  RunResult& lost = add("alpha", Profile::kMatched, Verdict::kDiverged);
  lost.metrics = {{"position.max", kNaN}, {"energy.max", kNaN}};
  lost.gates = {{"position.max", kNaN, 0.3, false, "a step of travel", "", {"collision/two_sphere.toml", 40, 1}}};
  lost.reason = "v_WB of body 'left' is nan at t = 1 s";
  lost.curve = {{0, 1e-16}, {0.5, 1e-3}, {1, kNaN}, {1.5, kNaN}, {2, kInfinity}};

  RunResult& dead = add("beta-f32", Profile::kMatched, Verdict::kCrashed);
  dead.reason = "the process died of SIGABRT";
  dead.messages = "assertion \"a < b\" failed\n\x1b[31mred\x1b[0m \xFF";
  add(kHostile, Profile::kDefault, Verdict::kTimedOut).reason = "stopped after 10 s";
  RunResult& refused = add(kHostile, Profile::kMatched, Verdict::kError);
  refused.reason = "no setting '<b>&\"' in the adapter";
  refused.settings = {{"a", 0.5}, {"b", true}, {"c", std::string("word")}, {"d", -kInfinity}};
}

void add_conformance(Report& report) {
  report.conformance_checks = {
      {"force_echoes_the_mass", "mass", "Does a force show the stated mass?", "16 roundings", false},
      {"gravity_pulls", "forces", "Does gravity pull where it is stated: a < b && \"c\"?", "", false},
      {"friction_is_a_cone", "forces", "Does friction brake equally in every direction?", "two steps' worth", true}};
  for (const std::string engine : {"alpha", "beta-f32", kHostile}) {
    for (const Profile p : {Profile::kDefault, Profile::kMatched}) {
      for (const ConformanceCheck& check : report.conformance_checks) {
        if (check.matched_only && p == Profile::kDefault) continue;
        report.conformance.push_back({engine, p, check.name, Verdict::kPass, "", "", ""});
      }
    }
  }
  const auto set = [&](std::size_t i, Verdict v, const std::string& text, const std::string& why = "",
                       const std::string& messages = "") {
    report.conformance[i].verdict = v;
    report.conformance[i].text = text;
    report.conformance[i].why = why;
    report.conformance[i].messages = messages;
  };
  set(1, Verdict::kFail, "the velocity after one step is (0, 0, 0.153), wanted (0, 0, -0.153) within 2.7e-16");
  set(4, Verdict::kUnexpectedPass, "", "a pyramid (manual, section 3)");
  set(5, Verdict::kCrashed, "killed by signal 6 (Aborted)", "", "line one\nassertion \"a < b\" failed\n");
  set(9, Verdict::kExpectedFail, "the velocity is 2.7, wanted 2.26 within 0.02", "friction is a pyramid");
  set(10, Verdict::kError, "no <b>&\"' here", "", "\x1b[31mred\x1b[0m \xFF");
  set(13, Verdict::kTimedOut, "no answer within 30 s");
  set(14, Verdict::kUnsupported, "the engine has no three dimensions");
}

void add_rest(Report& report) {
  RunResult r = run_of(std::string("odd/") + kHostile, "alpha", Profile::kMatched, 0.001, Verdict::kUnsupported);
  r.reason = "lacks contact of a box with a box";
  report.runs.push_back(r);
}

}  // namespace

Report literal_report() {
  Report report;
  report.tool_version = "0.1.0";
  report.environment = {
      {"date", "2024-02-29T12:00:00Z"}, {"compiler", "g++ 12.2"}, {"command", "plumbline run --filter '<b>&\"'"}};
  report.engines = {exact_engine(), rough_engine(), hostile_engine()};
  report.missing_engines = {{"gamma", "its library was not found; apt-get install libgamma-dev"}};
  report.scenarios = {{"particle/falling_box",
                       "a box in free fall",
                       "slide 8",
                       "particle/falling_box.toml",
                       "closed_form",
                       "z0 + v0 t - g t^2/2",
                       {"particle/falling_box"},
                       {0.02, 1.0 / 60}},
                      {"collision/two_sphere",
                       "two spheres meet",
                       "slides 19-23",
                       "collision/two_sphere.toml",
                       "events",
                       "impulse and momentum",
                       {"collision/two_sphere/e=1"},
                       {1.0 / 240}},
                      {std::string("odd/") + kHostile,
                       "a < b & \"c\"",
                       "",
                       "odd.toml",
                       "invariants",
                       "",
                       {std::string("odd/") + kHostile},
                       {0.001}}};
  add_falling_box(report);
  add_collision(report);
  add_rest(report);
  report.convergence = {
      {"particle/falling_box", "beta-f32", Profile::kMatched, "position.max", 0.998, 2, ""},
      {"particle/falling_box", "alpha", Profile::kDefault, "position.max", kNaN, 0, "errors of zero have no order"},
      {"particle/falling_box", "alpha", Profile::kMatched, "position.max", 1, 2, ""}};
  report.divergence = {
      {"particle/falling_box",
       Profile::kMatched,
       0.02,
       {"alpha", "beta-f32", kHostile},
       {0, 1e-7, 2e-3, 1e-7, 0, 2e-3, 2e-3, 2e-3, 0}},
      {"collision/two_sphere/e=1", Profile::kDefault, 1.0 / 240, {"alpha", "beta-f32"}, {0, kNaN, kNaN, 0}}};
  add_conformance(report);
  report.wall_seconds = 12.5;
  return report;
}

Report large_report() {
  const std::vector<std::string> engines = {"alpha",       "beta-f32", "beta-f64", "gamma",
                                            "gamma-quick", "delta-2d", "epsilon"};
  const std::vector<std::string> cases = {"particle/falling_box",           "particle/drag_ship/v0=0",
                                          "particle/drag_ship/v0=30",       "collision/two_sphere/e=0,b=0",
                                          "collision/two_sphere/e=0.5,b=0", "collision/two_sphere/e=1,b=0",
                                          "collision/two_sphere/e=0,b=0.3", "collision/two_sphere/e=0.5,b=0.3",
                                          "collision/two_sphere/e=1,b=0.3", "collision/box_drop",
                                          "collision/bouncing_ball"};
  Report report;
  report.tool_version = "0.1.0";
  report.environment = {{"date", "2024-02-29T12:00:00Z"}, {"machine", "2 cores"}, {"command", "plumbline run"}};
  report.wall_seconds = 42;
  for (const std::string& name : engines) {
    EngineInfo e = rough_engine();
    e.name = name;
    report.engines.push_back(e);
  }
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const std::string id = cases[c].substr(0, cases[c].find('/', cases[c].find('/') + 1));
    report.scenarios.push_back({id,
                                "one line about " + id,
                                "slide " + std::to_string(c),
                                id + ".toml",
                                "closed_form",
                                "by hand",
                                {cases[c]},
                                {}});
    for (const double dt : {0.02, 1.0 / 60, 1.0 / 240, 0.001}) {
      for (const Profile p : {Profile::kDefault, Profile::kMatched}) {
        Divergence d{cases[c], p, dt, engines, std::vector<double>(engines.size() * engines.size(), 0)};
        for (std::size_t e = 0; e < engines.size(); ++e) {
          RunResult r = run_of(id, engines[e], p, dt, Verdict::kPass);
          r.case_name = cases[c];
          r.parameters = {{"g", 9.8}, {"m", 1}};
          // No two rows alike: the worst case for a table that joins what is the same.
          const double scale = dt * (1 + static_cast<double>(c)) * std::pow(3.0, -static_cast<double>(e)) *
                               (p == Profile::kDefault ? 1.7 : 1);
          for (std::size_t k = 0; k < 200; ++k) {
            const double t = 0.01 * static_cast<double>(k);
            r.curve.push_back({t, scale * t * (1.2 + std::sin(5 * t + static_cast<double>(e)))});
          }
          r.metrics = {{"position.max", scale},
                       {"velocity.max", 2 * scale},
                       {"energy.max", -scale / 7},
                       {"event_time.max", scale / 3}};
          r.gates = {{"position.max", scale, 2 * scale, true, "first order in dt", "", {}}};
          r.explanation = {e % 2 == 0 ? "semi-implicit Euler" : "explicit Euler", scale / 100, 0.99};
          r.trajectory = "trajectories/" + cases[c] + "/" + engines[e] + ".csv";
          const bool energetic = c >= 3 && e == 1 && p == Profile::kDefault;
          if (energetic) {
            r.verdict = Verdict::kExpectedFail;
            r.gates.push_back({"energy.max",
                               0.4 + dt,
                               1e-6,
                               false,
                               "elastic: energy is kept",
                               "penetration is corrected with a velocity that stays in the motion",
                               {}});
          }
          if (c == 9 && e >= 5) {
            r.verdict = e == 5 ? Verdict::kUnsupported : Verdict::kFail;
            r.reason = e == 5 ? "lacks contact of a box with a box" : "position.max " + shortest(scale) + " > 1e-06";
            if (e == 6) r.gates = {{"position.max", scale, 1e-6, false, "at rest it must not move", "", {}}};
            if (e == 5) r.metrics.clear(), r.curve.clear(), r.gates.clear(), r.explanation = {};
          }
          if (e == 5 && c == 0) r.notes = {"planar projection"};
          for (std::size_t f = 0; f < e; ++f) {
            d.distance[e * engines.size() + f] = d.distance[f * engines.size() + e] =
                scale * static_cast<double>(e + f);
          }
          report.runs.push_back(std::move(r));
        }
        report.divergence.push_back(std::move(d));
      }
    }
    for (const std::string& e : engines) {
      for (const Profile p : {Profile::kDefault, Profile::kMatched})
        report.convergence.push_back({cases[c], e, p, "position.max", 1.0, 4, ""});
    }
  }
  return report;
}

Scenario two_body_scenario() {
  Scenario s;
  s.id = "test/two_body";
  s.bodies = {{"ball", Sphere{0.5}, false, 1, Vec3::Zero(), {}},
              {"a \"box\", tilted", Box{Vec3::Ones()}, false, 1, Vec3::Zero(), {}}};
  return s;
}

Trajectory two_body_trajectory() {
  Trajectory t(0.1, 2);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto states = t.append();
    const auto n = static_cast<double>(k);
    states[0] = {Vec3(n, 0.1 * n, -0.0), Quat(1, 0, 0, 0), Vec3(1.0 / 3, 1e-300, -5e-324),
                 Vec3(1e22, 123456789, -2.2250738585072014e-308)};
    states[1] = {Vec3(kNaN, kInfinity, -kInfinity), Quat(0.5, -0.5, 0.5, -0.5), Vec3(-kNaN, 0, 0), Vec3::Zero()};
  }
  return t;
}

}  // namespace plumbline::testing
