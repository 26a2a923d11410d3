// The records that a bag of format 2.0 is made of (http://wiki.ros.org/Bags/Format/2.0): a header
// of named fields, and data.
#pragma once

#include <ros/datatypes.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cosserat_cable {

/// Bytes that are appended to; the memory stays when they are cleared.
class ByteBuffer {
 public:
  std::size_t size() const { return used_; }
  /// Forgets all bytes but the first `size`.
  void Shorten(std::size_t size) { used_ = size; }
  std::uint8_t* data() { return bytes_.data(); }
  const std::uint8_t* data() const { return bytes_.data(); }

  /// Makes room for `count` more, which the caller fills.
  std::uint8_t* Extend(std::size_t count);
  void Append(const void* bytes, std::size_t count);
  void Append(std::string_view text) { Append(text.data(), text.size()); }
  /// Numbers in a bag are little endian, as on every machine that ROS 1 runs on.
  void Append(std::uint32_t value) { Append(&value, sizeof value); }
  /// Replaces the number at `position`.
  void Set(std::size_t position, std::uint32_t value);

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t used_ = 0;
};

/// With which a bag of this format begins.
constexpr char kBagVersion[] = "#ROSBAG V2.0\n";

enum class BagRecord : std::uint8_t {
  kMessage = 2,
  kFile = 3,
  kIndex = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};

/// A time as records have it.
struct BagTime {
  std::uint32_t seconds, nanoseconds;
};

/// Appends the header of one record, field by field.
class RecordHeader {
 public:
  /// `out` outlives this.
  RecordHeader(BagRecord kind, ByteBuffer* out);

  RecordHeader& Field(std::string_view name, std::string_view value);
  /// A number or a time, by its bytes.
  template <typename T>
  RecordHeader& Number(std::string_view name, T value) {
    return Field(name, {reinterpret_cast<const char*>(&value), sizeof value});
  }
  /// Ends the header; `size` bytes of data are to follow.
  void EndBefore(std::size_t size);

 private:
  ByteBuffer* out_;
  std::size_t begin_;
};

/// Says what messages of a connection are; `header` has their type, definition and so on.
void AppendConnection(std::uint32_t id, const std::string& topic, const ros::M_string& header,
                      ByteBuffer* out);

/// The first record, which has the same size whatever it says.
void AppendFileHeader(std::uint64_t index_position, std::uint32_t connections, std::uint32_t chunks,
                      ByteBuffer* out);

}  // namespace cosserat_cable
