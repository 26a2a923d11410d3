#include "bag_chunk.h"

#include <roslz4/lz4s.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace cosserat_cable {
namespace {

constexpr std::uint32_t kVersion = 1;  // of index and chunk info
constexpr int kBlockSize = 6;          // of roslz4: 1 MB, rosbag's own choice
// More than any record has here, apart from names and data [bytes].
constexpr std::size_t kHeaderSize = 128;
// What does not compress is kept as it is, with some bytes for each block.
constexpr std::size_t kMinBlocks = 64 * 1024;
constexpr std::size_t kIndexEntrySize = sizeof(BagTime) + sizeof(std::uint32_t);

bool IsEarlier(const BagTime& a, const BagTime& b) {
  return std::tie(a.seconds, a.nanoseconds) < std::tie(b.seconds, b.nanoseconds);
}

void Compress(const ByteBuffer& bytes, ByteBuffer* out) {
  // The format's interface takes no const, and changes nothing.
  auto* input = const_cast<char*>(reinterpret_cast<const char*>(bytes.data()));
  const std::size_t begin = out->size();
  const std::size_t most = bytes.size() + bytes.size() / kMinBlocks + kHeaderSize;
  auto used = static_cast<unsigned>(most);
  auto* output = reinterpret_cast<char*>(out->Extend(most));
  if (roslz4_buffToBuffCompress(input, static_cast<unsigned>(bytes.size()), output, &used,
                                kBlockSize) != ROSLZ4_OK) {
    throw std::runtime_error("a chunk could not be compressed");
  }
  out->Shorten(begin + used);
}

}  // namespace

std::size_t ChunkInfoSize(std::size_t connections) {
  return kHeaderSize + connections * 2 * sizeof(std::uint32_t);
}

void AppendChunkInfo(const ChunkInfo& info, ByteBuffer* out) {
  RecordHeader(BagRecord::kChunkInfo, out)
      .Number("ver", kVersion)
      .Number("chunk_pos", info.position)
      .Number("start_time", info.begin)
      .Number("end_time", info.end)
      .Number("count", static_cast<std::uint32_t>(info.counts.size()))
      .EndBefore(info.counts.size() * 2 * sizeof(std::uint32_t));
  for (const auto& [connection, count] : info.counts) {
    out->Append(connection);
    out->Append(count);
  }
}

std::uint8_t* BagChunk::AddMessage(std::uint32_t connection, const ros::Time& time,
                                   std::size_t size) {
  connections_ = std::max(connections_, connection + 1);
  const BagTime stamp = {time.sec, time.nsec};
  index_.push_back({connection, stamp, static_cast<std::uint32_t>(bytes_.size())});
  RecordHeader(BagRecord::kMessage, &bytes_)
      .Number("conn", connection)
      .Number("time", stamp)
      .EndBefore(size);
  return bytes_.Extend(size);
}

std::size_t BagChunk::MaxWrittenSize(std::size_t size) const {
  const std::size_t raw = bytes_.size() + kHeaderSize + size;
  return raw + raw / kMinBlocks + (connections_ + 3) * kHeaderSize +
         (index_.size() + 1) * kIndexEntrySize;
}

ChunkInfo BagChunk::Write(ByteBuffer* out) {
  RecordHeader(BagRecord::kChunk, out)
      .Field("compression", "lz4")
      .Number("size", static_cast<std::uint32_t>(bytes_.size()))
      .EndBefore(0);
  const std::size_t begin = out->size();
  Compress(bytes_, out);
  out->Set(begin - sizeof(std::uint32_t), static_cast<std::uint32_t>(out->size() - begin));

  std::stable_sort(index_.begin(), index_.end(), [](const Entry& a, const Entry& b) {
    return a.connection != b.connection ? a.connection < b.connection : IsEarlier(a.time, b.time);
  });
  ChunkInfo info;
  info.begin = info.end = index_.front().time;
  for (auto first = index_.begin(); first != index_.end();) {
    const auto last = std::find_if(first, index_.end(), [&](const Entry& entry) {
      return entry.connection != first->connection;
    });
    const auto count = static_cast<std::uint32_t>(last - first);
    info.counts[first->connection] = count;
    info.begin = std::min(info.begin, first->time, IsEarlier);
    info.end = std::max(info.end, std::prev(last)->time, IsEarlier);
    RecordHeader(BagRecord::kIndex, out)
        .Number("ver", kVersion)
        .Number("conn", first->connection)
        .Number("count", count)
        .EndBefore(count * kIndexEntrySize);
    for (; first != last; ++first) {
      out->Append(&first->time, sizeof first->time);
      out->Append(first->offset);
    }
  }
  bytes_.Shorten(0);
  index_.clear();
  return info;
}

}  // namespace cosserat_cable
