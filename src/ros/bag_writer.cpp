#include "cosserat_cable/ros/bag_writer.h"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "bag_chunk.h"

namespace cosserat_cable {
namespace {

// A chunk is written when it has grown to this, as rosbag's own are [bytes].
constexpr std::size_t kChunkSize = 768 * 1024;
// Room is allocated this much ahead of the need [bytes].
constexpr std::uint64_t kPiece = 4 * 1024 * 1024;

}  // namespace

struct BagWriter::Impl {
  explicit Impl(const std::string& to) : path(to), active_path(to + ".active") {}

  /// Makes sure of the room for what is there and `size` bytes more.
  void Reserve(std::size_t size);
  void WriteAt(std::uint64_t position, const ByteBuffer& bytes);
  void Append(const ByteBuffer& bytes);
  void WriteChunk();
  void WriteEnd();
  /// Closes the file where it cannot be used any more.
  [[noreturn]] void Break(const std::string& why);

  std::string path, active_path;
  int descriptor = -1;
  bool can_allocate = true;
  std::uint64_t end = 0, allocated = 0;  // of the file [bytes]
  std::uint32_t connection_count = 0, chunk_count = 0;
  ByteBuffer connections, chunk_infos;  // records for the end of the file
  BagChunk chunk;
  ByteBuffer scratch;
};

void BagWriter::Impl::Reserve(std::size_t size) {
  const std::uint64_t needed = end + chunk.MaxWrittenSize(size) + connections.size() +
                               chunk_infos.size() + ChunkInfoSize(connection_count);
  if (needed <= allocated) return;
  const std::uint64_t wanted = needed + kPiece;
  if (can_allocate) {
    if (fallocate(descriptor, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(wanted)) == 0) {
      allocated = wanted;
      return;
    }
    if (errno != EOPNOTSUPP && errno != ENOSYS)
      throw BagWriteError(path + ": " + std::strerror(errno));
    can_allocate = false;
  }
  // A file system that allocates nothing ahead: as good as can be without.
  struct statvfs free {};
  if (fstatvfs(descriptor, &free) == 0 &&
      static_cast<std::uint64_t>(free.f_bavail) * free.f_frsize < wanted - end) {
    throw BagWriteError(path + ": " + std::strerror(ENOSPC));
  }
  allocated = wanted;
}

void BagWriter::Impl::WriteAt(std::uint64_t position, const ByteBuffer& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = pwrite(descriptor, bytes.data() + done, bytes.size() - done,
                                   static_cast<off_t>(position + done));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) Break(std::strerror(errno));
    done += static_cast<std::size_t>(written);
  }
}

void BagWriter::Impl::Append(const ByteBuffer& bytes) {
  WriteAt(end, bytes);
  end += bytes.size();
}

void BagWriter::Impl::WriteChunk() {
  scratch.Shorten(0);
  ChunkInfo info = chunk.Write(&scratch);
  info.position = end;
  Append(scratch);
  AppendChunkInfo(info, &chunk_infos);
  ++chunk_count;
}

void BagWriter::Impl::WriteEnd() {
  if (!chunk.empty()) WriteChunk();
  const std::uint64_t index = end;
  Append(connections);
  Append(chunk_infos);
  scratch.Shorten(0);
  AppendFileHeader(index, connection_count, chunk_count, &scratch);
  WriteAt(sizeof kBagVersion - 1, scratch);
}

void BagWriter::Impl::Break(const std::string& why) {
  close(std::exchange(descriptor, -1));
  throw BagWriteError(active_path + ": " + why + "; `rosbag reindex` may recover what is there");
}

BagWriter::BagWriter(const std::string& path) : impl_(std::make_unique<Impl>(path)) {
  Impl& m = *impl_;
  m.descriptor = open(m.active_path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (m.descriptor < 0) throw BagWriteError(m.active_path + ": " + std::strerror(errno));
  try {
    m.scratch.Append(std::string_view(kBagVersion));
    AppendFileHeader(0, 0, 0, &m.scratch);
    m.Reserve(m.scratch.size());
    m.Append(m.scratch);
  } catch (const BagWriteError&) {
    // Nothing is in it yet: leave nothing behind.
    if (m.descriptor >= 0) close(m.descriptor);
    std::remove(m.active_path.c_str());
    throw;
  }
}

BagWriter::~BagWriter() {
  try {
    Close();
  } catch (const BagWriteError&) {
  }
}

BagWriter::Connection BagWriter::Connect(const std::string& topic, const ros::M_string& header) {
  Impl& m = *impl_;
  m.scratch.Shorten(0);
  AppendConnection(m.connection_count, topic, header, &m.scratch);
  m.Reserve(2 * m.scratch.size());
  // In a chunk too: from there a bag that is indexed anew has it.
  m.chunk.AddConnection(m.scratch);
  m.connections.Append(m.scratch.data(), m.scratch.size());
  return m.connection_count++;
}

std::uint8_t* BagWriter::Add(Connection connection, const ros::Time& time, std::size_t size) {
  Impl& m = *impl_;
  // Not after a message is added: its bytes come later.
  if (m.chunk.size() >= kChunkSize && !m.chunk.empty()) m.WriteChunk();
  m.Reserve(size);
  return m.chunk.AddMessage(connection, time, size);
}

void BagWriter::Write(Connection connection, const ros::Time& time,
                      const std::vector<std::uint8_t>& bytes) {
  std::copy(bytes.begin(), bytes.end(), Add(connection, time, bytes.size()));
}

void BagWriter::Close() {
  Impl& m = *impl_;
  if (m.descriptor < 0) return;
  m.WriteEnd();
  // Gives back the room that was kept ahead.
  const bool trimmed = ftruncate(m.descriptor, static_cast<off_t>(m.end)) == 0;
  const bool synced = fsync(m.descriptor) == 0;
  close(std::exchange(m.descriptor, -1));
  if (!trimmed || !synced || std::rename(m.active_path.c_str(), m.path.c_str()) != 0) {
    throw BagWriteError(m.active_path + ": " + std::strerror(errno));
  }
}

}  // namespace cosserat_cable
