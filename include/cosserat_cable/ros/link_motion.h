// Follows the links that cables need: every transform and joint state goes through here, live and
// in replay.
//
// The tree of frames is tf2's, and at the samples a link is where tf2 says it is; the MotionTree
// keeps each edge's samples at their own stamps and makes the C2 motion of them, which tf2's
// straight lines between samples cannot give.
#pragma once

#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cosserat_cable/math/gap_rule.h"
#include "cosserat_cable/ros/motion_topics.h"
#include "cosserat_cable/ros/warnings.h"
#include "cosserat_cable/vehicle/edge_smoother.h"
#include "cosserat_cable/vehicle/motion_tree.h"
#include "cosserat_cable/vehicle/recording_judge.h"
#include "cosserat_cable/vehicle/vehicle_model.h"

namespace cosserat_cable {

struct LinkMotionOptions {
  std::string world_frame;               ///< inertial; empty: the root of the tree above the links
  std::vector<std::string> held_joints;  ///< stay at rest, see RestPosition: nothing drives them
  MotionTopics topics;
  /// What stands before the URDF's names in recorded frames and joints: "rover1" is taken for
  /// "rover1/", "rover1_" as it is. Empty: nothing.
  std::string tf_prefix;
  double max_gap = 0.25;  ///< [s], see PoseCurve
  double smooth = 0;      ///< cutoff [Hz], see EdgeSmoother; 0: none
  bool judge = true;      ///< whether the samples are judged, see Findings
};

class LinkMotion {
 public:
  enum class Source { kUrdf, kTfStatic, kTf, kJointStates };

  /// One edge of the tree, named by its child.
  struct Edge {
    std::string parent;
    Source source = Source::kUrdf;
    std::uint64_t samples = 0;
    std::int64_t first = 0, last = 0;   ///< stamps [ns]
    std::int64_t longest_interval = 0;  ///< between two samples [ns]
    std::uint64_t gaps = 0;             ///< intervals longer than max_gap, see GapRule
    bool moves = false;                 ///< whether any two samples differ
    bool is_followed = false;           ///< whether a link depends on it
    MotionTree::Edge samples_of;        ///< where they are kept, once there are any

    Pose last_pose;
    GapRule gap_rule;
    RecordingJudge::Edge* judged = nullptr;
    EdgeSmoother* smoother = nullptr;
  };

  /// `links`: those whose motion will be asked for. `vehicle` outlives this.
  LinkMotion(const VehicleModel& vehicle, const std::vector<std::string>& links,
             LinkMotionOptions options);

  /// A sample that is older than its edge's last by more than half a second says that time ran
  /// backwards: all samples are forgotten, `clear_count` grows, and the sample is the first of the
  /// new run. Samples that cannot be used are counted in `warnings`. `publisher`: the node's name.
  void Ingest(const tf2_msgs::TFMessage& message, bool is_static,
              const std::string& publisher = "");
  void Ingest(const sensor_msgs::JointState& message, const std::string& publisher = "");
  /// No more samples will come.
  void Finish();
  /// Forgets all samples; the tree's edges stay.
  void Clear();

  /// The inertial frame: the option, or the common root of all links so far. Empty where they have
  /// none in common.
  const std::string& world() const { return world_; }
  /// What to do about names and stamps that do not fit, one sentence each.
  std::vector<std::string> Advice() const;
  /// What the samples so far say that cannot be, of the edges that links depend on. `world`: the
  /// inertial frame that is taken.
  Findings MotionFindings(const std::string& world) const;
  /// The inertial frame to be taken: world(), or a frame below it where a localisation corrects the
  /// frames above that one, see RecordingJudge.
  std::string SmoothWorld() const;
  /// Why links cannot be followed from world() yet, one sentence each. Empty: all edges are driven.
  std::vector<std::string> Missing() const;

  /// Why there is no time at which all links are known, where none is missing: which edges were
  /// recorded when.
  std::vector<std::string> Apart() const;

  /// The first time at which all links are known, and the time up to which their motion is final
  /// [ns]. False where some edge has no sample yet. Where nothing moves at all: the range is that
  /// of the samples seen.
  bool Range(std::int64_t* begin, std::int64_t* ready) const;

