#include "bag_file.h"

#include <bzlib.h>
#include <fcntl.h>
#include <roslz4/lz4s.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cerrno>
#include <cstring>
#include <map>

#include "bag_records.h"

namespace cosserat_cable {
namespace {

// A header of a chunk or of the file is far shorter [bytes].
constexpr std::uint64_t kHeaderRoom = 4096;
// What a damaged file claims to hold is not believed beyond this; rosbag's own chunks have less
// than a megabyte and one message, and records of the index far less [bytes].
constexpr std::uint64_t kMostOfChunk = 512 * 1024 * 1024;
constexpr std::uint64_t kMostOfRecord = 64 * 1024 * 1024;
// So much is read of the index at once [bytes].
constexpr std::uint64_t kBlock = 256 * 1024;
// The format lz4 makes no more of a byte.
constexpr std::uint64_t kMostByLz4 = 255;
constexpr std::uint32_t kNanosecondsPerSecond = 1'000'000'000;

/// A number from the next bytes of a source.
template <typename T, typename Source>
T TakeNumber(Source* from) {
  T value;
  std::memcpy(&value, from->Take(sizeof value).data(), sizeof value);
  return value;
}
constexpr std::size_t kIndexEntrySize = sizeof(BagTime) + sizeof(std::uint32_t);

/// Takes numbers and pieces from bytes, from first to last.
class Cursor {
 public:
  Cursor(const std::uint8_t* bytes, std::size_t size) : at_(bytes), left_(size) {}
  explicit Cursor(std::string_view bytes)
      : Cursor(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()) {}
  bool done() const { return left_ == 0; }
  std::string_view Take(std::size_t size) {
    if (size > left_) throw BagFormatError("a record ends too early");
    const std::string_view piece(reinterpret_cast<const char*>(at_), size);
    at_ += size;
    left_ -= size;
    return piece;
  }
  const std::uint8_t* at() const { return at_; }

 private:
  const std::uint8_t* at_;
  std::size_t left_;
};

/// A record's header, and where its data begins.
class Record {
 public:
  template <typename Source>
  explicit Record(Source* from) {
    fields_ = Fields(from->Take(TakeNumber<std::uint32_t>(from)));
    data_size = TakeNumber<std::uint32_t>(from);
  }
  static ros::M_string Fields(std::string_view text) {
    ros::M_string fields;
    Cursor cursor(text);
    while (!cursor.done()) {
      const std::string_view field = cursor.Take(TakeNumber<std::uint32_t>(&cursor));
      const std::size_t equals = field.find('=');
      if (equals == field.npos) throw BagFormatError("a field has no name");
      fields[std::string(field.substr(0, equals))] = field.substr(equals + 1);
    }
    return fields;
  }

  bool Is(BagRecord kind) const { return Number<BagRecord>("op") == kind; }
  void Require(BagRecord kind) const {
    if (!Is(kind)) throw BagFormatError("a record is of another kind than it should be");
  }
  const std::string& Text(const std::string& name) const {
    const auto field = fields_.find(name);
    if (field == fields_.end()) throw BagFormatError("a record lacks '" + name + "'");
    return field->second;
  }
  template <typename T>
  T Number(const std::string& name) const {
    const std::string& text = Text(name);
    T value;
    if (text.size() != sizeof value) throw BagFormatError("'" + name + "' is no number");
    std::memcpy(&value, text.data(), sizeof value);
    return value;
  }

  std::uint32_t data_size = 0;

 private:
  ros::M_string fields_;
};

/// Grows with what comes out, not with what was claimed.
bool DecompressBz2(std::vector<std::uint8_t>* from, std::uint32_t size,
                   std::vector<std::uint8_t>* to) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) return false;
  stream.next_in = reinterpret_cast<char*>(from->data());
  stream.avail_in = static_cast<unsigned>(from->size());
  to->clear();
  int state = BZ_OK;
  while (state == BZ_OK) {
    const std::size_t had = to->size();
    if (had > size) break;
    to->resize(had + std::max<std::size_t>(had, kBlock));
    stream.next_out = reinterpret_cast<char*>(to->data() + had);
    stream.avail_out = static_cast<unsigned>(to->size() - had);
    state = BZ2_bzDecompress(&stream);
    const std::size_t made = to->size() - had - stream.avail_out;
    to->resize(had + made);
    if (made == 0 && stream.avail_in == 0) break;  // it ends too early
  }
  BZ2_bzDecompressEnd(&stream);
  return state == BZ_STREAM_END && to->size() == size;
}

