#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/adapters/register.h"
#include "reference/cli/commands.h"
#include "reference/cli/own_detectors.h"
#include "reference/cli/run_and_report.h"
#include "reference/reduce/defect_search.h"
#include "reference/reduce/minimal_case.h"
#include "reference/reduce/reduction.h"
#include "reference/reduce/simple_number.h"
#include "reference/results/rerun.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/scene.h"
#include "reference/text/id_check.h"
#include "reference/text/json_value.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kProgressEvery = 20;  // candidates
constexpr std::chrono::seconds kLogEvery{2};
constexpr double kKeptGap = 0.25;  // of the first gap: numbers become simple, and the defect stays

// From the command line only: a case file that names a program to start is not mere data.
OwnDetectors own_detector(const ReduceArguments& arguments, const DetectorCatalog& catalog) {
  suite::RunSettings settings;
  settings.call_limit = arguments.call_limit;
  settings.memory_limit = arguments.memory_limit_mib << 20;
  std::vector<std::string> detectors, commands;
  if (!arguments.detector.empty()) detectors.push_back(arguments.detector);
  if (!arguments.command.empty()) commands.push_back(arguments.command);
  OwnDetectors own = load_own_detectors(detectors, commands, settings, catalog);
  if (own.names.size() > 1)
    throw InputError("--detector " + arguments.detector + " and --detector-cmd \"" +
                     arguments.command + "\" are two detectors; reduce takes one");
  return own;
}

// A number is as simple as its binary or its decimal text, whichever is shorter.
std::size_t most_figures(const reduce::CaseCandidate& candidate) {
  int out = 0;
  for (const double x : reduce::coordinates_of(candidate))
    out = std::max(out, std::min(reduce::significant_bits(x), reduce::decimal_digits(x)));
  return static_cast<std::size_t>(out);
}

struct ReducedCase {
  fs::path file;
  reduce::CaseCandidate whole;  ///< what it was reduced from
  reduce::Reduction reduction;
  reduce::MinimalCase minimal;
  reduce::CaseAnswers answers;
};

class ReduceCommand {
 public:
  ReduceCommand(const ReduceArguments& arguments, OwnDetectors own)
      : arguments_(arguments), own_(std::move(own)) {}

  ReducedCase run() {
    check_words();
    const std::vector<reduce::ReductionTask> tasks = read_tasks();
    make_probe(tasks.front());
    const reduce::Defect defect = reduce::find_defect(*probe_, detector_, is_case_, tasks);
    ReducedCase out;
    out.whole = reduce::candidate_of(defect.task.snapshot);
    out.whole.sides = defect.task.sides;
    std::optional<reduce::Reduction> reduction = reduce_defect(defect, out.whole);
    if (!reduction) refuse_own_lattice(defect);
    out.reduction = std::move(*reduction);
    out.file = out_file(defect.task);
    out.minimal = minimal_of(defect, out.reduction, out.file);
    out.answers = reduce::answers_of(out.minimal, verified(out.minimal));
    std::error_code ignored;
    if (out.file.has_parent_path()) fs::create_directories(out.file.parent_path(), ignored);
    write_file_atomically(out.file, reduce::family_text(out.minimal));
    return out;
  }

 private:
  void check_words() const {
    if (!arguments_.level.empty() && !level_from_name(arguments_.level))
      throw InputError("--level \"" + arguments_.level + "\" is no level");
    reduce::require_reducible(arguments_.level);
  }

  std::vector<reduce::ReductionTask> read_tasks() {
    is_case_ = reduce::is_case_file(arguments_.target);
    std::vector<reduce::ReductionTask> tasks =
        is_case_ ? std::vector<reduce::ReductionTask>{reduce::read_case(arguments_.target)}
                 : reduce::tasks_of_scene(arguments_.target, scene::fixtures_directory());
    for (reduce::ReductionTask& task : tasks) {
      if (!own_.names.empty() && !brings_along(task.detector)) task.detector = own_.names.front();
      if (!arguments_.level.empty()) task.level = arguments_.level;
      if (!arguments_.kind.empty()) task.kind = arguments_.kind;
      reduce::require_reducible(task.level);
    }
    if (tasks.front().detector.empty())
      throw InputError("\"" + arguments_.target +
                       "\" is no case file and names no detector: --detector says which one");
    return tasks;
  }

