#include "reference/compare/speedup.h"

#include <algorithm>
#include <functional>

#include "core/types/check.h"
#include "reference/statistics/statistics.h"

namespace contactcheck {
namespace {

constexpr double kMillisecondsPerNanosecond = 1e-6;

using Mode = std::vector<PhaseSample> FrameSamples::*;
using Value = std::function<double(const PhaseSample&)>;

// Which repeats are taken: (process, repeat) pairs.
using Draw = std::vector<std::pair<std::size_t, std::size_t>>;

double frame_median(const ProcessSamples& processes, std::size_t frame, Mode mode,
                    const Value& value, const Draw& draw) {
  std::vector<double> values;
  for (const auto& [process, repeat] : draw)
    values.push_back(value((processes[process].frames.at(frame).*mode)[repeat]));
  return median(std::move(values));
}

std::size_t repeats_of(const QuestionSamples& samples) {
  return samples.frames.empty() ? 0 : samples.frames.begin()->second.cold.size();
}

Draw everything(const ProcessSamples& processes) {
  Draw draw;
  for (std::size_t p = 0; p < processes.size(); ++p)
    for (std::size_t r = 0; r < repeats_of(processes[p]); ++r) draw.emplace_back(p, r);
  return draw;
}

// Processes, and within each as many repeats as it has. One draw takes the same repeats of both
// sides of a ratio, as they ran together.
Draw resample(const ProcessSamples& processes, Resampler& resampler) {
  Draw draw;
  for (std::size_t i = 0; i < processes.size(); ++i) {
    const std::size_t p = resampler.below(processes.size());
    const std::size_t n = repeats_of(processes[p]);
    for (std::size_t r = 0; r < n; ++r) draw.emplace_back(p, resampler.below(n));
  }
  return draw;
}

double total(const ProcessSamples& processes, const std::vector<std::size_t>& frames, Mode mode,
             const Value& value, const Draw& draw) {
  double sum = 0.0;
  for (std::size_t f : frames) sum += frame_median(processes, f, mode, value, draw);
  return sum;
}

Ratio ratio_of(const ProcessSamples& reference, const ProcessSamples& detector,
               const std::vector<std::size_t>& frames, Mode mode, const Value& value) {
  const auto time_ratio = [&](const Draw& draw) {
    return total(reference, frames, mode, value, draw) /
           std::max(total(detector, frames, mode, value, draw), 1.0);
  };
  return bootstrap(time_ratio(everything(detector)),
                   [&](Resampler& resampler) { return time_ratio(resample(detector, resampler)); });
}

std::vector<std::size_t> common_frames(const ProcessSamples& a, const ProcessSamples& b) {
  std::vector<std::size_t> frames;
  for (const auto& [frame, samples] : a.front().frames)
    if (b.front().frames.count(frame)) frames.push_back(frame);
  return frames;
}

std::vector<std::size_t> only_contact(const std::vector<std::size_t>& frames,
                                      const std::vector<bool>& contact_frames) {
  std::vector<std::size_t> out;
  for (std::size_t f : frames)
    if (contact_frames[f]) out.push_back(f);
  return out;
}

// A detector that says nothing once has said nothing.
bool all_reported(const ProcessSamples& processes, Mode mode) {
  for (const QuestionSamples& process : processes)
    for (const auto& [frame, samples] : process.frames)
      for (const PhaseSample& repeat : samples.*mode)
        if (!repeat.reported) return false;
  return true;
}

results::PhaseTimes phase_times(const ProcessSamples& processes,
                                const std::vector<std::size_t>& frames,
                                const std::vector<std::size_t>& contact, Mode mode) {
  const Draw all = everything(processes);
  const auto mean = [&](const std::vector<std::size_t>& over, const Value& value) {
    return total(processes, over, mode, value, all) * kMillisecondsPerNanosecond /
           static_cast<double>(over.size());
  };
  results::PhaseTimes out;
  if (!processes.front().lazy_map)
    out.map = mean(frames, [](const PhaseSample& s) { return s.map; });
  out.update = mean(frames, [](const PhaseSample& s) { return s.update; });
  out.query = mean(frames, [](const PhaseSample& s) { return s.query; });
  out.frame = mean(frames, [](const PhaseSample& s) { return s.total(); });
  if (!contact.empty())
    out.contact_frame = mean(contact, [](const PhaseSample& s) { return s.total(); });
  if (all_reported(processes, mode))
    out.self_reported = mean(frames, [](const PhaseSample& s) { return *s.reported; });
  return out;
}

}  // namespace

results::QuestionTimes summarize_times(const ProcessSamples& processes,
                                       const std::vector<bool>& contact_frames) {
  const std::vector<std::size_t> frames = common_frames(processes, processes);
  CONTACTCHECK_INVARIANT(!frames.empty(), "times of at least one frame");
  const std::vector<std::size_t> contact = only_contact(frames, contact_frames);
  results::QuestionTimes out;
  out.question = processes.front().question;
  out.timed_frames = frames.size();
  out.timed_contact_frames = contact.size();
  out.repeats = everything(processes).size();
  out.cold = phase_times(processes, frames, contact, &FrameSamples::cold);
  out.hot = phase_times(processes, frames, contact, &FrameSamples::hot);
  return out;
}

std::vector<std::optional<double>> cold_frame_ms(const ProcessSamples& processes,
                                                 std::size_t frames) {
  const Draw all = everything(processes);
  std::vector<std::optional<double>> out(frames);
  for (const auto& [frame, samples] : processes.front().frames)
    out.at(frame) = frame_median(
                        processes, frame, &FrameSamples::cold,
                        [](const PhaseSample& s) { return s.total(); }, all) *
                    kMillisecondsPerNanosecond;
  return out;
}

std::optional<results::Speedup> compute_speedup(const ProcessSamples& reference,
                                                const ProcessSamples& detector,
                                                const std::vector<bool>& contact_frames) {
  const std::vector<std::size_t> frames = common_frames(reference, detector);
  if (frames.empty()) return std::nullopt;
  const auto whole = [](const PhaseSample& s) { return s.total(); };
  const auto unmapped = [](const PhaseSample& s) { return s.update + s.query; };
  const std::vector<std::size_t> contact = only_contact(frames, contact_frames);
  results::Speedup out;
  out.cold = ratio_of(reference, detector, frames, &FrameSamples::cold, whole);
  out.hot = ratio_of(reference, detector, frames, &FrameSamples::hot, whole);
  if (!contact.empty())
    out.contact_frames = ratio_of(reference, detector, contact, &FrameSamples::cold, whole);
  if (!reference.front().lazy_map && !detector.front().lazy_map)
    out.without_map = ratio_of(reference, detector, frames, &FrameSamples::cold, unmapped);
  return out;
}

}  // namespace contactcheck
