// What the judge of the mutants found, and the case that it is at: a crash is named like any other
// fault.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

namespace contactcheck::test {

/// Where something was asked. `detector` names a part of core where no detector is asked.
struct MutantCase {
  std::string scene;
  std::size_t frame = 0;
  std::string detector, level;

  std::string text() const;
};

class MutantFindings {
 public:
  /// Installs handlers that name the current case when a signal ends the program, or when it has
  /// taken more than `seconds` of processor time; they exit as if a fault had been found.
  static void name_crashes(unsigned seconds);

  /// The case that is looked at from now on.
  void enter(const MutantCase& now);
  /// A fault of the current case, in a few words.
  void add(const std::string& what);
  void expect(bool holds, const std::string& what) {
    if (!holds) add(what);
  }
  /// A fault where the two sets differ. @pre both sorted and without repeats
  template <typename T>
  void expect_same(const std::vector<T>& truth, const std::vector<T>& reported) {
    std::vector<T> missed, spurious;
    std::set_difference(truth.begin(), truth.end(), reported.begin(), reported.end(),
                        std::back_inserter(missed));
    std::set_difference(reported.begin(), reported.end(), truth.begin(), truth.end(),
                        std::back_inserter(spurious));
    compared_ += truth.size();
    if (!missed.empty() || !spurious.empty())
      add("missed=" + std::to_string(missed.size()) +
          " spurious=" + std::to_string(spurious.size()));
  }

  /// One line per fault: the case, then what is wrong.
  const std::vector<std::string>& faults() const { return faults_; }
  /// Elements of all truths that were compared: zero would mean that nothing was asked.
  std::size_t compared() const { return compared_; }

 private:
  MutantCase now_;
  std::vector<std::string> faults_;
  std::size_t compared_ = 0;
};

}  // namespace contactcheck::test
