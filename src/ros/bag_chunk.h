// Messages that are compressed and written together, and the index of them.
#pragma once

#include <ros/time.h>

#include <cstdint>
#include <map>
#include <vector>

#include "bag_records.h"

namespace cosserat_cable {

/// What the end of a bag tells of a chunk.
struct ChunkInfo {
  std::uint64_t position = 0;  ///< in the file
  BagTime begin{}, end{};      ///< of its messages
  /// Messages by connection.
  std::map<std::uint32_t, std::uint32_t> counts;
};

void AppendChunkInfo(const ChunkInfo& info, ByteBuffer* out);
/// What AppendChunkInfo appends for so many connections, in bytes.
std::size_t ChunkInfoSize(std::size_t connections);

class BagChunk {
 public:
  bool empty() const { return index_.empty(); }
  /// Not compressed [bytes].
  std::size_t size() const { return bytes_.size(); }
  /// No less than Write will append [bytes], also with another message of `size`.
  std::size_t MaxWrittenSize(std::size_t size) const;

  /// `record`: as AppendConnection makes it.
  void AddConnection(const ByteBuffer& record) { bytes_.Append(record.data(), record.size()); }
  /// Makes room for a message of `size` bytes, which the caller fills.
  std::uint8_t* AddMessage(std::uint32_t connection, const ros::Time& time, std::size_t size);

  /// Appends the chunk and its index to `out`, and clears it. The info's position is left to the
  /// caller. Throws std::runtime_error where it cannot be compressed.
  ChunkInfo Write(ByteBuffer* out);

 private:
  struct Entry {
    std::uint32_t connection;
    BagTime time;
    std::uint32_t offset;  // in the chunk
  };

  ByteBuffer bytes_;
  std::vector<Entry> index_;
  std::uint32_t connections_ = 0;  // no less than the number of those in the index
};

}  // namespace cosserat_cable
