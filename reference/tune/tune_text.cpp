#include "reference/tune/tune_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reference/results/scale_ranges.h"
#include "reference/text/shell_word.h"
#include "reference/tune/chosen_file.h"

namespace contactcheck::tune {
namespace {

using Row = std::vector<std::string>;

constexpr std::size_t kNamed = 3;  ///< of those that are as cheap, for a terminal

std::string millimetres(double metres) { return fmt::format("{:.3g}", 1e3 * metres); }

bool varies_lattices(const std::vector<TuneCandidate>& candidates) {
  return std::any_of(candidates.begin(), candidates.end(),
                     [](const TuneCandidate& c) { return c.lattice != 1.0; });
}

bool varies_deformers(const std::vector<TuneCandidate>& candidates) {
  return !candidates.empty() && !candidates.front().deformer.empty();
}

// With deformers a frame is a step of the simulation.
Row header_of(const std::vector<TuneCandidate>& candidates) {
  const bool lattices = varies_lattices(candidates), deformers = varies_deformers(candidates);
  Row row = {
      deformers ? "ms/step" : "ms/frame", "interval", "missed", "spurious", "hover mm", "late"};
  if (deformers) row.insert(row.begin() + 2, "of it deforming");
  if (lattices || deformers) row.push_back("deviation mm");
  if (lattices) row.push_back("lattice");
  if (deformers) row.push_back("deformer");
  row.push_back("detector");
  return row;
}

// The anchor has no interval: costs are measured in it.
std::string interval_of(const Cost& cost) {
  if (!std::isfinite(cost.high_ms)) return "not known";
  if (cost.low_ms == cost.high_ms) return "the anchor";
  return fmt::format("{:.3g} to {:.3g}", cost.low_ms, cost.high_ms);
}

Row row_of(const Tried& tried, const std::vector<TuneCandidate>& candidates) {
  const TuneCandidate& candidate = candidates[tried.candidate];
  const Measurement& m = tried.measurement;
  const bool failed = !m.failure.empty();
  const Cost cost = m.cost();
  Row row = {fmt::format("{:.3g}", cost.ms),
             interval_of(cost),
             fmt::format("{}", m.missed),
             fmt::format("{}", m.spurious),
             m.hover ? millimetres(*m.hover) : "-",
             m.late_frames ? fmt::format("{:+}", *m.late_frames) : "-"};
  const bool lattices = varies_lattices(candidates), deformers = varies_deformers(candidates);
  if (deformers) row.insert(row.begin() + 2, fmt::format("{:.3g}", candidate.step.ms));
  if (lattices || deformers) row.push_back(millimetres(m.deviation));
  if (failed) std::fill(row.begin(), row.end(), "-");
  if (lattices) row.push_back(fmt::format("{:g}", candidate.lattice));
  if (deformers) row.push_back(candidate.deformer);
  row.push_back(candidate.detector + (failed ? " (" + m.failure + ")" : ""));
  return row;
}

std::string aligned(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    text += "  ";
    for (std::size_t c = 0; c + 1 < row.size(); ++c) {
      std::size_t width = 0;
      for (const Row& other : rows) width = std::max(width, other[c].size());
      text += fmt::format("{:>{}}  ", row[c], width);
    }
    text += row.back() + "\n";
  }
  return text;
}

std::string markdown(const std::vector<Row>& rows) {
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (const std::string& cell : rows[r]) text += "| " + cell + " ";
    text += "|\n";
    if (r > 0) continue;
    for (std::size_t c = 0; c < rows[r].size(); ++c)
      text += c + 1 < rows[r].size() ? "| --: " : "| --- ";
    text += "|\n";
  }
  return text;
}

std::vector<Row> rows_of(const std::vector<Tried>& tried,
                         const std::vector<TuneCandidate>& candidates) {
  std::vector<Row> rows = {header_of(candidates)};
  for (const Tried& each : tried) rows.push_back(row_of(each, candidates));
  return rows;
}

std::vector<Tried> front_of(const Tuning& tuning) {
  std::vector<Tried> front;
  for (const std::size_t i : tuning.front) front.push_back(tuning.outcome.tried[i]);
  return front;
}

std::string limits_in_words(const TuningRequest& request) {
  const Limits& limits = request.limits;
  std::string words;
  const auto add = [&](const std::string& limit) { words += (words.empty() ? "" : ", ") + limit; };
  if (limits.missed) add(fmt::format("missed at most {}", *limits.missed));
  if (limits.spurious) add(fmt::format("spurious at most {}", *limits.spurious));
  if (limits.hover) add(fmt::format("hover at most {} mm", millimetres(*limits.hover)));
  if (limits.late_frames) add(fmt::format("at most {} frames late or early", *limits.late_frames));
  if (limits.deviation) add(fmt::format("deviation at most {} mm", millimetres(*limits.deviation)));
  if (request.budget_ms) add(fmt::format("at most {:g} ms", *request.budget_ms));
  return words.empty() ? "none" : words;
}