  // A plug-in that is given without options is what the case's name, with its options, is about.
  bool brings_along(const std::string& detector) const {
    return !own_.plugins.empty() && own_.names.front() == own_.plugins.front().declaration.id &&
           own_.names.front() == detector.substr(0, detector.find(':'));
  }

  // A case keeps the name alone of a detector that came from outside.
  void require_known(const std::string& detector) const {
    const std::string id = detector.substr(0, detector.find(':'));
    if (!is_case_ || own_.catalog.find(id) != nullptr) return;
    throw InputError("case \"" + arguments_.target + "\" is of the detector \"" + id +
                     "\", which this program does not have; one from outside is brought along by "
                     "--detector FILE.so or --detector-cmd CMD");
  }

  void make_probe(const reduce::ReductionTask& task) {
    require_known(task.detector);
    const DetectorSpec spec = own_.catalog.parse(task.detector);
    const DetectorInfo* info = own_.catalog.find(spec.id);
    if (!info->absent_because.empty())
      throw InputError("detector \"" + spec.name + "\" is absent: " + info->absent_because);
    reduce::ProbeSettings settings;
    settings.executable = fs::read_symlink("/proc/self/exe");
    settings.detector = detector_ = spec.name;
    settings.plugins = own_.records();
    settings.call_limit = arguments_.call_limit;
    settings.memory_limit = arguments_.memory_limit_mib << 20;
    probe_.emplace(settings);
  }

  std::optional<reduce::Reduction> reduce_defect(const reduce::Defect& defect,
                                                 const reduce::CaseCandidate& whole) {
    const std::vector<Level> levels = reduce::levels_for(defect.finding.level, defect.task.self);
    std::optional<double> first_gap;
    return reduce::reduce(
        whole, defect.task.pair,
        [&](const reduce::CaseCandidate& candidate) {
          show_progress(candidate);
          const reduce::ProbeVerdict verdict = probe_->ask(reduce::snapshot_of(candidate), levels);
          if (!reduce::shows(verdict, defect.finding) ||
              !keeps_position(candidate, verdict, defect))
            return false;
          const double gap = reduce::gap_of(candidate, verdict, defect.finding);
          if (!first_gap) first_gap = gap;  // of the start, at the places of the scene
          return gap >= kKeptGap * *first_gap;
        },
        arguments_.budget,
        defect.task.cells ? reduce::cell_candidates(defect.task.snapshot, *defect.task.cells)
                          : std::vector<reduce::CaseCandidate>());
  }

  // On a terminal one line, cleared by whatever is printed next; in a log a line every few seconds.
  void show_progress(const reduce::CaseCandidate& candidate) {
    const bool terminal = isatty(STDERR_FILENO) != 0;
    const auto now = std::chrono::steady_clock::now();
    if (terminal ? probe_->asked() % kProgressEvery != 0 : now - shown_ < kLogEvery) return;
    shown_ = now;
    std::fprintf(stderr,
                 terminal ? "\r%zu candidates tried, now %zu triangles, %zu bits or digits   \r"
                          : "%zu candidates tried, now %zu triangles, %zu bits or digits\n",
                 probe_->asked(), candidate.triangles(), most_figures(candidate));
  }

  static bool keeps_position(const reduce::CaseCandidate& candidate,
                             const reduce::ProbeVerdict& verdict, const reduce::Defect& defect) {
    if (!defect.finding.general) return true;
    const ElementPair& pair = reduce::disagreement_of(verdict, defect.finding).pair;
    return reduce::in_general_position(candidate, {pair.body_a, pair.a}, {pair.body_b, pair.b});
  }

