#include "footnotes.hpp"

#include <algorithm>
#include <cmath>

#include "figure.hpp"

namespace plumbline::reports {
namespace {

// a..z, aa, ab, ...
std::string letter(std::size_t index) {
  std::string text;
  for (std::size_t n = index + 1; n > 0; n = (n - 1) / 26) {
    text.insert(text.begin(), static_cast<char>('a' + (n - 1) % 26));
  }
  return text;
}

// How far over its limit, NaN being the farthest.
bool is_farther(const GateResult& a, const GateResult& b) {
  if (std::isnan(a.value) || std::isnan(b.value)) return std::isnan(a.value) && !std::isnan(b.value);
  return std::abs(a.value) > std::abs(b.value);
}

}  // namespace

std::string Footnotes::letter_of(const std::string& key, const std::string& text, const GateResult* gate) {
  auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key == key; });
  if (found == entries_.end()) {
    entries_.push_back({key, text, gate, 0});
    found = entries_.end() - 1;
  }
  ++found->count;
  if (gate != nullptr && is_farther(*gate, *found->gate)) found->gate = gate;
  return letter(static_cast<std::size_t>(found - entries_.begin()));
}

std::string Footnotes::cite(const RunResult& run) {
  const GateResult* const gate = failed_gate(run);
  // Of the other verdicts, the reason of the run tells more than the gates that fell with it.
  if (gate != nullptr && (run.verdict == Verdict::kFail || run.verdict == Verdict::kExpectedFail)) {
    const std::string& cause = gate->deviation.empty() ? gate->reason : gate->deviation;
    const std::string text = (gate->deviation.empty() ? "the limit's reason: " : "known cause: ") + cause;
    std::string key = "gate\n";
    key.append(gate->metric).append("\n").append(text);
    return letter_of(key, text, gate);
  }
  if (run.verdict == Verdict::kPass) return "";
  const std::string name(verdict_name(run.verdict));
  const std::string reason = run.reason.empty() ? std::string(row_of(run.verdict).meaning) : run.reason;
  return letter_of("run\n" + name + "\n" + reason, name + ": " + reason, nullptr);
}

std::string Footnotes::cite(const std::string& remark) { return letter_of("remark\n" + remark, remark, nullptr); }

std::vector<Footnotes::Note> Footnotes::notes() const {
  std::vector<Note> notes;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Entry& e = entries_[i];
    std::string text = e.text;
    if (e.gate != nullptr) {
      text = gate_text(*e.gate);
      if (e.count > 1) text.append(" (the worst of ").append(std::to_string(e.count)).append(")");
      text.append("; ").append(e.text);
    }
    notes.push_back({letter(i), std::move(text)});
  }
  return notes;
}

}  // namespace plumbline::reports
