#include "fit_memory.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cosserat_cable/console/output_file.h"

namespace cosserat_cable {
namespace {

using nlohmann::json;

/// Fowler, Noll and Vo's hash of all files that a set consists of, by 64 bits.
class Fingerprint {
 public:
  void AddFile(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    for (char byte; file.get(byte);) Add(static_cast<unsigned char>(byte));
    Add(0);
  }
  std::string Text() const {
    char text[20];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash_));
    return text;
  }

 private:
  void Add(unsigned char byte) { hash_ = (hash_ ^ byte) * 1099511628211ULL; }
  std::uint64_t hash_ = 14695981039346656037ULL;
};

std::string FingerprintOf(const MeasurementSet& set) {
  const std::filesystem::path folder(set.folder);
  Fingerprint fingerprint;
  fingerprint.AddFile(folder / "measurement.yaml");
  for (const Experiment& experiment : set.experiments) {
    fingerprint.AddFile(folder / experiment.record.file);
    if (!experiment.load.file.empty()) fingerprint.AddFile(folder / experiment.load.file);
    for (const auto* motion : {&experiment.a.motion, &experiment.b.motion})
      if (*motion) fingerprint.AddFile(folder / (*motion)->file);
  }
  return fingerprint.Text();
}

}  // namespace

FitMemory::FitMemory(const std::string& file, const MeasurementSet& set) : file_(file) {
  if (file_.empty()) return;
  set_ = FingerprintOf(set);
  std::ifstream stream(file_);
  try {
    const json all = json::parse(stream);
    if (all.at("set") != set_) return;
    for (const auto& [key, fit] : all.at("fits").items())
      fits_[key] = {fit.at("at_minimum"), fit.at("values")};
  } catch (const json::exception&) {
    fits_.clear();  // what cannot be read is fitted again
  }
  begun_with_ = static_cast<int>(fits_.size());
}

const FitMemory::Fit* FitMemory::Find(const std::string& key) const {
  const auto found = fits_.find(key);
  return found == fits_.end() ? nullptr : &found->second;
}

void FitMemory::Add(const std::string& key, const FitPoint& point) {
  if (file_.empty()) return;
  Fit& fit = fits_[key];
  fit.at_minimum = point.at_minimum;
  for (std::size_t i = 0; i < point.unknowns.size(); ++i)
    fit.values[point.unknowns[i].name] = point.values[static_cast<Eigen::Index>(i)];
  json all = {{"set", set_}, {"fits", json::object()}};
  for (const auto& [name, one] : fits_)
    all["fits"][name] = {{"at_minimum", one.at_minimum}, {"values", one.values}};
  WriteWhole(file_, all.dump(1) + "\n");
}

void FitMemory::Forget() {
  std::error_code ignored;
  if (!file_.empty()) std::filesystem::remove(file_, ignored);
}

}  // namespace cosserat_cable
