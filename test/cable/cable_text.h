// Cable files as text, and what reading them says.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "cosserat_cable/cable/cable_check.h"
#include "cosserat_cable/cable/cable_model.h"
#include "tools/temporary_file.h"

namespace cosserat_cable {

// Expectations are computed with a pocket calculator to so many digits.
inline constexpr double kSixDigits = 1e-6;  // relative

// A specimen with everything that is required and nothing else, on lines 1 to 8.
inline const char* const kSpecimen =
    "format: 1\n"
    "cable:\n"
    "  length: 0.2\n"
    "  diameter: 0.008\n"
    "  mass_per_length: 0.09\n"
    "  EI: 0.012\n"
    "  GJ: 0.009\n"
    "  eta_EI: 2.0e-4\n";

struct Loaded {
  CableFile file;
  std::string said;  // without the file's own name
};

inline Loaded Load(const std::string& text) {
  const TemporaryFile yaml(text);
  Problems problems;
  Loaded loaded;
  loaded.file = LoadCableFile(yaml.path(), &problems);
  for (const Problem& problem : problems.all()) {
    EXPECT_EQ(problem.file, yaml.path());
    Problem anonymous = problem;
    anonymous.file = "f";
    loaded.said += anonymous.ToString() + "\n";
  }
  return loaded;
}

inline CableModel LoadOne(const std::string& text) {
  const Loaded loaded = Load(text);
  EXPECT_EQ(loaded.said, "");
  EXPECT_EQ(loaded.file.cables.size(), 1u);
  EXPECT_EQ(loaded.file.marks.size(), 1u);
  return loaded.file.cables.empty() ? CableModel() : loaded.file.cables[0];
}

inline std::string Replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

// What is said of the specimen with one line changed.
inline std::string Said(const std::string& what, const std::string& by) {
  return Load(Replaced(kSpecimen, what, by)).said;
}
// What is said of the specimen with lines added, from line 9 on.
inline std::string SaidWith(const std::string& lines) { return Load(kSpecimen + lines).said; }

inline std::string Vehicle(const std::string& cables) {
  return "format: 1\n"
         "types:\n"
         "  hose: {length: 0.2, diameter: 0.008, mass_per_length: 0.09, EI: 0.012, GJ: 0.009, "
         "eta_EI: 2.0e-4}\n"
         "cables:\n" +
         cables;
}
const char* const kClamps =
    "    a: {link: body, pose: [0, 0, 0, 0, 0, 0, 1]}\n"
    "    b: {link: wheel, pose: [0, 0, 0.1, 0, 0, 0, 1]}\n";

// ---- Defaults -----------------------------------------------------------------------------------

}  // namespace cosserat_cable
