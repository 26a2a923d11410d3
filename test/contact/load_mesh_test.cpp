#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "contact/meshes.h"
#include "cosserat_cable/contact/body.h"

// assimp 5.2 does not free what it has read of a DAE or OBJ that turns out to be broken.
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp"; }

namespace cosserat_cable {
namespace {

// Files hold, and assimp keeps, single precision; coordinates here are below 2 m, or 50 inch.
constexpr double kFloat = 1e-6;
constexpr double kFar = std::numeric_limits<double>::infinity();
const Eigen::Vector3d kNoScale(1, 1, 1);

class LoadMeshTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("load_mesh_test_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string Write(const std::string& name, const std::string& content) {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }

  TriangleMesh Load(const std::string& path, const Eigen::Vector3d& scale = kNoScale) {
    problems_ = Problems();
    return LoadMesh(path, scale, &problems_);
  }

  void ExpectRefused(const std::string& path, const std::string& reason,
                     const Eigen::Vector3d& scale = kNoScale) {
    const TriangleMesh mesh = Load(path, scale);
    EXPECT_TRUE(mesh.triangles.empty());
    ASSERT_EQ(problems_.all().size(), 1u) << path;
    EXPECT_EQ(problems_.all()[0].file, path);
    EXPECT_NE(problems_.all()[0].message.find(reason), std::string::npos)
        << problems_.all()[0].message;
  }

  std::filesystem::path folder_;
  Problems problems_;
};

std::string AsciiStl(const TriangleMesh& mesh) {
  std::ostringstream out;
  out << "solid part\n";
  for (const Eigen::Vector3i& t : mesh.triangles) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (int i : t) out << "vertex " << mesh.vertices[i].transpose() << "\n";
    out << "endloop\nendfacet\n";
  }
  out << "endsolid part\n";
  return out.str();
}

std::string BinaryStl(const TriangleMesh& mesh) {
  std::string out(80, ' ');
  const auto append = [&](const void* data, std::size_t size) {
    out.append(static_cast<const char*>(data), size);
  };
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  append(&count, 4);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    append(normal.data(), 12);
    for (int i : t) {
      const Eigen::Vector3f v = mesh.vertices[i].cast<float>();
      append(v.data(), 12);
    }
    out.append(2, '\0');
  }
  return out;
}

std::string Obj(const TriangleMesh& mesh) {
  std::ostringstream out;
  for (const Eigen::Vector3d& v : mesh.vertices) out << "v " << v.transpose() << "\n";
  for (const Eigen::Vector3i& t : mesh.triangles) {
    out << "f " << (t + Eigen::Vector3i::Ones()).transpose() << "\n";
  }
  return out.str();
}

// One geometry, shown by a node for each of `transforms` (COLLADA elements).
std::string Dae(const TriangleMesh& mesh, const std::string& unit, const std::string& up_axis,
                const std::vector<std::string>& transforms) {
  std::ostringstream out;
  out << R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2020-01-01</created><modified>2020-01-01</modified>
<unit name="unit" meter=")"
      << unit << R"("/>)" << up_axis << R"(</asset>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count=")"
      << 3 * mesh.vertices.size() << "\">";
  for (const Eigen::Vector3d& v : mesh.vertices) out << v.transpose() << " ";
  out << R"(</float_array><technique_common><accessor source="#a" stride="3" count=")"
      << mesh.vertices.size() << R"("><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count=")"
      << mesh.triangles.size() << R"("><input semantic="VERTEX" source="#v" offset="0"/><p>)";
  for (const Eigen::Vector3i& t : mesh.triangles) out << t.transpose() << " ";
  out << R"(</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">)";
  for (std::size_t i = 0; i < transforms.size(); ++i) {
    out << "<node id=\"n" << i << "\">" << transforms[i]
        << R"(<instance_geometry url="#g"/></node>)";
  }
  out << R"(</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
  return out.str();
}

// Same solid: the same signed distances all around it.
void ExpectSame(const TriangleMesh& loaded, const TriangleMesh& expected, double extent) {
  ASSERT_EQ(loaded.triangles.size(), expected.triangles.size());
  EXPECT_EQ(loaded.vertices.size(), expected.vertices.size());
  const Body body = test::MakeBody(loaded);
  test::RandomPoints random(3);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d p = random.InCube(extent);
    const double sign = test::WindingNumber(expected, p) > 0.5 ? -1 : 1;
    const Clearance clearance = body.Query(p, kFar);
    ASSERT_FALSE(clearance.two_sided);
    ASSERT_NEAR(clearance.distance, sign * test::BruteForceDistance(expected, p), kFloat);
  }
}

TEST_F(LoadMeshTest, AllThreeFormatsGiveTheSameSolid) {
  const TriangleMesh mesh = test::SphereMesh(0.7, 6, 9);
  for (const std::string& path :
       {Write("ascii.stl", AsciiStl(mesh)), Write("binary.stl", BinaryStl(mesh)),
        Write("part.obj", Obj(mesh)), Write("part.dae", Dae(mesh, "1", "", {""}))}) {
    SCOPED_TRACE(path);
    const TriangleMesh loaded = Load(path);
    EXPECT_TRUE(problems_.empty()) << problems_.ToString();
    ExpectSame(loaded, mesh, 1.0);
    EXPECT_NEAR(test::WindingNumber(loaded, {0, 0, 0}), 1, kFloat);
  }
}

