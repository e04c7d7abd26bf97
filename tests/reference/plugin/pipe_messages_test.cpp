// The bytes of the protocol: other programs have been written to them.
#include "reference/plugin/pipe_messages.h"

#include <gmock/gmock.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "core/types/check.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/shapes.h"

namespace contactcheck::plugin {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

struct Message {
  json line;
  std::string payload;

  explicit Message(const std::string& bytes)
      : line(json::parse(bytes.substr(0, bytes.find('\n')))),
        payload(bytes.substr(bytes.find('\n') + 1)) {}

  template <typename T>
  T value(std::size_t offset) const {
    T out;
    std::memcpy(&out, payload.data() + offset, sizeof out);
    return out;
  }
};

// A triangle without a lattice and a box in one of 2 x 1 x 1 cells.
std::vector<Body> two_bodies() {
  Body bare;
  bare.name = "bare";
  bare.shape = make_bare_shape(test::triangle_mesh({1, 2, 3}, {4, 5, 6}, {7, 8, 10}));
  return {bare, test::make_body("boxed", test::unit_box_mesh(1), {2, 1, 1})};
}

TEST(PipeMessages, OfHelloNamesProtocolAndVersion) {
  EXPECT_EQ(hello_message(), "{\"message\":\"hello\",\"protocol\":\"contactcheck-pipe/1\"}\n");
}

TEST(PipeMessages, OfPrepareHoldBodiesOneAfterTheOther) {
  const std::vector<Body> bodies = two_bodies();
  const Message m(prepare_message(bodies, {{"leaf", "4"}}));
  EXPECT_EQ(m.line.at("message"), "prepare");
  EXPECT_EQ(m.line.at("options"), json({{"leaf", "4"}}));
  EXPECT_EQ(m.line.at("bytes"), m.payload.size());
  const json& bare = m.line.at("bodies").at(0);
  EXPECT_EQ(bare,
            json({{"name", "bare"}, {"vertices", 3}, {"triangles", 1}, {"lattice", nullptr}}));
  EXPECT_EQ(m.value<double>(0), 1.0);
  EXPECT_EQ(m.value<double>(8 * 8), 10.0);
  EXPECT_EQ(m.value<std::uint32_t>(9 * 8 + 4), 1u);
  const json lattice = m.line.at("bodies").at(1).at("lattice");
  EXPECT_EQ(lattice.at("nodes"), 12);
  EXPECT_EQ(lattice.at("cells"), 2);
  const BodyShape& box = *bodies[1].shape;
  const std::size_t labels = lattice.at("labels");
  EXPECT_EQ(labels, box.embedding.label_cells.size());
  const std::size_t of_bare = 9 * 8 + 3 * 4, of_mesh = 8 * 24 + 12 * 12;
  const std::size_t nodes = of_bare + of_mesh, cells = nodes + 12 * 24, homes = cells + 2 * 32;
  EXPECT_EQ(m.value<double>(nodes), box.lattice->rest_node(0).x());
  EXPECT_EQ(m.value<std::uint32_t>(cells + 4), box.lattice->cell_nodes[0][1]);
  EXPECT_EQ(m.value<double>(homes + 8 * 4), box.embedding.local[0].x());
  EXPECT_EQ(m.payload.size(), homes + 8 * 4 + 8 * 24 + 13 * 4 + labels * 4);
  EXPECT_EQ(m.value<std::uint32_t>(m.payload.size() - 4), box.embedding.label_cells.back());
}

TEST(PipeMessages, OfFramesHoldWhatIsNeeded) {
  const std::vector<Vec3> nodes = {{1, 2, 3}}, vertices = {{4, 5, 6}, {7, 8, 9}};
  Frame frame;
  frame.index = 5;
  frame.time = 0.25;
  frame.bodies = {{nodes, vertices}};
  Declaration needs;
  const Message both(frame_message(frame, needs));
  EXPECT_EQ(both.line, json({{"message", "frame"}, {"index", 5}, {"time", 0.25}, {"bytes", 72}}));
  EXPECT_EQ(both.value<double>(0), 4.0);
  EXPECT_EQ(both.value<double>(6 * 8), 1.0) << "vertices first";
  needs.needs_vertices = false;
  const Message nodes_alone(frame_message(frame, needs));
  EXPECT_EQ(nodes_alone.payload.size(), 24u);
  EXPECT_EQ(nodes_alone.value<double>(16), 3.0);
}

template <typename... Values>
std::string packed(Values... values) {
  std::string out;
  (out.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
  return out;
}

std::uint32_t u(unsigned value) { return value; }

TEST(PipeMessages, OfContactsAreReadListByList) {
  const Reply reply(R"({"message": "contacts", "ms": 1.5, "bodies": 1, "triangles": 1, "cells": 1,
                        "vertices": 1, "near": 1, "piece_contacts": 1, "vertex_contacts": 1,
                        "bytes": 164})",
                    "command", "contacts");
  EXPECT_EQ(reply.reported_ns(), 1.5e6);
  ContactSet out;
  const std::string bytes = packed(u(0), u(1)) + packed(u(2), u(3), u(4), u(5)) +
                            packed(u(6), u(7), u(8), u(9)) + packed(u(10), u(11), u(12)) +
                            packed(u(13), u(14), u(15), u(16)) +
                            packed(u(1), u(2), u(3), u(4), 0.5, 1.0, 0.0, 0.0) +
                            packed(u(5), u(6), u(7), u(99), 0.25, 0.0, 0.0, 1.0);
  StepAnswer steps;
  read_contacts(reply, bytes, out, steps);
  EXPECT_THAT(out.bodies, ElementsAre(BodyPair{0, 1}));
  EXPECT_THAT(out.triangles, ElementsAre(ElementPair{2, 3, 4, 5}));
  EXPECT_THAT(out.cells, ElementsAre(ElementPair{6, 7, 8, 9}));
  EXPECT_THAT(out.vertices, ElementsAre(VertexInBody{10, 11, 12}));
  EXPECT_THAT(out.near, ElementsAre(NearPair{13, 14, 15, 16}));
  ASSERT_EQ(out.piece_contacts.size(), 1u);
  EXPECT_EQ(out.piece_contacts[0].pieces, (ElementPair{1, 2, 3, 4}));
  EXPECT_EQ(out.piece_contacts[0].depth, 0.5);
  ASSERT_EQ(out.vertex_contacts.size(), 1u);
  EXPECT_EQ(out.vertex_contacts[0].where, (VertexInBody{5, 6, 7}));
  EXPECT_EQ(out.vertex_contacts[0].normal, Vec3(0, 0, 1));
}

