// `contactcheck tune` of one scene file, as it is run.
#pragma once

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/reference/cli/program.h"
#include "tests/support/files.h"

namespace contactcheck::test {

class TuneProgram : public ::testing::Test {
 protected:
  TuneProgram(const char* file, const std::string& scene)
      : scene_(scratch_.write(file, scene).string()) {}

  Outcome tune(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"tune", scene_, "--out", out_, "--processes", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return contactcheck_program(words);
  }
  std::string page() const { return text_of(std::filesystem::path(out_) / "tune.md"); }
  nlohmann::ordered_json result() const {
    return nlohmann::ordered_json::parse(text_of(std::filesystem::path(out_) / "tune.json"));
  }

  Scratch scratch_;
  std::string scene_;
  std::string out_ = (scratch_.folder() / "out").string();
};

}  // namespace contactcheck::test
