#include "cosserat_cable/ros/bag_writer.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace cosserat_cable {
namespace {

// How much may be written before room is made again [bytes].
constexpr std::uint64_t kPiece = 2 * 1024 * 1024;
// Room kept ahead of the file's end: a piece, a chunk that rosbag still holds (768 kB), and the
// index, which grows by about a kilobyte for each chunk: a thousandth of the file [bytes].
constexpr std::uint64_t kRoom = 4 * 1024 * 1024;
constexpr std::uint64_t kIndexShare = 500;

}  // namespace

BagWriter::BagWriter(const std::string& path) : path_(path), active_path_(path + ".active") {
  bag_ = std::make_unique<rosbag::Bag>();
  try {
    bag_->open(active_path_, rosbag::bagmode::Write);
    bag_->setCompression(rosbag::compression::LZ4);
  } catch (const rosbag::BagException& error) {
    Broken(error.what());
  }
  descriptor_ = open(active_path_.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0) Broken(std::strerror(errno));
  unreserved_ = kPiece;
  try {
    Reserve(0);
  } catch (const BagWriteError&) {
    // Nothing is in it yet: leave nothing behind.
    close(descriptor_);
    descriptor_ = -1;
    bag_.release();  // its destructor would write, and throw
    std::remove(active_path_.c_str());
    throw;
  }
}

BagWriter::~BagWriter() {
  try {
    if (bag_) Close();
  } catch (const BagWriteError&) {
  }
}

void BagWriter::Reserve(std::uint64_t message_size) {
  unreserved_ += message_size;
  if (unreserved_ < kPiece) return;
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) {
    throw BagWriteError(active_path_ + ": " + std::strerror(errno));
  }
  const auto size = static_cast<std::uint64_t>(status.st_size);
  const std::uint64_t room = kRoom + message_size + size / kIndexShare;
  if (can_allocate_) {
    if (fallocate(descriptor_, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(size + room)) == 0) {
      unreserved_ = 0;
      return;
    }
    if (errno != EOPNOTSUPP && errno != ENOSYS) {
      throw BagWriteError(path_ + ": " + std::strerror(errno));
    }
    can_allocate_ = false;
  }
  // A file system that allocates nothing ahead: as good as can be without.
  struct statvfs free {};
  if (fstatvfs(descriptor_, &free) == 0 &&
      static_cast<std::uint64_t>(free.f_bavail) * free.f_frsize < room) {
    throw BagWriteError(path_ + ": " + std::strerror(ENOSPC));
  }
  unreserved_ = 0;
}

void BagWriter::Broken(const std::string& why) {
  // rosbag's destructor would try again and throw, which ends the program; its memory goes with
  // ours.
  bag_.release();
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
  throw BagWriteError(active_path_ + ": " + why + "; `rosbag reindex` may recover what is there");
}

void BagWriter::Close() {
  if (!bag_) return;
  try {
    bag_->close();
  } catch (const rosbag::BagException& error) {
    Broken(error.what());
  }
  bag_.reset();
  struct stat status {};
  // Gives back the room that was kept ahead.
  const bool trimmed =
      fstat(descriptor_, &status) == 0 && ftruncate(descriptor_, status.st_size) == 0;
  const bool synced = fsync(descriptor_) == 0;
  close(descriptor_);
  descriptor_ = -1;
  if (!trimmed || !synced || std::rename(active_path_.c_str(), path_.c_str()) != 0) {
    throw BagWriteError(active_path_ + ": " + std::strerror(errno));
  }
}

}  // namespace cosserat_cable
