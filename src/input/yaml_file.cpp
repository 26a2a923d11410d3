#include <yaml-cpp/eventhandler.h>

#include <cctype>
#include <sstream>
#include <vector>

#include "cosserat_cable/input/text_file.h"
#include "cosserat_cable/input/yaml_value.h"

namespace cosserat_cable {
namespace {

bool IsOfName(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
}

/// A name with an index, "extensions.maxwell[0].tau", that stands within { } or [ ] without quotes:
/// YAML takes its bracket for a list there.
struct BareName {
  int line = 0;  ///< 0: there is none
  std::string name;
};

BareName FindBareName(const std::string& text) {
  int line = 1, depth = 0;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i], before = i > 0 ? text[i - 1] : '\n';
    if (c == '\n') ++line;
    if (quote) {
      if (c == quote) quote = 0;
    } else if ((c == '"' || c == '\'') && !IsOfName(before)) {
      quote = c;
    } else if (c == '#' && std::isspace(static_cast<unsigned char>(before))) {
      while (i + 1 < text.size() && text[i + 1] != '\n') ++i;
    } else if (c == '[' && IsOfName(before)) {
      std::size_t begin = i, end = i + 1;
      while (begin > 0 && IsOfName(text[begin - 1])) --begin;
      while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end]))) ++end;
      const bool index = end > i + 1 && end < text.size() && text[end] == ']';
      if (index && depth > 0) {
        while (end + 1 < text.size() && (IsOfName(text[end + 1]) || text[end + 1] == '[' ||
                                         (text[end + 1] == ']' && text[end] != ']')))
          ++end;
        return {line, text.substr(begin, end + 1 - begin)};
      }
      if (index) i = end;
    } else if (c == '{' || c == '[') {
      ++depth;
    } else if ((c == '}' || c == ']') && depth > 0) {
      --depth;
    }
  }
  return {};
}

/// Where the contents of documents begin, and nothing of what they are.
class DocumentStarts : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override { begins_ = true; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { Take(mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { Take(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string&) override {
    Take(mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    Take(mark);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    Take(mark);
  }
  void OnMapEnd() override {}
  const std::vector<YAML::Mark>& starts() const { return starts_; }

 private:
  void Take(const YAML::Mark& mark) {
    if (begins_) starts_.push_back(mark);
    begins_ = false;
  }

  std::vector<YAML::Mark> starts_;
  bool begins_ = false;
};

/// Whether a line begins with what stands between documents.
bool HasSeparator(const std::string& text) {
  return text.find("\n---") != std::string::npos || text.find("\n...") != std::string::npos;
}

/// Where the first two documents begin. yaml-cpp's LoadAll never comes to an end where a bracket is
/// closed that nothing opened: each try to go on makes another document of nothing.
std::vector<YAML::Mark> FirstDocuments(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentStarts documents;
  if (parser.HandleNextDocument(documents)) parser.HandleNextDocument(documents);
  return documents.starts();
}

}  // namespace

YamlValue LoadYamlFile(const std::string& path, Problems* problems) {
  const TextFile file = ReadTextFile(path, kMostOfYaml);
  if (!file.ok) {
    problems->Add(path, file.is.empty() ? "cannot be read: " + file.why
                                        : "got " + file.is + ", expected a YAML file");
    return {};
  }
  const std::string& text = file.text;
  try {
    const std::vector<YAML::Mark> documents = FirstDocuments(text);
    if (documents.empty()) {
      problems->Add(path, 1, "", "got an empty file, expected a YAML document");
      return {};
    }
    if (documents.size() > 1) {
      problems->Add(path, documents[1].line + 1, "",
                    HasSeparator(text) ? "got a second YAML document, expected one in the file"
                                       : "malformed YAML: this belongs to nothing before it");
      return {};
    }
    return YamlValue::Root(path, YAML::Load(text), problems);
  } catch (const YAML::Exception& error) {
    if (const BareName bare = FindBareName(text); bare.line > 0) {
      problems->Add(path, bare.line, bare.name,
                    "malformed YAML: " + error.msg +
                        ": within { } and [ ] a name with brackets stands in quotes: '" +
                        bare.name + "'");
      return {};
    }
    problems->Add(path, error.mark.is_null() ? 0 : error.mark.line + 1, "",
                  "malformed YAML: " + error.msg);
    return {};
  }
}

}  // namespace cosserat_cable
