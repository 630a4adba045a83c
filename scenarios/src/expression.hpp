// Expressions: text such as "T/c*(1 - exp(-c*t/m))" compiled once and evaluated often.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "document.hpp"
#include "plumbline/core/scenario.hpp"

namespace mu {
class Parser;
}

namespace plumbline {

// What an expression may read besides its constants: names, and one number each at the same place of `slots`.
// The slots must outlive the expression and stay where they are.
struct Variables {
  std::span<const std::string_view> names;
  const double* slots = nullptr;
};

// A number that may depend on variables. Evaluation allocates nothing. The functions are those of muParser and
// floor, ceil, mod(a, b) = a - b floor(a/b); the only constant is pi.
class Expression {
 public:
  // From a number or a string; throws ScenarioError at the node's place. What depends on no variable is folded.
  Expression(const Node& node, const Parameters& constants, const Variables& variables);
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;
  ~Expression();

  double operator()() const;
  // Whether one of these variables stands in the text.
  bool uses(std::initializer_list<std::string_view> names) const;
  // Zero whatever the variables are.
  bool is_zero() const { return parser_ == nullptr && constant_ == 0; }

 private:
  std::unique_ptr<mu::Parser> parser_;  // empty for a constant
  double constant_ = 0;
  std::vector<std::string> used_;
};

// A number or an expression of constants; throws ScenarioError when it is not finite.
double number(const Node& node, const Parameters& constants);
// The same, and > 0.
double positive_number(const Node& node, const Parameters& constants);
// Three of them: an array of three numbers or expressions.
Vec3 vector3(const Node& node, const Parameters& constants);

// Names of the functions that expressions may call, sorted.
const std::vector<std::string>& function_names();

}  // namespace plumbline
