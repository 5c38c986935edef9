#pragma once
#include "core/check.hpp"
#include "core/units.hpp"

#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// Settings are declared once. For a plain struct T,
///
///     template <> struct Schema<SeedConfig> {
///       static constexpr std::string_view doc = "Where material points are placed.";
///       static void describe(FieldVisitor& v, SeedConfig& c) {
///         v.quantity("spacing", c.spacing, Dim::length, {.above = 0.0}, "distance of points");
///         v.choice("method", c.method, kSeedMethods, "how points are placed");
///       }
///     };
///
/// and the visitors of this module read it from YAML (unit, range, unknown keys with the nearest
/// known one, file:line:column), write its canonical text for hashing, its manual page and its
/// JSON Schema. What has no default (NaN, empty text or path, an integer out of its range) must be
/// given; in a std::optional it may be left out. Visitors run at set-up only, never inside a step.
namespace flowslide {

/// Allowed values in SI. Bounds named `above`/`below` are exclusive, `min`/`max` inclusive.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  double above = -std::numeric_limits<double>::infinity();
  double below = std::numeric_limits<double>::infinity();
  [[nodiscard]] bool contains(double x) const {
    return x >= min && x <= max && x > above && x < below;
  }
};

/// A file named by the user, relative to the file that names it; its content, not its path, counts
/// for "has the input changed".
struct InputFile {
  std::filesystem::path path;
};

template <class T>
struct Schema;

class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;

  virtual void quantity(std::string_view key, double& value, Dim dim, Range range,
                        std::string_view doc) = 0;
  virtual void quantity(std::string_view key, std::optional<double>& value, Dim dim, Range range,
                        std::string_view doc) = 0;
  virtual void integer(std::string_view key, int& value, Range range, std::string_view doc) = 0;
  virtual void flag(std::string_view key, bool& value, std::string_view doc) = 0;
  virtual void text(std::string_view key, std::string& value, std::string_view doc) = 0;
  virtual void text(std::string_view key, std::optional<std::string>& value,
                    std::string_view doc) = 0;
  virtual void file(std::string_view key, InputFile& value, std::string_view doc) = 0;
  virtual void file(std::string_view key, std::optional<InputFile>& value,
                    std::string_view doc) = 0;
  /// Fixed-length tuple such as a point: `[1 m, 2 m]`.
  virtual void tuple(std::string_view key, std::span<double> values, Dim dim,
                     std::string_view doc) = 0;
  /// List of numbers of any length; may be empty.
  virtual void numbers(std::string_view key, std::vector<double>& values, Dim dim,
                       std::string_view doc) = 0;
  virtual void integers(std::string_view key, std::vector<int>& values, std::string_view doc) = 0;
  virtual void texts(std::string_view key, std::vector<std::string>& values,
                     std::string_view doc) = 0;
  /// Table whose rows are tuples, e.g. `[[25 kPa, 3 kPa], ...]`; `columns` gives name and
  /// dimension.
  struct Column {
    std::string_view name;
    Dim dim;
  };
  virtual void rows(std::string_view key, std::vector<std::vector<double>>& values,
                    std::span<const Column> columns, std::string_view doc) = 0;

  /// A key of an older version of the program: refused with `text`, "(why) what to write now".
  /// With Moved::list the key lives on, but not as a list; before the field that it is now.
  enum class Moved { key, list };
  virtual void moved(std::string_view, std::string_view, Moved = Moved::key) {}
  /// A setting of another stage, which a reference to all of that stage's settings brings along: it
  /// may stand there and says nothing.
  virtual void passed_over(std::string_view) {}

  /// An enumeration whose enumerators are 0, 1, 2, ... and are spelled as in `names`.
  template <class E, std::size_t N>
  requires std::is_enum_v<E>
  void choice(std::string_view key, E& value, const std::array<std::string_view, N>& names,
              std::string_view doc) {
    int index = static_cast<int>(value);
    choice_index(key, index, names, doc);
    value = static_cast<E>(index);
  }

  template <class T>
  void group(std::string_view key, T& value, std::string_view doc) {
    if (begin_group(key, Presence::required_or_default, doc)) Schema<T>::describe(*this, value);
    end_group();
  }

  /// Left out by the user: stays empty.
  template <class T>
  void group(std::string_view key, std::optional<T>& value, std::string_view doc) {
    if (begin_group(key, value ? Presence::present : Presence::absent, doc)) {
      if (!value) value.emplace();
      Schema<T>::describe(*this, *value);
    }
    end_group();
  }

  /// List of structs: `key: [{...}, {...}]`.
  template <class T>
  void list(std::string_view key, std::vector<T>& values, std::string_view doc) {
    const std::size_t n = begin_list(key, values.size(), doc);
    if (replaces_defaults()) values.clear();
    values.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      if (begin_item(i)) Schema<T>::describe(*this, values[i]);
      end_group();
    }
    end_list();
  }

  /// Named structs: `key: {tailings: {...}, dam: {...}}`; order is alphabetical.
  template <class T>
  void table(std::string_view key, std::map<std::string, T>& values, std::string_view doc) {
    std::vector<std::string> names;
    for (const auto& [name, unused] : values) names.push_back(name);
    const std::vector<std::string> entries = begin_table(key, names, doc);
    if (replaces_defaults()) values.clear();
    for (const std::string& name : entries) {
      T& item = values[name];
      if (begin_entry(name)) Schema<T>::describe(*this, item);
      end_group();
    }
    end_table();
  }

 protected:
  enum class Presence { required_or_default, present, absent };

  virtual void choice_index(std::string_view key, int& index,
                            std::span<const std::string_view> names, std::string_view doc) = 0;
  /// Each begin returns whether the fields inside are to be visited; end_group is always called.
  virtual bool begin_group(std::string_view key, Presence presence, std::string_view doc) = 0;
  virtual void end_group() = 0;
  /// Returns the length the list has afterwards (the reader: as in the file; documentation: 1).
  virtual std::size_t begin_list(std::string_view key, std::size_t size, std::string_view doc) = 0;
  virtual bool begin_item(std::size_t index) = 0;
  virtual void end_list() = 0;
  /// Returns the names of the entries (the reader: as in the file; documentation: "<name>").
  virtual std::vector<std::string> begin_table(std::string_view key,
                                               const std::vector<std::string>& names,
                                               std::string_view doc) = 0;
  virtual bool begin_entry(const std::string& name) = 0;
  virtual void end_table() = 0;
  /// Asked after begin_list and begin_table: do the entries come from the file, so that none of the
  /// default ones may shine through?
  [[nodiscard]] virtual bool replaces_defaults() const { return false; }
};

namespace detail {
std::string canonical_fields(const std::function<void(FieldVisitor&)>& describe);
}  // namespace detail

/// Canonical text of settings: one `path = value` line per field in order of declaration, numbers
/// in SI and shortest round-trip form, files as the SHA-256 of their content. Equal settings,
/// however they were spelled, give equal text. Throws FileError for a missing file.
template <class T>
std::string canonical_text(const T& settings) {
  T copy = settings;
  return detail::canonical_fields([&](FieldVisitor& v) { Schema<T>::describe(v, copy); });
}

}  // namespace flowslide
