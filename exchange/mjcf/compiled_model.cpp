#include "compiled_model.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "plumbline/exchange/world_file.hpp"

namespace plumbline {
namespace {

[[noreturn]] void raise(const char* message) { throw std::invalid_argument(std::string("MuJoCo: ") + message); }

// MuJoCo's messages end in "..., line 12, column 4" or "..., line = 12, column = 4".
int line_in(const std::string& message) {
  const std::size_t at = message.rfind("line ");
  const std::size_t number = at == std::string::npos ? at : message.find_first_of("0123456789", at);
  return number == std::string::npos ? 0 : std::atoi(message.c_str() + number);
}

}  // namespace

CompiledModel::CompiledModel(const ImportRequest& request, std::vector<std::string>& notes) {
  // Unset, they write a file into the working directory, and an error ends the process.
  mju_user_error = raise;
  mju_user_warning = [](const char*) {};
  std::array<char, 1000> fault{};
  model_.reset(mj_loadXML(request.file.c_str(), nullptr, fault.data(), static_cast<int>(fault.size())));
  std::string message = fault.data();
  std::replace(message.begin(), message.end(), '\n', ' ');
  if (!model_) throw std::invalid_argument(at_line(request.file, line_in(message), "MuJoCo refuses it: " + message));
  if (!message.empty()) notes.push_back("MuJoCo warns: " + message);
  data_.reset(mj_makeData(model_.get()));
  take_start(request, notes);
  mj_forward(model_.get(), data_.get());
}

void CompiledModel::take_start(const ImportRequest& request, std::vector<std::string>& notes) {
  const std::string wanted = request.keyframe.value_or("start");
  std::string known;
  for (int k = 0; k < model_->nkey; ++k) {
    const std::string key = named(mjOBJ_KEY, k, "key");
    known += (known.empty() ? "" : ", ") + key;
    if (key != wanted) continue;
    mj_resetDataKeyframe(model_.get(), data_.get(), k);
    notes.push_back("starts from keyframe '" + key + "'");
    return;
  }
  if (request.keyframe && wanted != "none") {
    throw std::invalid_argument(request.file.string() + ": there is no keyframe '" + wanted +
                                "'; there are: " + (known.empty() ? "none" : known));
  }
  if (!known.empty())
    notes.push_back("starts as the model does, not from a keyframe (--keyframe takes one of: " + known + ")");
}

std::string CompiledModel::name(int type, int id) const {
  const char* const text = mj_id2name(model_.get(), type, id);
  return text != nullptr ? text : "";
}
std::string CompiledModel::named(int type, int id, const char* word) const {
  const std::string own = name(type, id);
  return own.empty() ? word + std::to_string(id) : own;
}

Mat3 CompiledModel::mat(const mjtNum* array, int row) const {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(array + 9 * row);
}

const mjtNum* CompiledModel::field(const char* name, int size) const {
  const int id = mj_name2id(model_.get(), mjOBJ_NUMERIC, name);
  if (id < 0 || model_->numeric_size[id] != size) return nullptr;
  return model_->numeric_data + model_->numeric_adr[id];
}

}  // namespace plumbline
