#include "cosserat_cable/vehicle/package_finder.h"

#include <tinyxml2.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <vector>

namespace cosserat_cable {
namespace {

namespace fs = std::filesystem;

constexpr int kDepth = 2;  // of subfolders below an entry of the path

bool IsPackage(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / "package.xml", error);
}

bool HasName(const fs::path& folder, const std::string& package) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile((folder / "package.xml").c_str()) != tinyxml2::XML_SUCCESS) return false;
  const tinyxml2::XMLElement* root = document.FirstChildElement("package");
  const tinyxml2::XMLElement* name = root ? root->FirstChildElement("name") : nullptr;
  return name && name->GetText() && package == name->GetText();
}

/// The package in `folder` or at most `depth` levels below it. Packages do not nest.
fs::path FindBelow(const fs::path& folder, const std::string& package, int depth) {
  if (IsPackage(folder)) return HasName(folder, package) ? folder : fs::path();
  // Most packages lie in a folder of their own name: this saves reading all of /usr/share.
  if (depth > 0 && IsPackage(folder / package) && HasName(folder / package, package)) {
    return folder / package;
  }
  std::error_code error;
  if (depth == 0) return {};
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (!entry.is_directory(error)) continue;
    const fs::path found = FindBelow(entry.path(), package, depth - 1);
    if (!found.empty()) return found;
  }
  return {};
}

}  // namespace

PackageFinder FindPackagesFrom(const std::string& start) {
  std::vector<fs::path> upwards, entries;
  for (fs::path folder = fs::absolute(start).lexically_normal();; folder = folder.parent_path()) {
    upwards.push_back(folder);
    if (folder == folder.parent_path()) break;
  }
  if (const char* path = std::getenv("ROS_PACKAGE_PATH")) {
    std::istringstream stream(path);
    for (std::string entry; std::getline(stream, entry, ':');) {
      if (!entry.empty()) entries.push_back(entry);
    }
  }
  return [upwards, entries](const std::string& package) -> std::string {
    for (const fs::path& folder : upwards) {
      if (IsPackage(folder) && HasName(folder, package)) return folder.string();
    }
    for (const fs::path& entry : entries) {
      const fs::path found = FindBelow(entry, package, kDepth);
      if (!found.empty()) return found.string();
    }
    return "";
  };
}

}  // namespace cosserat_cable