TEST(PipeMessages, OfContactsWithinStepsAreReadListByList) {
  const Reply reply(R"({"message": "contacts", "impacts": 2, "impact_triangles": 1,
                        "impact_vertices": 1, "impact_edges": 1, "bytes": 88})",
                    "command", "contacts");
  const std::string bytes = packed(u(0), u(1), 0.25) + packed(u(2), u(3), -1.0) +
                            packed(u(4), u(5), u(6), u(7)) + packed(u(8), u(9), u(10), u(11)) +
                            packed(u(12), u(13), u(14), u(15), u(16), u(17));
  ContactSet out;
  StepAnswer steps;
  read_contacts(reply, bytes, out, steps);
  ASSERT_EQ(steps.bodies.size(), 2u);
  EXPECT_EQ(steps.bodies[0].bodies, (BodyPair{0, 1}));
  EXPECT_EQ(steps.bodies[0].time, 0.25);
  EXPECT_EQ(steps.bodies[1].time, std::nullopt);
  EXPECT_THAT(steps.triangles, ElementsAre(ElementPair{4, 5, 6, 7}));
  EXPECT_THAT(steps.vertices, ElementsAre(NearPair{8, 9, 10, 11}));
  ASSERT_EQ(steps.edges.size(), 1u);
  EXPECT_EQ(steps.edges[0].body_b, 13u);
  EXPECT_EQ(steps.edges[0].a, (Edge{14, 15}));
  EXPECT_EQ(steps.edges[0].b, (Edge{16, 17}));
}

std::string sentence_about_line(const std::string& line) {
  return test::sentence_of([&] { check_contact_counts(Reply(line, "command", "contacts")); });
}

TEST(PipeMessages, OfContactsWithCountsThatDisagreeAreRefused) {
  EXPECT_EQ(sentence_about_line(R"({"message": "contacts"})"), "");
  EXPECT_THAT(sentence_about_line(R"({"message": "contacts", "near": 1})"),
              HasSubstr("lists of 16 bytes together and says 0"));
  EXPECT_THAT(sentence_about_line(R"({"message": "contacts", "near": -1})"),
              HasSubstr("near is -1"));
  EXPECT_THAT(sentence_about_line(R"({"message": "contacts", "near": 0.5})"),
              HasSubstr("near is 0.5"));
  EXPECT_THAT(sentence_about_line(R"({"message": "contacts", "bytes": 1e300})"),
              HasSubstr("bytes is"));
  EXPECT_THAT(sentence_about_line(R"({"message": "contacts", "bytes": 1, "bytes": 2})"),
              HasSubstr("bytes"));
  EXPECT_THAT(sentence_about_line("{}"), HasSubstr("message is missing"));
}

TEST(PipeMessages, WordsAmongThemAreShownWithWhereTheyBelong) {
  for (const char* line : {"found 3 pairs", "3", R"(["contacts"])"}) {
    const std::string sentence = sentence_about_line(line);
    EXPECT_THAT(sentence,
                HasSubstr("command wrote \"" + std::string(line) + "\" where its message"));
    EXPECT_THAT(sentence, HasSubstr("\"contacts\" was due"));
    EXPECT_THAT(sentence, HasSubstr("belongs on standard error"));
  }
  EXPECT_THAT(sentence_about_line(""), HasSubstr("command wrote \"\" where"));
  EXPECT_THAT(sentence_about_line(R"({"message": "contacts")"), HasSubstr("not valid JSON"));
}

TEST(PipeMessages, OfImpactsNameKeysThatResembleTheirOwn) {
  const Reply reply(R"({"message": "impact", "contact": true, "tiem": 0.5, "note": 1})", "mine",
                    "impact");
  EXPECT_THAT(test::sentence_of([&] { read_impact(reply); }),
              testing::HasSubstr("tiem is not a known key; did you mean time?"));
}

TEST(PipeMessages, NameKeysThatResembleTheirOwn) {
  EXPECT_THAT(
      test::sentence_of([&] {
        check_contact_counts(Reply(R"({"message": "contacts", "bodeis": 1})", "mine", "contacts"));
      }),
      testing::HasSubstr("bodeis is not a known key; did you mean bodies?"));
  EXPECT_THAT(
      test::sentence_of([&] { Reply(R"({"message": "ready", "semantic": {}})", "mine", "ready"); }),
      testing::HasSubstr("semantic is not a known key; did you mean semantics?"));
}

TEST(PipeMessages, OfErrorsAreThrownAsSuch) {
  EXPECT_THROW(Reply(R"({"message": "error", "text": "lost"})", "command", "done"),
               std::runtime_error);
  EXPECT_THROW(Reply(R"({"message": "refused", "text": "no"})", "command", "done"), RefusedInput);
}

}  // namespace
}  // namespace contactcheck::plugin
