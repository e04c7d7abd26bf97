#include "reference/timing/speedup.h"

#include <algorithm>
#include <functional>

#include "core/types/check.h"
#include "reference/results/statistics.h"

namespace contactcheck::timing {
namespace {

constexpr double kMillisecondsPerNanosecond = 1e-6;

using Value = std::function<double(const PhaseSample&)>;
using Places = std::vector<std::size_t>;  // in a pass

double whole(const PhaseSample& s) { return s.total(); }
double unmapped(const PhaseSample& s) { return s.update + s.query; }

Places cold_places(const TimedFrames& frames) {
  Places out(frames.cold.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = i;
  return out;
}

Places played_contact(const TimedFrames& frames) {
  Places out = played_frames(frames.contact.size());
  std::erase_if(out, [&](std::size_t f) { return !frames.contact[f]; });
  return out;
}

Places cold_contact(const TimedFrames& frames) {
  Places out = cold_places(frames);
  std::erase_if(out, [&](std::size_t i) { return !frames.contact[frames.cold[i]]; });
  return out;
}

// A clock that has not ticked has seen a nanosecond at most.
double mean_of(const Pass& pass, const Places& places, const Value& value) {
  double sum = 0.0;
  for (const std::size_t place : places) sum += value(pass.at(place));
  return std::max(sum, 1.0) / static_cast<double>(places.size());
}

double mean_ms(const std::vector<Pass>& passes, const Places& places, const Value& value) {
  std::vector<double> means;
  for (const Pass& pass : passes) means.push_back(mean_of(pass, places, value));
  return results::geometric_mean(means) * kMillisecondsPerNanosecond;
}

// A detector that says nothing once has said nothing.
bool all_reported(const std::vector<Pass>& passes) {
  for (const Pass& pass : passes)
    for (const PhaseSample& frame : pass)
      if (!frame.reported) return false;
  return true;
}

// Which share of the whole a phase is, over all passes.
double share_of(const std::vector<Pass>& passes, const Places& places, const Value& phase) {
  double sum = 0.0, all = 0.0;
  for (const Pass& pass : passes)
    for (const std::size_t place : places) {
      sum += phase(pass.at(place));
      all += pass.at(place).total();
    }
  return all > 0.0 ? sum / all : 0.0;
}

results::PhaseTimes phase_times(const std::vector<Pass>& passes, bool lazy_map,
                                const Places& places, const Places& contact) {
  results::PhaseTimes out;
  out.frame = mean_ms(passes, places, whole);
  const auto phase = [&](double PhaseSample::*member) {
    return out.frame *
           share_of(passes, places, [member](const PhaseSample& s) { return s.*member; });
  };
  if (!lazy_map) out.map = phase(&PhaseSample::map);
  out.update = phase(&PhaseSample::update);
  out.query = phase(&PhaseSample::query);
  if (!contact.empty()) out.contact_frame = mean_ms(passes, contact, whole);
  if (all_reported(passes))
    out.self_reported = mean_ms(passes, places, [](const PhaseSample& s) { return *s.reported; });
  out.cpu = mean_ms(passes, places, [](const PhaseSample& s) { return s.cpu; });
  double taken = 0.0;  // mostly none: there is no geometric mean of it
  for (const Pass& pass : passes)
    for (const std::size_t place : places) taken += pass.at(place).taken;
  out.taken =
      taken * kMillisecondsPerNanosecond / static_cast<double>(passes.size() * places.size());
  return out;
}

results::Ratio ratio_of(const std::vector<Pass>& reference, const std::vector<Pass>& detector,
                        const Places& places, const Value& value) {
  std::vector<double> ratios;
  for (std::size_t p = 0; p < std::min(reference.size(), detector.size()); ++p)
    ratios.push_back(mean_of(reference[p], places, value) / mean_of(detector[p], places, value));
  return results::mean_ratio(ratios);
}

}  // namespace

std::vector<std::size_t> cold_steps(std::vector<std::size_t> cold_frames, std::size_t steps) {
  std::erase_if(cold_frames, [steps](std::size_t frame) { return frame >= steps; });
  if (cold_frames.empty()) cold_frames.push_back(0);
  return cold_frames;
}

std::vector<std::size_t> played_frames(std::size_t frames) {
  Places out;
  for (std::size_t f = frames > 1 ? 1 : 0; f < frames; ++f) out.push_back(f);
  return out;
}

results::QuestionTimes summarize_times(const QuestionSamples& samples, const TimedFrames& frames) {
  CONTACTCHECK_INVARIANT(!samples.playback.empty() && !frames.contact.empty(),
                         "times of at least one pass through at least one frame");
  for (const Pass& pass : samples.playback)
    CONTACTCHECK_INVARIANT(pass.size() == frames.contact.size(), "all frames are timed");
  const Places contact = played_contact(frames);
  results::QuestionTimes out;
  out.question = samples.question;
  out.timed_frames = frames.contact.size();
  out.timed_contact_frames = contact.size();
  out.passes = samples.playback.size();
  out.playback = phase_times(samples.playback, samples.lazy_map,
                             played_frames(frames.contact.size()), contact);
  for (const Pass& pass : samples.playback)
    out.pass_ms.push_back(mean_of(pass, played_frames(pass.size()), whole) *
                          kMillisecondsPerNanosecond);
  out.playback.first_frame = mean_ms(samples.playback, {0}, whole);
  if (!samples.cold.empty())
    out.cold =
        phase_times(samples.cold, samples.lazy_map, cold_places(frames), cold_contact(frames));
  return out;
}

std::vector<std::optional<double>> frame_ms(const QuestionSamples& samples) {
  std::vector<std::optional<double>> out(samples.playback.front().size());
  for (std::size_t f = 0; f < out.size(); ++f) {
    std::vector<double> by_pass;
    for (const Pass& pass : samples.playback) by_pass.push_back(pass.at(f).total());
    out[f] = results::median(std::move(by_pass)) * kMillisecondsPerNanosecond;
  }
  return out;
}

results::Speedup compute_speedup(const QuestionSamples& reference, const QuestionSamples& detector,
                                 const TimedFrames& frames) {
  const auto played = [&](const Places& places, const Value& value) {
    return ratio_of(reference.playback, detector.playback, places, value);
  };
  const Places all = played_frames(frames.contact.size()), contact = played_contact(frames);
  results::Speedup out;
  out.playback = played(all, whole);
  if (!contact.empty()) out.contact_frames = played(contact, whole);
  if (!reference.lazy_map && !detector.lazy_map) out.without_map = played(all, unmapped);
  if (!reference.cold.empty() && !detector.cold.empty())
    out.cold = ratio_of(reference.cold, detector.cold, cold_places(frames), whole);
  out.passes = std::min(reference.playback.size(), detector.playback.size());
  return out;
}

}  // namespace contactcheck::timing
