#pragma once
#include "config/yaml.hpp"
#include "tests/support/scratch.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// A file case.yaml in a folder of its own, and settings that use every kind of field.
namespace flowslide::sample {

class YamlFile {
 public:
  explicit YamlFile(std::string_view text) { std::ofstream(path(), std::ios::binary) << text; }
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "case.yaml"; }
  [[nodiscard]] std::filesystem::path folder() const { return folder_.path(); }

 private:
  Scratch folder_;
};

/// The message of `use(file)` with places as "case.yaml:1:2"; "" if it does not throw.
template <class Use>
std::string problem_of(std::string_view text, Use use) {
  const YamlFile file(text);
  try {
    use(file.path());
  } catch (const InputError& e) {
    std::string message = e.what();
    const std::string folder = file.folder().string() + "/";
    for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder))
      message.erase(at, folder.size());
    return message;
  }
  return "";
}

inline std::string load_problem(std::string_view text, std::vector<std::string> overrides = {}) {
  return problem_of(text, [&](const auto& path) { load_yaml(path, overrides); });
}

enum class Method { lattice, gauss };
inline constexpr std::array<std::string_view, 2> kMethods = {"lattice", "gauss"};

struct Layer {
  double depth = kUnset;
  std::optional<double> ratio = {};
  int count = 3;
};

struct Settings {
  double spacing = kUnset;
  double slope = 0.1;
  Method method = Method::lattice;
  bool verbose = false;
  std::string title = "run";
  std::optional<InputFile> mesh = {};
  std::array<double, 2> toe{0.0, 0.0};
  std::vector<double> times = {};
  std::vector<int> ids = {};
  std::vector<std::string> names = {};
  std::vector<std::vector<double>> strength = {};
  Layer base{.depth = 1.0};
  std::optional<Layer> top = {};
  std::vector<Layer> layers = {};
  std::map<std::string, Layer> zones = {};
};

}  // namespace flowslide::sample

namespace flowslide {

template <>
struct Schema<sample::Layer> {
  static constexpr std::string_view doc = "A layer.";
  static void describe(FieldVisitor& v, sample::Layer& c) {
    v.quantity("depth", c.depth, Dim::length, {.min = 0.0}, "depth of the layer");
    v.quantity("ratio", c.ratio, Dim::none, {.max = 1.0, .above = 0.0}, "a share");
    v.integer("count", c.count, {.min = 1, .max = 9}, "number of points");
  }
};

template <>
struct Schema<sample::Settings> {
  static constexpr std::string_view doc = "Settings with every kind of field.";
  static void describe(FieldVisitor& v, sample::Settings& c) {
    v.quantity("spacing", c.spacing, Dim::length, {.max = 10.0, .above = 0.0},
               "distance of points");
    v.quantity("slope", c.slope, Dim::angle, {.min = 0.0, .below = 1.5707963267948966}, "slope");
    v.choice("method", c.method, sample::kMethods, "how points are placed");
    v.flag("verbose", c.verbose, "says more");
    v.text("title", c.title, "heading");
    v.file("mesh", c.mesh, "mesh file");
    v.tuple("toe", c.toe, Dim::length, "toe of the dam");
    v.numbers("times", c.times, Dim::time, "times of output");
    v.integers("ids", c.ids, "element ids");
    v.texts("names", c.names, "names of sets");
    static constexpr std::array columns = {FieldVisitor::Column{"depth", Dim::length},
                                           FieldVisitor::Column{"ratio", Dim::none}};
    v.rows("strength", c.strength, columns, "strength by depth");
    v.group("base", c.base, "lowest layer");
    v.group("top", c.top, "uppermost layer");
    v.list("layers", c.layers, "layers between");
    v.table("zones", c.zones, "zones by name");
  }
};

}  // namespace flowslide
