// urdfdom behind one call that says its errors instead of printing them.
#pragma once

#include <tinyxml2.h>
#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <string>

#include "cosserat_cable/input/problems.h"

namespace cosserat_cable {

/// The model that urdfdom makes of a document, or null with at least one problem. Adds <limit> to
/// joints that lack it: urdfdom insists on limits, which nothing here uses. Not for several threads
/// at once: urdfdom's messages go through one global handler. `complaints`: what it said although
/// it made a model, from which the rest of a link may then be missing.
urdf::ModelInterfaceSharedPtr ParseUrdf(tinyxml2::XMLDocument* document, const std::string& path,
                                        Problems* problems, Problems* complaints);

}  // namespace cosserat_cable
