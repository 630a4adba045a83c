// A sound scenario text with something in it replaced, and what the reader says of it.
#pragma once

#include <stdexcept>
#include <string>

#include "plumbline/scenarios/scenario_file.hpp"

namespace plumbline {

// The text with the first occurrence of `sound` replaced.
inline std::string replaced(std::string text, const std::string& sound, const std::string& faulty) {
  const std::size_t at = text.find(sound);
  if (at == std::string::npos) throw std::invalid_argument("the row does not fit the file: " + sound);
  return text.replace(at, sound.size(), faulty);
}

// The reader's message, or "no error".
inline std::string fault_of(const std::string& text) {
  try {
    read_scenario(text, "f.toml");
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace plumbline