  Motion Evaluate(const std::string& link, std::int64_t time) const;
  /// The links given at construction.
  const std::vector<std::string>& links() const { return links_; }
  /// The same of the i-th of them, up to rounding; see MotionTree::Follow.
  Motion Follow(std::size_t i, std::int64_t time);
  bool InGap(const std::string& link, std::int64_t time) const;
  /// Intervals longer than max_gap, over the edges that links depend on; also of runs before Clear.
  std::uint64_t gap_count() const;
  void DropBefore(std::int64_t time);

  const std::map<std::string, Edge>& edges() const { return edges_; }
  std::uint64_t clear_count() const { return clear_count_; }
  std::int64_t last_stamp() const { return last_stamp_; }  ///< the latest of all samples [ns]
  Warnings& warnings() { return warnings_; }
  const Warnings& warnings() const { return warnings_; }

 private:
  struct Step {
    std::string child, parent;
    const JointModel* joint;  // null where the recording alone knows this edge
  };

  struct Unstamped {
    std::string parent;
    Source source = Source::kTf;
    std::uint64_t samples = 0;
  };

  /// A source's name as the user knows it.
  std::string ToString(Source source) const;
  std::string UnstampedText(const Unstamped& unstamped) const;
  /// A recorded name as the URDF has it.
  std::string Own(const std::string& name) const;
  void AddFixed(const std::string& parent, const std::string& child, const Pose& X_PC,
                Source source);
  void AddSample(const std::string& parent, const std::string& child, std::int64_t stamp,
                 const Pose& X_PC, Source source, const double* position = nullptr);
  void Judge(Edge* edge, const std::string& child, std::int64_t stamp, const Pose& X_PC,
             const double* position);
  void Deliver(Edge* edge, const std::string& child, std::int64_t stamp, const Pose& X_PC);
  void JudgeRejected(const std::string& parent, const std::string& child, std::int64_t stamp,
                     const Pose& X_PC);
  void SetPublisher(const std::string& name, Source source);
  RecordingJudge::Way WayAboveVehicle() const;
  /// The edge, made where it is new; null where this source does not count for it.
  Edge* AcceptSource(const std::string& parent, const std::string& child, Source source);
  void IngestJoint(const JointModel& joint, double position, std::int64_t stamp);
  const JointModel* JointAbove(const std::string& link) const;
  // The way up from a frame: along edges seen, and along the URDF's joints where none was.
  std::vector<Step> Ascend(const std::string& frame) const;
  /// Whether a frame is the other or above it, by edges and joints.
  bool IsAbove(const std::string& ancestor, const std::string& frame) const;
  void UpdateTree();
  double Seconds(std::int64_t time) const { return static_cast<double>(time - epoch_) * 1e-9; }

  const VehicleModel& vehicle_;
  std::vector<std::string> links_;
  LinkMotionOptions options_;
  std::map<std::string, const JointModel*> joint_above_;  // by child
  std::multimap<std::string, const JointModel*> mimics_;  // by the joint they follow
  std::map<std::string, const JointModel*> joints_;       // by name
  std::vector<std::string> named_;                        // in the last joint state
  std::vector<const JointModel*> named_joints_;           // of these names; null: not in the URDF

  std::map<std::string, Unstamped> unstamped_;  // by child
  std::set<std::string> unknown_joints_;

  std::optional<RecordingJudge> judge_;
  std::string publisher_;
  Source publisher_source_ = Source::kUrdf;
  int publisher_number_ = -1;
  std::map<std::string, EdgeSmoother> smoothers_;  // by child

  MotionTree tree_;
  std::vector<MotionTree::Link> followed_;  // links_ as seen from world_, once asked for
  std::map<std::string, Edge> edges_;
  std::string world_;
  std::set<std::string> relevant_;  // children on the way from the links to the root
  std::int64_t epoch_ = 0;          // so that the tree's seconds are small numbers
  bool has_epoch_ = false;
  std::int64_t last_stamp_ = 0;
  std::uint64_t clear_count_ = 0;
  Warnings warnings_;
};

/// "/tf", "/joint_states", ...
std::string ToString(LinkMotion::Source source, const MotionTopics& topics = {});

/// With its separator: "rover1/" for "rover1", "/rover1" and "rover1/".
std::string WholePrefix(const std::string& tf_prefix);

}  // namespace cosserat_cable
