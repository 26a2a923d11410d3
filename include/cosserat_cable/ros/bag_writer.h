// An output bag that is valid whatever happens: interrupted, or the disk full.
//
// It is written as PATH.active and renamed when it is whole. Messages are gathered into chunks,
// each of which goes to the disk in one piece with its index, so that `rosbag reindex` finds them
// where the program is killed. Room for the chunk at hand and for the end of the file is allocated
// on the disk before a message is taken. rosbag's own writer does neither; it also keeps an entry
// of each message in memory, and moves to and fro in the file for each.
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/time.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace cosserat_cable {

/// The output could not be written; `what` says why and for which file.
class BagWriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class BagWriter {
 public:
  /// What messages belong to: a topic, and what they are.
  using Connection = std::uint32_t;

  /// Throws BagWriteError where the file cannot be made.
  explicit BagWriter(const std::string& path);
  /// Closes; errors are not reported.
  ~BagWriter();

  /// A new connection. `header`: what a reader needs to know, as a subscriber is told it.
  Connection Connect(const std::string& topic, const ros::M_string& header);
  template <typename T>
  Connection Connect(const std::string& topic) {
    return Connect(topic, {{"topic", topic},
                           {"type", ros::message_traits::datatype<T>()},
                           {"md5sum", ros::message_traits::md5sum<T>()},
                           {"message_definition", ros::message_traits::definition<T>()}});
  }

  /// Throws BagWriteError where there is no room: the message is not written, those before it are
  /// safe, and Close will succeed.
  template <typename T>
  void Write(Connection connection, const ros::Time& time, const T& message) {
    const std::uint32_t size = ros::serialization::serializationLength(message);
    ros::serialization::OStream stream(Add(connection, time, size), size);
    ros::serialization::serialize(stream, message);
  }
  /// A message that is serialised already.
  void Write(Connection connection, const ros::Time& time, const std::vector<std::uint8_t>& bytes);

  /// Writes the index and gives the file its name. Throws BagWriteError where that fails.
  void Close();

 private:
  struct Impl;
  /// Where the message's bytes go.
  std::uint8_t* Add(Connection connection, const ros::Time& time, std::size_t size);

  std::unique_ptr<Impl> impl_;
};

}  // namespace cosserat_cable
