#include "tests/reference/report/hard_results.h"

#include <nlohmann/json.hpp>

#include "tests/support/files.h"

namespace contactcheck::test {

nlohmann::ordered_json hard_results() {
  return nlohmann::ordered_json::parse(text_of(CONTACTCHECK_REPORT_SAMPLES "/hard.json"));
}

}  // namespace contactcheck::test
