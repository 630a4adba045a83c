// What a result depends on besides the code: machine, system, compiler, flags, and the command that was given.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace plumbline {

using Environment = std::vector<std::pair<std::string, std::string>>;

// date (UTC), system, processor, cores, compiler, build (flags), command.
Environment describe_environment();

}  // namespace plumbline
