// A model of MuJoCo at its start, with the views of it that the reader needs.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

#include "plumbline/exchange/import_program.hpp"

namespace plumbline {

struct FreeModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct FreeData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

class CompiledModel {
 public:
  // Loads, takes the starting state, and computes where everything is then. Appends to `notes` which start it took.
  CompiledModel(const ImportRequest& request, std::vector<std::string>& notes);

  const mjModel& m() const { return *model_; }
  const mjData& d() const { return *data_; }

  std::string name(int type, int id) const;                     // "" without
  std::string named(int type, int id, const char* word) const;  // the name, or word and number
  Vec3 vec(const mjtNum* array, int row) const { return Vec3(array[3 * row], array[3 * row + 1], array[3 * row + 2]); }
  Mat3 mat(const mjtNum* array, int row) const;
  // A custom field of that size, if there is one.
  const mjtNum* field(const char* name, int size) const;

 private:
  void take_start(const ImportRequest& request, std::vector<std::string>& notes);
  std::unique_ptr<mjModel, FreeModel> model_;
  std::unique_ptr<mjData, FreeData> data_;
};

}  // namespace plumbline
