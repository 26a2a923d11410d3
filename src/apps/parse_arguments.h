// How every tool takes its command line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cosserat_cable/input/number_spec.h"
#include "cosserat_cable/input/number_text.h"

namespace cosserat_cable {

/// A path that was given is not empty: a script's variable that is not set is no request for
/// nothing.
inline CLI::Validator FilledPath() {
  return CLI::Validator(
      [](const std::string& text) {
        return text.empty() ? std::string("got an empty text, expected a path") : std::string();
      },
      "", "path");
}

/// A finite number in the range of `spec`. CLI11's own ranges take nan.
inline CLI::Validator Within(const NumberSpec& spec) {
  return CLI::Validator(
      [spec](const std::string& text) {
        const NumberText number = ParseNumber(text);
        if (number.kind == NumberText::Kind::kFinite && spec.Contains(number.value))
          return std::string();
        return "got " + text + ", expected " + spec.Expected();
      },
      "", "number");
}

/// Parses; false where the program is to end with `code`.
inline bool Parse(CLI::App* app, int argc, char** argv, int* code) {
  // roslaunch appends __name:=... and __log:=... to every program, also to those that need no
  // master.
  std::vector<std::string> arguments;
  for (int i = argc - 1; i > 0; --i) {  // CLI11 takes them in reverse
    const std::string argument = argv[i];
    const bool remapping = argument.rfind("__", 0) == 0 && argument.find(":=") != std::string::npos;
    if (!remapping) arguments.push_back(argument);
  }
  try {
    app->parse(arguments);
    return true;
  } catch (const CLI::ParseError& error) {
    *code = app->exit(error) == 0 ? 0 : 2;
    return false;
  }
}

}  // namespace cosserat_cable
