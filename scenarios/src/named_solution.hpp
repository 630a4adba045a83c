// What all named solutions share: how they introduce themselves and how they refuse a scenario.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "plumbline/core/reference.hpp"
#include "plumbline/core/scenario.hpp"

namespace plumbline {

class NamedSolution : public Reference {
 public:
  explicit NamedSolution(std::string citation) : citation_(std::move(citation)) {}
  std::string_view citation() const override { return citation_; }
  std::string_view kind() const override { return "solution"; }
  std::string_view bound_source() const override {
    return "rounding of the solution's own steps, magnified as the motion magnifies it";
  }

 private:
  std::string citation_;
};

[[noreturn]] inline void refuse(const char* why) { throw std::invalid_argument(why); }

template <typename Kind>
std::shared_ptr<const Reference> solved_by(const Scenario& scenario, std::string citation) {
  return std::make_shared<Kind>(scenario, std::move(citation));
}

}  // namespace plumbline
