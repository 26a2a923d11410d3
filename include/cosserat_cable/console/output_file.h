// A file that is written whole or not at all.
#pragma once

#include <string>

namespace cosserat_cable {

/// Writes the text beside the path and puts it in its place; an older file stays until then.
/// @throws std::runtime_error with path and reason where that is not possible
void WriteWhole(const std::string& path, const std::string& text);

}  // namespace cosserat_cable
