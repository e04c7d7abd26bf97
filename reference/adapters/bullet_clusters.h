// Clusters of vertices for Bullet's soft bodies: for the .cpp files of the adapters alone.
#pragma once

#include <BulletSoftBody/btSoftBody.h>

namespace contactcheck {

/// The most nodes that generateClusters() can divide: beyond these it overflows an int and crashes.
inline constexpr int kMostNodesForBullet = 71888;

/// Divides the nodes, at their places now, into at most k clusters, of which each takes the direct
/// neighbours of its nodes too, as generateClusters() does. A body with more nodes than that can
/// divide takes the centres of the clusters of a sample of its nodes, each node going to its
/// nearest centre. @pre k >= 1
void make_clusters(btSoftBody& body, int k);

/// Bullet's frames and boxes of the clusters around the nodes' places now. The boxes are grown by
/// the margin, in every frame anew: left to itself Bullet does that only to boxes that have moved
/// out of their old ones, and what it finds within the margins depends on the frames before.
void refit_clusters(btSoftBody& body);

}  // namespace contactcheck
