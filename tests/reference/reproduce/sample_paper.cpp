#include "tests/reference/reproduce/sample_paper.h"

#include <gtest/gtest.h>

#include "tests/reference/scene/scratch.h"

namespace contactcheck::test {

std::string sample_paper_text() {
  return R"({
  "source": {"authors": ["Doe", "Roe"], "title": "A title", "journal": "A journal 12",
             "year": 2001, "doi": "10.1/x"},
  "devices": [
    {"name": "box", "average_frame_rate": {"says": "25 fps", "value": 25, "low": 24.5, "high": 25.5}},
    {"name": "tin", "average_frame_rate": {"says": "9 fps", "value": 9, "low": 8.5, "high": 9.5}}
  ],
  "table_1": {"device": "tin", "before": "none", "after": "one", "rows": [
    {"scene": "s", "method": "none", "mss": 10, "cell": 10, "test": 50, "response": 5, "total": 100},
    {"scene": "s", "method": "one", "mss": 10, "cell": 10, "test": 25, "response": 5, "total": 50}]},
  "table_2": [{"scene": "s", "objects": 2, "objects_in_text": 2,
               "vertices": 20, "triangles": 32, "cells": 7}],
  "table_3": {"device": "box", "before": "one", "after": "two", "rows": [
    {"scene": "s", "method": "one", "mss": 10, "cell": 1, "test": 40, "response": 4, "total": 60},
    {"scene": "s", "method": "two", "mss": 10, "cell": 1, "test": 20, "response": 4, "total": 40}]},
  "claims": {
    "frame_rate_gain": {"says": "more than half", "low": 50, "high": 60},
    "best_frame_rate": {"says": "25 fps", "value": 25, "low": 24.5, "high": 25.5},
    "best_device": "box", "best_scene": "s",
    "test_share": {"says": "half", "value": 50, "low": 45, "high": 55},
    "cell_share": {"says": "next to nothing", "low": 0, "high": 5},
    "one_level_gain": {"says": "twice as fast", "value": 100, "low": 95, "high": 105}}
})";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) {
    ADD_FAILURE() << "not in the text: " << from;
    return text;
  }
  return text.replace(at, from.size(), to);
}

reproduce::PaperTables tables_of(const std::string& text) {
  const Scratch scratch;
  return reproduce::load_paper_tables(scratch.write("tables.json", text));
}

reproduce::PaperTables real_paper() {
  return reproduce::load_paper_tables(std::filesystem::path(CONTACTCHECK_FIXTURES) / "paper" /
                                      "tables.json");
}

std::vector<reproduce::PaperFinding> select(const std::vector<reproduce::PaperFinding>& findings,
                                            const std::string& topic, const std::string& table,
                                            const std::string& scene, const std::string& method) {
  const auto fits = [](const std::string& wanted, const std::string& word) {
    return wanted.empty() || wanted == word;
  };
  std::vector<reproduce::PaperFinding> out;
  for (const reproduce::PaperFinding& f : findings)
    if (fits(topic, f.topic) && fits(table, f.table) && fits(scene, f.scene) &&
        fits(method, f.method))
      out.push_back(f);
  return out;
}

}  // namespace contactcheck::test