bool DecompressLz4(std::vector<std::uint8_t>* from, std::uint32_t size,
                   std::vector<std::uint8_t>* to) {
  if (size > kMostByLz4 * from->size()) return false;
  to->resize(size);
  unsigned made = size;
  return roslz4_buffToBuffDecompress(reinterpret_cast<char*>(from->data()),
                                     static_cast<unsigned>(from->size()),
                                     reinterpret_cast<char*>(to->data()), &made) == ROSLZ4_OK &&
         made == size;
}

void Decompress(const std::string& compression, std::vector<std::uint8_t>* from, std::uint32_t size,
                std::vector<std::uint8_t>* to) {
  bool good = false;
  if (compression == "none") {
    std::swap(*from, *to);
    good = to->size() == size;
  } else if (compression == "lz4") {
    good = DecompressLz4(from, size, to);
  } else if (compression == "bz2") {
    good = DecompressBz2(from, size, to);
  } else {
    throw BagFormatError("got compression '" + compression + "', expected none, lz4 or bz2");
  }
  if (!good) throw BagFormatError("a chunk cannot be decompressed");
}

}  // namespace

/// A part of the file, from first to last. It is read in pieces: what a record claims to hold costs
/// no memory that the file does not have.
class BagFile::Walk {
 public:
  Walk(const BagFile& file, std::uint64_t begin, std::uint64_t end)
      : file_(file), at_(begin), end_(std::max(begin, end)) {}

  /// The next bytes, which stay until more are taken.
  std::string_view Take(std::uint64_t size) {
    if (size > bytes_.size() - used_ + (end_ - at_)) throw BagFormatError("it ends too early");
    if (size > kMostOfRecord)
      throw BagFormatError("a record claims to hold " + std::to_string(size) + " bytes");
    if (size > bytes_.size() - used_) {
      bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(used_));
      used_ = 0;
      const std::uint64_t more = std::min(end_ - at_, std::max(size - bytes_.size(), kBlock));
      const std::vector<std::uint8_t> piece = file_.ReadAt(at_, more);
      bytes_.insert(bytes_.end(), piece.begin(), piece.end());
      at_ += more;
    }
    const std::string_view taken(reinterpret_cast<const char*>(bytes_.data()) + used_, size);
    used_ += size;
    return taken;
  }

 private:
  const BagFile& file_;
  std::uint64_t at_, end_;
  std::vector<std::uint8_t> bytes_;  // before at_
  std::uint64_t used_ = 0;           // of bytes_
};

std::string BagConnection::Field(const std::string& name) const {
  const auto field = header->find(name);
  return field == header->end() ? "" : field->second;
}

BagFile::BagFile(const std::string& path, const std::function<bool(const std::string&)>& topics) {
  descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  try {
    struct stat status {};
    if (descriptor_ < 0 || fstat(descriptor_, &status) != 0)
      throw BagFormatError(std::strerror(errno));
    size_ = static_cast<std::uint64_t>(status.st_size);
    const std::vector<std::uint8_t> start = ReadAt(0, std::min(size_, 2 * kHeaderRoom));
    Cursor cursor(start.data(), start.size());
    const std::string_view version(kBagVersion);
    if (start.size() < version.size() || cursor.Take(version.size()) != version)
      throw BagFormatError("it does not begin with '#ROSBAG V2.0'");
    const Record header(&cursor);
    header.Require(BagRecord::kFile);
    const auto index = header.Number<std::uint64_t>("index_pos");
    if (index == 0) throw BagUnindexedError("it has no index");
    ReadEnd(index, header.Number<std::uint32_t>("conn_count"),
            header.Number<std::uint32_t>("chunk_count"), topics);
    for (std::uint32_t i = 0; i < chunks_.size(); ++i)
      if (chunks_[i].is_wanted)
        ReadIndex(i, i + 1 < chunks_.size() ? chunks_[i + 1].position : index);
  } catch (...) {
    if (descriptor_ >= 0) close(descriptor_);
    throw;
  }
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.time < b.time; });
}

BagFile::~BagFile() { close(descriptor_); }

