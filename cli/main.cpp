#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "usage_error.hpp"
#include "verbs.hpp"

namespace {

constexpr const char* kFooter = R"(
Start here:
  plumbline run                                  every engine, every scenario, the report
  plumbline run --tier standard                  every case and time step of them
  plumbline run -f two_sphere -e bullet,ode      some of it
  plumbline run -f drag_ship -P v0=0,10,30       other parameters
  plumbline run my_case.toml                     your own scenario file
  plumbline list                                 what there is
  plumbline certify                              whether the references are right: second sources
  plumbline compare old/results.json new/results.json
  plumbline doctor                               what was found and what is missing
  plumbline adapter test ode                     whether an adapter hands on what is stated
  plumbline export friction/incline -P mu=0.2 --as mjcf -o incline.xml     its world for MuJoCo; also sdf, urdf
  plumbline export --reference rotation/free_rotation --dt 0.01 --as npz -o exact.npz
  plumbline import robot.sdf -o robot.toml       a world of Gazebo, ROS (URDF) or MuJoCo as a scenario

Exit codes: 0 all pass, 1 a gate or a reference failed, 2 usage or bad file, 3 engine or infrastructure error,
4 nothing matched, 77 everything was skipped, 130 interrupted.)";

constexpr void (*kVerbs[])(CLI::App&, plumbline::Action&) = {
    plumbline::add_run_verb,     plumbline::add_list_verb,    plumbline::add_compare_verb, plumbline::add_doctor_verb,
    plumbline::add_adapter_verb, plumbline::add_certify_verb, plumbline::add_export_verb,  plumbline::add_import_verb};

}  // namespace

int main(int argc, char** argv) {
  CLI::App program{"Plumbline tells how far a physics engine is from the truth, and why.", "plumbline"};
  program.set_version_flag("--version", "plumbline " PLUMBLINE_VERSION);
  program.footer(kFooter);
  program.require_subcommand(1);
  plumbline::Action action;
  for (const auto add : kVerbs) add(program, action);
  try {
    program.parse(argc, argv);
    return action();
  } catch (const CLI::ParseError& e) {
    const bool asked = e.get_exit_code() == 0;  // --help and --version arrive as exceptions too
    program.exit(e);
    return asked ? plumbline::kExitPass : plumbline::kExitUsage;
  } catch (const plumbline::UsageError& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
    return plumbline::kExitUsage;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
    return plumbline::kExitEngineError;
  }
}
