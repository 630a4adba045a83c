// Simbody behind the door of core/engine.hpp.
#include "simbody_rows.hpp"

namespace plumbline {

std::vector<std::unique_ptr<Engine>> make_engines() {
  std::vector<std::unique_ptr<Engine>> engines;
  engines.push_back(make_simbody_rigid());
  engines.push_back(make_simbody_compliant());
  return engines;
}

}  // namespace plumbline
