// Near misses: what did the author mean?
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumbline {

// Smallest number of single-character insertions, deletions, substitutions and swaps of neighbours between two words.
std::size_t edit_distance(std::string_view a, std::string_view b);

// "did you mean 'mass'? " for the nearest candidate within a third of the word's length (one letter at least);
// empty when there is none.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace plumbline
