#include "cosserat_cable/input/yaml_value.h"

#include <gtest/gtest.h>

#include <random>
#include <tuple>

#include "cosserat_cable/input/map_reader.h"
#include "cosserat_cable/input/number_text.h"
#include "tools/temporary_file.h"

namespace cosserat_cable {
namespace {

// A document in memory, named "f".
class Document {
 public:
  explicit Document(const std::string& text)
      : root_(YamlValue::Root("f", YAML::Load(text), &problems_)) {}
  const YamlValue& root() const { return root_; }
  YamlValue operator[](const std::string& key) {
    MapReader map(root_);
    map.Entries();  // the other keys are another test's
    return map.Required(key);
  }
  std::string said() const { return problems_.ToString(); }

 private:
  Problems problems_;
  YamlValue root_;
};

const NumberSpec kMetres = NumberSpec::Above(0, "m").AtMost(20).Hint("is it in mm?");

std::string SaidOfLength(const std::string& text) {
  Document document("x: 1\nlength: " + text);
  EXPECT_FALSE(document["length"].Number(kMetres).has_value()) << text;
  return document.said();
}

TEST(YamlValue, ReadsNumbers) {
  Document document("a: 1e-3\nb: .5\nc: 20");
  EXPECT_EQ(document["a"].Number(kMetres), 1e-3);
  EXPECT_EQ(document["b"].Number(kMetres), 0.5);
  EXPECT_EQ(document["c"].Number(kMetres), 20);
  EXPECT_EQ(document.said(), "");
}

TEST(YamlValue, SaysWhyANumberIsWrong) {
  const std::string expected = ", expected a number in (0, 20] [m]";
  EXPECT_EQ(SaidOfLength("200"), "f:2: length: got 200" + expected + ": is it in mm?\n");
  EXPECT_EQ(SaidOfLength("-1"), "f:2: length: got -1" + expected + "\n");
  EXPECT_EQ(SaidOfLength("nan"), "f:2: length: got nan" + expected + "\n");
  EXPECT_EQ(SaidOfLength(".NaN"), "f:2: length: got .NaN" + expected + "\n");
  EXPECT_EQ(SaidOfLength("inf"), "f:2: length: got inf" + expected + "\n");
  EXPECT_EQ(SaidOfLength("1e999"), "f:2: length: got 1e999" + expected + "\n");
  EXPECT_EQ(SaidOfLength("long"), "f:2: length: got 'long'" + expected + "\n");
  EXPECT_EQ(SaidOfLength("'0.2'"), "f:2: length: got '0.2'" + expected + "\n");
  EXPECT_EQ(SaidOfLength("200 mm"), "f:2: length: got '200 mm'" + expected + "\n");
  EXPECT_EQ(SaidOfLength("0,2"), "f:2: length: got '0,2'" + expected + "\n");
  EXPECT_EQ(SaidOfLength("[1, 2]"), "f:2: length: got a list of 2" + expected + "\n");
  EXPECT_EQ(SaidOfLength("{a: 1}"), "f:2: length: got a map" + expected + "\n");
  EXPECT_EQ(SaidOfLength(""), "f:2: length: got nothing" + expected + "\n");
  EXPECT_EQ(SaidOfLength("~"), "f:2: length: got nothing" + expected + "\n");
}

TEST(YamlValue, MissingKeysAreReportedAtTheMapWithWhatWasExpected) {
  Document document("a: 1");
  MapReader map(document.root());
  map.Entries();
  EXPECT_FALSE(map.Required("length").Number(kMetres).has_value());
  EXPECT_FALSE(map.Optional("width").Number(kMetres).has_value());
  EXPECT_EQ(document.said(), "f:1: length: missing, expected a number in (0, 20] [m]\n");
}

TEST(YamlValue, ReadsWholeNumbers) {
  Document document("a: 40\nb: 40.5\nc: 3\nd: many\ne: 1e99");
  EXPECT_EQ(document["a"].Integer(4, 1000), 40);
  for (const char* key : {"b", "c", "d", "e"}) {
    EXPECT_FALSE(document[key].Integer(4, 1000).has_value()) << key;
  }
  EXPECT_EQ(document.said(),
            "f:2: b: got 40.5, expected a whole number in [4, 1000]\n"
            "f:3: c: got 3, expected a whole number in [4, 1000]\n"
            "f:4: d: got 'many', expected a whole number in [4, 1000]\n"
            "f:5: e: got 1e99, expected a whole number in [4, 1000]\n");
}

TEST(YamlValue, ReadsFlagsTextsNamesAndWords) {
  Document document(
      "a: true\nb: yes\nc: base_link\nd: ''\ne: brake hose\nf: 2fast\ng: ringdwon\nh: hm");
  EXPECT_EQ(document["a"].Flag(), true);
  EXPECT_FALSE(document["b"].Flag().has_value());
  EXPECT_EQ(document["c"].Text(), "base_link");
  EXPECT_EQ(document["c"].Name(), "base_link");
  EXPECT_FALSE(document["d"].Text("a link").has_value());
  EXPECT_FALSE(document["e"].Name().has_value());
  EXPECT_FALSE(document["f"].Name().has_value());
  EXPECT_FALSE(document["g"].OneOf({"ringdown", "sweep"}).has_value());
  EXPECT_FALSE(document["h"].OneOf({"ringdown", "sweep"}).has_value());
  const std::string name =
      "expected a name of letters, digits and underscores that starts with a letter\n";
  EXPECT_EQ(
      document.said(),
      "f:2: b: got 'yes', expected true or false\n"
      "f:4: d: got '', expected a link\n"
      "f:5: e: got 'brake hose', " +
          name + "f:6: f: got '2fast', " + name +
          "f:7: g: got 'ringdwon', expected one of ringdown, sweep: did you mean 'ringdown'?\n"
          "f:8: h: got 'hm', expected one of ringdown, sweep\n");
}

TEST(YamlValue, ReadsVectors) {
  Document document("a: [1, 2.5, -3]\nb: [1, 2]\nc: [1,\n  nan, 3]\nd: 7");
  const NumberSpec any = NumberSpec::Any("N");
  EXPECT_EQ(document["a"].Vector3(any).value(), Eigen::Vector3d(1, 2.5, -3));
  for (const char* key : {"b", "c", "d"}) EXPECT_FALSE(document[key].Vector3(any).has_value());
  EXPECT_EQ(document.said(),
            "f:2: b: got a list of 2, expected a list of 3 numbers\n"
            "f:4: c[1]: got nan, expected a finite number [N]\n"
            "f:5: d: got 7, expected a list of 3 numbers\n");
}

TEST(YamlValue, ReadsPosesAndNormalisesTheirRotation) {
  Document document("a: [1, 2, 3, 0.38268, 0, 0, 0.92388]");
  const Pose pose = document["a"].PoseOf().value();
  EXPECT_EQ(pose.p, Eigen::Vector3d(1, 2, 3));
  constexpr double kRounding = 1e-15;  // a few ulps of 1
  EXPECT_NEAR(pose.q.norm(), 1, kRounding);
  constexpr double kFiveDigits = 1e-5;  // as many as the text has
  EXPECT_NEAR(2 * std::atan2(pose.q.x(), pose.q.w()), M_PI / 4, kFiveDigits);
  EXPECT_EQ(document.said(), "");
}

TEST(YamlValue, KeepsTheBitsOfANormalisedRotation) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {
    Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
    q.normalize();
    Document document("a: [0, 0, 0, " + FormatNumber(q.x()) + ", " + FormatNumber(q.y()) + ", " +
                      FormatNumber(q.z()) + ", " + FormatNumber(q.w()) + "]");
    EXPECT_EQ(document["a"].PoseOf().value().q.coeffs(), q.coeffs());
  }
}

TEST(YamlValue, SaysWhyAPoseIsWrong) {
  Document document(
      "a: [0, 0, 0, 0, 0, 0, 0]\n"
      "b: [0, 0, 0, 0, 0, 0, 0.5]\n"
      "c: [0, 0, 0, 0, 0, 0, nan]\n"
      "d: [0, 0, 0, 0, 0, 1]\n"
      "e: [0, 350, 0, 0, 0, 0, 1]\n"
      "f: 3\n"
      "g: [0, 0, 0, 1e300, 0, 0, 1]\n");
  for (const char* key : {"a", "b", "c", "d", "e", "f", "g"}) {
    EXPECT_FALSE(document[key].PoseOf().has_value()) << key;
  }
  const std::string pose = "expected a pose [x, y, z, qx, qy, qz, qw] in metres\n";
  EXPECT_EQ(document.said(),
            "f:1: a: got a quaternion of length 0, expected unit length within 0.001\n"
            "f:2: b: got a quaternion of length 0.5, expected unit length within 0.001\n"
            "f:3: c[6]: got nan, expected a finite number\n"
            "f:4: d: got a list of 6, " +
                pose +
                "f:5: e[1]: got 350, expected a number in [-100, 100] [m]: is it in mm?\n"
                "f:6: f: got 3, " +
                pose +
                "f:7: g: got a quaternion of length 1e+300, expected unit length within 0.001\n");
}

TEST(YamlValue, ShowsLongAndManyLinedTextsShort) {
  Document document("a: \"" + std::string(200, 'x') + "\"\nb: \"one\\ntwo\"");
  EXPECT_EQ(document["a"].Shown(), "'" + std::string(60, 'x') + "...'");
  EXPECT_EQ(document["b"].Shown(), "'one two'");
}

TEST(MapReader, ReportsUnknownKeysWithTheNearestKnownOne) {
  Document document("lenght: 1\nname: x\ncolour: red\n");
  {
    MapReader map(document.root());
    map.Optional("length");
    map.Optional("name");
  }
  EXPECT_EQ(document.said(),
            "f:1: lenght: got an unknown key, did you mean 'length'?\n"
            "f:3: colour: got an unknown key, expected one of length, name\n");
}

TEST(MapReader, ReportsKeysThatStandTwice) {
  Document document("a: 1\nb: 2\na: 3\n");
  {
    MapReader map(document.root());
    EXPECT_EQ(map.Required("a").Number(NumberSpec::Any("")), 1);
    map.Optional("b");
  }
  EXPECT_EQ(document.said(),
            "f:3: a: got this key a second time, expected it once: it stands on line 1 already\n");
}

TEST(MapReader, ReportsWhatIsNoMapOnce) {
  Document document("- 1\n- 2\n");
  {
    MapReader map(document.root());
    EXPECT_FALSE(map.ok());
    EXPECT_FALSE(map.Required("a").Number(NumberSpec::Any("")).has_value());
  }
  EXPECT_EQ(document.said(), "f:1: got a list of 2, expected a map of keys\n");
}

TEST(MapReader, ReportsKeysThatAreNoTexts) {
  Document document("a: 1\n? [1, 2]\n: 3\n");
  { MapReader(document.root()).Optional("a"); }
  EXPECT_EQ(document.said(), "f:2: got a key that is not a text, expected one\n");
}

TEST(MapReader, NamesPathsThroughMapsAndLists) {
  Document document("cables:\n  - name: x\n  - name: y\n    a:\n      pose: 3\n");
  {
    MapReader map(document.root());
    const auto items = map.Required("cables").Items("a list");
    ASSERT_EQ(items.size(), 2u);
    MapReader first(items[0]);
    first.Optional("name");
    first.Required("b").Text();
    MapReader second(items[1]);
    second.Optional("name");
    MapReader a(second.Required("a"));
    a.Required("pose").PoseOf();
    a.Required("link").Text();
  }
  EXPECT_EQ(document.said(),
            "f:2: cables[0].b: missing, expected a text\n"
            "f:5: cables[1].a.pose: got 3, expected a pose [x, y, z, qx, qy, qz, qw] in metres\n"
            "f:4: cables[1].a.link: missing, expected a text\n");
}

TEST(MapReader, IsSilentBelowWhatIsAbsentOptionally) {
  Document document("a: 1");
  {
    MapReader map(document.root());
    map.Optional("a");
    MapReader apex(map.Optional("apex"));
    EXPECT_FALSE(apex.Required("s").Number(NumberSpec::Any("m")).has_value());
    EXPECT_TRUE(map.Optional("list").Items("a list").empty());
  }
  EXPECT_EQ(document.said(), "");
}

std::string SaidOfFile(const std::string& path) {
  Problems problems;
  EXPECT_FALSE(LoadYamlFile(path, &problems).given());
  return problems.ToString();
}

TEST(LoadYamlFile, ReportsWhatCannotBeRead) {
  EXPECT_EQ(SaidOfFile("/nowhere/x.yaml"),
            "/nowhere/x.yaml: cannot be read: No such file or directory\n");
  EXPECT_EQ(SaidOfFile("/tmp"), "/tmp: got a directory, expected a YAML file\n");
}

TEST(LoadYamlFile, ReportsMalformedYamlWithItsLine) {
  const TemporaryFile open_list("a: 1\nb: [1, 2\nc: 3\n");
  EXPECT_EQ(SaidOfFile(open_list.path()).rfind(open_list.path() + ":3: malformed YAML: ", 0), 0u)
      << SaidOfFile(open_list.path());
  const TemporaryFile tab("a:\n\tb: 1\n");
  EXPECT_EQ(SaidOfFile(tab.path()).rfind(tab.path() + ":2: malformed YAML: ", 0), 0u)
      << SaidOfFile(tab.path());
  const TemporaryFile alias("a: 1\nb: *none\n");
  EXPECT_EQ(SaidOfFile(alias.path()).rfind(alias.path() + ":2: malformed YAML: ", 0), 0u)
      << SaidOfFile(alias.path());
}

TEST(LoadYamlFile, ANameWithBracketsNeedsQuotesWithinBraces) {
  for (const auto& [text, line, name] :
       {std::tuple<const char*, const char*, const char*>{
            "a: 1\nb: {extensions.maxwell[0].tau: 0.1}\n", ":2: ", "extensions.maxwell[0].tau"},
        {"a: [EI,\n  faults.sensor[0].tilt[1],\n  GJ]\n", ":2: ", "faults.sensor[0].tilt[1]"},
        {"a: {b: it's, c: \"d[0]\", # e[1]\n  f[2]: 1}\n", ":2: ", "f[2]"}}) {
    const TemporaryFile file(text);
    const std::string said = SaidOfFile(file.path());
    EXPECT_EQ(said.rfind(file.path() + line + name + ": malformed YAML: ", 0), 0u) << said;
    EXPECT_NE(said.find(std::string("a name with brackets stands in quotes: '") + name + "'"),
              std::string::npos)
        << said;
  }
  for (const char* text : {"a: {\"b[0]\": 1, 'c[0].d': 2}\n", "a[0].b: 1\nc:\n  - d[1]\n"}) {
    const TemporaryFile file(text);
    Problems problems;
    EXPECT_TRUE(LoadYamlFile(file.path(), &problems).given());
    EXPECT_TRUE(problems.empty()) << problems.ToString();
  }
}

TEST(LoadYamlFile, ReportsEmptyFilesAndSecondDocuments) {
  const TemporaryFile empty("");
  EXPECT_EQ(SaidOfFile(empty.path()),
            empty.path() + ":1: got an empty file, expected a YAML document\n");
  const TemporaryFile two("a: 1\n---\nb: 2\n");
  EXPECT_EQ(SaidOfFile(two.path()),
            two.path() + ":3: got a second YAML document, expected one in the file\n");
}

// yaml-cpp makes documents without an end of the first two.
TEST(LoadYamlFile, ABracketThatClosesNothingIsTold) {
  for (const auto& [text, line] :
       {std::pair<const char*, const char*>{"   , a, b]\n\n  - name: b\n", ":1: "},
        {", a", ":1: "},
        {"a: [1, 2]]\n", ":1: malformed YAML: "},
        {"a: {b: 1}\n}\n", ":2: malformed YAML: "},
        {"]", ":1: "}}) {
    const TemporaryFile file(text);
    Problems problems;
    MapReader map(LoadYamlFile(file.path(), &problems));
    const std::string said = problems.ToString();
    EXPECT_EQ(said.rfind(file.path() + line, 0), 0u) << text << "\n" << said;
  }
}

TEST(LoadYamlFile, SurvivesBytesThatAreNoText) {
  const TemporaryFile noise(std::string("\x00\xff\xfe{[\x01\x80", 7));
  Problems problems;
  MapReader map(LoadYamlFile(noise.path(), &problems));
  EXPECT_FALSE(problems.empty());
}

}  // namespace
}  // namespace cosserat_cable
