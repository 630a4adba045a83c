#include "plumbline/exchange/world_file.hpp"

#include <tinyxml2.h>

#include <stdexcept>

namespace plumbline {
std::string at_line(const std::filesystem::path& file, int line, const std::string& text) {
  return file.string() + (line > 0 ? ":" + std::to_string(line) : "") + ": " + text;
}

WorldFormat format_of_world_file(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) throw std::invalid_argument(file.string() + ": no such file");
  tinyxml2::XMLDocument document;
  if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) {
    throw std::invalid_argument(
        at_line(file, document.ErrorLineNum(), std::string("is not well-formed XML: ") + document.ErrorName()));
  }
  const tinyxml2::XMLElement* const root = document.RootElement();
  const std::string tag = root != nullptr ? root->Name() : "";
  if (tag == "mujoco") return WorldFormat::kMjcf;
  if (tag == "sdf") return WorldFormat::kSdf;
  if (tag == "robot") return WorldFormat::kUrdf;
  throw std::invalid_argument(at_line(file, root != nullptr ? root->GetLineNum() : 0,
                                      "its outermost element is <" + tag +
                                          ">; worlds have <mujoco> (MJCF), <sdf> or "
                                          "<robot> (URDF)"));
}

}  // namespace plumbline
