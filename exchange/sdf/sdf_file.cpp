#include "sdf_file.hpp"

#include <tinyxml2.h>

#include <cstdlib>
#include <iostream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "plumbline/exchange/world_file.hpp"

namespace plumbline {
namespace {

using tinyxml2::XMLElement;

// libsdformat keeps a log below HOME and speaks to std::cerr in colours: the former is switched off, the latter caught.
class Silence {
 public:
  Silence() : before_(std::cerr.rdbuf(caught_.rdbuf())) { unsetenv("HOME"); }
  ~Silence() { std::cerr.rdbuf(before_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

  // Without colours and without the prefix that names libsdformat's own source.
  std::vector<std::string> lines() const {
    std::vector<std::string> result;
    std::istringstream in(caught_.str());
    for (std::string line; std::getline(in, line);) {
      std::string plain;
      for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '\033') {
          while (i < line.size() && line[i] != 'm') ++i;
        } else {
          plain += line[i];
        }
      }
      if (plain.starts_with("Warning [") || plain.starts_with("Error [")) plain = plain.substr(plain.find(']') + 1);
      plain.erase(0, plain.find_first_not_of(" \t"));
      if (!plain.empty() && plain.find("No HOME defined") == plain.npos) result.push_back(std::move(plain));
    }
    return result;
  }

 private:
  std::ostringstream caught_;
  std::streambuf* before_;
};

std::string text_of(const XMLElement* element) {
  return element != nullptr && element->GetText() != nullptr ? element->GetText() : "";
}
std::string attribute_of(const XMLElement* element, const char* name) {
  const char* const text = element != nullptr ? element->Attribute(name) : nullptr;
  return text != nullptr ? text : "";
}

void read_recorded(const XMLElement& parent, const std::string& scope, SdfFile& file) {
  for (const XMLElement* model = parent.FirstChildElement("model"); model != nullptr;
       model = model->NextSiblingElement("model")) {
    const std::string name = scope + attribute_of(model, "name") + "::";
    for (const XMLElement* link = model->FirstChildElement("link"); link != nullptr;
         link = link->NextSiblingElement("link")) {
      RecordedLink recorded;
      std::istringstream numbers(text_of(link->FirstChildElement("velocity")));
      for (Vec3* part : {&recorded.v_W, &recorded.w_W}) {
        for (int i = 0; i < 3; ++i) numbers >> (*part)(i);
      }
      if (const XMLElement* pose = link->FirstChildElement("pose")) {
        std::istringstream coordinates(text_of(pose));
        Vec3 p = Vec3::Zero();
        for (int i = 0; i < 3; ++i) coordinates >> p(i);
        recorded.place = p;
      }
      file.recorded[name + attribute_of(link, "name")] = recorded;
    }
    read_recorded(*model, name, file);
  }
}

std::string told(const sdf::Error& error, const std::filesystem::path& file) {
  return at_line(error.FilePath().value_or(file.string()), error.LineNumber().value_or(0), error.Message());
}

// What libsdformat does to a URDF without a word in its answer.
void list_urdf_losses(const XMLElement& robot, const sdf::Root& root, WorldDraft& draft) {
  draft.notes.emplace_back("URDF states neither gravity nor contact laws: libsdformat's defaults stand in");
  std::set<std::string> on_the_world;  // links that a fixed joint ties to the world
  for (const XMLElement* joint = robot.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    const std::string type = attribute_of(joint, "type"), name = "joint '" + attribute_of(joint, "name") + "'";
    if (type == "planar") draft.losses.push_back(name + " is planar; scenarios have hinges and sliders");
    if (type == "floating") {
      draft.losses.push_back(name + " is floating, which libsdformat cannot place; give the body a model in SDF");
    }
    if (joint->FirstChildElement("mimic") != nullptr) draft.losses.push_back(name + " mimics another joint");
    if (type == "fixed" && attribute_of(joint->FirstChildElement("parent"), "link") == "world") {
      on_the_world.insert(attribute_of(joint->FirstChildElement("child"), "link"));
    }
  }
  const sdf::Model* const model = root.Model();
  for (const XMLElement* link = robot.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    const std::string name = attribute_of(link, "name");
    if (name == "world" || model == nullptr || model->LinkNameExists(name)) continue;
    const bool collides = link->FirstChildElement("collision") != nullptr;
    if (collides && on_the_world.contains(name)) {
      draft.losses.push_back("link '" + name +
                             "' stands on the world and collides, but libsdformat leaves it out; give " +
                             "it a static model in SDF");
    } else if (link->FirstChildElement("inertial") == nullptr && !collides) {
      draft.notes.push_back("link '" + name + "' is only a place: merged into its parent");
    } else {
      draft.notes.push_back("link '" + name +
                            "' is gone: libsdformat merges links that a fixed joint holds into their " +
                            "parent, and leaves out those without mass");
    }
  }
}

}  // namespace

SdfFile load_sdf(const ImportRequest& request, WorldDraft& draft) {
  const WorldFormat format = format_of_world_file(request.file);
  draft.format = format == WorldFormat::kUrdf ? "URDF" : "SDF";
  SdfFile file;
  sdf::Errors errors;
  {
    const Silence silence;
    errors = file.root.Load(request.file.string());
    for (std::string& line : silence.lines()) draft.notes.push_back("libsdformat: " + line);
  }
  const bool something = file.root.WorldCount() > 0 || file.root.Model() != nullptr;
  std::string all;
  for (const sdf::Error& error : errors) {
    if (all.find(told(error, request.file)) != all.npos) continue;  // it says some things twice
    all += (all.empty() ? "" : "\n") + told(error, request.file);
    draft.losses.push_back(told(error, request.file));
  }
  if (!something) {
    throw std::invalid_argument(!all.empty() ? all
                                             : at_line(request.file, 0, "there is neither a world nor a model in it"));
  }
  tinyxml2::XMLDocument document;
  document.LoadFile(request.file.c_str());
  const XMLElement* const root = document.RootElement();
  if (format == WorldFormat::kUrdf) {
    list_urdf_losses(*root, file.root, draft);
  } else if (const XMLElement* world = root->FirstChildElement("world")) {
    if (const XMLElement* state = world->FirstChildElement("state")) read_recorded(*state, "", file);
  }
  return file;
}

}  // namespace plumbline
