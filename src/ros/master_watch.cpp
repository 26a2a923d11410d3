#include "master_watch.h"

#include <ros/console.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/param.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <cstdint>
#include <utility>

namespace cosserat_cable {
namespace {

constexpr std::chrono::seconds kPeriod{1};

std::string RunId() {
  std::string id;
  ros::param::get("/run_id", id);
  return id;
}

}  // namespace

MasterWatch::MasterWatch(std::string description)
    : description_(std::move(description)), run_id_(RunId()) {}

void MasterWatch::Look() {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < kPeriod) return;
  last_ = now;
  const bool is_there = ros::master::check();
  if (is_there == is_gone_) {
    is_gone_ = !is_there;
    if (is_gone_) {
      ROS_WARN_STREAM("the ROS master at " << ros::master::getURI()
                                           << " is gone: what is connected goes on");
    }
  }
  if (!is_there) return;
  const std::string run_id = RunId();
  if (run_id != run_id_ && !run_id.empty()) {
    run_id_ = run_id;
    Register();
    ROS_WARN_STREAM(
        "the ROS master was restarted: this node's topics are registered anew, its "
        "parameters are lost there, and it goes on with those it had");
  }
  std::string description;
  if (description_.empty() || !ros::param::get("robot_description", description)) return;
  if (description == description_) return;
  description_ = description;
  ROS_WARN_STREAM(
      "robot_description was replaced: the vehicle of the start is simulated; restart "
      "the node to take the new one");
}

// roscpp registers topics once, when they are made. Which they are, and of which types, it tells
// those who ask its server.
void MasterWatch::Register() const {
  const std::string uri = ros::XMLRPCManager::instance()->getServerURI();
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) return;
  XmlRpc::XmlRpcClient own(host.c_str(), static_cast<int>(port), "/");
  for (const bool publishes : {false, true}) {
    XmlRpc::XmlRpcValue question, answer;
    question[0] = ros::this_node::getName();
    if (!own.execute(publishes ? "getPublications" : "getSubscriptions", question, answer)) return;
    XmlRpc::XmlRpcValue& topics = answer[2];
    for (int i = 0; i < topics.size(); ++i) {
      XmlRpc::XmlRpcValue arguments, result, payload;
      arguments[0] = ros::this_node::getName();
      arguments[1] = topics[i][0];
      arguments[2] = topics[i][1];
      arguments[3] = uri;
      ros::master::execute(publishes ? "registerPublisher" : "registerSubscriber", arguments,
                           result, payload, false);
    }
  }
}

}  // namespace cosserat_cable
