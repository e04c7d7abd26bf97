#include "reference/judge/answer_fingerprint.h"

#include <gmock/gmock.h>

namespace contactcheck::judge {
namespace {

using testing::HasSubstr;

// A detector's questions, the last of which is asked.
Asked asked_last(std::vector<Question> questions) {
  Semantics semantics;
  semantics.questions = questions;
  return asked(questions.back(), semantics);
}
const Asked kOwnTriangles = asked_last({Question::kTriangles});
const Asked kBodyBeside = asked_last({Question::kTriangles, Question::kBody});
const Asked kContactsBeside = asked_last({Question::kTriangles, Question::kContacts});

ContactSet two_triangles() {
  ContactSet set;
  set.triangles = {{0, 1, 2, 3}, {0, 1, 4, 5}};
  set.canonicalize();
  return set;
}

// An answer to `asked` as it would be judged, and another.
std::string difference(const ContactSet& answer, const ContactSet& judged, const Asked& asked) {
  return answer_difference(fingerprint_of(answer, asked), fingerprint_of(judged, asked));
}

TEST(AnswerFingerprint, SaysWhatIsMissingAndWhatIsTooMuch) {
  const ContactSet judged = two_triangles(), nothing;
  EXPECT_EQ(difference(judged, judged, kOwnTriangles), "");
  EXPECT_EQ(difference(nothing, judged, kOwnTriangles),
            "it answered 0 pairs of triangles and not the 2 that were judged");
  EXPECT_EQ(difference(judged, nothing, kOwnTriangles),
            "it answered 2 pairs of triangles and not the 0 that were judged");
}

TEST(AnswerFingerprint, SaysThatAsManyAreOthers) {
  ContactSet others = two_triangles();
  others.triangles[1].b = 6;
  EXPECT_EQ(difference(others, two_triangles(), kOwnTriangles),
            "it answered 2 pairs of triangles, and others than those that were judged");
}

TEST(AnswerFingerprint, EveryListThatIsJudgedCounts) {
  const std::pair<Asked, void (*)(ContactSet&)> changes[] = {
      {kOwnTriangles,
       [](ContactSet& s) {
         s.bodies.push_back({2, 3});
       }},
      {kOwnTriangles,
       [](ContactSet& s) {
         s.cells.push_back({0, 1, 0, 0});
       }},
      {kOwnTriangles,
       [](ContactSet& s) {
         s.vertices.push_back({0, 1, 0});
       }},
      {kOwnTriangles,
       [](ContactSet& s) {
         s.near.push_back({0, 1, 0, 0});
       }},
      {kContactsBeside, [](ContactSet& s) { s.piece_contacts.resize(9); }},
      {kContactsBeside, [](ContactSet& s) { s.vertex_contacts.resize(9); }}};
  for (const auto& [asked, change] : changes) {
    ContactSet changed = two_triangles();
    change(changed);
    EXPECT_NE(difference(changed, two_triangles(), asked), "");
  }
}

// An early-out may find another pair first.
TEST(AnswerFingerprint, OfTheQuestionBodyTheBodiesAlone) {
  ContactSet other;
  other.triangles = {{0, 1, 9, 9}};
  other.canonicalize();
  EXPECT_EQ(difference(other, two_triangles(), kBodyBeside), "");
  EXPECT_THAT(difference({}, two_triangles(), kBodyBeside), HasSubstr("0 pairs of bodies"));
}

// Libraries are not sure of degenerate ones.
TEST(AnswerFingerprint, OfContactsTheNumberCountsRoughly) {
  ContactSet judged, answer;
  judged.piece_contacts.resize(20);
  judged.vertex_contacts.resize(2);
  answer.piece_contacts.resize(10);
  EXPECT_EQ(difference(answer, judged, kContactsBeside), "");
  answer.piece_contacts.resize(9);
  const std::string too_few = "it answered 9 contacts of pieces and not the 20 that were judged";
  EXPECT_EQ(difference(answer, judged, kContactsBeside), too_few);
  EXPECT_NE(difference(judged, {}, kContactsBeside), "");
}

}  // namespace
}  // namespace contactcheck::judge