std::string heading(const Tuning& tuning, const TuningRequest& request) {
  const SearchOutcome& outcome = tuning.outcome;
  const auto again = std::count_if(outcome.tried.begin(), outcome.tried.end(),
                                   [](const Tried& tried) { return tried.times > 1; });
  return fmt::format("{}, question {}, {} frames: {} of {} configurations measured{}{}",
                     tuning.scene, name_of(request.space.question), tuning.frames,
                     outcome.tried.size(), tuning.candidates.size(),
                     again > 0 ? fmt::format(", the cheapest {} repeatedly", again) : "",
                     outcome.exhausted ? " (as many as were allowed)" : "");
}

std::string model_in_words(const TuneCandidate& candidate) {
  if (!candidate.deformer.empty()) return " with " + candidate.deformer;
  return candidate.lattice == 1.0 ? ""
                                  : fmt::format(" in {:g} times as many cells", candidate.lattice);
}

// Also of those that were never measured with a detector, because their step alone is dearer.
std::string deformers_of(const Tuning& tuning) {
  if (!tuning.varies_deformers()) return "";
  std::string costs, failures;
  for (const SimulatedModel& model : tuning.models) {
    if (model.failure.empty())
      costs += fmt::format("{}{} {:.3g}", costs.empty() ? "" : ", ", model.deformer, model.step.ms);
    else
      failures += "\nNot tried: " + model.deformer + ": " + model.failure;
  }
  return "deforming, ms a step: " + costs + failures + "\n";
}

// What intervals in milliseconds do not tell.
std::string costs_in_words(const Tuning& tuning) {
  if (tuning.anchor.empty()) return "";
  std::string words =
      "Costs were measured as ratios to the time of one detector, the anchor: " + tuning.anchor +
      ".";
  const bool lattices = varies_lattices(tuning.candidates), deformers = tuning.varies_deformers();
  if (lattices || deformers)
    words += fmt::format(
        "\nWithin one {} these ratios are compared. The intervals in ms also hold how well {} is "
        "known, which all there share: they may overlap where the ratios do not.",
        deformers ? "deformer" : "lattice",
        deformers ? "the time of a step and of the anchor" : "the anchor's own time");
  return words + "\n";
}

// Whether the choice is one by its cost at all.
std::string as_cheap_in_words(const Tuning& tuning, std::size_t most_named) {
  const std::vector<std::size_t>& others = tuning.as_cheap;
  if (others.empty())
    return "Nothing else that was measured and meets the limits is as cheap within noise.\n";
  std::string words = "As cheap within noise: ";
  const std::size_t named = std::min(others.size(), most_named);
  for (std::size_t i = 0; i < named; ++i) {
    const TuneCandidate& other = tuning.candidates[others[i]];
    words += (i == 0 ? "" : "; ") + other.detector + model_in_words(other);
  }
  if (others.size() > named) words += fmt::format("; and {} more (tune.md)", others.size() - named);
  return words + ".\n";
}

// What no frame of this scene shows: that another, smaller or farther out, may be answered wrongly.
std::string range_in_words(const results::ScaleRange& range, const results::SceneScale& scale) {
  const std::string what = range.by_size() ? "edges of" : "distances from the origin, in edges, of";
  const std::string right = range.from.empty() ? what + " no size that was tried"
                                               : fmt::format("{} {} to {}{}", what, range.from,
                                                             range.to, range.by_size() ? " m" : "");
  const std::string here =
      range.by_size() ? fmt::format("{:.3g} to {:.3g} m", scale.shortest_edge, scale.longest_edge)
                      : fmt::format("{:.3g}", scale.reach / scale.shortest_edge);
  return fmt::format("In the suite scales it is right for {}; here {}{}.\n", right, here,
                     results::outside(range, scale) ? ": outside" : "");
}

// Whether no configuration without errors can be cheaper: only other limits could have kept it out.
bool cheapest_without_errors(const Measurement& chosen, const Limits& limits) {
  return chosen.missed == 0 && chosen.spurious == 0 && !limits.hover && !limits.late_frames &&
         !limits.deviation;
}

