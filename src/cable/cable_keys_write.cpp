#include "cosserat_cable/cable/cable_keys.h"
#include "cosserat_cable/input/number_text.h"
#include "extensions.h"

namespace cosserat_cable {
namespace {

std::string Text(double value) { return FormatNumber(value); }
std::string Text(int value) { return std::to_string(value); }
std::string Text(const DampingKey& damping) {
  switch (damping.kind) {
    case DampingKey::Kind::kCritical:
      return "critical";
    case DampingKey::Kind::kUnknown:
      return "null";
    case DampingKey::Kind::kNumber:
      break;
  }
  return FormatNumber(damping.value);
}

class KeyWriter {
 public:
  explicit KeyWriter(std::string indent) : indent_(std::move(indent)) {}

  template <typename T>
  void Key(const std::string& name, const CableKey<T>& key) {
    if (key.value) Line(name, Text(*key.value));
  }
  template <typename T>
  void Key(const std::string& name, const CableKey<std::array<T, 2>>& key) {
    if (!key.value) return;
    const std::string first = Text((*key.value)[0]), second = Text((*key.value)[1]);
    if (first == second) return Line(name, first);
    Line(name + "1", first);
    Line(name + "2", second);
  }
  // One entry behind the other in brackets.
  template <typename T, typename Show>
  void List(const std::string& name, const CableKey<std::vector<T>>& key, const Show& show) {
    if (!key.value) return;
    std::string list;
    for (const T& item : *key.value) list += (list.empty() ? "" : ", ") + show(item);
    Line(name, "[" + list + "]");
  }
  void Extensions(const CableKey<std::vector<ExtensionKey>>& key) {
    if (!key.value) return;
    if (key.value->empty()) return Line("extensions", "{}");
    text_ += indent_ + "extensions:\n";
    for (const ExtensionKey& entry : *key.value)
      Line("  " + entry.extension.name, WriteExtension(entry.extension));
  }

  const std::string& text() const { return text_; }

 private:
  void Line(const std::string& name, const std::string& value) {
    text_ += indent_ + name + ": " + value + "\n";
  }

  std::string indent_, text_;
};

// Always quoted: `null` or `on` may be the name of a link.
std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::string WriteCableKeys(const CableKeys& keys, const std::string& indent) {
  KeyWriter out(indent);
  out.Key("length", keys.length);
  out.Key("diameter", keys.diameter);
  out.Key("width", keys.width);
  out.Key("height", keys.height);
  out.Key("mass_per_length", keys.mass_per_length);
  out.Key("EI", keys.EI);
  out.Key("GJ", keys.GJ);
  out.Key("EA", keys.EA);
  out.Key("GA", keys.GA);
  out.Key("eta_EI", keys.eta_EI);
  out.Key("eta_GJ", keys.eta_GJ);
  out.Key("eta_EA", keys.eta_EA);
  out.Key("eta_GA", keys.eta_GA);
  out.List("masses", keys.masses, [](const LumpedMassKey& key) {
    return "{s: " + FormatNumber(key.mass.s) + ", mass: " + FormatNumber(key.mass.mass) + "}";
  });
  out.List("uncertain", keys.uncertain, [](const UncertainKey& key) { return Quoted(key.name); });
  out.Key("elements", keys.elements);
  out.Extensions(keys.extensions);
  return out.text();
}

}  // namespace cosserat_cable
