#include "plumbline/exchange/world_export.hpp"

#include "formats.hpp"

namespace plumbline {

std::string quoted(const std::string& name) { return "'" + name + "'"; }

std::vector<std::string> losses_of_every_format(const Scenario& scenario) {
  std::vector<std::string> losses;
  for (const ForceLaw& law : scenario.forces) {
    losses.push_back("force law on " + quoted(scenario.bodies[law.body].name) + ": dropped; " + law.text);
  }
  for (const JointDrive& drive : scenario.drives) {
    losses.push_back("drive of joint " + quoted(scenario.joints[drive.joint].name) + ": dropped; " + drive.text);
  }
  if (scenario.threshold) {
    losses.push_back("threshold in '" + scenario.threshold->parameter + "': dropped; the world is that of the file");
  }
  return losses;
}

ExportedWorld export_world(const Scenario& scenario, WorldFormat format) {
  require_sound(scenario);
  switch (format) {
    case WorldFormat::kMjcf:
      return to_mjcf(scenario);
    case WorldFormat::kSdf:
      return to_sdf(scenario);
    case WorldFormat::kUrdf:
      return to_urdf(scenario);
  }
  return {};
}

}  // namespace plumbline
