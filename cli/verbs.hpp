// The table of verbs. Each has its own file; each adds its options and tells what to do.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace plumbline {

// Adds the verb to the program; when it is chosen, `action` is set to what it does, which returns the exit code.
using Action = std::function<int()>;
void add_run_verb(CLI::App& program, Action& action);
void add_list_verb(CLI::App& program, Action& action);
void add_certify_verb(CLI::App& program, Action& action);
void add_compare_verb(CLI::App& program, Action& action);
void add_doctor_verb(CLI::App& program, Action& action);
void add_adapter_verb(CLI::App& program, Action& action);
void add_export_verb(CLI::App& program, Action& action);
void add_import_verb(CLI::App& program, Action& action);

}  // namespace plumbline
