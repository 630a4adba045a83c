// What is said once below a table instead of in each of its cells.
#pragma once

#include <string>
#include <vector>

#include "plumbline/core/run_result.hpp"

namespace plumbline::reports {

class Footnotes {
 public:
  struct Note {
    std::string letter;
    std::string text;
  };

  // The letter of the note that tells why the run did not simply pass; empty when there is nothing to tell. Failures
  // of one metric for one cause share a note, which then tells the largest value.
  std::string cite(const RunResult& run);
  // The letter of a plain remark.
  std::string cite(const std::string& remark);

  std::vector<Note> notes() const;

 private:
  struct Entry {
    std::string key;
    std::string text;        // the cause
    const GateResult* gate;  // the worst of them; nullptr for a remark
    std::size_t count;
  };
  std::string letter_of(const std::string& key, const std::string& text, const GateResult* gate);
  std::vector<Entry> entries_;
};

}  // namespace plumbline::reports
