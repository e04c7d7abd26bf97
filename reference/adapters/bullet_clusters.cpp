// Seen in Bullet 3.24 (Debian 12, single precision), November 2026:
// - generateClusters() numbers nodes by i * 29873 in an int: from 71,889 nodes on that overflows,
//   and the negative remainder indexes in front of an array (segmentation fault).
// - Of k clusters fewer remain: all centres start near the body's own, and those that get no node
//   are dropped. A sphere of 45,000 vertices has 18 of 64.
// - It compares every node with every other for a table of connected clusters that only collisions
//   within a body read: seconds for 45,000 nodes.
#include "reference/adapters/bullet_clusters.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

namespace contactcheck {
namespace {

// Centres hardly move after this many; each costs k times the number of nodes.
constexpr int kMostIterations = 64;

// Enough nodes for centres of any k that is allowed; comparing all with all takes well under 1 s.
constexpr int kSampleNodes = 20000;

using Members = std::vector<std::vector<std::uint32_t>>;  // nodes of each cluster

std::vector<btVector3> centres_of_sample(const btSoftBody& body, int k) {
  const int count = body.m_nodes.size();
  const int stride = (count + kSampleNodes - 1) / kSampleNodes;
  std::vector<btVector3> places;
  for (int v = 0; v < count; v += stride) places.push_back(body.m_nodes[v].m_x);
  const auto sample = std::make_unique<btSoftBody>(
      body.m_worldInfo, static_cast<int>(places.size()), places.data(), nullptr);
  sample->generateClusters(k, kMostIterations);
  std::vector<btVector3> centres;
  for (int c = 0; c < sample->m_clusters.size(); ++c)
    if (sample->m_clusters[c]->m_collide) centres.push_back(sample->clusterCom(c));
  return centres;
}

std::uint32_t nearest(const std::vector<btVector3>& centres, const btVector3& x) {
  std::uint32_t best = 0;
  for (std::uint32_t c = 1; c < centres.size(); ++c)
    if (centres[c].distance2(x) < centres[best].distance2(x)) best = c;
  return best;
}

Members divide(const btSoftBody& body, const std::vector<btVector3>& centres) {
  Members members(centres.size());
  std::vector<std::uint32_t> cluster_of(static_cast<std::size_t>(body.m_nodes.size()));
  for (std::uint32_t v = 0; v < cluster_of.size(); ++v) {
    cluster_of[v] = nearest(centres, body.m_nodes[static_cast<int>(v)].m_x);
    members[cluster_of[v]].push_back(v);
  }
  for (int f = 0; f < body.m_faces.size(); ++f) {
    for (const btSoftBody::Node* corner : body.m_faces[f].m_n) {
      const std::uint32_t cluster = cluster_of[static_cast<std::size_t>(corner - &body.m_nodes[0])];
      for (const btSoftBody::Node* node : body.m_faces[f].m_n)
        members[cluster].push_back(static_cast<std::uint32_t>(node - &body.m_nodes[0]));
    }
  }
  return members;
}

void append_cluster(btSoftBody& body, std::vector<std::uint32_t>& members) {
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
  auto* cluster = new (btAlignedAlloc(sizeof(btSoftBody::Cluster), 16)) btSoftBody::Cluster();
  cluster->m_collide = true;
  cluster->m_clusterIndex = body.m_clusters.size();
  for (const std::uint32_t v : members)
    cluster->m_nodes.push_back(&body.m_nodes[static_cast<int>(v)]);
  body.m_clusters.push_back(cluster);
}

}  // namespace

void make_clusters(btSoftBody& body, int k) {
  if (body.m_nodes.size() == 0) return;
  if (body.m_nodes.size() <= kMostNodesForBullet) {
    body.generateClusters(k, kMostIterations);
    return;
  }
  Members members = divide(body, centres_of_sample(body, k));
  for (std::vector<std::uint32_t>& nodes : members)
    if (!nodes.empty()) append_cluster(body, nodes);
  body.initializeClusters();
  body.updateClusters();
}

void refit_clusters(btSoftBody& body) {
  body.m_cdbvt.clear();
  for (int c = 0; c < body.m_clusters.size(); ++c) body.m_clusters[c]->m_leaf = nullptr;
  body.updateClusters();  // inserts boxes without margins
  const btScalar margin = body.m_sst.radmrg;
  for (int c = 0; c < body.m_clusters.size(); ++c) {
    btDbvtNode* leaf = body.m_clusters[c]->m_leaf;
    if (leaf == nullptr) continue;  // the cluster of all nodes collides with nothing
    btDbvtVolume grown = leaf->volume;
    grown.Expand(btVector3(margin, margin, margin));
    body.m_cdbvt.update(leaf, grown);
  }
}

}  // namespace contactcheck
