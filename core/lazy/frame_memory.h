// Memory of one frame: arenas, one per thread, and tables of what was made in them.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace contactcheck {

/// Memory that lives until the next frame; nothing is freed and pointers stay valid.
class FrameArena {
 public:
  void clear() { chunk_ = used_ = 0; }
  /// Aligned to 64 bytes. @pre bytes <= kChunk
  void* take(std::size_t bytes) {
    bytes = (bytes + 63) / 64 * 64;
    if (chunk_ == chunks_.size() || used_ + bytes > kChunk) next_chunk();
    void* out = chunks_[chunk_]->bytes + used_;
    used_ += bytes;
    return out;
  }
  std::size_t bytes() const { return chunks_.size() * kChunk; }

 private:
  static constexpr std::size_t kChunk = std::size_t{1} << 16;
  struct alignas(64) Chunk {
    std::byte bytes[kChunk];
  };
  void next_chunk() {
    if (chunk_ < chunks_.size() && used_ > 0) ++chunk_;
    if (chunk_ == chunks_.size()) chunks_.push_back(std::unique_ptr<Chunk>(new Chunk));
    used_ = 0;
  }
  std::vector<std::unique_ptr<Chunk>> chunks_;
  std::size_t chunk_ = 0, used_ = 0;
};

/// What was made in this frame, by index. Threads that miss an entry at the same time each make it
/// in their own arena and put it down; what they make is the same to the last bit, so it does not
/// matter whose entry stays, nor whether a reader sees one or the other.
template <class T>
class FrameTable {
 public:
  /// Begins a frame: no entry is known. Not while others use the table.
  void begin_frame(std::size_t size) {
    if (entries_.size() != size || frame_ == std::numeric_limits<std::uint32_t>::max()) {
      entries_ = std::vector<Entry>(size);
      frame_ = 0;
    }
    ++frame_;
  }
  /// The entry of this frame, or none.
  T* find(std::uint32_t index) const {
    const Entry& entry = entries_[index];
    if (entry.frame.load(std::memory_order_acquire) != frame_) return nullptr;
    return entry.made.load(std::memory_order_acquire);
  }
  void put(std::uint32_t index, T* made) {
    Entry& entry = entries_[index];
    entry.made.store(made, std::memory_order_release);
    entry.frame.store(frame_, std::memory_order_release);
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(entries_.size()); }
  std::size_t bytes() const { return entries_.size() * sizeof(Entry); }

 private:
  struct Entry {
    std::atomic<T*> made = nullptr;
    std::atomic<std::uint32_t> frame = 0;
  };
  std::vector<Entry> entries_;
  std::uint32_t frame_ = 0;
};

}  // namespace contactcheck
