#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

#include "cosserat_cable/input/number_text.h"
#include "cosserat_cable/measurement/measurement_set.h"
#include "csv_writer.h"
#include "fault_reader.h"

namespace cosserat_cable {
namespace {

namespace fs = std::filesystem;

std::string Quoted(const std::string& text) {
  std::string quoted;
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c == '\n' ? "\\n" : c == '\r' ? "\\r" : c == '\t' ? "\\t" : std::string(1, c);
  }
  return '"' + quoted + '"';
}

std::string List(std::initializer_list<double> numbers) {
  std::string list;
  for (const double x : numbers) list += (list.empty() ? "" : ", ") + FormatNumber(x);
  return "[" + list + "]";
}
std::string List(const Eigen::Vector3d& v) { return List({v.x(), v.y(), v.z()}); }
std::string List(const Pose& pose) {
  return List({pose.p.x(), pose.p.y(), pose.p.z(), pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w()});
}

const char* FirstColumn(bool quasi_static) { return quasi_static ? "step" : "t"; }

// The files of a set, by name, before any is written.
class Files {
 public:
  // Returns the name.
  const std::string& Add(const std::string& name, const std::string& text) {
    const fs::path plain = fs::path(name).lexically_normal();
    if (fs::path(name).is_absolute() || *plain.begin() == "..")
      throw std::runtime_error(name + ": lies outside the set's folder");
    const auto inserted = texts_.emplace(name, text);
    if (!inserted.second && inserted.first->second != text)
      throw std::runtime_error(name + ": two files of the set have this name");
    return inserted.first->first;
  }

  void Write(const fs::path& folder) const {
    for (const auto& [name, text] : texts_) {
      const fs::path path = folder / name;
      fs::create_directories(path.parent_path());
      errno = 0;
      std::ofstream out(path, std::ios::binary);
      out << text;
      out.close();
      if (!out) throw std::runtime_error(path.string() + ": " + std::strerror(errno));
    }
  }

