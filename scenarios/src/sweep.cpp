#include "sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "expression.hpp"
#include "symbols.hpp"

namespace plumbline {
namespace {

struct Axis {
  std::string name;
  std::vector<double> values;
  bool swept = false;
};

void check_finite(const Node& node, double value) {
  if (!std::isfinite(value)) fail(node, fmt::format("must be finite, is {}", value));
}

// A value that appears twice would make two cases of one name.
void check_distinct(const Node& node, const std::vector<double>& values) {
  for (auto v = values.begin(); v != values.end(); ++v) {
    check_finite(node, *v);
    if (std::find(values.begin(), v, *v) != v) {
      fail(node, fmt::format("the value {} is there twice; name each value once", shortest(*v)));
    }
  }
}

double plain_number(const Node& node) {
  if (node.kind == NodeKind::kText) {
    fail(node, "must be a number or an array of numbers, is a string; expressions belong under [derived]");
  }
  if (node.kind != NodeKind::kNumber) fail(node, "must be a number or an array of numbers");
  check_finite(node, node.number);
  return node.number;
}

Axis read_axis(const Entry& entry, const Overrides& overrides) {
  Axis axis{entry.key, {}, false};
  const Node& node = entry.value;
  if (node.kind == NodeKind::kArray) {
    if (node.items.empty()) fail(node, "is an empty sweep; give at least one value");
    for (const Node& item : node.items) axis.values.push_back(plain_number(item));
    check_distinct(node, axis.values);
  } else {
    axis.values.push_back(plain_number(node));
  }
  axis.swept = axis.values.size() > 1;
  if (const auto replacement = overrides.find(entry.key); replacement != overrides.end()) {
    if (replacement->second.empty()) fail(node, fmt::format("has no value left; give one: -P {}=1", entry.key));
    check_distinct(node, replacement->second);
    axis.values = replacement->second;
    axis.swept = axis.swept || axis.values.size() > 1;
  }
  return axis;
}

void check_name(const Entry& entry, const Parameters& earlier) {
  const auto complain = [&](const std::string& what) { fail(entry.key_place, entry.value.path, what); };
  const auto is_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  if (!std::all_of(entry.key.begin(), entry.key.end(), is_word) || std::isdigit(entry.key[0]) != 0) {
    complain("cannot be used in expressions; a name has letters, digits and _, and begins with a letter");
  }
  if (is_reserved(entry.key)) {
    complain("this name already means something in expressions; choose another, for instance " + entry.key + "0");
  }
  for (const auto& [name, value] : earlier) {
    if (name == entry.key) complain("this name is used twice; [parameters] and [derived] share their names");
  }
}

}  // namespace

std::vector<ParameterSet> expand_sweeps(const Node& root, const Overrides& overrides) {
  std::vector<ParameterSet> sets(1);
  const Node* table = find(root, "parameters");
  if (table == nullptr) return sets;
  for (const Entry& entry : as_table(*table).entries) {
    check_name(entry, {});
    const Axis axis = read_axis(entry, overrides);
    std::vector<ParameterSet> product;
    for (const ParameterSet& set : sets) {
      for (double value : axis.values) {
        product.push_back(set);
        product.back().values.emplace_back(axis.name, value);
        if (axis.swept) product.back().swept.emplace_back(axis.name, value);
      }
    }
    sets = std::move(product);
  }
  return sets;
}

Parameters with_derived(const Node& root, const Parameters& parameters) {
  Parameters all = parameters;
  if (const Node* table = find(root, "derived")) {
    for (const Entry& entry : as_table(*table).entries) {
      check_name(entry, all);
      all.emplace_back(entry.key, number(entry.value, all));
    }
  }
  return all;
}

}  // namespace plumbline
