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
#include <utility>
#include <vector>

#include "cosserat_cable/math/gap_rule.h"
#include "cosserat_cable/ros/motion_topics.h"
#include "cosserat_cable/ros/warnings.h"
#include "cosserat_cable/vehicle/edge_smoother.h"
#include "cosserat_cable/vehicle/motion_tree.h"
#include "cosserat_cable/vehicle/recording_judge.h"
#include "cosserat_cable/vehicle/stamp_delays.h"
#include "cosserat_cable/vehicle/vehicle_model.h"

namespace cosserat_cable {

/// A transform that is sent as if it moved, and never does.
struct ConstantEdge {
  std::string parent, child;
  Pose X_PC;
  double interval = 0;  ///< the longest one between two samples [s]
};

struct LinkMotionOptions {
  std::string world_frame;               ///< inertial; empty: the root of the tree above the links
  std::vector<std::string> held_joints;  ///< stay at rest, see RestPosition: nothing drives them
  MotionTopics topics;
  /// What stands before the URDF's names in recorded frames and joints: "rover1" is taken for
  /// "rover1/", "rover1_" as it is. Empty: nothing.
  std::string tf_prefix;
  double max_gap = 0.25;                ///< [s], see PoseCurve
  double smooth = 0;                    ///< cutoff [Hz], see EdgeSmoother; 0: none
  std::vector<ConstantEdge> constants;  ///< hold at all times, see LinkMotion::Constants
  bool judge = true;                    ///< whether the samples are judged, see Findings
  bool is_node = false;                 ///< options are named in messages as the node's parameters
};

class LinkMotion {
 public:
  enum class Source { kUrdf, kTfStatic, kTf, kJointStates };

  struct Sample {
    std::int64_t stamp = 0;  ///< [ns]
    Pose X_PC;
    std::optional<double> position;  ///< where a joint state says it
    std::int64_t recorded = 0;       ///< when [ns]; 0: not known
    int publisher = -1;              ///< see RecordingJudge
    int overtaken = 0;               ///< by how many later samples with earlier stamps
  };

  /// One edge of the tree, named by its child.
  struct Edge {
    std::string parent;
    Source source = Source::kUrdf;
    std::uint64_t samples = 0;
    std::int64_t first = 0, last = 0;   ///< stamps [ns]
    std::int64_t longest_interval = 0;  ///< between two samples [ns]
    std::uint64_t gaps = 0;             ///< intervals longer than max_gap, see GapRule
    std::int64_t first_gap = 0;         ///< the stamp before it [ns]
    std::int64_t longest_gap = 0, longest_gap_at = 0;  ///< [ns], and the stamp before it
    std::int64_t longest_gap_recorded = 0;  ///< the same by times of recording [ns]; 0: not known
    bool moves = false;                     ///< whether any two samples differ
    bool is_followed = false;               ///< whether a link depends on it
    bool is_constant = false;               ///< of the options: its samples say nothing new
    MotionTree::Edge samples_of;            ///< where they are kept, once there are any

    Pose last_pose;  ///< or the one pose of a fixed edge
    std::int64_t last_recorded = 0;
    double usual_interval = 0;   ///< [ns]
    std::optional<Sample> held;  ///< after a long interval, until the next one confirms its stamp
    StampDelays delays;
    std::int64_t least_delay = 0;        ///< of recording after the stamp [ns], where it is known
    std::uint64_t bad_stamps = 0;        ///< samples that were left out for it
    std::vector<Warnings::Event> older;  ///< samples in a row that are older than the last one
    std::int64_t oldest = 0, newest_older = 0;  ///< of these: the first and the latest stamp [ns]
    std::int64_t hole_end = 0;                  ///< the stamp behind the last long interval [ns]
    std::uint64_t set_back = 0;                 ///< how often its clock was
    std::int64_t first_set_back = 0, most_set_back = 0, most_set_back_at = 0;  ///< [ns]
    std::uint64_t set_forward = 0;  ///< the same by less than a gap
    std::int64_t first_set_forward = 0, most_set_forward = 0, most_set_forward_at = 0;  ///< [ns]
    GapRule gap_rule;
    RecordingJudge::Edge* judged = nullptr;
    EdgeSmoother* smoother = nullptr;
  };

  /// No recording or robot rests without a transform for longer: more is another time [ns].
  static constexpr std::int64_t kForwardJump = 60'000'000'000;

