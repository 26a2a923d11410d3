#include "bag_records.h"

#include <algorithm>
#include <cstring>

namespace cosserat_cable {
namespace {

// Of the first record's header and padding [bytes].
constexpr std::size_t kFileHeaderSize = 4096;

std::size_t FieldSize(std::string_view name, std::string_view value) {
  return sizeof(std::uint32_t) + name.size() + 1 + value.size();
}

void AppendField(std::string_view name, std::string_view value, ByteBuffer* out) {
  out->Append(static_cast<std::uint32_t>(FieldSize(name, value) - sizeof(std::uint32_t)));
  out->Append(name);
  out->Append("=");
  out->Append(value);
}

}  // namespace

std::uint8_t* ByteBuffer::Extend(std::size_t count) {
  const std::size_t begin = used_;
  used_ += count;
  if (used_ > bytes_.size()) bytes_.resize(std::max(used_, 2 * bytes_.size()));
  return bytes_.data() + begin;
}

void ByteBuffer::Append(const void* bytes, std::size_t count) {
  if (count > 0) std::memcpy(Extend(count), bytes, count);
}

void ByteBuffer::Set(std::size_t position, std::uint32_t value) {
  std::memcpy(bytes_.data() + position, &value, sizeof value);
}

RecordHeader::RecordHeader(BagRecord kind, ByteBuffer* out) : out_(out), begin_(out->size()) {
  out_->Append(std::uint32_t{0});
  Number("op", kind);
}

RecordHeader& RecordHeader::Field(std::string_view name, std::string_view value) {
  AppendField(name, value, out_);
  return *this;
}

void RecordHeader::EndBefore(std::size_t size) {
  out_->Set(begin_, static_cast<std::uint32_t>(out_->size() - begin_ - sizeof(std::uint32_t)));
  out_->Append(static_cast<std::uint32_t>(size));
}

void AppendConnection(std::uint32_t id, const std::string& topic, const ros::M_string& header,
                      ByteBuffer* out) {
  std::size_t size = 0;
  for (const auto& [name, value] : header) size += FieldSize(name, value);
  RecordHeader(BagRecord::kConnection, out)
      .Number("conn", id)
      .Field("topic", topic)
      .EndBefore(size);
  for (const auto& [name, value] : header) AppendField(name, value, out);
}

void AppendFileHeader(std::uint64_t index_position, std::uint32_t connections, std::uint32_t chunks,
                      ByteBuffer* out) {
  const std::size_t begin = out->size();
  RecordHeader header(BagRecord::kFile, out);
  header.Number("index_pos", index_position)
      .Number("conn_count", connections)
      .Number("chunk_count", chunks);
  const std::size_t padding = kFileHeaderSize - (out->size() - begin - sizeof(std::uint32_t));
  header.EndBefore(padding);
  std::memset(out->Extend(padding), ' ', padding);
}

}  // namespace cosserat_cable
