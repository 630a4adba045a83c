// A parsed TOML file as a plain tree that remembers where everything was written.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "plumbline/core/gate.hpp"

namespace plumbline {

enum class NodeKind { kNumber, kText, kBoolean, kArray, kTable, kDate };

struct Entry;

// One value. Only the member that belongs to `kind` is filled.
struct Node {
  NodeKind kind = NodeKind::kTable;
  SourcePlace place;
  std::string path;   // "/gate/0/limit"; "/" for the whole file
  double number = 0;  // integers too: 53 bits are plenty for what a scenario counts; true is 1
  std::string text;
  std::vector<Node> items;
  std::vector<Entry> entries;  // in the order of the file
};

struct Entry {
  std::string key;
  Node value;
  SourcePlace key_place;
};

// Throws ScenarioError on a syntax error.
Node parse_document(std::string_view text, const std::string& file);

// Throws ScenarioError "file:line:col: /path: what". `what` holds the fault and, after a semicolon, the way out.
[[noreturn]] void fail(const Node& node, const std::string& what);
[[noreturn]] void fail(const SourcePlace& place, const std::string& path, const std::string& what);

// Throws for the first key, in the order of the file, that is not among `keys`.
void allow_only(const Node& table, std::initializer_list<std::string_view> keys);

// nullptr when the key is absent.
const Node* find(const Node& table, std::string_view key);
// Throws when the key is absent; `example` is the line that would mend it.
const Node& need(const Node& table, std::string_view key, std::string_view example);

// Typed views; each throws when the node is something else.
const Node& as_table(const Node& node);
const std::string& as_text(const Node& node);  // not empty
bool as_boolean(const Node& node);
const std::vector<Node>& as_array(const Node& node);
const std::vector<Node>& as_array(const Node& node, std::size_t count);
// The elements of an array of tables ([[key]]); empty when the key is absent.
const std::vector<Node>& tables(const Node& table, std::string_view key);

}  // namespace plumbline
