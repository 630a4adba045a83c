#include "expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "spelling.hpp"

namespace plumbline {
namespace {

double floor_of(double a) { return std::floor(a); }
double ceil_of(double a) { return std::ceil(a); }
double mod_of(double a, double b) { return a - b * std::floor(a / b); }

std::unique_ptr<mu::Parser> make_parser() {
  auto parser = std::make_unique<mu::Parser>();
  parser->ClearConst();
  parser->DefineConst("pi", std::numbers::pi);
  parser->DefineFun("floor", floor_of);
  parser->DefineFun("ceil", ceil_of);
  parser->DefineFun("mod", mod_of);
  // What is written is what is computed: the optimiser regroups sums and products, which rounds differently.
  parser->EnableOptimizer(false);
  return parser;
}

struct Word {
  std::string name;
  bool is_call;
};

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool starts_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// Past the number that begins at `i`; the e of an exponent belongs to it.
std::size_t skip_number(const std::string& text, std::size_t i) {
  while (i < text.size() && (is_digit(text[i]) || text[i] == '.')) ++i;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    std::size_t digits = i + 1;
    if (digits < text.size() && (text[digits] == '+' || text[digits] == '-')) ++digits;
    if (digits < text.size() && is_digit(text[digits])) {
      i = digits;
      while (i < text.size() && is_digit(text[i])) ++i;
    }
  }
  return i;
}

// Every name in the text. The parser itself would stop at an unknown function with a complaint about parentheses.
std::vector<Word> words_of(const std::string& text) {
  std::vector<Word> words;
  for (std::size_t i = 0; i < text.size();) {
    if (is_digit(text[i]) || text[i] == '.') {
      i = skip_number(text, i);
    } else if (starts_word(text[i])) {
      const std::size_t begin = i;
      while (i < text.size() && (starts_word(text[i]) || is_digit(text[i]))) ++i;
      std::size_t next = text.find_first_not_of(" \t\n", i);
      words.push_back({text.substr(begin, i - begin), next != std::string::npos && text[next] == '('});
    } else {
      ++i;
    }
  }
  return words;
}

// muParser would take a lone '=' as an assignment and overwrite the variable.
bool assigns(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    if (i + 1 < text.size() && text[i + 1] == '=') {
      ++i;
    } else if (i == 0 || std::string_view("<>!").find(text[i - 1]) == std::string_view::npos) {
      return true;
    }
  }
  return false;
}

void check_names(const Node& node, const std::vector<Word>& words, const std::vector<std::string>& symbols) {
  for (const Word& word : words) {
    const std::vector<std::string>& known = word.is_call ? function_names() : symbols;
    if (std::find(known.begin(), known.end(), word.name) != known.end()) continue;
    fail(node, fmt::format("unknown {} '{}' in \"{}\"; {}known here: {}", word.is_call ? "function" : "symbol",
                           word.name, node.text, did_you_mean(word.name, known), fmt::join(known, ", ")));
  }
}

}  // namespace

const std::vector<std::string>& function_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    const auto parser = make_parser();  // outlives the loop over its table
    for (const auto& [name, callback] : parser->GetFunDef()) names.push_back(name);
    return names;
  }();
  return kNames;
}

Expression::Expression(const Node& node, const Parameters& constants, const Variables& variables) {
  if (node.kind == NodeKind::kNumber) {
    constant_ = node.number;
    return;
  }
  if (node.kind != NodeKind::kText) fail(node, "must be a number or an expression in quotes");
  const std::string& text = as_text(node);

  std::vector<std::string> symbols;
  for (const auto& [name, value] : constants) symbols.push_back(name);
  symbols.insert(symbols.end(), variables.names.begin(), variables.names.end());
  symbols.emplace_back("pi");
  const std::vector<Word> words = words_of(text);
  check_names(node, words, symbols);
  if (assigns(text)) fail(node, fmt::format("\"{}\" assigns with '='; to compare, write '=='", text));

  auto parser = make_parser();
  const auto is_used = [&](std::string_view name) {
    return std::any_of(words.begin(), words.end(), [&](const Word& w) { return !w.is_call && w.name == name; });
  };
  try {
    for (const auto& [name, value] : constants) parser->DefineConst(name, value);
    for (std::size_t i = 0; i < variables.names.size(); ++i) {
      const std::string name(variables.names[i]);
      // The library wants a pointer to non-const because of its assignment operator, which was ruled out above.
      parser->DefineVar(name, const_cast<double*>(variables.slots + i));  // NOLINT
      if (is_used(name)) used_.push_back(name);
    }
    parser->SetExpr(text);
    constant_ = parser->Eval();  // compiles: later evaluations only run
    if (parser->GetNumResults() != 1) {
      fail(node, fmt::format("\"{}\" holds several expressions; write one, without commas outside of calls", text));
    }
  } catch (const mu::Parser::exception_type& error) {
    fail(node, fmt::format("cannot read the expression \"{}\" ({}); write it like \"T/c*(1 - exp(-c*t/m))\"", text,
                           error.GetMsg()));
  }
  if (!used_.empty()) parser_ = std::move(parser);
}

Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;
Expression::~Expression() = default;

double Expression::operator()() const { return parser_ == nullptr ? constant_ : parser_->Eval(); }

bool Expression::uses(std::initializer_list<std::string_view> names) const {
  return std::any_of(names.begin(), names.end(), [this](std::string_view name) {
    return std::find(used_.begin(), used_.end(), name) != used_.end();
  });
}

double number(const Node& node, const Parameters& constants) {
  const double value = Expression(node, constants, {})();
  if (!std::isfinite(value)) fail(node, fmt::format("must be finite, is {}; check the parameters", value));
  return value;
}

double positive_number(const Node& node, const Parameters& constants) {
  const double value = number(node, constants);
  if (!(value > 0)) fail(node, fmt::format("must be > 0, is {}", shortest(value)));
  return value;
}

Vec3 vector3(const Node& node, const Parameters& constants) {
  const auto& items = as_array(node, 3);
  return {number(items[0], constants), number(items[1], constants), number(items[2], constants)};
}

}  // namespace plumbline
