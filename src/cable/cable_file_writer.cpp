#include <string>

#include "cosserat_cable/cable/cable_model.h"
#include "cosserat_cable/input/number_text.h"
#include "extensions.h"

namespace cosserat_cable {
namespace {

// Always quoted: `null`, `on` or `1` may be the name of a link.
std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

// Links to avoid, as the file may say them.
std::string AvoidList(const CableModel& cable) {
  std::string list;
  for (const std::string& link : cable.avoid) {
    const bool visual = cable.avoid_visual.count(link) > 0;
    list += (list.empty() ? "" : ", ") +
            (visual ? "{link: " + Quoted(link) + ", use_visual: true}" : Quoted(link));
  }
  return "[" + list + "]";
}

std::string QuotedList(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + Quoted(text);
  return "[" + list + "]";
}

// The keys of one cable, each line behind `indent`.
class CableWriter {
 public:
  explicit CableWriter(std::string indent) : indent_(std::move(indent)) {}

  void Line(const std::string& key, const std::string& value) {
    text_ += indent_ + key + ": " + value + "\n";
  }
  void Number(const std::string& key, double value) { Line(key, FormatNumber(value)); }
  // One key where both directions agree, else two.
  void Pair(const std::string& key, double first, double second) {
    if (first == second) return Number(key, first);
    Number(key + "1", first);
    Number(key + "2", second);
  }
  void Clamp(const std::string& key, const ClampModel& clamp) {
    std::string pose;
    for (const double x : {clamp.X_LC.p.x(), clamp.X_LC.p.y(), clamp.X_LC.p.z(), clamp.X_LC.q.x(),
                           clamp.X_LC.q.y(), clamp.X_LC.q.z(), clamp.X_LC.q.w()}) {
      pose += (pose.empty() ? "" : ", ") + FormatNumber(x);
    }
    Line(key, "{link: " + Quoted(clamp.link) + ", pose: [" + pose + "]}");
  }
  void Masses(const std::vector<LumpedMass>& masses) {
    std::string list;
    for (const LumpedMass& mass : masses) {
      list += (list.empty() ? "{s: " : ", {s: ") + FormatNumber(mass.s) +
              ", mass: " + FormatNumber(mass.mass) + "}";
    }
    Line("masses", "[" + list + "]");
  }
  void Extensions(const std::vector<CableExtension>& extensions) {
    if (extensions.empty()) return Line("extensions", "{}");
    text_ += indent_ + "extensions:\n";
    for (const CableExtension& extension : extensions)
      Line("  " + extension.name, WriteExtension(extension));
  }

  const std::string& text() const { return text_; }

 private:
  std::string indent_, text_;
};

std::string WriteCable(const CableModel& cable, const std::string& indent) {
  CableWriter out(indent);
  out.Line("name", Quoted(cable.name));
  if (!cable.reference.empty()) out.Line("reference", Quoted(cable.reference));
  if (!cable.a.link.empty()) {
    out.Clamp("a", cable.a);
    out.Clamp("b", cable.b);
  }
  out.Number("length", cable.length);
  if (cable.flat()) {
    out.Number("width", cable.width);
    out.Number("height", cable.height);
  } else {
    out.Number("diameter", cable.diameter);
  }
  out.Number("mass_per_length", cable.mass_per_length);
  out.Pair("EI", cable.EI1, cable.EI2);
  out.Number("GJ", cable.GJ);
  out.Number("EA", cable.EA);
  out.Pair("GA", cable.GA1, cable.GA2);
  out.Pair("eta_EI", cable.eta_EI1, cable.eta_EI2);
  out.Number("eta_GJ", cable.eta_GJ);
  out.Number("eta_EA", cable.eta_EA);
  out.Pair("eta_GA", cable.eta_GA1, cable.eta_GA2);
  out.Masses(cable.masses);
  out.Line("uncertain", QuotedList(cable.uncertain));
  out.Line("apex", "{s: " + FormatNumber(cable.apex_s) + "}");
  out.Line("elements", std::to_string(cable.elements));
  out.Line("avoid", AvoidList(cable));
  out.Line("contact", "{stiffness: " + FormatNumber(cable.contact.stiffness) +
                          ", smoothing: " + FormatNumber(cable.contact.smoothing) +
                          ", damping: " + FormatNumber(cable.contact.damping) + "}");
  out.Extensions(cable.extensions);
  return out.text();
}

}  // namespace

std::string WriteCableFile(const CableFile& file) {
  std::string text = "format: 1\n";
  if (file.specimen) {
    for (const CableModel& cable : file.cables) text += "cable:\n" + WriteCable(cable, "  ");
    return text;
  }
  text += "cables:\n";
  for (const CableModel& cable : file.cables) {
    // The list's dash takes the place of the first line's indent.
    text += "  - " + WriteCable(cable, "    ").substr(4);
  }
  return text;
}

}  // namespace cosserat_cable
