// An output bag that is valid whatever happens: interrupted, or the disk full.
//
// It is written as PATH.active and renamed when it is whole. rosbag cannot close a bag on a full
// disk, so room for the end of the file is allocated on the disk before each piece is written.
#pragma once

#include <rosbag/bag.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

namespace cosserat_cable {

/// The output could not be written; `what` says why and for which file.
class BagWriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class BagWriter {
 public:
  /// Throws BagWriteError where the file cannot be made.
  explicit BagWriter(const std::string& path);
  /// Closes; errors are not reported.
  ~BagWriter();

  /// Throws BagWriteError where there is no room: the message is not written, those before it are
  /// safe, and Close will succeed.
  template <typename T>
  void Write(const std::string& topic, const ros::Time& time, const T& message,
             const boost::shared_ptr<ros::M_string>& connection = nullptr) {
    Reserve(ros::serialization::serializationLength(message));
    try {
      bag_->write(topic, time, message, connection);
    } catch (const rosbag::BagException& error) {
      Broken(error.what());
    }
  }

  /// Writes the index and gives the file its name. Throws BagWriteError where that fails.
  void Close();

 private:
  void Reserve(std::uint64_t message_size);
  [[noreturn]] void Broken(const std::string& why);

  std::string path_, active_path_;
  std::unique_ptr<rosbag::Bag> bag_;
  int descriptor_ = -1;
  std::uint64_t unreserved_ = 0;  // written since room was last made [bytes]
  bool can_allocate_ = true;
};

}  // namespace cosserat_cable
