#include "cosserat_cable/console/planned_outputs.h"

#include <unistd.h>

#include <filesystem>
#include <system_error>

namespace cosserat_cable {
namespace {

namespace fs = std::filesystem;

// Files are written beside their place, under this name, and renamed.
constexpr const char* kBeside = ".active";

bool AreOne(const std::string& a, const std::string& b) {
  std::error_code none;
  if (fs::equivalent(a, b, none)) return true;
  return fs::absolute(a, none).lexically_normal() == fs::absolute(b, none).lexically_normal();
}

/// The folder that a path is to be made in, or the nearest above it that is there.
fs::path NearestFolder(const fs::path& path) {
  std::error_code none;
  fs::path folder = fs::absolute(path, none).parent_path();
  while (!fs::exists(folder, none) && folder != folder.parent_path()) folder = folder.parent_path();
  return folder;
}

/// Why nothing can be written in the folder; empty where it can.
std::string WhyNotIn(const fs::path& folder) {
  std::error_code none;
  const std::string name = "the folder '" + folder.string() + "'";
  if (!fs::exists(folder, none)) return name + " does not exist";
  if (!fs::is_directory(folder, none)) return "'" + folder.string() + "' is no folder";
  if (access(folder.c_str(), W_OK | X_OK) != 0) return name + " is not writable";
  return "";
}

}  // namespace

void PlannedOutputs::Reads(const std::string& path) {
  if (!path.empty()) inputs_.push_back(path);
}

void PlannedOutputs::WritesFile(const std::string& path, const std::string& option) {
  if (!path.empty()) outputs_.push_back({path, option});
}

void PlannedOutputs::WritesFolder(const std::string& path, const std::string& option,
                                  const std::vector<std::string>& files) {
  if (path.empty()) return;
  outputs_.push_back({path, option, true});
  for (const std::string& file : files)
    outputs_.push_back({(fs::path(path) / file).string(), option, false, true});
}

bool PlannedOutputs::IsRead(const Output& output, const std::vector<std::string>& files,
                            Problems* problems) {
  for (const std::string& input : files) {
    if (!AreOne(output.path, input) && !AreOne(output.path + kBeside, input)) continue;
    problems->Add(output.path, 0, output.option,
                  "'" + input + "' is read by this run and would be lost: write elsewhere");
    return true;
  }
  return false;
}

void PlannedOutputs::CheckReads(const std::vector<std::string>& files, Problems* problems) {
  for (const Output& output : outputs_)
    if (!output.is_folder) IsRead(output, files, problems);
  inputs_.insert(inputs_.end(), files.begin(), files.end());
}

void PlannedOutputs::Check(Problems* problems) const {
  std::error_code none;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const Output& output = outputs_[i];
    const auto tell = [&](const std::string& what) {
      problems->Add(output.path, 0, output.option, what);
    };
    const bool is_there = fs::exists(output.path, none);
    if (output.is_folder) {
      if (is_there && !fs::is_directory(output.path, none)) {
        tell("got a file, expected a folder");
      } else {
        const fs::path folder = is_there ? fs::path(output.path) : NearestFolder(output.path);
        if (const std::string why = WhyNotIn(folder); !why.empty()) tell(why);
      }
      continue;
    }
    if (is_there && fs::is_directory(output.path, none)) {
      tell("got a folder, expected a file");
      continue;
    }
    if (is_there && !fs::is_regular_file(output.path, none)) {
      tell("got a device or pipe, expected a file, which is put in place whole");
      continue;
    }
    IsRead(output, inputs_, problems);
    for (std::size_t k = 0; k < i; ++k)
      if (AreOne(output.path, outputs_[k].path) ||
          AreOne(output.path + kBeside, outputs_[k].path) ||
          AreOne(output.path, outputs_[k].path + kBeside)) {
        tell("is what --" + outputs_[k].option + " writes, too");
        break;
      }
    if (output.in_folder) continue;
    const fs::path parent = fs::path(output.path).parent_path();
    if (const std::string why = WhyNotIn(parent.empty() ? "." : parent); !why.empty()) tell(why);
  }
}

}  // namespace cosserat_cable