  /// `links`: those whose motion will be asked for. `vehicle` outlives this.
  LinkMotion(const VehicleModel& vehicle, const std::vector<std::string>& links,
             LinkMotionOptions options);

  /// Samples of two messages that are older than their edges' last by more than half a second say
  /// that time ran backwards: all samples are forgotten, `clear_count` grows, and these are the
  /// first of the new run. One alone has a bad stamp. So it is with samples that are ahead of all
  /// others by more than kForwardJump. Samples that cannot be used are counted in `warnings`.
  /// `publisher`: the node's name. `recorded`: the time of recording, or of arrival [ns]; 0: not
  /// known.
  void Ingest(const tf2_msgs::TFMessage& message, bool is_static, const std::string& publisher = "",
              std::int64_t recorded = 0);
  void Ingest(const sensor_msgs::JointState& message, const std::string& publisher = "",
              std::int64_t recorded = 0);
  /// No more samples will come.
  void Finish();
  /// Forgets all samples; the tree's edges stay.
  void Clear();
  /// The inertial frame stays the one that it is now, whatever comes above it: unless the tree
  /// below it changes. Without effect where the option names one.
  void KeepWorld();

  /// The inertial frame: the option, or the common root of all links so far. Empty where they have
  /// none in common.
  const std::string& world() const { return world_; }
  /// What to do about names and stamps that do not fit, one sentence each.
  std::vector<std::string> Advice() const;
  /// What the samples so far say that cannot be, of the edges that links depend on. `world`: the
  /// inertial frame that is taken.
  Findings MotionFindings(const std::string& world) const;
  /// Which edges below `world` were recorded for less time than others, so that the links are known
  /// together for less. To be asked once all samples are there. `nothing`: set where they are known
  /// together at one instant at most, though more than that was recorded.
  Findings CoverageFindings(const std::string& world, bool* nothing) const;
  /// The transforms below `world` that never change in the recording, and were not sent yet at its
  /// begin, or no longer at its end, for no longer than they are sent anyway: they hold all the
  /// time. To be asked once all samples are there.
  std::vector<ConstantEdge> Constants(const std::string& world) const;
  /// The latest pose of a frame in one above it, by the last samples of all edges between; nothing
  /// where one is missing.
  std::optional<Pose> LatestPose(const std::string& ancestor, const std::string& frame) const;
  /// The stamp at which the recording begins [ns]; 0: not known.
  std::int64_t Start() const;
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
  const std::string& clear_reason() const { return clear_reason_; }  ///< of the last Clear
  /// The latest stamp of the samples that the last Clear forgot [ns].
  std::int64_t cleared_until() const { return cleared_until_; }
  std::int64_t last_stamp() const { return last_stamp_; }  ///< the latest of all samples [ns]
  Warnings& warnings() { return warnings_; }
  const Warnings& warnings() const { return warnings_; }