 private:
  std::map<std::string, std::string> texts_;
};

std::string RecordText(const Experiment& experiment) {
  const Record& record = experiment.record;
  std::vector<std::string> columns = {FirstColumn(record.quasi_static)};
  for (const Channel& channel : experiment.channels) columns.push_back(channel.column);
  CsvText csv(columns);
  for (std::size_t i = 0; i < record.t.size(); ++i) {
    csv.Add(record.t[i]);
    for (Eigen::Index k = 0; k < record.values.cols(); ++k)
      csv.Add(record.values(static_cast<Eigen::Index>(i), k));
  }
  return csv.text();
}

std::string MotionText(const ClampMotion& motion) {
  CsvText csv({FirstColumn(motion.quasi_static), "x", "y", "z", "qx", "qy", "qz", "qw"});
  for (std::size_t i = 0; i < motion.t.size(); ++i) {
    const Pose& pose = motion.poses[i];
    csv.Add(motion.t[i]);
    for (int k = 0; k < 3; ++k) csv.Add(pose.p[k]);
    for (int k = 0; k < 4; ++k) csv.Add(pose.q.coeffs()[k]);  // x, y, z, w
  }
  return csv.text();
}

std::string LoadText(const ExperimentLoad& load) {
  CsvText csv({FirstColumn(load.quasi_static), "s", "fx", "fy", "fz"});
  for (const ExperimentLoad::Sample& sample : load.samples) {
    csv.Add(sample.t);
    csv.Add(sample.s);
    for (int k = 0; k < 3; ++k) csv.Add(sample.force_W[k]);
  }
  return csv.text();
}

std::string FreeComponents(const EndCondition& end) {
  std::string list;
  for (int i = 0; i < 6; ++i) {
    const auto axis = static_cast<std::size_t>(i % 3);
    if (!(i < 3 ? end.translation_free : end.rotation_free)[axis]) continue;
    list += std::string(list.empty() ? "" : ", ") + (i < 3 ? "t" : "r") + "xyz"[axis];
  }
  return list.empty() ? "" : ", free: [" + list + "]";
}

std::string EndText(const EndCondition& end, const std::string& default_file, Files* files) {
  if (end.kind == EndCondition::Kind::kFree) return "free";
  if (end.kind == EndCondition::Kind::kDisc) {
    return "{disc: {inertia: " + FormatNumber(end.disc.inertia) +
           ", mass: " + FormatNumber(end.disc.mass) + (end.disc.guided ? ", guided: true" : "") +
           "}}";
  }
  std::string text = "{pose: " + List(end.pose);
  if (end.motion) {
    const std::string& name = end.motion->file.empty() ? default_file : end.motion->file;
    text = "{motion: " + Quoted(files->Add(name, MotionText(*end.motion)));
  }
  return text + FreeComponents(end) + (end.roll_unknown ? ", roll: unknown" : "") + "}";
}

std::string PointText(const PointAt& point) {
  return "{s: " + FormatNumber(point.s) + ", position: " + List(point.position_W) + "}";
}

std::string StartText(const StartCondition& start) {
  switch (start.kind) {
    case StartCondition::Kind::kRest:
      return "{rest: true" + (start.near ? ", near: " + PointText(*start.near) : "") + "}";
    case StartCondition::Kind::kHeld:
      return "{held: " + PointText(start.held) + "}";
    case StartCondition::Kind::kTwisted:
      return "{twisted: " + FormatNumber(start.twisted) + "}";
    case StartCondition::Kind::kUnknown:
      break;
  }
  return "{unknown: true}";
}

std::string ChannelText(const Channel& channel) {
  std::string text =
      "{column: " + Quoted(channel.column) + ", quantity: " + ToString(channel.quantity);
  const bool at_clamp =
      channel.quantity == Quantity::kForce || channel.quantity == Quantity::kMoment;
  const bool about_axis =
      channel.quantity == Quantity::kAngle || channel.quantity == Quantity::kRate;
  text += at_clamp ? std::string(", clamp: ") + (channel.clamp == ClampSide::kA ? "a" : "b")
                   : ", s: " + FormatNumber(channel.s);
  if (!about_axis) text += std::string(", axis: ") + "xyz"[channel.axis];
  if (channel.in_frame_a) text += ", frame: a";
  if (channel.sigma) text += ", sigma: " + FormatNumber(*channel.sigma);
  if (channel.unknown_offset) text += ", offset: unknown";
  return text + "}";
}

std::string ConstantLoads(const ExperimentLoad& load) {
  std::string list;
  for (const ExperimentLoad::Sample& sample : load.samples) {
    list += (list.empty() ? "{s: " : ", {s: ") + FormatNumber(sample.s) +
            ", force: " + List(sample.force_W) + "}";
  }
  return "[" + list + "]";
}

std::string ExperimentText(const Experiment& experiment, Files* files) {
  const std::string& name = experiment.name;
  const std::string indent = "    ";
  std::string text = "  - name: " + Quoted(name) + "\n";
  const auto line = [&](const std::string& key, const std::string& value) {
    text += indent + key + ": " + value + "\n";
  };
  if (!experiment.kind.empty()) line("kind", Quoted(experiment.kind));
  const std::string specimen = WriteCableKeys(experiment.specimen, indent + "  ");
  if (!specimen.empty()) text += indent + "specimen:\n" + specimen;
  text += WriteFaults(experiment.specimen.faults, indent);
  line("gravity", List(experiment.gravity_W));
  line("a", EndText(experiment.a, name + "_a.csv", files));
  line("b", EndText(experiment.b, name + "_b.csv", files));
  line("start", StartText(experiment.start));
  if (!experiment.load.file.empty()) {
    line("load", Quoted(files->Add(experiment.load.file, LoadText(experiment.load))));
  } else if (!experiment.load.samples.empty()) {
    line("load", ConstantLoads(experiment.load));
  }
  const Record& record = experiment.record;
  const std::string& file = record.file.empty() ? name + ".csv" : record.file;
  line("record", Quoted(files->Add(file, RecordText(experiment))));
  text += indent + "channels:\n";
  for (const Channel& channel : experiment.channels)
    text += indent + "  - " + ChannelText(channel) + "\n";
  return text;
}

}  // namespace

void WriteMeasurementSet(const MeasurementSet& set, const std::string& folder) {
  Files files;
  std::string text = "format: 1\ncable:\n" + WriteCableKeys(set.cable, "  ") +
                     WriteFaults(set.cable.faults, "") + "experiments:\n";
  for (const Experiment& experiment : set.experiments) text += ExperimentText(experiment, &files);
  files.Add("measurement.yaml", text);
  files.Write(folder);
}

}  // namespace cosserat_cable