  [[noreturn]] void refuse_own_lattice(const reduce::Defect& defect) const {
    throw InputError(reduce::where(defect.task) + ", " + detector_ + ": " +
                     reduce::described(defect.finding) +
                     " is there with the scene's own lattices and rest shapes alone, and a minimal "
                     "case has its vertices for both");
  }

  fs::path out_file(const reduce::ReductionTask& task) const {
    if (!arguments_.out.empty()) return arguments_.out;
    if (is_case_) return fs::path(arguments_.target).replace_extension(".min.json");
    const std::string name = task.scene + "-" + std::to_string(task.frame) + "-" + detector_;
    // Of a run's recording beside the cases of the run.
    const fs::path folder = fs::path(arguments_.target).parent_path();
    const fs::path run = folder.filename() == "recordings" ? folder.parent_path() : fs::path("out");
    return run / "cases" / (reduce::id_from(name) + ".min.json");
  }

  std::string library() const {
    const std::string name = adapters::library_of(detector_);
    const auto versions = adapters::library_versions();
    const auto found = versions.find(name);
    return found == versions.end() ? "" : name + " " + found->second;
  }

  reduce::MinimalCase minimal_of(const reduce::Defect& defect, const reduce::Reduction& reduction,
                                 const fs::path& file) const {
    reduce::MinimalCase minimal;
    const std::string stem = file.stem().string();
    minimal.id = !arguments_.out.empty() && text::is_id(stem)
                     ? stem
                     : reduce::id_from("min-" + detector_ + "-" + defect.task.scene);
    minimal.scene = defect.task.scene;
    minimal.place = defect.task.place;
    minimal.drawn = arguments_.drawn;
    minimal.detector = detector_;
    minimal.library = library();
    minimal.finding = defect.finding;
    minimal.candidate = reduction.result;
    minimal.levels = reduce::levels_for(defect.finding.level, defect.task.self);
    return minimal;
  }

  // In a fresh process, as a user of the case will see it.
  reduce::ProbeVerdict verified(const reduce::MinimalCase& minimal) {
    probe_->restart();
    reduce::ProbeVerdict verdict =
        probe_->ask(reduce::snapshot_of(minimal.candidate), minimal.levels);
    if (!reduce::shows(verdict, minimal.finding))
      throw InputError(minimal.scene + ", " + minimal.place + ": the answer of " + detector_ +
                       " depends on what ran before it in its process, and cannot be reduced");
    return verdict;
  }

  const ReduceArguments& arguments_;
  OwnDetectors own_;
  bool is_case_ = false;
  std::string detector_;
  std::optional<reduce::Probe> probe_;
  std::chrono::steady_clock::time_point shown_ = std::chrono::steady_clock::now();  // of progress
};

std::string title_of(const reduce::MinimalCase& minimal) {
  return minimal.scene + ", " + minimal.place + ": " + minimal.detector + " " +
         reduce::described(minimal.finding);
}

// The test alone on standard output, so that it can be written into a file.
void print(const ReducedCase& reduced, const std::string& language) {
  const reduce::TestLanguage test = language == "python"       ? reduce::TestLanguage::kPython
                                    : language == "javascript" ? reduce::TestLanguage::kJavaScript
                                    : language == "c"          ? reduce::TestLanguage::kC
                                                               : reduce::TestLanguage::kCpp;
  const reduce::CaseCandidate &before = reduced.whole, &after = reduced.minimal.candidate;
  std::fprintf(stderr, "%s\n\n", title_of(reduced.minimal).c_str());
  std::fprintf(stderr, "  %-28s %10s %10s\n", "", "before", "after");
  const auto line = [](const char* what, std::size_t was, std::size_t is) {
    std::fprintf(stderr, "  %-28s %10zu %10zu\n", what, was, is);
  };
  line("triangles", before.triangles(), after.triangles());
  line("vertices", before.vertices(), after.vertices());
  line("bits or digits, most", most_figures(before), most_figures(after));
  std::fprintf(stderr, "  %zu candidates tried%s; %s\n\n", reduced.reduction.evaluations,
               reduced.reduction.complete ? "" : ", the whole budget: --budget N allows more",
               after.on_nodes ? "the vertices are lattice nodes" : "no lattice");
  std::fprintf(stderr, "exact:    %s\nanswered: %s\nwritten:  %s\n\n",
               reduced.answers.exact.c_str(), reduced.answers.detector.c_str(),
               reduced.file.c_str());
  std::printf("%s", reduce::printed_test(reduced.minimal, reduced.answers, test).c_str());
}