 private:
  /// From which on a clock is said to have been set forward [ns].
  static constexpr std::int64_t kSetForward = 50'000'000;

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
  std::string UseRecordTimes() const;
  std::string NoCommonRoot() const;
  void BeginMessage(std::int64_t recorded);
  /// A recorded name as the URDF has it.
  std::string Own(const std::string& name) const;
  void AddFixed(const std::string& parent, const std::string& child, const Pose& X_PC,
                Source source);
  void AddSample(const std::string& parent, const std::string& child, std::int64_t stamp,
                 const Pose& X_PC, Source source, const double* position = nullptr);
  void CountOlder(Edge* edge, const Warnings::Event& event, std::int64_t stamp);
  /// What a sample that goes on says of the older ones before it.
  void ResolveOlder(Edge* edge);
  /// What the next sample says of the edge's sample that waits.
  void ResolveHeld(Edge* edge, const std::string& child, const Sample& sample);
  /// Whether a sample that is far behind its edge confirms that time ran backwards.
  bool RunsBackwards(const std::string& child, const Edge& edge, const Sample& sample);
  void ForgetEarly(const std::string& child);
  /// Begins anew with a sample that is far ahead of all others.
  void JumpForward(const std::string& child, const Sample& sample);
  bool IsFarAhead(const Edge& edge, std::int64_t stamp) const;
  /// The frame whose edge keeps `child` from being moved in `parent`; empty where none does.
  std::string RivalOf(const std::string& parent, const std::string& child) const;
  /// Whether what speaks against this edge went silent for good, and is forgotten now.
  bool OutlivesRival(const std::string& parent, const std::string& child, Source source);
  void CountBadStamp(const std::string& child, Edge* edge, std::int64_t stamp, double late);
  void CountContradiction(const Edge& edge, const std::string& child, const Pose& X_PC,
                          Source source);
  void Take(Edge* edge, const std::string& child, const Sample& sample);
  void Feed(Edge* edge, const std::string& child, const Sample& sample);
  void JudgeSaid(Edge* edge, const std::string& child, const Sample& sample);
  void Judge(Edge* edge, const std::string& child, const Sample& sample);
  Warnings::Event Event(const std::string& subject, const std::string& detail,
                        const std::string& remedy, std::int64_t stamp = 0) const;
  std::string Option(const std::string& name, const std::string& value) const;
  /// Frames above `world`, and itself.
  std::set<std::string> Above(const std::string& world) const;
  /// Of the edges to these children.
  std::string SubjectOf(const std::vector<std::string>& children) const;
  /// Of recording after the stamp [ns], over all samples or of the edges' first ones.
  std::int64_t UsualDelay(bool at_first) const;
  void AddGapFindings(const std::set<std::string>& above, Findings* findings) const;
  /// Frames that move and lead to no link, where the vehicle's root stands still.
  void AddUnconnectedFindings(Findings* findings) const;
  void AddDriftFindings(const std::set<std::string>& above, Findings* findings) const;
  void AddSetClockFindings(const std::set<std::string>& above, Findings* findings) const;
  /// When what moves below `above` was recorded [ns]; where nothing does, all that was.
  std::pair<std::int64_t, std::int64_t> Recorded(const std::set<std::string>& above) const;
  void AddClockFindings(const std::set<std::string>& above, Findings* findings) const;
  void Deliver(Edge* edge, const std::string& child, std::int64_t stamp, const Pose& X_PC);
  void JudgeRejected(const std::string& parent, const std::string& child, std::int64_t stamp,
                     const Pose& X_PC);
  void SetPublisher(const std::string& name, Source source);
  RecordingJudge::Way WayAboveVehicle() const;
  /// The edge, made where it is new; null where this source does not count for it.
  Edge* AcceptSource(const std::string& parent, const std::string& child, Source source,
                     const Pose& X_PC);
  /// A sample that may move a frame, of an edge that has no place.
  void CountIgnored(Source source, const std::string& why);
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
  std::set<std::string> parents_;                         // of an edge or a joint
  std::multimap<std::string, const JointModel*> mimics_;  // by the joint they follow
  std::map<std::string, const JointModel*> joints_;       // by name
  std::vector<std::string> named_;                        // in the last joint state
  std::vector<const JointModel*> named_joints_;           // of these names; null: not in the URDF

  struct Early {
    std::string child;
    Sample sample;
    std::int64_t last = 0;  // the edge's, before it
  };
  std::vector<Early> early_;  // far behind their edges; of one message
  std::uint64_t early_message_ = 0, message_ = 0;
  std::int64_t recorded_ = 0, message_stamp_ = 0;  // of the message at hand [ns]
  std::int64_t first_recorded_ = 0, first_stamp_ = 0;

  // An edge that another one speaks against.
  struct Contender {
    std::int64_t rival_last = 0;        // the other one's stamp [ns]
    std::int64_t first = 0, count = 0;  // of its own samples since then
  };
  std::map<std::pair<std::string, std::string>, Contender> contenders_;  // by parent and child

  std::map<std::string, Unstamped> unstamped_;  // by child
  std::set<std::string> unknown_joints_;
  std::uint64_t usable_ = 0, unusable_ = 0;  // transforms that may move
  std::string why_unusable_;                 // the first one
  std::uint64_t ignored_ = 0;                // samples that the tree of frames has no place for
  std::string why_ignored_;                  // the first one

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
  std::int64_t newest_followed_ = 0;  // the same of those that links depend on
  bool keeps_world_ = false;          // though the option names none
  std::uint64_t clear_count_ = 0;
  std::string clear_reason_;
  std::int64_t cleared_until_ = 0;
  Warnings warnings_;
};

/// "/tf", "/joint_states", ...
std::string ToString(LinkMotion::Source source, const MotionTopics& topics = {});

/// With its separator: "rover1/" for "rover1", "/rover1" and "rover1/".
std::string WholePrefix(const std::string& tf_prefix);

}  // namespace cosserat_cable
