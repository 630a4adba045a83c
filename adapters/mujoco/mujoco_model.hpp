// A scenario as a model of MuJoCo: geometry, mass and joints, not yet what a step needs to know.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>

#include "plumbline/adapters/joint_tree.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

struct DeleteModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DeleteData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using MujocoModel = std::unique_ptr<mjModel, DeleteModel>;
using MujocoData = std::unique_ptr<mjData, DeleteData>;

// Body i of the scenario is the body named mujoco_name(i), with its frame at the centre of mass; a fixed one is a shape
// of the world body. Its joint, if it has one in the tree, bears the same name.
std::string mujoco_name(std::size_t body);

// Throws std::invalid_argument for what MuJoCo cannot be told, in its own words where it refuses itself.
MujocoModel mujoco_model(const Scenario& scenario, const JointTree& tree);

}  // namespace plumbline
