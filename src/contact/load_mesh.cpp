#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <limits>

#include "collada_check.h"
#include "cosserat_cable/contact/shape.h"
#include "cosserat_cable/input/text_file.h"
#include "mesh_cleanup.h"

namespace cosserat_cable {
namespace {

// Ten million triangles of a binary STL; assimp reads a file whole [bytes].
constexpr std::uintmax_t kMostOfMesh = 512 * 1024 * 1024;

Eigen::Affine3d ToEigen(const aiMatrix4x4& m) {
  Eigen::Affine3d result;
  for (unsigned row = 0; row < 3; ++row) {
    for (unsigned column = 0; column < 4; ++column) result(row, column) = m[row][column];
  }
  return result;
}

// In double precision from the root down, so that parts that meet in the file still meet.
void Append(const aiScene& scene, const aiNode& node, const Eigen::Affine3d& parent,
            TriangleMesh* mesh) {
  const Eigen::Affine3d transform = parent * ToEigen(node.mTransformation);
  const bool mirrored = transform.linear().determinant() < 0;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[i]];
    const int first = static_cast<int>(mesh->vertices.size());
    for (unsigned j = 0; j < part.mNumVertices; ++j) {
      const aiVector3D& v = part.mVertices[j];
      mesh->vertices.push_back(transform * Eigen::Vector3d(v.x, v.y, v.z));
    }
    for (unsigned j = 0; j < part.mNumFaces; ++j) {
      const aiFace& face = part.mFaces[j];
      if (face.mNumIndices != 3) continue;  // lines and points have no surface
      Eigen::Vector3i t(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
      if (mirrored) std::swap(t[1], t[2]);
      mesh->triangles.push_back(t + Eigen::Vector3i::Constant(first));
    }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    Append(scene, *node.mChildren[i], transform, mesh);
}

int CountNonFinite(const TriangleMesh& mesh) {
  int count = 0;
  for (const Eigen::Vector3d& v : mesh.vertices) count += v.allFinite() ? 0 : 1;
  return count;
}

}  // namespace

TriangleMesh LoadMesh(const std::string& path, const Eigen::Vector3d& scale, Problems* problems) {
  if (!scale.allFinite() || (scale.array() == 0).any()) {
    problems->Add(path, "mesh scale: got a component that is zero or not finite");
    return {};
  }
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    problems->Add(path, "mesh file not found");
    return {};
  }
  if (std::filesystem::file_size(path, error) > kMostOfMesh) {
    problems->Add(path,
                  "mesh file has more than " + std::to_string(kMostOfMesh) + " bytes: simplify it");
    return {};
  }
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".dae") {
    const std::string trouble = ColladaProblem(ReadTextFile(path, kMostOfMesh).text);
    if (!trouble.empty()) {
      problems->Add(path, "mesh could not be read: " + trouble);
      return {};
    }
  }
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  // rviz 1.14 keeps the root's scale, which is DAE's unit, and drops its rotation, which is
  // DAE's up_axis turned to assimp's; what the cable touches must be what is seen.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate | aiProcess_SortByPType);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    problems->Add(path, std::string("mesh could not be read: ") + importer.GetErrorString());
    return {};
  }

  TriangleMesh mesh;
  Append(*scene, *scene->mRootNode, Eigen::Affine3d(Eigen::Scaling(scale)), &mesh);
  const int non_finite = CountNonFinite(mesh);
  if (non_finite > 0) {
    problems->Add(path, "mesh has " + std::to_string(non_finite) +
                            " vertices that are not finite (nan, inf, or beyond 3.4e38)");
    return {};
  }
  mesh = CleanMesh(mesh);
  if (mesh.triangles.empty()) problems->Add(path, "mesh has no triangle with an area");
  return mesh;
}

}  // namespace cosserat_cable
