#include "urdf_parse.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <exception>

namespace cosserat_cable {
namespace {

/// Turns urdfdom's errors into problems for as long as it lives, and silences the rest.
class MessageCatcher : public console_bridge::OutputHandler {
 public:
  MessageCatcher(std::string path, Problems* problems)
      : path_(std::move(path)), problems_(*problems), level_(console_bridge::getLogLevel()) {
    console_bridge::useOutputHandler(this);
    console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_ERROR);
  }
  ~MessageCatcher() override {
    console_bridge::setLogLevel(level_);
    console_bridge::restorePreviousOutputHandler();
  }
  MessageCatcher(const MessageCatcher&) = delete;
  MessageCatcher& operator=(const MessageCatcher&) = delete;

  void log(const std::string& text, console_bridge::LogLevel, const char*, int) override {
    problems_.Add(path_, text);
  }

 private:
  std::string path_;
  Problems& problems_;
  console_bridge::LogLevel level_;
};

void AddMissingLimits(tinyxml2::XMLElement* robot) {
  for (auto* joint = robot->FirstChildElement("joint"); joint;
       joint = joint->NextSiblingElement("joint")) {
    if (joint->FirstChildElement("limit")) continue;
    tinyxml2::XMLElement* limit = joint->GetDocument()->NewElement("limit");
    limit->SetAttribute("effort", 0);
    limit->SetAttribute("velocity", 0);
    joint->InsertEndChild(limit);
  }
}

}  // namespace

urdf::ModelInterfaceSharedPtr ParseUrdf(tinyxml2::XMLDocument* document, const std::string& path,
                                        Problems* problems, Problems* complaints) {
  AddMissingLimits(document->RootElement());
  tinyxml2::XMLPrinter printer;
  document->Print(&printer);
  Problems found;
  urdf::ModelInterfaceSharedPtr model;
  try {
    const MessageCatcher catcher(path, &found);
    model = urdf::parseURDF(printer.CStr());
  } catch (const std::exception& error) {
    found.Add(path, error.what());
  }
  if (!model && found.empty()) found.Add(path, "is not a URDF that urdfdom can read");
  (model ? complaints : problems)->Append(found);
  return model;
}

}  // namespace cosserat_cable
