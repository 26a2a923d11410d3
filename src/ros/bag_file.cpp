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
  template <typename T>
  T Number() {
    T value;
    std::memcpy(&value, Take(sizeof value).data(), sizeof value);
    return value;
  }
  const std::uint8_t* at() const { return at_; }

 private:
  const std::uint8_t* at_;
  std::size_t left_;
};

/// A record's header, and where its data begins.
class Record {
 public:
  explicit Record(Cursor* from) {
    const std::string_view header = from->Take(from->Number<std::uint32_t>());
    fields_ = Fields(header);
    data_size = from->Number<std::uint32_t>();
  }
  static ros::M_string Fields(std::string_view text) {
    ros::M_string fields;
    Cursor cursor(text);
    while (!cursor.done()) {
      const std::string_view field = cursor.Take(cursor.Number<std::uint32_t>());
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

void Decompress(const std::string& compression, std::vector<std::uint8_t>* from,
                std::vector<std::uint8_t>* to) {
  auto* input = reinterpret_cast<char*>(from->data());
  auto* output = reinterpret_cast<char*>(to->data());
  auto size = static_cast<unsigned>(to->size());
  bool good = false;
  if (compression == "none") {
    std::swap(*from, *to);
    return;
  }
  if (compression == "lz4") {
    good = roslz4_buffToBuffDecompress(input, static_cast<unsigned>(from->size()), output, &size) ==
           ROSLZ4_OK;
  } else if (compression == "bz2") {
    good = BZ2_bzBuffToBuffDecompress(output, &size, input, static_cast<unsigned>(from->size()), 0,
                                      0) == BZ_OK;
  } else {
    throw BagFormatError("got compression '" + compression + "', expected none, lz4 or bz2");
  }
  if (!good || size != to->size()) throw BagFormatError("a chunk cannot be decompressed");
}

}  // namespace

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
  const std::vector<std::uint8_t> bytes = ReadAt(position, size_ - std::min(size_, position));
  Cursor cursor(bytes.data(), bytes.size());
  std::map<std::uint32_t, TopicContent*> content_of;  // by connection
  for (std::uint32_t i = 0; i < connections; ++i) {
    const Record record(&cursor);
    record.Require(BagRecord::kConnection);
    const ros::M_string header = Record::Fields(cursor.Take(record.data_size));
    const std::string& topic = record.Text("topic");
    TopicContent* content = content_of[record.Number<std::uint32_t>("conn")] = &contents_[topic];
    const auto field = [&header](const char* name) {
      const auto found = header.find(name);
      return found == header.end() ? std::string() : found->second;
    };
    content->type = field("type");
    content->md5sum = field("md5sum");
    if (topics(topic))
      connections_.push_back(
          {record.Number<std::uint32_t>("conn"), topic, boost::make_shared<ros::M_string>(header)});
  }
  for (std::uint32_t i = 0; i < chunks; ++i) {
    const Record record(&cursor);
    record.Require(BagRecord::kChunkInfo);
    Chunk chunk;
    chunk.position = record.Number<std::uint64_t>("chunk_pos");
    chunk.connections = record.Number<std::uint32_t>("count");
    Cursor counts(cursor.Take(record.data_size));
    for (std::uint32_t k = 0; k < chunk.connections; ++k) {
      const auto connection = counts.Number<std::uint32_t>();
      chunk.is_wanted = IndexOf(connection) >= 0 || chunk.is_wanted;
      const auto messages = counts.Number<std::uint32_t>();
      const auto content = content_of.find(connection);
      if (content != content_of.end()) content->second->messages += messages;
    }
    chunks_.push_back(chunk);
  }
  std::sort(chunks_.begin(), chunks_.end(),
            [](const Chunk& a, const Chunk& b) { return a.position < b.position; });
}

int BagFile::IndexOf(std::uint32_t id) const {
  for (std::size_t i = 0; i < connections_.size(); ++i)
    if (connections_[i].id == id) return static_cast<int>(i);
  return -1;
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
  const std::vector<std::uint8_t> bytes =
      ReadAt(chunk.position + chunk.size, end - chunk.position - chunk.size);
  Cursor index(bytes.data(), bytes.size());
  for (std::uint32_t i = 0; i < chunk.connections; ++i) {
    const Record list(&index);
    list.Require(BagRecord::kIndex);
    Cursor items(index.Take(list.data_size));
    const int connection = IndexOf(list.Number<std::uint32_t>("conn"));
    if (connection < 0) continue;
    for (std::size_t k = 0; k < list.data_size / kIndexEntrySize; ++k) {
      const auto time = items.Number<BagTime>();
      entries_.push_back({time.seconds * std::int64_t{1'000'000'000} + time.nanoseconds,
                          static_cast<std::uint32_t>(connection), number,
                          items.Number<std::uint32_t>()});
    }
  }
}

void BagFile::Open(std::uint32_t number) {
  if (number == open_chunk_) return;
  const Chunk& chunk = chunks_[number];
  open_chunk_ = UINT32_MAX;
  std::vector<std::uint8_t> stored = ReadAt(chunk.position, chunk.size);
  open_bytes_.resize(chunk.uncompressed_size);
  Decompress(chunk.compression, &stored, &open_bytes_);
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
