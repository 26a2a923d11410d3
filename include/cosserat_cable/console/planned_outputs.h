// What a run reads and what it is going to write, checked before it works: nothing that was read is
// ever written, and a run of minutes does not end with files that it cannot write.
#pragma once

#include <string>
#include <vector>

#include "cosserat_cable/input/problems.h"

namespace cosserat_cable {

class PlannedOutputs {
 public:
  /// A file that is read. Empty paths are ignored here and below.
  void Reads(const std::string& path);
  /// A file to be written, for the option of this name.
  void WritesFile(const std::string& path, const std::string& option);
  /// A folder to be made where there is none, for these files in it.
  void WritesFolder(const std::string& path, const std::string& option,
                    const std::vector<std::string>& files);

  /// Tells every output that is a file of the run's input or another of its outputs, no regular
  /// file (a device, a pipe, a folder), or in a place where nothing can be written.
  void Check(Problems* problems) const;
  /// What is known to be read only once other inputs are: as Reads and the part of Check that
  /// concerns these files, and nothing else.
  void CheckReads(const std::vector<std::string>& files, Problems* problems);

 private:
  struct Output {
    std::string path, option;
    bool is_folder = false;
    bool in_folder = false;  // of an output, which may not be there yet
  };
  /// Whether the output is one of the files, which is told.
  static bool IsRead(const Output& output, const std::vector<std::string>& files,
                     Problems* problems);

  std::vector<std::string> inputs_;
  std::vector<Output> outputs_;
};

}  // namespace cosserat_cable
