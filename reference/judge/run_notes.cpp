#include "reference/judge/run_notes.h"

#include <algorithm>

namespace contactcheck::judge {

void note_environment(const process::FloatEnvironmentGuard& guard, const char* call,
                      results::Run& run) {
  const std::string changed = guard.check_and_restore();
  if (changed.empty()) return;
  const std::string text = std::string(call) + " changed " + changed;
  auto& list = run.float_environment;
  if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
}

void FrameNotes::add_frame(const std::vector<std::string>& sentences) {
  ++frames_;
  for (const std::string& sentence : sentences) {
    const auto known = std::find_if(lines_.begin(), lines_.end(),
                                    [&](const Line& l) { return l.sentence == sentence; });
    if (known == lines_.end()) {
      lines_.push_back({sentence, 1});
    } else {
      ++known->frames;
    }
  }
}

std::vector<std::string> FrameNotes::summary() const {
  std::vector<std::string> out;
  for (const Line& l : lines_)
    out.push_back(l.frames == frames_ ? l.sentence
                                      : l.sentence + " (in " + std::to_string(l.frames) + " of " +
                                            std::to_string(frames_) + " frames)");
  return out;
}

void ExchangedPairs::add_frame(const LevelComparison& comparison) {
  missed_ += comparison.missed.size();
  for (const ElementPair& p : comparison.missed)
    if (std::binary_search(comparison.spurious.begin(), comparison.spurious.end(),
                           ElementPair{p.body_a, p.body_b, p.b, p.a}))
      ++exchanged_;
}

std::string ExchangedPairs::sentence() const {
  if (missed_ == 0 || 2 * exchanged_ < missed_) return "";
  const std::string missed = std::to_string(missed_);
  return "reports " +
         (exchanged_ == missed_ ? "all " + missed : std::to_string(exchanged_) + " of " + missed) +
         " missed pairs with a and b exchanged; a belongs to the body with the lower index";
}

}  // namespace contactcheck::judge
