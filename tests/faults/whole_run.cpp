#include "tests/faults/whole_run.h"

#include <gtest/gtest.h>

#include "tests/reference/cli/tiny_scene.h"
#include "tests/support/files.h"

namespace contactcheck::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path out_folder(const Scratch& scratch) { return scratch.folder() / "out"; }

}  // namespace

std::string WholeRun::message(const std::string& detector) const {
  return row(detector).at("message");
}

std::vector<std::string> WholeRun::notes(const std::string& detector) const {
  return row(detector).at("notes");
}

std::vector<std::string> WholeRun::files() const {
  const std::set<std::string> names = names_in(out_folder(*scratch));
  return {names.begin(), names.end()};
}

std::string WholeRun::schema_errors() const {
  const fs::path results = out_folder(*scratch) / "results.json";
  const Outcome valid =
      run_program(CONTACTCHECK_PYTHON3, {"-B", CONTACTCHECK_VALIDATOR, results.string()});
  return valid.exit_code == 0 ? "" : valid.out + valid.err;
}

std::vector<std::string> honest_detectors() { return {"fcl-aabb", "ffd-aabb-sphere2+tri"}; }

WholeRun run_whole(const std::vector<std::string>& detectors,
                   const std::vector<std::string>& flags) {
  WholeRun run;
  run.scratch = std::make_shared<const Scratch>();
  std::vector<std::string> arguments = {"run",
                                        run.scratch->write("tiny.json", tiny_scene()).string(),
                                        "--out", out_folder(*run.scratch).string()};
  for (const std::string& detector : detectors)
    arguments.insert(arguments.end(), {"--detector", detector});
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  run.outcome = run_program(CONTACTCHECK_WITH_FAULTS, arguments);
  const json results =
      json::parse(text_of(out_folder(*run.scratch) / "results.json"), nullptr, false);
  EXPECT_FALSE(results.is_discarded()) << run.outcome.err;
  if (results.is_discarded()) throw std::runtime_error("no results to look at");
  for (const json& row : results.at("runs")) run.rows[row.at("detector")] = row;
  EXPECT_EQ(run.rows.size(), detectors.size());
  return run;
}

}  // namespace contactcheck::test