std::string verdict(const Tuning& tuning, const TuningRequest& request, std::size_t most_named) {
  if (!tuning.chosen)
    return tuning.confirmed.empty()
               ? "No configuration meets the limits.\n"
               : fmt::format("No configuration meets the limits on the {} held-out frames.\n",
                             tuning.held_out_frames);
  const Tried& chosen = tuning.confirmed[*tuning.chosen];
  const TuneCandidate& candidate = tuning.candidates[chosen.candidate];
  const Cost cost = chosen.measurement.cost();
  std::string text = fmt::format("{}: {}{}, {:.3g} ms a {} ({}) on {} held-out frames.\n",
                                 cheapest_without_errors(chosen.measurement, request.limits)
                                     ? "Cheapest without errors"
                                     : "Chosen",
                                 candidate.detector, model_in_words(candidate), cost.ms,
                                 tuning.varies_deformers() ? "step" : "frame", interval_of(cost),
                                 tuning.held_out_frames) +
                     as_cheap_in_words(tuning, most_named);
  if (const auto& scale = chosen.measurement.scale)
    for (const results::ScaleRange& range : chosen.measurement.ranges)
      text += range_in_words(range, *scale);
  if (!tuning.within_budget(request.budget_ms))
    text += fmt::format("That is more than the {:g} ms that are allowed.\n", *request.budget_ms);
  return text;
}

// The arguments of a command line that load the chosen detector and name it.
std::string detector_in_words(const Tuning& tuning, const TuningRequest& request) {
  const std::string& name = tuning.candidates[tuning.confirmed[*tuning.chosen].candidate].detector;
  const std::string id = name.substr(0, name.find(':'));
  std::string words;
  if (const auto own = request.commands.find(id); own != request.commands.end())
    words += " --detector-cmd " + text::in_shell(own->second);
  const auto library = request.libraries.find(id);
  return words + " --detector " +
         text::in_shell(
             library == request.libraries.end() ? name : library->second + name.substr(id.size()));
}

/// How the chosen configuration is run.
struct HowToRun {
  std::string words;  ///< one line
  std::vector<std::string> commands;
};

HowToRun how_to_run(const Tuning& tuning, const TuningRequest& request) {
  const std::string file = chosen_file(request).string(), run = "contactcheck run ";
  const std::string detector = detector_in_words(tuning, request);
  if (chosen_from_outside(tuning, request))
    return {file +
                " names scene and detector, but a file cannot bring in a detector from outside; "
                "the command line does:",
            {run + text::in_shell(file) + detector}};
  return {"It is written to " + file + "; run it by either of:",
          {run + text::in_shell(file), run + text::in_shell(tuning.chosen_scene) + detector}};
}

}  // namespace

std::string tuning_text(const Tuning& tuning, const TuningRequest& request) {
  std::string text = heading(tuning, request) + "\nlimits: " + limits_in_words(request) + "\n" +
                     deformers_of(tuning) + "\nPareto front of what was measured\n" +
                     aligned(rows_of(front_of(tuning), tuning.candidates)) + "\n";
  if (!tuning.confirmed.empty())
    text += fmt::format("On {} held-out frames\n", tuning.held_out_frames) +
            aligned(rows_of(tuning.confirmed, tuning.candidates)) + "\n";
  text += costs_in_words(tuning) + verdict(tuning, request, kNamed);
  if (!tuning.chosen) return text;
  const HowToRun how = how_to_run(tuning, request);
  text += how.words + "\n";
  for (const std::string& command : how.commands) text += "  " + command + "\n";
  return text;
}

std::string tuning_markdown(const Tuning& tuning, const TuningRequest& request) {
  std::string text =
      "# " + heading(tuning, request) + "\n\nLimits: " + limits_in_words(request) + ".\n\n";
  if (std::string deformers = deformers_of(tuning); !deformers.empty()) {
    deformers[0] = 'D';
    text += deformers + "\n";
  }
  text += verdict(tuning, request, tuning.as_cheap.size());
  if (tuning.chosen) {
    const HowToRun how = how_to_run(tuning, request);
    text += "\n" + how.words + "\n\n";
    for (const std::string& command : how.commands) text += "    " + command + "\n";
  }
  text += "\n## Pareto front\n\n" + costs_in_words(tuning) + "\n" +
          markdown(rows_of(front_of(tuning), tuning.candidates));
  if (!tuning.confirmed.empty())
    text += fmt::format("\n## On {} held-out frames\n\n", tuning.held_out_frames) +
            markdown(rows_of(tuning.confirmed, tuning.candidates));
  return text + "\n## Everything that was measured\n\n" +
         markdown(rows_of(tuning.outcome.tried, tuning.candidates));
}

}  // namespace contactcheck::tune
