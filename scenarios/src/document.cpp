#include "document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

#include "plumbline/scenarios/scenario_file.hpp"
#include "spelling.hpp"

namespace plumbline {
namespace {

SourcePlace place_of(const toml::source_region& region, const std::string& file) {
  return {file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

std::string below(const std::string& path, std::string_view name) {
  return fmt::format("{}/{}", path == "/" ? "" : path, name);
}

Node convert(const toml::node& source, const std::string& file, std::string path) {
  Node node;
  node.place = place_of(source.source(), file);
  node.path = std::move(path);
  if (const toml::table* table = source.as_table()) {
    node.kind = NodeKind::kTable;
    for (const auto& [key, value] : *table) {
      node.entries.push_back(
          {std::string(key.str()), convert(value, file, below(node.path, key.str())), place_of(key.source(), file)});
    }
    // The library sorts by name. People read from top to bottom, and [derived] is evaluated in that order.
    std::stable_sort(node.entries.begin(), node.entries.end(), [](const Entry& a, const Entry& b) {
      return std::pair(a.key_place.line, a.key_place.column) < std::pair(b.key_place.line, b.key_place.column);
    });
  } else if (const toml::array* array = source.as_array()) {
    node.kind = NodeKind::kArray;
    for (std::size_t i = 0; i < array->size(); ++i) {
      node.items.push_back(convert((*array)[i], file, below(node.path, std::to_string(i))));
    }
  } else if (const auto text = source.value_exact<std::string>()) {
    node.kind = NodeKind::kText;
    node.text = *text;
  } else if (source.is_number()) {
    node.kind = NodeKind::kNumber;
    node.number = source.value<double>().value();
  } else {
    node.kind = source.is_boolean() ? NodeKind::kBoolean : NodeKind::kDate;
    if (source.is_boolean()) node.number = source.value<bool>().value() ? 1 : 0;
  }
  return node;
}

std::string_view kind_name(NodeKind kind) {
  static constexpr std::string_view kNames[] = {"a number", "a string", "a boolean", "an array", "a table", "a date"};
  return kNames[static_cast<std::size_t>(kind)];
}

[[noreturn]] void wrong_type(const Node& node, std::string_view wanted) {
  fail(node, fmt::format("must be {}, is {}", wanted, kind_name(node.kind)));
}

}  // namespace

Node parse_document(std::string_view text, const std::string& file) {
  try {
    const toml::table table = toml::parse(text, file);
    Node root = convert(table, file, "/");
    root.place = {file, 1, 1};
    return root;
  } catch (const toml::parse_error& error) {
    fail(place_of(error.source(), file), "/",
         fmt::format("this is not TOML ({}); the form is `key = value`, with \"quotes\" around text and expressions",
                     error.description()));
  }
}

void fail(const SourcePlace& place, const std::string& path, const std::string& what) {
  throw ScenarioError(fmt::format("{}:{}:{}: {}: {}", place.file, place.line, place.column, path, what));
}

void fail(const Node& node, const std::string& what) { fail(node.place, node.path, what); }

void allow_only(const Node& table, std::initializer_list<std::string_view> keys) {
  for (const Entry& entry : as_table(table).entries) {
    if (std::find(keys.begin(), keys.end(), entry.key) != keys.end()) continue;
    const std::vector<std::string> known(keys.begin(), keys.end());
    fail(entry.key_place, entry.value.path,
         fmt::format("unknown key; {}allowed here: {}", did_you_mean(entry.key, known), fmt::join(known, ", ")));
  }
}

const Node* find(const Node& table, std::string_view key) {
  for (const Entry& entry : as_table(table).entries) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

const Node& need(const Node& table, std::string_view key, std::string_view example) {
  if (const Node* node = find(table, key)) return *node;
  fail(table.place, below(table.path, key), fmt::format("is missing; add {}", example));
}

const Node& as_table(const Node& node) {
  if (node.kind != NodeKind::kTable) wrong_type(node, "a table");
  return node;
}

const std::string& as_text(const Node& node) {
  if (node.kind != NodeKind::kText) wrong_type(node, "text in quotes");
  if (node.text.find_first_not_of(" \t\n") == std::string::npos) fail(node, "is empty; write what it stands for");
  return node.text;
}

bool as_boolean(const Node& node) {
  if (node.kind != NodeKind::kBoolean) wrong_type(node, "true or false");
  return node.number != 0;
}

const std::vector<Node>& as_array(const Node& node) {
  if (node.kind != NodeKind::kArray) wrong_type(node, "an array");
  return node.items;
}

const std::vector<Node>& as_array(const Node& node, std::size_t count) {
  if (as_array(node).size() != count) {
    fail(node, fmt::format("must have {} components, has {}", count, node.items.size()));
  }
  return node.items;
}

const std::vector<Node>& tables(const Node& table, std::string_view key) {
  static const std::vector<Node> kNone;
  const Node* node = find(table, key);
  if (node == nullptr) return kNone;
  if (node->kind != NodeKind::kArray) {
    fail(*node, fmt::format("must be an array of tables; write the header as [[{}]]", key));
  }
  for (const Node& item : node->items) as_table(item);
  return node->items;
}

}  // namespace plumbline
