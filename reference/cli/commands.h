// The subcommands. Each returns an exit code: 0 done, 1 a check failed, 2 bad usage or bad input, 3
// a detector ended in an error that known-defects.json does not list. InputError passes through to
// contactcheck_main, which makes it 2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "reference/queries/query_judge.h"
#include "reference/queries/scene_queries.h"
#include "reference/results/results.h"
#include "reference/scene/frame_files.h"
#include "reference/scene/mesh_scene.h"
#include "reference/scene/random_pairs.h"
#include "reference/suite/job.h"
#include "reference/suite/run_plan.h"
#include "reference/suite/shard.h"

namespace contactcheck::cli {

struct RunArguments : suite::RunTargets {
  std::vector<std::string> commands;  ///< detectors that run as processes, over pipes
  std::string detectors_of;           ///< a suite whose detectors run before these; empty: none
  std::size_t step_repeats = suite::RunSettings{}.step_repeats;
  std::optional<std::size_t> processes;  ///< passes of every detector; none: see RunSettings
  std::filesystem::path out = "out";
  std::optional<suite::Shard> shard;  ///< run only this part
  bool timing = true, quiet = false, resume = false, overwrite = false;
  bool explain = false;      ///< what the columns mean
  bool reduce = false;       ///< reduce the first wrong answers after the run
  bool json_lines = false;   ///< write events to stdout, and nothing else
  bool closed_loop = false;  ///< simulated scenes: drive them with every detector too
  double call_limit = suite::RunSettings{}.call_limit;  ///< seconds
  std::uint64_t memory_limit_mib = suite::RunSettings{}.memory_limit >> 20;
  std::string command_line;  ///< for the record
};

struct ExportArguments {
  std::vector<std::string> targets;  ///< suites, scenes, files, frames; at least one
  std::size_t frames = 0, every = 1;
  bool queries = false;  ///< elementary queries of the steps instead of frames
  bool between = false;  ///< proofs of the steps instead of frames
  bool weld = false;     ///< vertices at one place in the first of given frames are one
  queries::QuerySample sample;
  std::filesystem::path out = "out/export";
};

/// What to list; nothing chosen: everything, with one line each.
struct ListArguments {
  bool suites = false, scenes = false, families = false, detectors = false;
  std::vector<std::string> named;     ///< detectors alone, by name or library
  std::vector<std::string> commands;  ///< the same for detectors that run as processes
};

struct ReduceArguments {
  std::string target;    ///< a case file, or what `run` takes as a scene, with "@FRAME" behind it
  std::string detector;  ///< name or library; empty: that of the case
  std::string command;   ///< of a detector that runs as a process; empty: none
  std::string level, kind;       ///< empty: the case's, or what is found first
  std::filesystem::path out;     ///< file; empty: beside the case, or in out/cases
  std::string language = "c++";  ///< of the test that is printed: c++, c or python
  std::string drawn;             ///< parameters of the scene if it is a drawn one, for the record
  std::size_t budget = 20000;
  double call_limit = 10.0;  ///< seconds
  std::uint64_t memory_limit_mib = suite::RunSettings{}.memory_limit >> 20;
};

struct GateArguments {
  std::filesystem::path results, policy;
  std::filesystem::path baseline, junit;  ///< empty: none
  bool github = false;
  bool advisory_times = false;  ///< rules on times are shown and do not fail the gate
};

struct AbArguments {
  std::filesystem::path base, head;    ///< two programs, libraries or commands
  std::vector<std::string> targets;    ///< as of `run`; empty: the suite default
  std::vector<std::string> detectors;  ///< empty: those of the suite
  std::size_t rounds = 7, frames = 0;
  double slower_than = 1.1;  ///< time(head) / time(base) that is allowed
  double floor_us = 20.0;    ///< microseconds a frame that do not matter
  bool accuracy_may_change = false, quiet = false, github = false;
  bool resume = false, overwrite = false;  ///< rounds of an interrupted comparison
  std::filesystem::path out = "out/ab";
  std::string command_line;  ///< for the record
};

struct TuneArguments {
  std::string target;
  std::string question = "body";
  std::vector<std::string> detectors;  ///< names or libraries; empty: all that answer
  std::vector<std::string> commands;   ///< detectors that run as processes
  std::vector<double> lattices;        ///< in addition to the scene's own
  std::vector<std::string> deformers;  ///< of a simulated scene; "all" among them: all
  std::optional<std::uint64_t> max_missed, max_spurious;
  std::optional<double> max_hover, max_deviation;  ///< metres
  std::optional<long> max_late;                    ///< frames
  std::optional<double> budget_ms;
  std::size_t frames = 0, processes = 5, most = 0;
  bool exhaustive = false, quiet = false;
  bool resume = false, overwrite = false;               ///< measurements of an interrupted search
  double call_limit = suite::RunSettings{}.call_limit;  ///< seconds
  std::uint64_t memory_limit_mib = suite::RunSettings{}.memory_limit >> 20;
  std::filesystem::path out = "out";
  std::string command_line;  ///< for the record
};

struct CheckArguments {
  std::vector<std::filesystem::path> frames;  ///< files of a simulation; at least one
  std::vector<std::string> allow;             ///< contact, self, depth=METRES, impact
  scene::FrameRules rules;                    ///< which files are frames of what
  bool between = false;                       ///< look for contact between frames, too
  bool weld = false, quiet = false, json_lines = false;
  bool resume = false, overwrite = false;  ///< as of `run`, by frames
  std::vector<std::string> keep;           ///< frames to be written: "17", or both of a step, "3-4"
  std::filesystem::path out = "out";
};

struct QueriesArguments {
  std::vector<std::filesystem::path> files;   ///< at least one, but for families
  bool families = false;                      ///< the hard families of this program instead
  std::vector<std::filesystem::path> truths;  ///< none, or one a file
  std::string kind;  ///< "vertex-face" or "edge-edge"; empty: as names and folders say
  std::vector<std::string> detectors;     ///< names and libraries; none, and no commands: all
  std::vector<std::string> commands;      ///< detectors that run as processes, over pipes
  ImpactTolerance cap = queries::kNoCap;  ///< of what detectors tolerate
  double call_limit = suite::RunSettings{}.call_limit;  ///< seconds
  std::uint64_t memory_limit_mib = suite::RunSettings{}.memory_limit >> 20;
  std::filesystem::path out = "out";
};

/// Which frames have contacts that are not allowed; 1 when one has.
int check_command(const CheckArguments& arguments, const DetectorCatalog& catalog);
/// Judges detectors of elementary impacts on query files; 3 when one fails or reports a time that
/// is none.
int queries_command(const QueriesArguments& arguments, const DetectorCatalog& catalog);
int run_command(const RunArguments& arguments, const DetectorCatalog& catalog);
/// Runs the suite `paper` (or the targets), in closed loop too, and compares it with the paper's
/// tables.
int reproduce_command(RunArguments arguments, const DetectorCatalog& catalog);
/// Writes a starter folder: scene, detector, policy and CI job, which run unchanged.
/// @throws InputError for an unknown language or a folder that is not empty
int init_command(const std::filesystem::path& folder, const std::string& language);
/// Searches for the cheapest configuration within limits; 1 if there is none.
int tune_command(const TuneArguments& arguments, const DetectorCatalog& catalog);
int list_command(const ListArguments& arguments, const DetectorCatalog& catalog);
/// Prints the exact answers to families of hard cases (to all if none is named); `write` stores
/// them in fixtures/hard/expected.json.
int truth_command(const std::vector<std::string>& families, bool write);
/// Writes a folder per scene into `out`: frames, certificates of their truth, and their checker; or
/// the elementary queries of its steps.
int export_command(const ExportArguments& arguments, const DetectorCatalog& catalog);
/// fixtures/hard: known-defects.json, readings.json and ranges.json
std::filesystem::path hard_cases_folder();
/// Compares known wrong answers with those of a run; 1 if they differ, also in a count. For the
/// suite scales it compares ranges. `write` updates the files to what the run shows.
int defects_command(const std::filesystem::path& results, bool write);
/// Shrinks a disagreement to a minimal case, writes it and prints it as a test.
int reduce_command(const ReduceArguments& arguments, const DetectorCatalog& catalog);
/// Prints what differs between two results; with `fail` 1 when an answer is worse or a row is gone.
int diff_command(const std::filesystem::path& before, const std::filesystem::path& after,
                 bool fail);
/// Checks results against a policy; 1 if it fails. `github` adds annotations on standard output and
/// appends to the file that GITHUB_STEP_SUMMARY names, if it is set.
int gate_command(const GateArguments& arguments);
/// Writes results as a baseline, and prints the changes against the baseline that it replaces.
int accept_command(const std::filesystem::path& results, const std::filesystem::path& baseline);
/// Compares two builds; 1 when head is slower than allowed or answers differently.
int ab_command(const AbArguments& arguments, const DetectorCatalog& catalog);
/// Merges the results of all shards of a run, and writes their reports.
int merge_command(const std::vector<std::string>& results, const std::filesystem::path& out);
/// `formats`: of "csv", "html" and "md".
int report_command(const std::filesystem::path& results, const std::vector<std::string>& formats,
                   const std::filesystem::path& out);

}  // namespace contactcheck::cli
