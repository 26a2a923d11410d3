// Any bytes as a mesh: problems, or a body whose distances are numbers.
#include <cmath>

#include "cosserat_cable/contact/body.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cosserat_cable;
  // By what it begins with; assimp asks for the name.
  const std::string start(reinterpret_cast<const char*>(data), std::min<std::size_t>(size, 1));
  const std::filesystem::path path = FuzzFolder() / (start == "<"   ? "mesh.dae"
                                                     : start == "v" ? "mesh.obj"
                                                                    : "mesh.stl");
  WriteFuzzFile(path, data, size);
  Problems problems;
  const TriangleMesh mesh = LoadMesh(path.string(), {1, 1, 1}, &problems);
  RequireTold(problems);
  if (!problems.empty()) return 0;
  Shape shape;
  shape.geometry = mesh;
  const Body body({shape});
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.1, 0.2, 0.3)})
    if (std::isnan(body.Query(p, 1).distance)) abort();
  return 0;
}