std::vector<std::uint8_t> BagFile::ReadAt(std::uint64_t position, std::uint64_t size) const {
  if (position > size_ || size > size_ - position) throw BagFormatError("it ends too early");
  std::vector<std::uint8_t> bytes(size);
  for (std::uint64_t done = 0; done < size;) {
    const ssize_t count =
        pread(descriptor_, bytes.data() + done, size - done, static_cast<off_t>(position + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw BagFormatError(count < 0 ? std::strerror(errno) : "it ends too early");
    done += static_cast<std::uint64_t>(count);
  }
  return bytes;
}

void BagFile::ReadEnd(std::uint64_t position, std::uint32_t connections, std::uint32_t chunks,
                      const std::function<bool(const std::string&)>& topics) {
  Walk walk(*this, position, size_);
  std::map<std::uint32_t, TopicContent*> content_of;  // by connection
  for (std::uint32_t i = 0; i < connections; ++i) {
    const Record record(&walk);
    record.Require(BagRecord::kConnection);
    const ros::M_string header = Record::Fields(walk.Take(record.data_size));
    const std::string& topic = record.Text("topic");
    TopicContent* content = content_of[record.Number<std::uint32_t>("conn")] = &contents_[topic];
    const auto field = [&header](const char* name) {
      const auto found = header.find(name);
      return found == header.end() ? std::string() : found->second;
    };
    content->type = field("type");
    content->md5sum = field("md5sum");
    if (topics(topic)) {
      indices_.emplace(record.Number<std::uint32_t>("conn"), connections_.size());
      connections_.push_back(
          {record.Number<std::uint32_t>("conn"), topic, boost::make_shared<ros::M_string>(header)});
    }
  }
  for (std::uint32_t i = 0; i < chunks; ++i) {
    const Record record(&walk);
    record.Require(BagRecord::kChunkInfo);
    Chunk chunk;
    chunk.position = record.Number<std::uint64_t>("chunk_pos");
    chunk.connections = record.Number<std::uint32_t>("count");
    Cursor counts(walk.Take(record.data_size));
    for (std::uint32_t k = 0; k < chunk.connections; ++k) {
      const auto connection = TakeNumber<std::uint32_t>(&counts);
      chunk.is_wanted = IndexOf(connection) >= 0 || chunk.is_wanted;
      const auto messages = TakeNumber<std::uint32_t>(&counts);
      const auto content = content_of.find(connection);
      if (content != content_of.end()) content->second->messages += messages;
    }
    chunks_.push_back(chunk);
  }
  std::sort(chunks_.begin(), chunks_.end(),
            [](const Chunk& a, const Chunk& b) { return a.position < b.position; });
}

int BagFile::IndexOf(std::uint32_t id) const {
  const auto found = indices_.find(id);
  return found == indices_.end() ? -1 : static_cast<int>(found->second);
}

// Of the chunk, whose records end at `end`.
void BagFile::ReadIndex(std::uint32_t number, std::uint64_t end) {
  Chunk& chunk = chunks_[number];
  const std::uint64_t begin = chunk.position;
  if (end < begin) throw BagFormatError("its index is out of order");
  const std::vector<std::uint8_t> head = ReadAt(begin, std::min(end - begin, kHeaderRoom));
  Cursor cursor(head.data(), head.size());
  const Record record(&cursor);
  record.Require(BagRecord::kChunk);
  chunk.compression = record.Text("compression");
  chunk.uncompressed_size = record.Number<std::uint32_t>("size");
  chunk.size = record.data_size;
  chunk.position += static_cast<std::uint64_t>(cursor.at() - head.data());
  if (end < chunk.position + chunk.size) throw BagFormatError("a chunk ends too early");
  for (const std::uint32_t size : {chunk.size, chunk.uncompressed_size})
    if (size > kMostOfChunk)
      throw BagFormatError("a chunk claims to hold " + std::to_string(size) + " bytes");
  Walk index(*this, chunk.position + chunk.size, end);
  for (std::uint32_t i = 0; i < chunk.connections; ++i) {
    const Record list(&index);
    list.Require(BagRecord::kIndex);
    Cursor items(index.Take(list.data_size));
    const int connection = IndexOf(list.Number<std::uint32_t>("conn"));
    if (connection < 0) continue;
    for (std::size_t k = 0; k < list.data_size / kIndexEntrySize; ++k) {
      const auto time = TakeNumber<BagTime>(&items);
      if (time.nanoseconds >= kNanosecondsPerSecond)
        throw BagFormatError("a time in its index is none");
      entries_.push_back({time.seconds * std::int64_t{kNanosecondsPerSecond} + time.nanoseconds,
                          static_cast<std::uint32_t>(connection), number,
                          TakeNumber<std::uint32_t>(&items)});
    }
  }
}

void BagFile::Open(std::uint32_t number) {
  if (number == open_chunk_) return;
  const Chunk& chunk = chunks_[number];
  open_chunk_ = UINT32_MAX;
  std::vector<std::uint8_t> stored = ReadAt(chunk.position, chunk.size);
  Decompress(chunk.compression, &stored, chunk.uncompressed_size, &open_bytes_);
  open_chunk_ = number;
}

std::vector<std::uint8_t> BagFile::Read(const Entry& entry) {
  Open(entry.chunk);
  if (entry.offset > open_bytes_.size()) throw BagFormatError("its index points nowhere");
  Cursor cursor(open_bytes_.data() + entry.offset, open_bytes_.size() - entry.offset);
  const Record record(&cursor);
  record.Require(BagRecord::kMessage);
  const std::string_view data = cursor.Take(record.data_size);
  return {data.begin(), data.end()};
}

}  // namespace cosserat_cable
