// The door: what an adapter implements to put an engine into the suite.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "plumbline/core/feature.hpp"
#include "plumbline/core/scenario.hpp"
#include "plumbline/core/state.hpp"

namespace plumbline {

// One scenario living in one engine.
class World {
 public:
  World() = default;
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  virtual ~World() = default;

  // One wrench per body, in scenario order, for the next step only. Called before every step of a scenario that
  // has force laws, never otherwise. Wrenches of fixed bodies are zero.
  virtual void apply(std::span<const Wrench> wrenches) = 0;
  // Advances by exactly one step of dt [s].
  virtual void step(double dt) = 0;
  // Writes the state of every body, in scenario order.
  virtual void read(std::span<BodyState> states) const = 0;
};

using SettingValue = std::variant<bool, double, std::string>;
using Settings = std::map<std::string, SettingValue, std::less<>>;

// One knob of an engine: what a user gets, and what makes the engine solve the problem that the scenario states.
struct Setting {
  std::string name;
  SettingValue default_value;
  SettingValue matched_value;
  std::string unit;     // "" for a pure number or a switch
  std::string meaning;  // and, where the two values differ, why
};

enum class Profile { kDefault, kMatched };
std::string_view profile_name(Profile profile);  // "default", "matched"

enum class Precision { kSingle, kDouble };

struct EngineInfo {
  std::string name;     // the row: "ode-quickstep"
  std::string library;  // "Open Dynamics Engine"
  std::string version;  // as the library itself or its package tells it
  Precision precision = Precision::kDouble;
  int dimension = 3;           // 2: lives in the x-z plane
  std::string scheme;          // the declared integrator, in words
  double velocity_offset = 0;  // velocities are those of t_n + offset*dt (0 or +-1/2), positions those of t_n
  FeatureSet features;
  std::vector<Setting> settings;

  double unit_roundoff() const { return precision == Precision::kSingle ? 0x1p-24 : 0x1p-53; }
};

class Engine {
 public:
  virtual ~Engine() = default;
  virtual const EngineInfo& info() const = 0;
  // `settings` holds a value for each row of info().settings. Throws std::exception with a message for people: for a
  // scenario that is not sound (require_sound), for one that needs what the engine has not, for a setting that is
  // missing, unknown or of another type, and for what the engine itself refuses.
  std::unique_ptr<World> build(const Scenario& scenario, const Settings& settings) const;

 protected:
  // Called with a sound scenario within features(), and with all settings.
  virtual std::unique_ptr<World> create(const Scenario& scenario, const Settings& settings) const = 0;
};

// Defined once by every adapter: its rows. The worker program links exactly one adapter.
std::vector<std::unique_ptr<Engine>> make_engines();

// Every setting's value under that profile.
Settings settings_of(const EngineInfo& info, Profile profile);

// Throws std::invalid_argument, naming the setting and the way out, unless `settings` holds exactly one value of the
// right type for each row of info.settings, and no number is NaN.
void require_settings(const EngineInfo& info, const Settings& settings);

// Typed access; throws std::invalid_argument that names the setting when it is absent or of another type.
bool setting_bool(const Settings& settings, std::string_view name);
double setting_number(const Settings& settings, std::string_view name);
const std::string& setting_text(const Settings& settings, std::string_view name);

}  // namespace plumbline
