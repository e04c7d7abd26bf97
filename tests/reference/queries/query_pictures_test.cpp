#include "reference/queries/query_pictures.h"

#include <gtest/gtest.h>

#include <string>

namespace contactcheck::queries {
namespace {

DecadeScore decade(int number, std::uint64_t timed, double early, double late, double micros) {
  DecadeScore score;
  score.decade = number;
  score.timed = timed;
  score.early_max = early;
  score.late_max = late;
  score.micros = micros;
  score.answered = 10;
  return score;
}

FileScore file_of(const std::string& detector, const std::vector<DecadeScore>& decades) {
  FileScore file;
  DetectorScore score;
  score.detector = detector;
  score.decades = decades;
  file.detectors = {score};
  return file;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++found;
  return found;
}

constexpr const char* kDot = "d=\"M-3 0a";
constexpr const char* kSquare = "d=\"M-3 -3h";

TEST(QueryPictures, AreEmptyWithoutTimes) {
  EXPECT_EQ(time_error_picture({}), "");
  EXPECT_EQ(cost_picture({}), "");
  const auto silent = file_of("silent", {decade(0, 0, 0, 0, 2)});
  EXPECT_EQ(time_error_picture({silent}), "");
  EXPECT_NE(cost_picture({silent}), "");
}

TEST(QueryPictures, HaveAPointForEachDecadeAndEnd) {
  const auto file = file_of("exact", {decade(-2, 3, 1e-9, 0, 1), decade(0, 3, 1e-3, 0.5, 2)});
  EXPECT_EQ(count(time_error_picture({file}), kDot), 2U);
  EXPECT_EQ(count(time_error_picture({file}), kSquare), 2U);
  EXPECT_EQ(count(cost_picture({file}), kDot), 2U);
}

TEST(QueryPictures, AddUpOverFiles) {
  const auto one = file_of("exact", {decade(0, 1, 1e-9, 0, 1)});
  const auto two = file_of("exact", {decade(0, 1, 1e-3, 0, 3)});
  EXPECT_EQ(time_error_picture({one, two}), time_error_picture({two}));
  EXPECT_EQ(cost_picture({one, two}), cost_picture({file_of("exact", {decade(0, 1, 0, 0, 2)})}));
}

TEST(QueryPictures, LeaveOutWhatWouldSqueezeTheRest) {
  const auto far =
      file_of("exact", {decade(-300, 1, 0, 0, 1), decade(-13, 1, 0, 0, 1), decade(-12, 1, 0, 0, 1),
                        decade(5, 1, 0, 0, 1), decade(6, 1, 0, 0, 1), decade(300, 1, 0, 0, 1)});
  EXPECT_EQ(count(cost_picture({far}), kDot), 2U);
  EXPECT_NE(cost_picture({far}).find("queries.json has all"), std::string::npos);
  const auto near = file_of("exact", {decade(0, 1, 0, 0, 1)});
  EXPECT_EQ(cost_picture({near}).find("queries.json has all"), std::string::npos);
}

}  // namespace
}  // namespace contactcheck::queries
