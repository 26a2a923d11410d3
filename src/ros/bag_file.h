// A recorded bag of format 2.0, read through its index.
//
// rosbag's own class looks for plugins (of decryption) in every package of the system before it
// opens a bag, which takes as long as simulating seconds of a vehicle.
#pragma once

#include <ros/datatypes.h>

#include <boost/shared_ptr.hpp>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include "cosserat_cable/ros/motion_topics.h"

namespace cosserat_cable {

/// The bag is none, truncated or damaged; `what` says how.
class BagFormatError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// It was never closed.
class BagUnindexedError : public BagFormatError {
 public:
  using BagFormatError::BagFormatError;
};

/// What messages of a topic are.
struct BagConnection {
  std::uint32_t id = 0;
  std::string topic;
  boost::shared_ptr<ros::M_string> header;  ///< as a subscriber is told it: type, md5sum, ...
  /// A field of the header; "" where it is missing.
  std::string Field(const std::string& name) const;
};

class BagFile {
 public:
  /// A message in the index.
  struct Entry {
    std::int64_t time;         ///< of recording [ns]
    std::uint32_t connection;  ///< index in connections()
    std::uint32_t chunk, offset;
  };

  /// Reads the index of the messages on `topics`. Throws BagFormatError.
  BagFile(const std::string& path, const std::function<bool(const std::string&)>& topics);
  ~BagFile();
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;

  /// Of these topics.
  const std::vector<BagConnection>& connections() const { return connections_; }
  /// Of all topics, wanted or not.
  const TopicContents& contents() const { return contents_; }
  /// In the order of time.
  const std::vector<Entry>& entries() const { return entries_; }
  /// The message's bytes. Entries that follow each other in time are cheap. Throws BagFormatError.
  std::vector<std::uint8_t> Read(const Entry& entry);

 private:
  class Walk;
  struct Chunk {
    std::uint64_t position = 0;  // of the record; of its data once that is known
    std::string compression;
    std::uint32_t size = 0, uncompressed_size = 0;
    std::uint32_t connections = 0;  // in its index
    bool is_wanted = false;
  };

  std::vector<std::uint8_t> ReadAt(std::uint64_t position, std::uint64_t size) const;
  void ReadEnd(std::uint64_t position, std::uint32_t connections, std::uint32_t chunks,
               const std::function<bool(const std::string&)>& topics);
  void ReadIndex(std::uint32_t chunk, std::uint64_t end);
  /// The index in connections() of that id; -1: not wanted.
  int IndexOf(std::uint32_t id) const;
  void Open(std::uint32_t chunk);

  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::vector<BagConnection> connections_;
  std::unordered_map<std::uint32_t, std::size_t> indices_;  // in connections_, by id
  TopicContents contents_;
  std::vector<Chunk> chunks_;
  std::vector<Entry> entries_;
  std::uint32_t open_chunk_ = UINT32_MAX;
  std::vector<std::uint8_t> open_bytes_;
};

}  // namespace cosserat_cable
