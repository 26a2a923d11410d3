#include "bag_message_sizes.h"

#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include <cstring>

namespace cosserat_cable {
namespace {

// Serialized, before the frame's name: seq, stamp [bytes].
constexpr std::uint64_t kHeader = 3 * sizeof(std::uint32_t);
constexpr std::uint64_t kTransform = 7 * sizeof(double);

/// Walks over a message; once it has left the bytes, it stays false.
class Sizes {
 public:
  explicit Sizes(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}
  bool good() const { return good_; }

  void Skip(std::uint64_t size) {
    good_ = good_ && size <= bytes_.size() - at_;
    if (good_) at_ += size;
  }
  /// The number of items that are claimed to follow.
  std::uint32_t Count() {
    std::uint32_t count = 0;
    if (good_ && sizeof count <= bytes_.size() - at_)
      std::memcpy(&count, bytes_.data() + at_, sizeof count);
    Skip(sizeof count);
    return count;
  }
  void Text() { Skip(Count()); }
  void Numbers() { Skip(std::uint64_t{Count()} * sizeof(double)); }
  void Header() {
    Skip(kHeader);
    Text();
  }

 private:
  const std::vector<std::uint8_t>& bytes_;
  std::uint64_t at_ = 0;
  bool good_ = true;
};

}  // namespace

template <>
bool HoldsWhole<sensor_msgs::JointState>(const std::vector<std::uint8_t>& bytes) {
  Sizes sizes(bytes);
  sizes.Header();
  const std::uint32_t names = sizes.Count();
  for (std::uint32_t i = 0; i < names && sizes.good(); ++i) sizes.Text();
  for (int list = 0; list < 3; ++list) sizes.Numbers();  // positions, velocities, efforts
  return sizes.good();
}

template <>
bool HoldsWhole<tf2_msgs::TFMessage>(const std::vector<std::uint8_t>& bytes) {
  Sizes sizes(bytes);
  const std::uint32_t transforms = sizes.Count();
  for (std::uint32_t i = 0; i < transforms && sizes.good(); ++i) {
    sizes.Header();
    sizes.Text();
    sizes.Skip(kTransform);
  }
  return sizes.good();
}

}  // namespace cosserat_cable