TEST_F(LoadMeshTest, DaeUnitAndNodeTransformsAreApplied) {
  // In inches; turned by 90 degrees about x and moved by (1, 2, 3) inches; then a second, mirrored
  // copy.
  const TriangleMesh mesh = test::BoxMesh({10, 20, 30});
  const std::string path =
      Write("inch.dae", Dae(mesh, "0.0254", "<up_axis>Z_UP</up_axis>",
                            {"<translate>1 2 3</translate><rotate>1 0 0 90</rotate>",
                             "<translate>50 0 0</translate><scale>-1 1 1</scale>"}));
  const TriangleMesh loaded = Load(path);
  ASSERT_TRUE(problems_.empty()) << problems_.ToString();
  const TriangleMesh first = test::Moved(test::BoxMesh(0.0254 * Eigen::Vector3d(10, 30, 20)),
                                         {0.0254 * Eigen::Vector3d(1, 2, 3), {1, 0, 0, 0}});
  const TriangleMesh second = test::Moved(test::BoxMesh(0.0254 * Eigen::Vector3d(10, 20, 30)),
                                          {0.0254 * Eigen::Vector3d(50, 0, 0), {1, 0, 0, 0}});
  ExpectSame(loaded, test::Joined(first, second), 1.5);
  EXPECT_NEAR(test::WindingNumber(loaded, 0.0254 * Eigen::Vector3d(1, 2, 3)), 1, kFloat);
  EXPECT_NEAR(test::WindingNumber(loaded, 0.0254 * Eigen::Vector3d(50, 0, 0)), 1, kFloat);
}

// As rviz shows it: REP-103 says which way is up, the file does not.
TEST_F(LoadMeshTest, DaeUpAxisTurnsNothing) {
  const TriangleMesh mesh = test::BoxMesh({0.2, 0.4, 0.6});
  for (const char* up :
       {"", "<up_axis>X_UP</up_axis>", "<up_axis>Y_UP</up_axis>", "<up_axis>Z_UP</up_axis>"}) {
    SCOPED_TRACE(up);
    ExpectSame(Load(Write("up.dae", Dae(mesh, "1", up, {""}))), mesh, 0.5);
  }
}

TEST_F(LoadMeshTest, ScaleIsApplied) {
  const TriangleMesh mesh = test::BoxMesh({200, 400, 600});
  const TriangleMesh loaded = Load(Write("mm.stl", BinaryStl(mesh)), {1e-3, 1e-3, -2e-3});
  ExpectSame(loaded, test::BoxMesh({0.2, 0.4, 1.2}), 0.8);
  EXPECT_NEAR(test::WindingNumber(loaded, {0, 0, 0}), 1, kFloat)
      << "a mirrored mesh must be turned";
}

TEST_F(LoadMeshTest, QuadsAndSeveralObjectsOfAnObj) {
  const TriangleMesh loaded = Load(Write("quads.obj",
                                         "o one\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
                                         "o two\nv 2 0 0\nv 3 0 0\nv 2 1 0\nf 5 6 7\nl 1 2\n"));
  EXPECT_TRUE(problems_.empty()) << problems_.ToString();
  EXPECT_EQ(loaded.triangles.size(), 3u);
  EXPECT_EQ(loaded.vertices.size(), 7u);
}

TEST_F(LoadMeshTest, TrianglesWithoutAreaAreDropped) {
  TriangleMesh mesh = test::BoxMesh({0.2, 0.4, 0.6});
  const Eigen::Vector3d a = mesh.vertices[0], b = mesh.vertices[7];
  const int n = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back((a + b) / 2);
  mesh.triangles.push_back({0, 0, 1});
  mesh.triangles.push_back({0, n, 7});  // on one line
  const TriangleMesh loaded = Load(Write("slivers.stl", BinaryStl(mesh)));
  EXPECT_TRUE(problems_.empty());
  ExpectSame(loaded, test::BoxMesh({0.2, 0.4, 0.6}), 0.5);
}

TEST_F(LoadMeshTest, VerticesThatAreNotFiniteAreRefusedInEveryFormat) {
  TriangleMesh mesh = test::BoxMesh({1, 1, 1});
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), kFar, -kFar, 1e39}) {
    mesh.vertices[5].y() = bad;
    ExpectRefused(Write("bad.stl", AsciiStl(mesh)), "not finite");
    ExpectRefused(Write("bad_binary.stl", BinaryStl(mesh)), "not finite");
    ExpectRefused(Write("bad.obj", Obj(mesh)), "not finite");
    ExpectRefused(Write("bad.dae", Dae(mesh, "1", "", {""})), "not finite");
  }
}

TEST_F(LoadMeshTest, FilesWithoutAMeshAreRefused) {
  const std::string good = BinaryStl(test::BoxMesh({1, 1, 1}));
  ExpectRefused((folder_ / "missing.stl").string(), "not found");
  ExpectRefused(folder_.string(), "not found");
  for (const char* name : {"empty.stl", "empty.obj", "empty.dae"}) {
    ExpectRefused(Write(name, ""), "could not be read");
  }
  ExpectRefused(Write("truncated.stl", good.substr(0, good.size() / 2)), "could not be read");
  ExpectRefused(Write("truncated.dae", Dae(test::BoxMesh({1, 1, 1}), "1", "", {""}).substr(0, 700)),
                "could not be read");
  ExpectRefused(Write("text.stl", AsciiStl(test::BoxMesh({1, 1, 1})).replace(60, 3, "abc")),
                "could not be read");
  ExpectRefused(Write("mesh.unknown", "hello"), "could not be read");
  ExpectRefused(Write("lines.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), "could not be read");
  ExpectRefused(Write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), "no triangle");
  ExpectRefused(Write("unit.dae", Dae(test::BoxMesh({1, 1, 1}), "0", "", {""})), "no triangle");
  ExpectRefused(Write("good.stl", good), "scale", {1, 0, 1});
  ExpectRefused(Write("good.stl", good), "scale", {1, kFar, 1});
}

}  // namespace
}  // namespace cosserat_cable
