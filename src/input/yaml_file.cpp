#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cosserat_cable/input/yaml_value.h"

namespace cosserat_cable {

YamlValue LoadYamlFile(const std::string& path, Problems* problems) {
  std::error_code ignored;  // what cannot be asked about cannot be opened either
  if (std::filesystem::is_directory(path, ignored)) {
    problems->Add(path, "got a directory, expected a YAML file");
    return {};
  }
  errno = 0;
  std::ifstream file(path);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (!file || file.bad()) {
    problems->Add(path, std::string("cannot be read: ") + std::strerror(errno));
    return {};
  }
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text.str());
    if (documents.empty()) {
      problems->Add(path, 1, "", "got an empty file, expected a YAML document");
      return {};
    }
    if (documents.size() > 1) {
      problems->Add(path, documents[1].Mark().line + 1, "",
                    "got a second YAML document, expected one in the file");
      return {};
    }
    return YamlValue::Root(path, documents[0], problems);
  } catch (const YAML::Exception& error) {
    problems->Add(path, error.mark.is_null() ? 0 : error.mark.line + 1, "",
                  "malformed YAML: " + error.msg);
    return {};
  }
}

}  // namespace cosserat_cable