/// What to reduce of a run, and into which file: the first case of every detector, level and kind,
/// and the first error of every detector, which is looked for in the recording of its scene.
std::vector<ReduceArguments> first_errors(const results::Results& results, const fs::path& out) {
  std::vector<ReduceArguments> wanted;
  const auto file = [&](const std::string& detector, const std::string& what,
                        const std::string& scene) {
    return out / "cases" /
           ("min-" + reduce::id_from(detector) + "-" + what + "-" + scene + ".json");
  };
  std::set<std::tuple<std::string, std::string, std::string>> seen;
  const auto drawn_text = [&](const std::string& id) {
    std::string text;
    for (const results::Scene& scene : results.scenes)
      if (scene.id == id && scene.drawn)
        for (const auto& [name, value] : scene.drawn->parameters)
          text += (text.empty() ? "" : ", ") + name + " " + text::shown(value);
    return text;
  };
  for (const results::Disagreement& d : results.disagreements) {
    if (d.detector == "oracle" || !reduce::can_be_reduced(d.level)) continue;
    if (!seen.insert({d.detector, d.level, d.kind}).second) continue;
    ReduceArguments& one = wanted.emplace_back();
    one.target = out / d.case_file;
    one.out = file(d.detector, d.kind + "-" + d.level, d.scene);
    one.drawn = drawn_text(d.scene);
  }
  for (const results::Run& run : results.runs) {
    if (!results::failed_in_a_frame(run) || !seen.insert({run.detector, "", "error"}).second)
      continue;
    ReduceArguments& one = wanted.emplace_back();
    one.target = (out / run.recording).string() + "@" + std::to_string(*run.failed_frame);
    one.detector = run.detector;
    one.kind = "error";
    one.out = file(run.detector, "error", run.scene);
    one.drawn = drawn_text(run.scene);
  }
  return wanted;
}

}  // namespace

int reduce_command(const ReduceArguments& arguments, const DetectorCatalog& catalog) {
  print(ReduceCommand(arguments, own_detector(arguments, catalog)).run(), arguments.language);
  return 0;
}

void reduce_first_errors(const results::Results& results, const RunArguments& run,
                         const DetectorCatalog& catalog) {
  suite::RunSettings settings;
  settings.call_limit = ReduceArguments{}.call_limit;
  settings.memory_limit = run.memory_limit_mib << 20;
  OwnDetectors own = load_own_detectors(run.detectors, run.commands, settings, catalog);
  std::FILE* const stream = run.json_lines ? stderr : stdout;
  for (ReduceArguments& arguments : first_errors(results, run.out)) {
    arguments.memory_limit_mib = run.memory_limit_mib;
    own.names.clear();  // a case names its own
    if (!arguments.detector.empty()) own.names = {arguments.detector};
    std::string line;
    try {
      const ReducedCase reduced = ReduceCommand(arguments, own).run();
      line = "reduced: " + title_of(reduced.minimal) + ": " +
             std::to_string(reduced.minimal.candidate.triangles()) +
             " triangles: " + reduced.file.string();
    } catch (const InputError& e) {
      line = "not reduced: " + std::string(e.what());
    }
    std::fprintf(stream, "%s\n", line.c_str());
    std::fflush(stream);
  }
}

}  // namespace contactcheck::cli
