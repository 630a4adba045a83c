// Simbody behind the door of core/engine.hpp: a row for each of its two kinds of contact.
#include "simbody_model.hpp"

#include "simbody_rows.hpp"

namespace plumbline {
namespace {

class SimbodyRow final : public Engine {
 public:
  using Create = std::unique_ptr<World> (*)(const Scenario&, const Settings&);

  SimbodyRow(std::string name, std::string scheme, const FeatureSet& more, std::vector<Setting> settings, Create maker)
      : create_(maker) {
    info_.name = std::move(name);
    info_.library = "Simbody";
    info_.version = simbody_version();
    info_.scheme = std::move(scheme);
    info_.features = more;
    for (const Feature feature :
         {Feature::kSpatial, Feature::kForce, Feature::kTorque, Feature::kSphereSphere, Feature::kSphereHalfSpace,
          Feature::kBoxHalfSpace, Feature::kFriction, Feature::kBallJoint, Feature::kHinge, Feature::kSlider,
          Feature::kFixedJoint, Feature::kJointsAndContact, Feature::kSpring, Feature::kJointSpring}) {
      info_.features.insert(feature);
    }
    info_.settings = std::move(settings);
  }

  const EngineInfo& info() const override { return info_; }

  std::unique_ptr<World> create(const Scenario& scenario, const Settings& settings) const override {
    return create_(scenario, settings);
  }

 private:
  EngineInfo info_;
  Create create_;
};

}  // namespace

std::vector<std::unique_ptr<Engine>> make_engines() {
  std::vector<std::unique_ptr<Engine>> engines;
  // No loops and no rods: this stepper leaves out every constraint that is not a contact, without a word.
  engines.push_back(std::make_unique<SimbodyRow>("simbody-rigid", "semi-implicit Euler",
                                                 FeatureSet{Feature::kRestitution}, simbody_rigid_settings(),
                                                 make_simbody_rigid));
  // No restitution: in this contact law e falls with the speed of the impact (by 1 - c v where it is slow), so that no
  // constant makes it what a scenario states at every speed.
  engines.push_back(std::make_unique<SimbodyRow>(
      "simbody-compliant", "integration with error control, forces held over each step",
      FeatureSet{Feature::kDistanceJoint, Feature::kJointLoop}, simbody_compliant_settings(), make_simbody_compliant));
  return engines;
}

}  // namespace plumbline
